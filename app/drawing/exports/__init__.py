"""Files of strokes and of the robot's path for other programs and machines."""

from __future__ import annotations

from app.drawing.exports.csv_files import TimedPath, write_strokes_csv, write_toolpath_csv
from app.drawing.exports.dxf import write_dxf
from app.drawing.exports.formats import EXPORTS, GCODE_VARIANTS, Export
from app.drawing.exports.gcode import write_gcode
from app.drawing.exports.png import write_preview_png
from app.drawing.exports.points_file import read_points_file, write_points_file
from app.drawing.exports.strokes import SheetSize, Stroke
from app.drawing.exports.svg import write_svg

__all__ = [
    "EXPORTS",
    "GCODE_VARIANTS",
    "Export",
    "SheetSize",
    "Stroke",
    "TimedPath",
    "read_points_file",
    "write_dxf",
    "write_gcode",
    "write_points_file",
    "write_preview_png",
    "write_strokes_csv",
    "write_svg",
    "write_toolpath_csv",
]
