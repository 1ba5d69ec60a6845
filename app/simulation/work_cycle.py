"""The 5R's experiment: pick and place between two moving belts under a law at 4 kHz (fivebar spec, B6 and B7)."""

from __future__ import annotations

from functools import cache

from app.control.laws import Tuning
from app.motion import CYCLES, CycleMotion, WorkCycle, plan_work_cycle
from app.simulation.closed_loop import Experiment, simulate
from app.simulation.closed_loop.experiment import PlantKind
from app.simulation.controlled_run import ControlledRun
from app.simulation.tracking import TrackingError

ON_BELTS_S = ((0.48, 1.10), (1.58, 2.20))
"""Segments b-e and f-i of W1 and W2, in which the tool moves with a belt."""


def work_cycle(
    controller: str,
    cycle: str | WorkCycle = "W1",
    friction: bool | float = True,
    plant: PlantKind = "exact",
    *,
    tuning: Tuning | None = None,
) -> ControlledRun:
    """The five-bar picks an item from one belt and places it on the other.

    Args:
        controller: key of `LAWS`.
        cycle: `W1` (stroke 5 mm, within every limit), `W2` (25 mm, which saturates the third drive), or another.
        friction: whether, or how much of, the drives' friction acts.
        tuning: None: the spec's 30 and 28 Hz.

    Raises:
        TrackingError: for a name that does not exist.
        MotionError: if the cycle cannot be, with the reason.
    """
    return simulate(cycle_experiment(controller, cycle, friction, plant, tuning=tuning))


def cycle_experiment(
    controller: str,
    cycle: str | WorkCycle = "W1",
    friction: bool | float = True,
    plant: PlantKind = "exact",
    *,
    tuning: Tuning | None = None,
) -> Experiment:
    """What `work_cycle` runs."""
    if isinstance(cycle, str) and cycle not in CYCLES:
        raise TrackingError(f"There is no work cycle {cycle!r}; choose {' or '.join(CYCLES)}.")
    motion = _reference_cycle(cycle) if isinstance(cycle, str) else plan_work_cycle(cycle)
    return Experiment.of_motion(motion, controller, tuning=tuning, friction=float(friction), plant=plant)


@cache
def _reference_cycle(name: str) -> CycleMotion:
    return plan_work_cycle(CYCLES[name])
