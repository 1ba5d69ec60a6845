"""Ways to find the gains of a PID: rules, a relay, the paper's tables, and shaping the loop."""

from app.control.tuning.reaction_curve import TuningError

__all__ = ["TuningError"]
