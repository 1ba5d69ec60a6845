"""The order of strokes: nothing gets lost, nothing gets slower, and small cases come out best."""

from __future__ import annotations

import itertools
import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing.order import HopCost, Improvement, is_closed, join_touching, order_strokes, pen_up_mm, pen_up_s, reseat
from app.drawing.order.cost import DEFAULT_COST
from app.drawing.order.greedy import greedy_tour
from app.drawing.order.moves import _stays_whole, new_hops
from app.drawing.order.tour import Ends, Tour, in_order

PLAIN = HopCost(lift_s=0.0, speed_mm_s=1.0, touch_mm=0.0)


def random_strokes(count, seed=0, size=160.0):
    rng = np.random.default_rng(seed)
    starts = rng.uniform(-size / 2, size / 2, (count, 1, 2))
    return list(starts + np.cumsum(rng.normal(0.0, 2.0, (count, 3, 2)), axis=1))


def circle(x, y, radius, points=60, begin=0.0):
    angle = np.linspace(0.0, 2.0 * np.pi, points + 1) + begin
    ring = np.column_stack([x + radius * np.cos(angle), y + radius * np.sin(angle)])
    ring[-1] = ring[0]
    return ring


def canonical(stroke):
    """Equal for strokes that are the same up to direction and, if closed, the point where they begin."""
    points = [tuple(point) for point in stroke.tolist()]
    ways = [points, points[::-1]]
    if points[0] == points[-1]:
        ways = [way[k:-1] + way[: k + 1] for way in ways for k in range(len(way) - 1)]
    return min(ways)


def same_strokes(one, other):
    return sorted(map(canonical, one)) == sorted(map(canonical, other))


def shortest_s(strokes, home, cost):
    """The optimum over all orders and directions, by dynamic programming over sets of strokes."""
    ways = [(k, stroke[begin], stroke[-1 - begin]) for k, stroke in enumerate(strokes) for begin in (0, -1)]
    best = {(1 << k, end): float(cost.seconds(math.dist(home, ways[end][1]))) for end, (k, _, _) in enumerate(ways)}
    for _ in strokes[1:]:
        longer: dict[tuple[int, int], float] = {}
        for (done, last), seconds in best.items():
            for end, (k, begin, _) in enumerate(ways):
                if not done >> k & 1:
                    total = seconds + float(cost.seconds(math.dist(ways[last][2], begin)))
                    key = (done | 1 << k, end)
                    longer[key] = min(longer.get(key, math.inf), total)
        best = longer
    return min(best.values())


coordinate = st.integers(-40, 40).map(float)
point = st.tuples(coordinate, coordinate)
line = st.lists(point, min_size=2, max_size=6)
stroke = st.one_of(line, line.map(lambda points: [*points, points[0]]), point.map(lambda p: [p, p])).map(np.array)


@given(st.lists(stroke, max_size=14), point, st.integers(0, 3))
@settings(max_examples=50)
def test_the_same_strokes_never_slower(strokes, home, seed):
    before = [each.copy() for each in strokes]
    ordered = order_strokes(strokes, home=home)
    assert same_strokes(ordered, strokes)
    assert pen_up_s(ordered, home) <= pen_up_s(strokes, home) + 1e-9
    improvement = Improvement(ordered, home=home, seed=seed)
    improvement.improve(steps=20)
    assert same_strokes(improvement.strokes, strokes)
    assert improvement.pen_up_s <= pen_up_s(ordered, home) + 1e-9
    assert all((each == old).all() for each, old in zip(strokes, before, strict=True)), "the input is left alone"


@pytest.mark.parametrize("count", [1, 2, 3, 5, 7])
@pytest.mark.parametrize("cost", [PLAIN, HopCost(touch_mm=8.0)])
def test_few_strokes_come_out_best(count, cost):
    for seed in range(2):
        strokes, home = random_strokes(count, seed, size=30.0), (5.0, -20.0)
        improvement = Improvement(order_strokes(strokes, home=home, hop_cost=cost), home, cost)
        improvement.improve(steps=150)
        assert improvement.pen_up_s == pytest.approx(shortest_s(strokes, home, cost))


def test_rows_are_drawn_to_and_fro():
    """Rows 2 mm apart: 2 mm a hop, from the corner at home on."""
    rows = [np.array([[0.0, y], [50.0, y]]) for y in np.arange(0.0, 80.0, 2.0)]
    shuffled = [rows[k][:: 1 if k % 3 else -1] for k in np.random.default_rng(1).permutation(len(rows))]
    improvement = Improvement(order_strokes(shuffled, home=(-3.0, 0.0)), home=(-3.0, 0.0))
    improvement.improve(steps=300)
    ordered = improvement.strokes
    assert improvement.pen_up_mm == pytest.approx(3.0 + 39 * 2.0)
    assert [each[0].tolist() for each in ordered[:3]] == [[0.0, 0.0], [50.0, 2.0], [0.0, 4.0]]


def test_pieces_that_touch_are_drawn_in_one_go():
    """Cheaper than a shorter way with lifts: a lift takes as long as 45 mm."""
    angle = np.linspace(0.0, 12.0, 121)
    spiral = np.column_stack([angle * np.cos(angle), angle * np.sin(angle)])
    pieces = [spiral[k : k + 7] for k in range(0, 120, 6)]
    shuffled = [pieces[k][:: 1 if k % 2 else -1] for k in np.random.default_rng(2).permutation(len(pieces))]
    ordered = order_strokes(shuffled, home=(100.0, 0.0))
    far = math.dist((100.0, 0.0), spiral[-1])
    assert pen_up_mm(ordered, (100.0, 0.0)) == pytest.approx(far)
    assert pen_up_s(ordered, (100.0, 0.0)) == pytest.approx(0.15 + far / 300.0)


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


