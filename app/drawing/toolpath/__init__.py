"""From ordered strokes on a sheet to a timed trajectory of the robot."""

from app.drawing.toolpath.check import ToolpathError, unreachable
from app.drawing.toolpath.placement import Placement, Sheet, default_placement, fit_to_sheet, largest_sheet
from app.drawing.toolpath.plan import PenSettings, Sample, Toolpath, plan_toolpath, sample

__all__ = [
    "PenSettings",
    "Placement",
    "Sample",
    "Sheet",
    "Toolpath",
    "ToolpathError",
    "default_placement",
    "fit_to_sheet",
    "largest_sheet",
    "plan_toolpath",
    "sample",
    "unreachable",
]
