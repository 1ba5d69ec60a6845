"""Tracing visits every pixel, and every line between two meetings once."""

from __future__ import annotations

import numpy as np
from hypothesis import given

from app.drawing.vectorise.pixel_graph import trace
from app.drawing.vectorise.thinning import thin
from tests.drawing.vectorise.test_thinning import masks


def mask_of(text: str) -> np.ndarray:
    return np.array([[character == "#" for character in row] for row in text.split()])


def lines_of(text: str) -> list[list[tuple[int, int]]]:
    return [[tuple(point) for point in line.astype(int).tolist()] for line in trace(mask_of(text)).lines]


def test_a_line_in_order():
    (found,) = lines_of("""
        #.....
        .#....
        ..##..
        ....#.
        ....#.""")
    way = [(0, 0), (1, 1), (2, 2), (3, 2), (4, 3), (4, 4)]
    assert found in (way, way[::-1])


def test_a_ring_comes_back_to_its_first_point():
    (ring,) = lines_of("""
        .##.
        #..#
        .##.""")
    assert ring[0] == ring[-1] and len(set(ring)) == 6 and len(ring) == 7


def test_a_corner_is_no_junction():
    """Two pixels with a common neighbour by its sides are not joined across the corner."""
    (line,) = lines_of("""
        ##.
        .##
        ..#""")
    assert len(line) == 5


def test_a_tee_is_three_branches_that_share_their_junction():
    branches = trace(
        mask_of("""
        .......
        #######
        ...#...
        ...#...""")
    )
    assert sorted(len(line) for line in branches.lines) == [3, 4, 4]
    assert all((3, 1) in map(tuple, line.astype(int).tolist()) for line in branches.lines)
    assert np.sort(branches.degrees, axis=1).tolist() == [[1, 3]] * 3
    assert len(np.unique(branches.nodes)) == 4


def test_a_loop_on_a_stick():
    branches = trace(
        mask_of("""
        .##...
        #..###
        .##...""")
    )
    ends = [nodes for nodes in branches.nodes.tolist() if nodes[0] == nodes[1]]
    assert len(branches.lines) == 2 and len(ends) == 1


def test_lone_pixels_and_none():
    branches = trace(mask_of("#..#"))
    assert [line.tolist() for line in branches.lines] == [[[0, 0]], [[3, 0]]] and not branches.degrees.any()
    assert trace(np.zeros((4, 4), bool)).lines == []


@given(masks())
def test_every_pixel_once(mask):
    """Pixels inside a branch belong to it alone; steps go from neighbour to neighbour."""
    thinned = thin(mask)
    lines = trace(thinned).lines
    inner = np.concatenate([line[1:-1] for line in lines if len(line) > 2] or [np.zeros((0, 2))])
    assert len(np.unique(inner, axis=0)) == len(inner)
    seen = np.zeros_like(thinned)
    for line in lines:
        x, y = line.astype(int).T
        seen[y, x] = True
        assert np.abs(np.diff(line, axis=0)).max(initial=0) <= 1
    assert (seen == thinned).all()


def test_the_ink_of_a_thousand_branches_is_each_edge_once():
    """A lattice has so many unit edges; tracing must draw exactly those."""
    mask = np.zeros((201, 301), bool)
    mask[::10], mask[:, ::10] = True, True
    lines = trace(mask).lines
    steps = sum(len(line) - 1 for line in lines)
    assert steps == 21 * 300 + 31 * 200 and len(lines) == 21 * 30 + 31 * 20 - 4
