"""Runs side by side, the best first."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from app.simulation.controlled_run import Array, ControlledRun


@dataclass(frozen=True, eq=False)
class Row:
    """One line of the table."""

    place: int
    """From 1; by the error's size in space."""
    run: ControlledRun
    rmse_mm: Array
    """(dof,) of the tool, mm; a rotation in mrad."""
    peak_mm: Array
    """(dof,) likewise."""
    error_mm: float
    """RMS of the tool's distance from where it should be."""


def ranking(runs: Sequence[ControlledRun], first_s: float = 0.0) -> list[Row]:
    """Sorted by the tool's RMS distance from the reference, from `first_s` on."""
    scored = sorted(((run.rms_distance_m(first_s) * 1e3, k) for k, run in enumerate(runs)))
    return [
        Row(place, runs[k], runs[k].rms_from(first_s) * 1e3, runs[k].peak_from(first_s) * 1e3, error)
        for place, (error, k) in enumerate(scored, start=1)
    ]
