"""Strokes as G-code for pen plotters under GRBL or Marlin.

X0 Y0 is the middle of the sheet, X right, Y up; with a Z axis the pen touches the paper at Z0. A servo takes
`M3 S1000` (down) and `M5` (up) under GRBL with a servo on the spindle's output, `M280` under Marlin.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import Stroke, checked_strokes, hops, length_mm

Flavour = Literal["grbl", "marlin"]
Pen = Literal["z", "servo"]

SERVO_WAIT_S = 0.15
"""For a servo to arrive; the controller does not know when it has."""


@dataclass(frozen=True)
class _Words:
    """The lines that move the pen, and the last ones."""

    up: str
    down: str
    end: str


def write_gcode(
    strokes: Sequence[Stroke],
    *,
    flavour: Flavour = "grbl",
    pen: Pen = "z",
    draw_mm_s: float = 80.0,
    travel_mm_s: float = 300.0,
    lift_mm: float = 4.0,
) -> str:
    """Text: lifted moves by G0, drawn ones by G1, ending lifted over X0 Y0.

    GRBL makes G0 as fast as its settings $110 to $112 allow, whatever `travel_mm_s` says.
    """
    checked = checked_strokes(strokes)
    if not checked:
        raise DrawingError("There is nothing to draw, so no G-code was written; change the settings and try again.")
    if flavour not in get_args(Flavour) or pen not in get_args(Pen):
        raise DrawingError(f"G-code is for grbl or marlin with the pen on z or servo, not for {flavour!r} and {pen!r}.")
    if not (np.array([draw_mm_s, travel_mm_s, lift_mm]) > 0.0).all():
        raise DrawingError("The drawing speed, the travel speed and the lift must be above zero; correct them.")
    words = _words(flavour, pen, draw_mm_s, lift_mm)
    lines = [*_header(checked, pen, draw_mm_s, travel_mm_s, lift_mm), "G21", "G90", *words.up.splitlines()]
    for stroke in checked:
        start, *rest = stroke.tolist()
        lines += [f"G0 {_place(start)} F{60.0 * travel_mm_s:g}", *words.down.splitlines()]
        lines += [f"G1 {_place(rest[0])} F{60.0 * draw_mm_s:g}"]
        lines += [f"G1 {_place(point)}" for point in rest[1:]]
        lines += words.up.splitlines()
    return "\n".join([*lines, f"G0 X0 Y0 F{60.0 * travel_mm_s:g}", words.end, ""])


def _words(flavour: Flavour, pen: Pen, draw_mm_s: float, lift_mm: float) -> _Words:
    end = "M2" if flavour == "grbl" else "M400"  # Marlin knows no M2; M400 waits until the last move is made
    if pen == "z":
        return _Words(f"G0 Z{lift_mm:g}", f"G1 Z0 F{60.0 * draw_mm_s:g}", end)
    if flavour == "grbl":
        wait = f"G4 P{SERVO_WAIT_S:g}"
        return _Words(f"M5\n{wait}", f"M3 S1000\n{wait}", end)
    wait = f"G4 P{1000.0 * SERVO_WAIT_S:g}"  # milliseconds; M400 first, for M280 does not wait for the moves
    return _Words(f"M400\nM280 P0 S0\n{wait}", f"M400\nM280 P0 S90\n{wait}", end)


def _place(point: Sequence[float]) -> str:
    x, y = point
    return f"X{x:z.3f} Y{y:z.3f}"


def _header(strokes: list[Stroke], pen: Pen, draw_mm_s: float, travel_mm_s: float, lift_mm: float) -> list[str]:
    """What the file is, as comments. The time is without accelerations."""
    points = np.concatenate(strokes)
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    down = sum(length_mm(stroke) for stroke in strokes)
    home = np.zeros((1, 2))
    up = length_mm(hops([home, *strokes, home]))
    lift_s = SERVO_WAIT_S if pen == "servo" else lift_mm / travel_mm_s
    lower_s = SERVO_WAIT_S if pen == "servo" else lift_mm / draw_mm_s
    seconds = down / draw_mm_s + up / travel_mm_s + len(strokes) * (lift_s + lower_s)
    return [
        "; Delta Lab drawing, mm, X0 Y0 is the middle of the sheet",
        f"; bounds: X {left:.1f} to {right:.1f}, Y {bottom:.1f} to {top:.1f}",
        f"; strokes: {len(strokes)}, pen down {down:.0f} mm, pen up {up:.0f} mm",
        f"; time: at least {seconds:.0f} s at {draw_mm_s:g} mm/s down and {travel_mm_s:g} mm/s up",
    ]
