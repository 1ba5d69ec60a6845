"""All kinds of files that strokes can be written to, for whoever offers a choice of them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.drawing.exports.csv_files import write_strokes_csv
from app.drawing.exports.dxf import write_dxf
from app.drawing.exports.gcode import write_gcode
from app.drawing.exports.png import write_preview_png
from app.drawing.exports.points_file import write_points_file
from app.drawing.exports.svg import write_svg

Writer = Callable[..., bytes]
"""Sheet strokes, the sheet's size in mm, and options by name -> the file's content."""


@dataclass(frozen=True)
class Export:
    """A kind of file."""

    title: str
    suffix: str
    """With its dot."""
    mime_type: str
    write: Writer
    options: tuple[str, ...] = ()
    """Names of what `write` takes besides strokes and sheet; all may be left out."""


def _with_sheet(write: Callable[..., str]) -> Writer:
    return lambda strokes, sheet_mm, **options: write(strokes, sheet_mm, **options).encode()


def _without_sheet(write: Callable[..., str]) -> Writer:
    return lambda strokes, sheet_mm, **options: write(strokes, **options).encode()


_GCODE_OPTIONS = ("flavour", "pen", "draw_mm_s", "travel_mm_s", "lift_mm", "power")
_PNG_OPTIONS = ("px_per_mm", "pen_mm", "outside", "stray", "margin_mm")

_FORMATS = (
    Export("SVG, one polyline a stroke", ".svg", "image/svg+xml", _with_sheet(write_svg), ("pen_mm",)),
    Export("G-code for plotters and lasers", ".gcode", "text/x-gcode", _without_sheet(write_gcode), _GCODE_OPTIONS),
    Export("CSV of stroke_id, x_mm, y_mm", ".csv", "text/csv", _without_sheet(write_strokes_csv)),
    Export("Ptos_Dibujo.txt, points x y z", ".txt", "text/plain", _with_sheet(write_points_file), ("lift_mm",)),
    Export("DXF R12 polylines", ".dxf", "image/vnd.dxf", _with_sheet(write_dxf)),
    Export("PNG preview, coloured by order", ".png", "image/png", write_preview_png, _PNG_OPTIONS),
)

EXPORTS: dict[str, Export] = {export.suffix: export for export in _FORMATS}
"""By the file name's suffix."""

GCODE_VARIANTS: dict[str, dict[str, str]] = {
    "GRBL, pen on the Z axis": {"flavour": "grbl", "pen": "z"},
    "GRBL, pen on a servo": {"flavour": "grbl", "pen": "servo"},
    "GRBL, laser": {"flavour": "grbl", "pen": "laser"},
    "Marlin, pen on the Z axis": {"flavour": "marlin", "pen": "z"},
    "Marlin, pen on a servo": {"flavour": "marlin", "pen": "servo"},
    "Marlin, laser": {"flavour": "marlin", "pen": "laser"},
}
"""Title -> options of the G-code; the first is what it is without any."""
