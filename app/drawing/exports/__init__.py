"""Files of strokes and of the robot's path for other programs and machines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from app.drawing.exports.csv_files import TimedPath, write_strokes_csv, write_toolpath_csv
from app.drawing.exports.dxf import write_dxf
from app.drawing.exports.gcode import write_gcode
from app.drawing.exports.png import write_preview_png
from app.drawing.exports.points_file import read_points_file, write_points_file
from app.drawing.exports.strokes import Sheet, Stroke
from app.drawing.exports.svg import write_svg


@dataclass(frozen=True)
class Export:
    """A kind of file that strokes can be written to."""

    title: str
    write: Callable[[Sequence[Stroke], Sheet], bytes]
    """Sheet strokes and the sheet's size in mm -> the file's content, with default settings."""


EXPORTS: dict[str, Export] = {
    ".svg": Export("SVG, one polyline a stroke", lambda strokes, sheet: write_svg(strokes, sheet).encode()),
    ".gcode": Export("G-code for a pen plotter under GRBL", lambda strokes, sheet: write_gcode(strokes).encode()),
    ".csv": Export("CSV of stroke_id, x_mm, y_mm", lambda strokes, sheet: write_strokes_csv(strokes).encode()),
    ".txt": Export("Ptos_Dibujo.txt, points x y z", lambda strokes, sheet: write_points_file(strokes, sheet).encode()),
    ".dxf": Export("DXF R12 polylines", lambda strokes, sheet: write_dxf(strokes, sheet).encode()),
    ".png": Export("PNG preview, coloured by order", write_preview_png),
}
"""By the file name's suffix."""

__all__ = [
    "EXPORTS",
    "Export",
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
