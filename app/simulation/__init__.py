"""Plants and closed loops, recorded runs, and the papers' experiments."""

from app.simulation.circle import circle_tracking
from app.simulation.controlled_run import ControlledRun
from app.simulation.helix import helix_tracking
from app.simulation.run import Run
from app.simulation.tracking import Task, TrackingError, follow_sampled, follow_simulink
from app.simulation.work_cycle import work_cycle

__all__ = [
    "ControlledRun",
    "Run",
    "Task",
    "TrackingError",
    "circle_tracking",
    "follow_sampled",
    "follow_simulink",
    "helix_tracking",
    "work_cycle",
]
