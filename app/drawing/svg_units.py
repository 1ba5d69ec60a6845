"""Lengths, transforms and viewports of SVG, as numbers and 3x3 matrices."""

from __future__ import annotations

import math
import re

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError

PX_MM = 25.4 / 96.0
"""Millimetres of a CSS pixel."""

UNITS_PX = {"": 1.0, "px": 1.0, "in": 96.0, "pt": 96.0 / 72.0, "pc": 16.0}
UNITS_PX |= {"mm": 1.0 / PX_MM, "cm": 10.0 / PX_MM, "q": 0.25 / PX_MM}

NUMBER = r"[-+]?+(?:\d++(?:\.\d*+)?+|\.\d++)(?:[eE][-+]?\d++)?+"
"""It never goes back to try another reading, so that no text takes long."""

LENGTH = re.compile(rf"({NUMBER})\s*([a-zA-Z%]*)")
MAX_LENGTH = 2_000
"""Characters of a list of transforms or a viewBox."""

LARGEST = 1e9
"""Of any number; what is larger is a mistake or an attack."""

Matrix = NDArray[np.float64]


def finite_number(text: str) -> float:
    """A number within reason."""
    try:
        value = float(text)
    except ValueError:
        raise DrawingError(f"The SVG has {text[:20]!r} where a number belongs; save it again as a plain SVG.") from None
    if not abs(value) <= LARGEST:
        raise DrawingError(f"The SVG has the number {text[:20]!r}, which is no place on a sheet; correct the drawing.")
    return value


def numbers(text: str) -> list[float]:
    """Numbers separated by blanks or commas."""
    if len(text) > MAX_LENGTH:
        raise DrawingError(f"The SVG has {text[:20]!r} and more where a few numbers belong; save it as a plain SVG.")
    return [finite_number(word) for word in text.replace(",", " ").split()]


def length_px(text: str, whole_px: float) -> float:
    """A length with or without a unit, in CSS pixels; percentages are of `whole_px`."""
    match = LENGTH.fullmatch(text.strip()) if len(text) < 100 else None
    unit = match[2].lower() if match else ""
    if not match or unit not in {*UNITS_PX, "%"}:
        raise DrawingError(f"The SVG has the length {text.strip()[:20]!r}; give it in mm, cm, in or px.")
    return finite_number(match[1]) * (whole_px / 100.0 if unit == "%" else UNITS_PX[unit])


def translation(x: float, y: float) -> Matrix:
    return np.array([[1.0, 0.0, x], [0.0, 1.0, y], [0.0, 0.0, 1.0]])


def scaling(x: float, y: float) -> Matrix:
    return np.diag([x, y, 1.0])


def transform_matrix(text: str) -> Matrix:
    """What a `transform` attribute does to a column (x, y, 1)."""
    if len(text) > MAX_LENGTH:
        raise DrawingError(f"The SVG has the transform {text[:30]!r} and many more; save it again as a plain SVG.")
    matrix = np.eye(3)
    *parts, rest = text.split(")")
    for part in parts:
        name, bracket, arguments = part.partition("(")
        matrix = checked(matrix @ _one_transform(name.strip(" \t\r\n,"), numbers(arguments) if bracket else []))
    if rest.strip():
        raise DrawingError(f"The SVG has the transform {rest.strip()[:30]!r}; save it again as a plain SVG.")
    return matrix


def checked(matrix: Matrix) -> Matrix:
    """Refuse what has left all bounds."""
    if not (np.abs(matrix) <= LARGEST).all():
        raise DrawingError("The SVG magnifies its drawing beyond all bounds; correct its transforms or its viewBox.")
    return matrix


def _one_transform(name: str, values: list[float]) -> Matrix:
    match name, values:
        case "matrix", [a, b, c, d, e, f]:
            return np.array([[a, c, e], [b, d, f], [0.0, 0.0, 1.0]])
        case "translate", [x, *more] if len(more) < 2:
            return translation(x, *more or [0.0])
        case "scale", [x, *more] if len(more) < 2:
            return scaling(x, *more or [x])
        case "rotate", [degrees]:
            c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
            return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        case "rotate", [degrees, x, y]:
            return translation(x, y) @ _one_transform("rotate", [degrees]) @ translation(-x, -y)
        case "skewX", [degrees]:
            return np.array([[1.0, math.tan(math.radians(degrees)), 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
        case "skewY", [degrees]:
            return np.array([[1.0, 0.0, 0.0], [math.tan(math.radians(degrees)), 1.0, 0.0], [0.0, 0.0, 1.0]])
    raise DrawingError(f"The SVG has the transform {name[:20]!r} of {len(values)} numbers; save it as a plain SVG.")


def view_box(text: str) -> tuple[float, float, float, float]:
    """Corner and size that a `viewBox` shows, in the drawing's units."""
    match numbers(text):
        case [x, y, width, height] if width > 0.0 and height > 0.0:
            return x, y, width, height
    raise DrawingError(f"The SVG has the viewBox {text[:30]!r}; it needs a corner and a size above zero.")


def fit(box: tuple[float, float, float, float], width: float, height: float, aspect: str) -> Matrix:
    """Maps a viewBox to a viewport of that size, as `preserveAspectRatio` says."""
    x, y, box_width, box_height = box
    scale_x, scale_y = width / box_width, height / box_height
    if aspect.strip() != "none":
        scale_x = scale_y = (max if "slice" in aspect else min)(scale_x, scale_y)
    spare_x, spare_y = width - scale_x * box_width, height - scale_y * box_height
    share_x = 0.0 if "xMin" in aspect else 1.0 if "xMax" in aspect else 0.5
    share_y = 0.0 if "YMin" in aspect else 1.0 if "YMax" in aspect else 0.5
    return checked(translation(share_x * spare_x, share_y * spare_y) @ scaling(scale_x, scale_y) @ translation(-x, -y))
