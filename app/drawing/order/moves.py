"""Exchanging two or three hops wherever that saves time, thousands of candidates at once.

All ends are screened with NumPy; the improving exchanges are then made one by one, the best first, unless an earlier
one has touched their hops; the next round looks only at the ends concerned. Three hops include every move of a run of
strokes to another place (Or-opt).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.drawing.order.cost import Array
from app.drawing.order.tour import Ends, Ints, Tour

NEAR = (10, 30)
"""Ends to which an end may get a hop, at least and at most. More help where strokes are crowded, but take time."""
CANDIDATES = 200_000
"""Of all ends together, between these limits."""
EPS = 1e-9
"""Seconds that are no gain but rounding."""

Near = tuple[Ints, Array]
"""See `Ends.near`."""


class _Partial(NamedTuple):
    """Exchanges under way, (m,) each: the hops (a, b) and (c, d) are given up, b hops to c."""

    a: Ints
    b: Ints
    c: Ints
    d: Ints
    gain: Array
    """Seconds, before d gets a new partner."""


def descend(ends: Ends, tour: Tour, go_on: Callable[[], bool] = lambda: True) -> None:
    """Exchange hops until no two or three among near ends are worth it, or until told not to go on."""
    if not go_on():
        return
    size = len(ends.points)
    near = ends.near(max(NEAR[0], min(NEAR[1], CANDIDATES // size)))
    active = np.arange(size - 1)
    while len(active) and go_on():
        active = _round(ends, tour, near, active)


def new_hops(chain: Sequence[int]) -> list[tuple[int, int]]:
    """A chain a, b, c, d, .. gives up the hops (a, b), (c, d), .. for (b, c), .. and, last, its end to a."""
    return list(zip(chain[1::2], [*chain[2::2], chain[0]], strict=True))


def _round(ends: Ends, tour: Tour, near: Near, active: Ints) -> Ints:
    """Make the improving exchanges that begin at the active ends; returns the ends to look at next."""
    partial = _first_hop(ends, tour, near, active)
    two, gain_two = _two_hops(ends, tour, partial)
    three, gain_three = _three_hops(ends, tour, near, partial)
    best_first = np.argsort(-np.concatenate([gain_two, gain_three]), kind="stable")
    chains = [*two.tolist(), *three.tolist()]
    todo: set[int] = set()
    for chain in (chains[k] for k in best_first.tolist()):
        untouched = all(tour.partner(x) == y for x, y in zip(chain[::2], chain[1::2], strict=True))
        if untouched and tour.exchange(new_hops(chain)):
            todo.update(chain)
        else:
            todo.add(chain[0])
    return np.array(sorted(todo), dtype=int)


def _partners(tour: Tour, ends: Ints) -> Ints:
    return tour.rings[tour.places[ends] ^ 1]


def _first_hop(ends: Ends, tour: Tour, near: Near, a: Ints) -> _Partial:
    """For each end a with partner b: the near ends c to which b had better hop."""
    b = _partners(tour, a)
    gain = ends.seconds(a, b)[:, None] - near[1][b]
    row, column = np.nonzero(gain > EPS)
    c = near[0][b[row], column]
    d = _partners(tour, c)
    return _Partial(a[row], b[row], c, d, gain[row, column] + ends.seconds(c, d))


def _two_hops(ends: Ends, tour: Tour, partial: _Partial) -> tuple[Ints, Array]:
    """(m, 4) chains and their gains: d hops to a."""
    a, b, c, d, gain = partial
    gain = gain - ends.seconds(d, a)
    whole = (tour.places[b] ^ tour.places[c]) & 1 == 0
    good = (gain > EPS) & whole
    return np.column_stack([a, b, c, d])[good], gain[good]


def _three_hops(ends: Ends, tour: Tour, near: Near, partial: _Partial) -> tuple[Ints, Array]:
    """(m, 6) chains and their gains: d hops to e, and e's partner f to a."""
    gain = partial.gain[:, None] - near[1][partial.d]
    row, column = np.nonzero(gain > EPS)
    a, b, c, d = (each[row] for each in partial[:4])
    e = near[0][d, column]
    f = _partners(tour, e)
    gain = gain[row, column] + ends.seconds(e, f) - ends.seconds(f, a)
    good = (gain > EPS) & (e != a) & (e != b) & (e != c)
    chains, gain = np.column_stack([a, b, c, d, e, f])[good], gain[good]
    whole = _stays_whole(tour.places[chains])
    return chains[whole], gain[whole]


def _stays_whole(places: Ints) -> NDArray[np.bool_]:
    """(m,) whether exchanging the three hops at (m, 6) places leaves one ring.

    The pen leaves the first hop's left end and comes back to its right end. What decides is where these two hop to.
    """
    mates = places[:, [5, 2, 1, 4, 3, 0]]
    first, second, third = np.sort(places[:, ::2] & ~1, axis=1).T
    left, right = (mates[places == (first + side)[:, None]] for side in (0, 1))
    return (
        ((left == second) & (right == third))
        | ((left == second + 1) & (right >= third))
        | ((left == third) & (right == second + 1))
    )
