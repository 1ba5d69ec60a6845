"""What the order of strokes is made of: beginnings of closed strokes, strokes that touch, hops and their exchange."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.order import is_closed, join_touching, order_strokes, pen_up_mm, pen_up_s, reseat
from app.drawing.order.moves import _stays_whole, new_hops
from app.drawing.order.tour import Ends, Tour
from tests.drawing.order_strokes import PLAIN, circle, random_strokes, same_strokes


def test_closed_strokes_begin_where_it_is_best():
    """Circles about home: from ring to ring along one ray, whichever, and the direction of drawing stays."""
    rings = [circle(0.0, 0.0, radius, begin=radius) for radius in (30.0, 10.0, 20.0, 40.0)]
    ordered = order_strokes(rings)
    assert same_strokes(ordered, rings)
    assert pen_up_mm(ordered) == pytest.approx(40.0, abs=0.5)
    (ring,) = reseat([circle(10.0, 0.0, 3.0, begin=2.0)], home=(100.0, 0.0))
    assert ring[0] == pytest.approx([13.0, 0.0], abs=0.16) and is_closed(ring)
    rolled = [tuple(each) for each in circle(10.0, 0.0, 3.0, begin=2.0)[:-1].tolist()]
    at = rolled.index(tuple(ring[0].tolist()))
    assert [tuple(each) for each in ring[:-1].tolist()] == rolled[at:] + rolled[:at]


def test_the_beginnings_in_a_given_order_are_the_best():
    """Two polygons between two lines, against all pairs of beginnings."""
    for seed in range(10):
        rng = np.random.default_rng(seed)
        first, last, *corners = rng.uniform(0.0, 50.0, (18, 2))
        polygons = [np.array([*part, part[0]]) for part in (corners[:7], corners[7:])]
        strokes = [np.array([first, first + 1.0]), *polygons, np.array([last, last + 1.0])]
        best = min(
            math.dist(first + 1.0, a) + math.dist(a, b) + math.dist(b, last)
            for a, b in itertools.product(polygons[0], polygons[1])
        )
        got = reseat(strokes, tuple(first), PLAIN)
        assert pen_up_mm(got, tuple(first)) == pytest.approx(best)
        assert same_strokes(got, strokes)
        assert got[0] is strokes[0] and got[3] is strokes[3]


def test_rings_that_touch_are_drawn_in_one_go():
    """They touch in one of 97 points, on the side away from home: farther, but without a second lift."""
    for rolled in (38, 41, 59):
        inner, outer = circle(0.0, 0.0, 5.0, 97, begin=-np.pi / 2), circle(0.0, 1.0, 6.0, 97, begin=-np.pi / 2)
        inner, outer = (np.concatenate([ring[rolled:-1], ring[: rolled + 1]]) for ring in (inner, outer))
        assert pen_up_s(reseat([inner, outer], (0.0, 50.0)), (0.0, 50.0)) == pytest.approx(0.15 + 55.0 / 300.0)


def test_a_dot_and_a_line_are_not_closed():
    assert not is_closed(np.zeros((2, 2)))
    assert not is_closed(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1e-9]]))
    assert is_closed(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]))


def test_what_touches_becomes_one_stroke():
    a, b, dot = np.array([[0.0, 0.0], [1.0, 0.0]]), np.array([[1.0, 0.0], [1.0, 5.0]]), np.full((2, 2), 5.0)
    near, far = np.array([[1.04, 5.0], [9.0, 9.0]]), np.array([[9.1, 9.0], [9.0, 9.0]])
    joined = join_touching([a, b, near, far, dot, dot])
    assert [each.tolist() for each in joined] == [
        [[0.0, 0.0], [1.0, 0.0], [1.0, 5.0], [1.04, 5.0], [9.0, 9.0]],
        far.tolist(),
        dot.tolist(),
    ]
    assert len(join_touching([a, b, near, far], touch_mm=0.0)) == 3 and join_touching([]) == []
    assert joined[1] is far
    for strokes in ([a, b, near], [dot, dot], [a, dot[:] * 0.2 * [1, 0]]):
        assert pen_up_s(join_touching(strokes)) == pytest.approx(pen_up_s(strokes))


def test_near_ends():
    strokes = random_strokes(20, 4)
    ends = Ends(strokes, (1.0, 2.0), PLAIN)
    index, seconds = ends.near(5)
    for end in range(41):
        others = [other for other in range(41) if other >> 1 != end >> 1]
        by_way = sorted(others, key=lambda other: math.dist(ends.points[end], ends.points[other]))
        assert index[end].tolist() == by_way[:5]
        assert seconds[end] == pytest.approx([math.dist(ends.points[end], ends.points[other]) for other in by_way[:5]])
    assert np.isinf(seconds[41]).all()
    assert np.isfinite(Ends(strokes[:2], (1.0, 2.0), PLAIN).near(5)[1]).sum(axis=1).tolist() == [3, 3, 3, 3, 4, 0]


def one_ring(partner):
    """Whether one leaves no end out on going from stroke to hop to stroke."""
    end, seen = 0, 0
    while True:
        end, seen = partner[end ^ 1], seen + 2
        if end == 0:
            return seen == len(partner)


@given(st.integers(0, 10**6), st.integers(2, 4), st.integers(4, 12))
def test_exchanging_hops(seed, hops, strokes):
    """Exactly the hops asked for, one ring, or a refusal; and it can be taken back."""
    rng = np.random.default_rng(seed)
    tour = Tour.as_given(strokes)
    size = 2 * strokes + 2
    for _ in range(5):
        lefts = 2 * rng.permutation(strokes + 1)[:hops]
        chain = [tour.ring[place] for left in lefts.tolist() for place in rng.permutation([left, left + 1])]
        wanted = {end: tour.partner(end) for end in range(size)}
        for a, b in new_hops(chain):
            wanted |= {a: b, b: a}
        whole, before = one_ring(wanted), tour.ring[:]
        if hops == 3:
            assert _stays_whole(tour.places[chain][None]).tolist() == [whole]
        undo = tour.exchange(new_hops(chain))
        assert (undo is not None) == whole
        if undo:
            after = tour.ring[:]
            assert {end: tour.partner(end) for end in range(size)} == wanted
            assert all(tour.ring[tour.place[end]] == end for end in range(size))
            tour.restore(undo)
            assert tour.ring == before and tour.exchange(new_hops(chain)) and tour.ring == after
            assert sorted(entry // 2 for entry in tour.entries()) == list(range(strokes))
            assert tour.entries()[0] == wanted[2 * strokes]
