"""How well one run went: errors of the tool by quantity, torques, shares. Small plain data for tables and bars."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from app.simulation.controlled_run import ControlledRun

Array = NDArray[np.float64]

WHOLE, LATER, FIRST = "Whole run", "After 1 s", "First 1 s"
STRETCHES: dict[str, tuple[float, float]] = {WHOLE: (0.0, np.inf), LATER: (1.0, np.inf), FIRST: (0.0, 1.0)}
"""Parts of a run, s."""

POSITION, IN_PLANE = "position", "in plane"
TURNS = {"theta": "θ", "phi": "φ"}


def quantities(pose_names: tuple[str, ...]) -> tuple[str, ...]:
    """What an error can be looked at in: all of the position, its part in the plane, each coordinate."""
    return (POSITION, IN_PLANE, *(TURNS.get(name, name) for name in pose_names))


def unit_of(quantity: str) -> str:
    """In which errors are read."""
    return "mrad" if quantity in TURNS.values() else "mm"


def error_columns(run: ControlledRun) -> Array:
    """(k, dof + 2) errors in mm and mrad, one column a quantity: the distances, then wanted minus actual."""
    return 1e3 * np.column_stack([run.tool_error_m, run.in_plane_error, run.tool_error])


@dataclass(frozen=True)
class Score:
    """Figures of one run; errors in mm and mrad, joints in the robot's order."""

    quantities: tuple[str, ...]
    rms: Mapping[str, tuple[float, ...]]
    """By part of the run: one value a quantity."""
    peak: Mapping[str, tuple[float, ...]]
    effort_peak: tuple[float, ...]
    """Largest torque (N m) or force (N) of each joint."""
    effort_rms: tuple[float, ...]
    effort_limit: tuple[float, ...]
    saturation: tuple[float, ...]
    """Share of the samples in which each joint stands at its limit."""
    shares: Mapping[str, tuple[float, ...]]
    """RMS of each component over the sum of all, by component: one value a joint."""

    def rms_of(self, quantity: str, stretch: str) -> float:
        return self.rms[stretch][self.quantities.index(quantity)]

    def peak_of(self, quantity: str, stretch: str) -> float:
        return self.peak[stretch][self.quantities.index(quantity)]

    @property
    def strain(self) -> float:
        """Largest torque in parts of its limit."""
        return max(value / limit for value, limit in zip(self.effort_peak, self.effort_limit, strict=True))


def score_of(run: ControlledRun, pose_names: tuple[str, ...]) -> Score:
    """The figures of a run. A part that the run does not reach counts as the whole."""
    columns = error_columns(run)
    parts = {name: columns[_within(run.t, *span)] for name, span in STRETCHES.items()}
    return Score(
        quantities(pose_names),
        rms={name: _floats(np.sqrt(np.mean(part**2, axis=0))) for name, part in parts.items()},
        peak={name: _floats(np.abs(part).max(axis=0)) for name, part in parts.items()},
        effort_peak=_floats(run.torque_peak),
        effort_rms=_floats(run.torque_rms),
        effort_limit=_floats(run.effort_limit),
        saturation=_floats(run.saturation),
        shares={name: _floats(share) for name, share in run.shares.items()},
    )


def ranking(scores: Mapping[str, Score], quantity: str, stretch: str) -> list[str]:
    """Laws from the smallest RMS error to the largest."""
    errors = {law: score.rms_of(quantity, stretch) for law, score in scores.items()}
    return sorted(errors, key=lambda law: (not np.isfinite(errors[law]), errors[law]))


def _within(t: Array, first_s: float, last_s: float) -> NDArray[np.bool_]:
    inside = (t >= first_s) & (t <= last_s)
    return inside if inside.any() else np.ones(len(t), dtype=bool)


def _floats(values: Array) -> tuple[float, ...]:
    return tuple(float(value) for value in values)
