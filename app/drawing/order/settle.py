"""Strokes in a good order, at once: exchanges of hops, then where closed strokes begin, and again."""

from __future__ import annotations

import math
from collections.abc import Callable

from app.drawing.order.cost import Array, HopCost, pen_up_s
from app.drawing.order.greedy import greedy_tour
from app.drawing.order.moves import EPS, descend
from app.drawing.order.reseat import is_closed, reseat
from app.drawing.order.tour import Ends, Tour, in_order

MAX_ROUNDS = 5
"""Of hops and beginnings. Later ones bring next to nothing."""


def first_order(
    strokes: list[Array], home: tuple[float, float], hop_cost: HopCost, go_on: Callable[[], bool]
) -> list[Array]:
    """From the greedy order and, if it is quicker than that, from the order given; the quicker of both results."""

    def seconds(order: list[Array]) -> float:
        return pen_up_s(order, home, hop_cost)

    greedy = in_order(strokes, greedy_tour(Ends(strokes, home, hop_cost)))
    found = settled(greedy, home, hop_cost, go_on)
    if seconds(strokes) < seconds(greedy):
        found = min(found, settled(strokes, home, hop_cost, go_on), key=seconds)
    return found


def settled(
    strokes: list[Array], home: tuple[float, float], hop_cost: HopCost, go_on: Callable[[], bool]
) -> list[Array]:
    """Strokes in an order in which no exchange of hops saves time, nor another beginning of a closed stroke."""
    any_closed = any(is_closed(stroke) for stroke in strokes)
    seconds = math.inf
    for _ in range(MAX_ROUNDS):
        ends, tour = Ends(strokes, home, hop_cost), Tour.as_given(len(strokes))
        descend(ends, tour, go_on)
        strokes = in_order(strokes, tour)
        if not any_closed:
            break
        strokes = reseat(strokes, home, hop_cost)
        before, seconds = seconds, pen_up_s(strokes, home, hop_cost)
        if seconds > before - EPS or not go_on():
            break
    return strokes
