"""Strokes as SVG in millimetres, for vpype, Inkscape and the AxiDraw."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app.drawing.exports.strokes import SheetSize, Stroke, checked_sheet, checked_strokes, from_corner, hops

DECIMALS = 4
"""Of a millimetre."""

HEAD = """<?xml version="1.0" encoding="UTF-8"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape"
  version="1.1" width="{width}mm" height="{height}mm" viewBox="0 0 {width} {height}">
<g id="drawing" inkscape:groupmode="layer" inkscape:label="1 drawing" fill="none" stroke="black"
  stroke-width="{pen}" stroke-linecap="round" stroke-linejoin="round">
"""
# The AxiDraw ignores layers whose name begins with %, in case somebody makes this one visible.
PEN_UP = """</g>
<g id="pen-up" inkscape:groupmode="layer" inkscape:label="% pen up" style="display:none" fill="none" stroke="red"
  stroke-width="{pen}">
"""


def write_svg(strokes: Sequence[Stroke], sheet_mm: SheetSize, *, pen_mm: float = 0.5) -> str:
    """One polyline a stroke in the order of drawing, and a hidden layer of the moves between them.

    One unit is 1 mm, the origin is the sheet's upper left corner, y points down; numbers are rounded to 0.1 um.
    """
    sheet = checked_sheet(sheet_mm)
    drawn = [from_corner(stroke, sheet) for stroke in checked_strokes(strokes)]
    lines = [f'<polyline points="{_pairs(stroke)}"/>\n' for stroke in drawn]
    moves = [f'<polyline points="{_pairs(hop)}"/>\n' for hop in hops(drawn)]
    head = HEAD.format(width=sheet[0], height=sheet[1], pen=pen_mm)
    return "".join([head, *lines, PEN_UP.format(pen=pen_mm / 4.0), *moves, "</g>\n</svg>\n"])


def _pairs(points: Stroke) -> str:
    rounded = np.round(points, DECIMALS) + 0.0  # + 0.0: no minus zeros
    return " ".join(f"{x},{y}" for x, y in rounded.tolist())
