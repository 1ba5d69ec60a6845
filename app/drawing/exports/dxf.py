"""Strokes as DXF of release 12, which every CAD program and laser cutter reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from app.drawing.exports.strokes import SheetSize, Stroke, checked_sheet, checked_strokes

LAYER = "DRAWING"
CLOSED, OPEN = 1, 0


def write_dxf(strokes: Sequence[Stroke], sheet_mm: SheetSize) -> str:
    """One polyline a stroke in the order of drawing; mm from the sheet's lower left corner, y up.

    R12 has no units: tell the program that reads it that they are millimetres.
    """
    corner = np.array(checked_sheet(sheet_mm)) / 2.0
    lines = ["0", "SECTION", "2", "ENTITIES"]
    for stroke in checked_strokes(strokes):
        lines += _polyline(np.round(stroke + corner, 4) + 0.0)
    return "\n".join([*lines, "0", "ENDSEC", "0", "EOF", ""])


def _polyline(points: Stroke) -> Iterator[str]:
    """Pairs of group code and value. A closed one does not repeat its first point."""
    is_closed = len(points) > 3 and (points[0] == points[-1]).all()
    yield from ("0", "POLYLINE", "8", LAYER, "66", "1", "70", str(CLOSED if is_closed else OPEN))
    yield from ("10", "0.0", "20", "0.0", "30", "0.0")
    for x, y in (points[:-1] if is_closed else points).tolist():
        yield from ("0", "VERTEX", "8", LAYER, "10", str(x), "20", str(y), "30", "0.0")
    yield from ("0", "SEQEND", "8", LAYER)
