"""Strokes as G-code for pen plotters and lasers under GRBL or Marlin.

X0 Y0 is the middle of the sheet, X right, Y up; with a Z axis the pen touches the paper at Z0. A servo takes
`M3 S1000` (down) and `M5` (up) under GRBL with a servo on the spindle's output, `M280` under Marlin.

A laser is off on every G0. GRBL's laser mode ($32=1) sees to that and with `M4` makes the power follow the actual
speed; `S0` on every G0 keeps it off even where that mode is missing. Marlin gets `M3 S` and `M5` around each stroke,
which wait for the moves before them: all its versions know these, while its modes inline differ between versions.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, get_args

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.exports.strokes import Stroke, checked_strokes, hops, length_mm
from app.drawing.order import ink_mm

Flavour = Literal["grbl", "marlin"]
Pen = Literal["z", "servo", "laser"]

SERVO_WAIT_S = 0.15
"""For a servo to arrive; the controller does not know when it has."""

FULL_POWER = {"grbl": 1000, "marlin": 255}
"""What S means all of a laser's power: the firmwares' defaults."""


@dataclass(frozen=True)
class _Words:
    """The lines that move the pen or switch the laser, and the last one."""

    up: str
    down: str
    end: str
    ready: str = ""
    """Before the first stroke."""
    travel: str = ""
    """At the end of each G0."""
    draw: str = ""
    """At the end of the first G1 of each stroke."""


def write_gcode(
    strokes: Sequence[Stroke],
    *,
    flavour: Flavour = "grbl",
    pen: Pen = "z",
    draw_mm_s: float = 80.0,
    travel_mm_s: float = 300.0,
    lift_mm: float = 4.0,
    power: float = 0.5,
) -> str:
    """Text: lifted moves by G0, drawn ones by G1, ending lifted, or switched off, over X0 Y0.

    GRBL makes G0 as fast as its settings $110 to $112 allow, whatever `travel_mm_s` says.

    Args:
        power: share of a laser's power, above 0 and at most 1.
    """
    checked = checked_strokes(strokes)
    _check(checked, flavour, pen, (draw_mm_s, travel_mm_s, lift_mm), power)
    words = _words(flavour, pen, draw_mm_s, lift_mm, power)
    lines = _header(checked, pen, draw_mm_s, travel_mm_s, lift_mm)
    if pen == "laser":
        lines += _laser_header(checked, flavour, power)
    lines += ["G21", "G90", *words.up.splitlines(), *words.ready.splitlines()]
    for stroke in checked:
        start, *rest = stroke.tolist()
        lines += [f"G0 {_place(start)} F{60.0 * travel_mm_s:g}{words.travel}", *words.down.splitlines()]
        lines += [f"G1 {_place(rest[0])} F{60.0 * draw_mm_s:g}{words.draw}"]
        lines += [f"G1 {_place(point)}" for point in rest[1:]]
        lines += words.up.splitlines()
    return "\n".join([*lines, f"G0 X0 Y0 F{60.0 * travel_mm_s:g}{words.travel}", words.end, ""])


def _check(strokes: list[Stroke], flavour: str, pen: str, above_zero: tuple[float, ...], power: float) -> None:
    if not strokes:
        raise DrawingError("There is nothing to draw, so no G-code was written; change the settings and try again.")
    if flavour not in get_args(Flavour) or pen not in get_args(Pen):
        raise DrawingError(
            f"G-code is for grbl or marlin with the pen on z or servo or a laser, not for {flavour!r} and {pen!r}."
        )
    if not (np.array(above_zero) > 0.0).all():
        raise DrawingError("The drawing speed, the travel speed and the lift must be above zero; correct them.")
    if not 0.0 < power <= 1.0:
        raise DrawingError("The laser's power must be above 0 and at most 1; choose a share in this range.")
    if flavour == "grbl" and pen == "laser" and not any(map(_has_length, strokes)):
        raise DrawingError("GRBL's laser leaves no mark where it rests, and these are dots only; choose another mode.")


def _words(flavour: Flavour, pen: Pen, draw_mm_s: float, lift_mm: float, power: float) -> _Words:
    end = "M2" if flavour == "grbl" else "M400"  # Marlin knows no M2; M400 waits until the last move is made
    if pen == "z":
        return _Words(f"G0 Z{lift_mm:g}", f"G1 Z0 F{60.0 * draw_mm_s:g}", end)
    if pen == "laser":
        return _laser_words(flavour, end, power)
    if flavour == "grbl":
        wait = f"G4 P{SERVO_WAIT_S:g}"
        return _Words(f"M5\n{wait}", f"M3 S1000\n{wait}", end)
    wait = f"G4 P{1000.0 * SERVO_WAIT_S:g}"  # milliseconds; M400 first, for M280 does not wait for the moves
    return _Words(f"M400\nM280 P0 S0\n{wait}", f"M400\nM280 P0 S90\n{wait}", end)


def _laser_words(flavour: Flavour, end: str, power: float) -> _Words:
    strength = f"S{_strength(flavour, power)}"
    if flavour == "marlin":
        return _Words("M5", f"M3 {strength}", end)
    # M4 and M5 around each stroke would make GRBL stop there
    return _Words("", "", f"M5\n{end}", ready="M4 S0", travel=" S0", draw=f" {strength}")


def _strength(flavour: Flavour, power: float) -> int:
    return max(1, round(FULL_POWER[flavour] * power))


def _has_length(stroke: Stroke) -> bool:
    return bool((stroke != stroke[0]).any())


def _place(point: Sequence[float]) -> str:
    x, y = point
    return f"X{x:z.3f} Y{y:z.3f}"


def _header(strokes: list[Stroke], pen: Pen, draw_mm_s: float, travel_mm_s: float, lift_mm: float) -> list[str]:
    """What the file is, as comments. The time is without accelerations."""
    points = np.concatenate(strokes)
    (left, bottom), (right, top) = points.min(axis=0), points.max(axis=0)
    down = ink_mm(strokes)
    home = np.zeros((1, 2))
    up = length_mm(hops([home, *strokes, home]))
    change_s = {"z": lift_mm / travel_mm_s + lift_mm / draw_mm_s, "servo": 2.0 * SERVO_WAIT_S, "laser": 0.0}[pen]
    seconds = down / draw_mm_s + up / travel_mm_s + len(strokes) * change_s
    return [
        "; Delta Lab drawing, mm, X0 Y0 is the middle of the sheet",
        f"; bounds: X {left:.1f} to {right:.1f}, Y {bottom:.1f} to {top:.1f}",
        f"; strokes: {len(strokes)}, pen down {down:.0f} mm, pen up {up:.0f} mm",
        f"; time: at least {seconds:.0f} s at {draw_mm_s:g} mm/s down and {travel_mm_s:g} mm/s up",
    ]


def _laser_header(strokes: list[Stroke], flavour: Flavour, power: float) -> list[str]:
    said = f"; laser: power {100.0 * power:g} %, S{_strength(flavour, power)} of {FULL_POWER[flavour]}"
    if flavour == "marlin":
        return [f"{said}; Marlin must have LASER_FEATURE, and CUTTER_POWER_UNIT as PWM255"]
    dots = sum(not _has_length(stroke) for stroke in strokes)
    unmarked = [f"; laser: {dots} dots will not be marked, for it is dark where it rests"] if dots else []
    return [f"{said}; GRBL must be in laser mode, $32=1, with $30={FULL_POWER[flavour]}", *unmarked]
