"""The order of strokes: nothing gets lost, nothing gets slower, and small cases come out best."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.drawing.order import HopCost, Improvement, order_strokes, pen_up_mm, pen_up_s
from app.drawing.order.cost import DEFAULT_COST
from app.drawing.order.greedy import greedy_tour
from app.drawing.order.tour import Ends, in_order
from tests.drawing.order_strokes import PLAIN, circle, random_strokes, same_strokes


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
    assert len(order_strokes([np.zeros((2, 2))] * 5000)) == 5000


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
