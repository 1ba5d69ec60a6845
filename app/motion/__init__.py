"""Where a tool should be, and when."""

from app.motion.curves import CURVES, CurveKind
from app.motion.motion import Motion
from app.motion.paths import PATHS, Path, Tour, quintic
from app.motion.plan import plan_motion
from app.motion.plan_cycle import CycleMotion, plan_work_cycle
from app.motion.point_to_point import point_to_point
from app.motion.profiles import PROFILES, ProfileKind
from app.motion.settings import MotionSettings, default_motion
from app.motion.trajectory import MotionError, Sample, Trajectory
from app.motion.work_cycle import CYCLES, WorkCycle

__all__ = [
    "CURVES",
    "CYCLES",
    "PATHS",
    "PROFILES",
    "CurveKind",
    "CycleMotion",
    "Motion",
    "MotionError",
    "MotionSettings",
    "Path",
    "ProfileKind",
    "Sample",
    "Tour",
    "Trajectory",
    "WorkCycle",
    "default_motion",
    "plan_motion",
    "plan_work_cycle",
    "point_to_point",
    "quintic",
]
