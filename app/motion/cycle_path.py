"""The tool's path through a work cycle: between the belts by the sin2 law, along them and in height by quintics."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from app.motion.pieces import Pieces, joined, quintic_between
from app.motion.profiles import Sin2
from app.motion.trajectory import Sample
from app.motion.work_cycle import PAPER_PERIOD_S, WorkCycle

RAMP = 1.0 - 0.318 / (1.16 * 0.48)
"""Share of a transfer in which the tool speeds up across the belts: 318 mm in 0.48 s with at most 1.16 m/s."""

BRAKE = 0.26 / PAPER_PERIOD_S
"""Share of a period, at most, in which the tool brakes from the place belt's speed; then it waits."""


class Waypoints(NamedTuple):
    """Along the belts, y in metres: at rest, at b and g..i, and at e and f, where the tool leaves the pick belt."""

    a: float
    b: float
    e: float


@dataclass(frozen=True)
class CyclePath:
    """A trajectory: one round, from rest at a to rest at a."""

    title: str
    duration_s: float
    place_x_m: float
    there: Sin2
    """Across the belts, from t = 0."""
    back: Sin2
    back_s: float
    """When it begins."""
    others: tuple[Pieces, Pieces, Pieces]
    """y, z and the turn over time."""

    def sample(self, t: ArrayLike) -> Sample:
        """See `Trajectory`."""
        times = np.asarray(t, dtype=float)
        across = [go + come for go, come in zip(self.there.at(times), self.back.at(times - self.back_s), strict=True)]
        across[0] = across[0] + self.place_x_m
        rest = zip(*(law.at(times) for law in self.others), strict=True)
        return Sample(*(np.stack([x, *yzphi], axis=-1) for x, yzphi in zip(across, rest, strict=True)))


def cycle_path(cycle: WorkCycle, middle_y: float) -> CyclePath:
    """The cycle in which the tool moves with the belts symmetrically about y = `middle_y` (m)."""
    durations = cycle.durations
    transfer, half = durations[0], sum(durations[:4])
    across = cycle.pick_x_m - cycle.place_x_m
    there, back = (Sin2(way, transfer, RAMP * transfer) for way in (across, -across))
    others = _along(cycle, _waypoints(cycle, middle_y)), _height(cycle), _turn(cycle)
    return CyclePath(cycle.title, cycle.period_s, cycle.place_x_m, there, back, half, others)


def _waypoints(cycle: WorkCycle, middle_y: float) -> Waypoints:
    """The way back to a is as long as braking evenly from the belt's speed."""
    v = cycle.belt_speed_m_s
    ride = v * sum(cycle.durations[1:4])
    b = middle_y - 0.5 * ride
    return Waypoints(b - 0.5 * v * _braking_s(cycle), b, b + ride)


def _braking_s(cycle: WorkCycle) -> float:
    return min(cycle.durations[8], BRAKE * cycle.period_s)


def _along(cycle: WorkCycle, y: Waypoints) -> Pieces:
    v, transfer, brake = cycle.belt_speed_m_s, cycle.durations[0], _braking_s(cycle)
    return joined(
        [
            (transfer, quintic_between(y.a, y.b, transfer, 0.0, v)),
            *_riding(cycle.durations[1:4], y.b, v),
            (transfer, quintic_between(y.e, y.e, transfer, v, -v)),
            *_riding(cycle.durations[5:8], y.e, -v),
            (brake, quintic_between(y.b, y.a, brake, -v, 0.0)),
        ]
    )


def _riding(durations: Sequence[float], y: float, v: float) -> list[tuple[float, list[float]]]:
    """With a belt, segment by segment."""
    starts = y + v * np.concatenate([[0.0], np.cumsum(durations)[:-1]])
    return [(duration, [start, v]) for duration, start in zip(durations, starts.tolist(), strict=True)]


def _height(cycle: WorkCycle) -> Pieces:
    transfer, stroke, grip, _, *_, settle = cycle.durations
    depth = -cycle.stroke_m
    down, up = quintic_between(0.0, depth, stroke), quintic_between(depth, 0.0, stroke)
    visit = [(transfer, [0.0]), (stroke, down), (grip, [depth]), (stroke, up)]
    return joined([*visit, *visit, (settle, [0.0])])


def _turn(cycle: WorkCycle) -> Pieces:
    transfer, stroke, grip, _, *_, settle = cycle.durations
    turn, visit = cycle.turn_rad, 2.0 * stroke + grip
    return joined(
        [
            (transfer, quintic_between(turn, 0.0, transfer)),
            (visit, [0.0]),
            (transfer, quintic_between(0.0, turn, transfer)),
            (visit + settle, [turn]),
        ]
    )
