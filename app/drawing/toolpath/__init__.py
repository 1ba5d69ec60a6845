"""From ordered strokes on a sheet to a timed trajectory of the robot."""

from app.drawing.toolpath.check import ToolpathError, unreachable
from app.drawing.toolpath.laser import laser_power
from app.drawing.toolpath.pauses import pause_after
from app.drawing.toolpath.pen import PenSettings, default_pen
from app.drawing.toolpath.placement import Placement, Sheet, default_placement, fit_to_sheet, largest_sheet, sheet_fits
from app.drawing.toolpath.plan import Sample, Toolpath, plan_toolpath, sample
from app.drawing.toolpath.tracks import Track, track

__all__ = [
    "PenSettings",
    "Placement",
    "Sample",
    "Sheet",
    "Toolpath",
    "ToolpathError",
    "Track",
    "default_pen",
    "default_placement",
    "fit_to_sheet",
    "largest_sheet",
    "laser_power",
    "pause_after",
    "plan_toolpath",
    "sample",
    "sheet_fits",
    "track",
    "unreachable",
]
