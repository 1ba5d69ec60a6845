"""Controllers and how to choose them: motor model, PID, tuning, metrics, margins, identification."""

from app.control.motor import PAR4_MOTOR, Motor
from app.control.pid import PID_APPROX, PID_AUTO, Pid

__all__ = ["PAR4_MOTOR", "PID_APPROX", "PID_AUTO", "Motor", "Pid"]
