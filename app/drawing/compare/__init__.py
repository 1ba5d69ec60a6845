"""Comparisons: quality against speed, robot against robot, a delta against a serial arm."""

from app.drawing.compare.paths import rose, zigzag
from app.drawing.compare.robots import RobotResult, draw_on
from app.drawing.compare.serial_arm import ArmComparison, SerialArm, arm_behind, compare_with_arm
from app.drawing.compare.sweep import SWEEPS, SweepPoint, sweep_point, sweep_values

__all__ = [
    "SWEEPS",
    "ArmComparison",
    "RobotResult",
    "SerialArm",
    "SweepPoint",
    "arm_behind",
    "compare_with_arm",
    "draw_on",
    "rose",
    "sweep_point",
    "sweep_values",
    "zigzag",
]