def test_never_touching():
    assert HopCost(touch_mm=-1.0).seconds(0.0) == 0.15
    strokes = random_strokes(7, 1, size=10.0)
    cost = HopCost(touch_mm=-1.0)
    ordered = order_strokes([*strokes, *(each + 1.0 for each in strokes)], hop_cost=cost, budget_s=0.05)
    assert pen_up_s(ordered, hop_cost=cost) == pytest.approx(14 * 0.15 + pen_up_mm(ordered) / 300.0)


def test_the_price_of_hops():
    cost = HopCost(lift_s=0.2, speed_mm_s=100.0, touch_mm=1.0)
    assert cost.seconds([0.0, 1.0, 1.5, 300.0]).tolist() == pytest.approx([0.0, 0.0, 0.215, 3.2])
    strokes = [
        np.array([[3.0, 4.0], [9.0, 9.0]]),
        np.array([[9.0, 8.0], [0.0, 0.0]]),
        np.array([[0.0, 2.0], [1.0, 1.0]]),
    ]
    assert pen_up_mm(strokes) == pytest.approx(5.0 + 1.0 + 2.0)
    assert pen_up_s(strokes, hop_cost=cost) == pytest.approx(0.25 + 0.0 + 0.22)
    assert pen_up_mm([]) == pen_up_s([]) == 0.0


def test_nothing_one_stroke_and_dots():
    assert order_strokes([]) == []
    (only,) = order_strokes([np.array([[9.0, 0.0], [5.0, 0.0], [1.0, 0.0]])])
    assert only.tolist() == [[1.0, 0.0], [5.0, 0.0], [9.0, 0.0]]
    dots = [np.full((2, 2), float(k)) for k in (3, 1, 2, 5, 4, 1)]
    assert [each[0, 0] for each in order_strokes(dots, home=(0.0, 0.0))] == [1, 1, 2, 3, 4, 5]
    assert len(order_strokes([np.zeros((2, 2))] * 50, budget_s=0.02)) == 50


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


def test_circles_that_touch_are_drawn_in_one_go():
    """They have a single point in common, out of 97."""
    for begin in (0.3, 1.0, 4.0):
        left, right = circle(0.0, 0.0, 20.0, 97), circle(40.0, 0.0, 20.0, 97, begin=np.pi)
        left, right = (
            np.concatenate([ring[k:-1], ring[: k + 1]]) for ring, k in ((left, 41), (right, int(10 * begin)))
        )
        assert (
            pen_up_s(reseat([left, right], home=(0.0, 90.0)), (0.0, 90.0)) < 2 * 0.15 + math.hypot(20.0, 90.0) / 300.0
        )


def test_a_dot_and_a_line_are_not_closed():
    assert not is_closed(np.zeros((2, 2)))
    assert not is_closed(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1e-9]]))
    assert is_closed(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]))


def test_it_repeats():
    strokes = [*random_strokes(60, 3), *(circle(x, 20.0, 5.0, 20) for x in range(-60, 60, 30))]

    def improved(seed, parts):
        improvement = Improvement(order_strokes(strokes), seed=seed)
        for steps in parts:
            improvement = pickle.loads(pickle.dumps(improvement))
            improvement.improve(steps=steps)
        return improvement

    one, again, other = improved(1, [205, 30]), improved(1, [205, 30]), improved(2, [205, 30])
    assert one.steps == 235
    assert all((a == b).all() for a, b in zip(one.strokes, again.strokes, strict=True))
    assert [each.tolist() for each in one.strokes] != [each.tolist() for each in other.strokes]
    assert one.pen_up_mm == pen_up_mm(one.strokes) and one.pen_up_s < pen_up_s(order_strokes(strokes))


def test_more_steps_help():
    strokes = random_strokes(200, 5)
    improvement = Improvement(order_strokes(strokes))
    before = improvement.pen_up_mm
    improvement.improve(steps=300)
    assert improvement.pen_up_mm < 0.995 * before
    assert same_strokes(improvement.strokes, strokes)


def test_it_stops_by_itself():
    for count in (1, 2, 5):
        improvement = Improvement(random_strokes(count))
        improvement.improve()
        assert improvement.finished


def test_cancelling_keeps_what_there_is():
    strokes = random_strokes(300, 7)
    calls = []

    def cancel_at(number):
        def progress(share):
            calls.append(share)
            return len(calls) < number

        calls.clear()
        return order_strokes(strokes, budget_s=60.0, progress=progress)

    for number in (1, 3, 40):
        got = cancel_at(number)
        assert same_strokes(got, strokes) and len(calls) <= number + 3
        assert pen_up_s(got) <= pen_up_s(strokes)
    assert 0.0 < calls[-1] < 0.2 and calls == sorted(calls)


def test_the_order_given_is_kept_if_it_cannot_be_beaten():
    strokes = order_strokes(random_strokes(60, 9))
    improvement = Improvement(strokes)
    improvement.improve(steps=300)
    best = improvement.strokes
    assert pen_up_s(order_strokes(best)) <= pen_up_s(best)
    assert pen_up_s(order_strokes(best, progress=lambda share: False)) <= pen_up_s(best)


def test_many_strokes():
    """Far better than the greedy order, and still one of the same strokes."""
    strokes = random_strokes(20_000, 11)
    greedy = in_order(strokes, greedy_tour(Ends(strokes, (0.0, 0.0), DEFAULT_COST)))
    ordered = order_strokes(strokes)
    assert sorted(each[1].tolist() for each in ordered) == sorted(each[1].tolist() for each in strokes)
    assert pen_up_mm(ordered) < 0.88 * pen_up_mm(greedy)


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
