"""Chains, junctions and gaps: which lines are drawn in one go."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.vectorise.chains import chains, lengths, outward, tied
from app.drawing.vectorise.gaps import join_gaps
from app.drawing.vectorise.junctions import through_junctions
from app.drawing.vectorise.pixel_graph import Branches, trace
from app.drawing.vectorise.thinning import thin
from tests.drawing.vectorise.pictures import arc, inked, polygon, walked


def through(*lines: np.ndarray) -> list[np.ndarray]:
    """Lines drawn one pixel wide, traced and passed through their junctions."""
    mask = np.zeros((120, 120), bool)
    for line in lines:
        x, y = np.rint(walked(line)).astype(int).T
        mask[y, x] = True
    return through_junctions(trace(thin(mask)), np.full(mask.shape, 0.5, np.float32))


@given(st.integers(1, 12), st.randoms(use_true_random=False))
def test_every_line_is_in_one_chain(count, random):
    ends = random.sample(range(2 * count), 2 * random.randint(0, count))
    links = list(zip(ends[::2], ends[1::2], strict=True))
    found = chains(count, links)
    assert sorted(entry // 2 for chain, _ in found for entry in chain) == list(range(count))
    followed = [{before ^ 1, after} for chain, _ in found for before, after in pairwise(chain)]
    followed += [{chain[-1] ^ 1, chain[0]} for chain, closed in found if closed]
    assert sorted(map(sorted, followed)) == sorted(sorted(link) for link in links)


def test_tied_lines_run_on_without_a_gap():
    lines = [polygon((0, 0), (1, 0)), polygon((9, 5), (5, 2)), polygon((9, 6), (9, 7))]
    (line,) = tied(lines, [(1, 3), (2, 4)])
    assert line[0].tolist() == [0, 0] and line[-1].tolist() == [9, 7]
    assert np.hypot(*np.diff(line, axis=0).T).max() <= 5.0
    assert lengths([line])[0] == pytest.approx(1 + np.hypot(4, 2) + 5 + 1 + 1)


def test_a_chain_that_closes_repeats_its_first_point():
    (line,) = tied([polygon((0, 0), (3, 0), (3, 3), (0, 3))], [(0, 1)])
    assert line[0].tolist() == line[-1].tolist() == [0, 0] and lengths([line])[0] == pytest.approx(12)


def test_outward():
    line = polygon((0, 0), (1, 0), (2, 0), (2, 1), (2, 2))
    ways = outward([line, line[:1]], np.zeros(4, int), np.full(4, 2))
    np.testing.assert_allclose(ways, [[-1, 0], [0, 1], [0, 0], [0, 0]])


@pytest.mark.parametrize("turn", [90, 70, 50])
def test_crossing_lines_go_straight_through(turn):
    way = 50 * np.array([np.cos(np.radians(turn)), np.sin(np.radians(turn))])
    found = through(polygon((10, 60), (110, 60)), np.array([60 - way, 60 + way]))
    assert len(found) == 2
    for line in found:
        assert np.hypot(*(line[-1] - line[0])) == pytest.approx(lengths([line])[0], rel=0.1)


def test_a_tee_is_a_line_and_a_leg_that_draw_nothing_twice():
    found = sorted(through(polygon((10, 60), (110, 60)), polygon((60, 60), (60, 110))), key=len)
    assert [round(length) for length in lengths(found)] == [49, 100]


def test_a_loop_on_a_stick_is_a_closed_stroke_and_the_stick():
    loop, stick = sorted(through(polygon((10, 60), (60, 60)), arc(80, 60, 20)), key=len, reverse=True)
    assert (loop[0] == loop[-1]).all() and len(np.unique(loop, axis=0)) == len(loop) - 1
    assert lengths([stick])[0] == pytest.approx(48, abs=2)


@pytest.mark.parametrize(("rise", "strokes"), [(0.35, 3), (2.0, 2)])
def test_no_turning_back(rise, strokes):
    """Three lines leave a point to one side: nearly alike, each is a stroke; well apart, the outer two are one."""
    x = np.arange(20.0)
    lines = [np.column_stack([x, 50 + slope * x]) for slope in (-rise, 0.0, rise)]
    branches = Branches(lines, np.array([[0, 1], [0, 2], [0, 3]]), np.array([[3, 1]] * 3))
    assert len(through_junctions(branches, np.full((100, 100), 0.5, np.float32))) == strokes


@pytest.mark.parametrize(("whisker", "strokes"), [(4, 1), (12, 2)])
def test_whiskers_go(whisker, strokes):
    """A short leg of a line 6 pixels wide comes from its thinning, a long one was drawn."""
    lines = [walked(polygon((50, 50), end), 1.0) for end in ((10, 50), (90, 50), (50, 50 + whisker))]
    branches = Branches(lines, np.array([[0, 1], [0, 2], [0, 3]]), np.array([[3, 1]] * 3))
    assert len(through_junctions(branches, np.full((100, 100), 3.0, np.float32))) == strokes


def test_a_corner_of_thick_ink_is_one_stroke():
    ink = inked([polygon((60, 60), (400, 60), (400, 300))], width=15)[:400, :500] < 128
    lines = through_junctions(trace(thin(ink)), np.full(ink.shape, 7.0, np.float32))
    assert len(lines) == 1


def test_a_gap_ahead_is_drawn_over():
    lines = [walked(polygon((0, 0), (20, 0)), 1.0), walked(polygon((45, 0), (24, 0)), 1.0)]
    (line,) = join_gaps(lines, 5.0)
    assert lengths([line])[0] == pytest.approx(45)
    assert len(join_gaps(lines, 3.0)) == 2 and len(join_gaps(lines, 0.0)) == 2


def test_a_hairpin_has_less_reach_than_a_straight_gap():
    side_by_side = [walked(polygon((0, y), (30, y)), 1.0) for y in (0, 4.8)]
    assert len(join_gaps(side_by_side, 5.0)) == 2
    assert len(join_gaps(side_by_side, 9.0)) == 1


def test_an_open_circle_closes_and_a_tick_does_not():
    t = np.linspace(0.1, 2 * np.pi - 0.1, 120)
    circle = 20 * np.column_stack([np.cos(t), np.sin(t)])
    (closed,) = join_gaps([circle], 5.0)
    assert (closed[0] == closed[-1]).all()
    tick = np.concatenate([walked(polygon((0, 0), (5, 0)), 1.0), walked(polygon((5, 0), (2, 3)), 1.0)])
    (open_,) = join_gaps([tick], 5.0)
    assert (open_[0] != open_[-1]).any()


def test_near_ends_are_joined_first_and_straight_ones_before_others():
    lines = [walked(polygon((0, 0), (20, 0)), 1.0), walked(polygon((22, 0), (40, 0)), 1.0)]
    lines.append(walked(polygon((23, 1), (40, 9)), 1.0))
    joined = [sorted(line[[0, -1]].tolist()) for line in join_gaps(lines, 5.0)]
    assert [[0, 0], [40, 0]] in joined and len(joined) == 2
