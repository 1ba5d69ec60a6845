"""Where to begin a closed stroke: at the point that is best reached from the stroke before and best left for the next.

Strokes may be drawn from any of their points if they are closed. With the order given, the best choice for all of
them is a shortest way through the layers of points, stroke by stroke.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby, pairwise

import numpy as np
from scipy.spatial import KDTree

from app.drawing.order.cost import DEFAULT_COST, HOME, Array, HopCost

SPREAD_SEATS = 30
"""Points of one stroke to choose from, evenly spread over it, while its neighbours may begin anywhere, too."""


def is_closed(stroke: Array) -> bool:
    """It ends where it begins, and is no dot."""
    return len(stroke) > 2 and bool((stroke[0] == stroke[-1]).all())


def reseat(strokes: Sequence[Array], home: tuple[float, float] = HOME, hop_cost: HopCost = DEFAULT_COST) -> list[Array]:
    """The strokes in the same order, closed ones begun at the best of their points; never slower than before."""
    result: list[Array] = []
    for closed, run in groupby(enumerate(strokes), key=lambda item: is_closed(item[1])):
        numbers, members = zip(*run, strict=True)
        if closed:
            before = result[-1][-1] if result else np.array(home)
            after = strokes[numbers[-1] + 1][:1] if numbers[-1] + 1 < len(strokes) else None
            members = _begun_best(members, before, after, hop_cost)
        result += members
    for k in [k for k, stroke in enumerate(result) if is_closed(stroke)]:
        around = [result[k - 1][-1] if k else home, *(after[0] for after in result[k + 1 : k + 2])]
        ways = sum(hop_cost.seconds(np.hypot(*(result[k] - point).T)) for point in around)
        result[k] = begun_at(result[k], int(np.argmin(ways)))
    return result


def _begun_best(run: Sequence[Array], before: Array, after: Array | None, hop_cost: HopCost) -> list[Array]:
    """Closed strokes on the quickest way from the point `before` (2,) to `after` (1, 2), if there is such a point."""
    seats = _seats(run)
    places, seconds, best_from = before[None], np.zeros(1), []
    for layer in [stroke[seat] for stroke, seat in zip(run, seats, strict=True)] + ([] if after is None else [after]):
        ways = seconds[:, None] + hop_cost.seconds(np.hypot(*(places[:, None] - layer).transpose(2, 0, 1)))
        best_from.append(ways.argmin(axis=0))
        places, seconds = layer, ways.min(axis=0)
    best = int(seconds.argmin())
    if after is not None:
        best = int(best_from.pop()[best])
    result = []
    for stroke, seat, back in zip(reversed(run), reversed(seats), reversed(best_from), strict=True):
        result.append(begun_at(stroke, seat[best]))
        best = int(back[best])
    return result[::-1]


def _seats(run: Sequence[Array]) -> list[list[int]]:
    """Points of each stroke to choose from: the present one, 0, and where it comes closest to its neighbours, too."""
    seats = [{k * (len(stroke) - 1) // SPREAD_SEATS for k in range(SPREAD_SEATS)} for stroke in run]
    for k, (stroke, following) in enumerate(pairwise(run)):
        far, nearest = KDTree(stroke[:-1]).query(following[:-1])
        point = int(np.argmin(far))
        seats[k].add(int(np.asarray(nearest)[point]))
        seats[k + 1].add(point)
    return [sorted(points) for points in seats]


def begun_at(stroke: Array, point: int) -> Array:
    """The same closed curve, in the same direction."""
    return np.concatenate([stroke[point:-1], stroke[: point + 1]]) if point else stroke
