"""Plants and closed loops, recorded runs, and the papers' experiments."""

from app.simulation.circle import circle_tracking
from app.simulation.run import Run
from app.simulation.tracking import Task, TrackingError, follow_sampled, follow_simulink

__all__ = ["Run", "Task", "TrackingError", "circle_tracking", "follow_sampled", "follow_simulink"]
