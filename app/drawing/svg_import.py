"""Shapes of an SVG file as strokes on the sheet: a drawing from Inkscape or vpype instead of a photo.

Every shape gives its outline, whether filled or stroked; text and pictures inside the file are not drawn. What
`display:none` hides stays hidden, such as the pen-up layer that `write_svg` adds.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.drawing.svg_path import MAX_POINTS, path_polylines
from app.drawing.svg_units import (
    PX_MM,
    Matrix,
    checked,
    fit,
    length_px,
    scaling,
    transform_matrix,
    translation,
    view_box,
)
from app.drawing.svg_xml import MAX_DEPTH, MAX_ELEMENTS, Element, parse_svg

TOLERANCE_MM = 0.01
"""By which polylines may be off the curves: far below a pen's width."""

LARGEST_MM = 1e5
GROUPS = {"svg", "g", "a", "switch"}

Stroke = NDArray[np.float64]
Size = tuple[float, float]
NO_SIZE: Size = (0.0, 0.0)

Get = Callable[[str], float]
"""A shape's attribute by name, in pixels; 0 without it."""


def read_svg(data: bytes) -> list[Stroke]:
    """(n, 2) strokes in the file's order, mm from the middle of its sheet, y up.

    Without a size or a viewBox the middle of the drawing is the middle of the sheet. DrawingError for files that
    cannot be read, hold more than a drawing, or hold nothing to draw.
    """
    root = parse_svg(data)
    matrix, size, whole = _page(root)
    strokes = list(_Reader(root, whole).strokes(root.children, scaling(PX_MM, PX_MM) @ matrix))
    if not strokes:
        raise DrawingError("The SVG holds no lines to draw; turn its text and pictures into paths and save it again.")
    middle = PX_MM * np.array(size) / 2.0 if size != NO_SIZE else _middle(strokes)
    return [(stroke - middle) * (1.0, -1.0) + 0.0 for stroke in strokes]  # + 0.0: no minus zeros


def _middle(strokes: list[Stroke]) -> NDArray[np.float64]:
    points = np.concatenate(strokes)
    return (points.min(axis=0) + points.max(axis=0)) / 2.0


def _page(root: Element) -> tuple[Matrix, Size, Size]:
    """From the drawing's units to pixels of the page; the page's size in pixels, and in the drawing's units."""
    get = root.attributes.get
    width, height = (length_px(get(name, "0"), 0.0) for name in ("width", "height"))  # 100 % of the unknown is 0
    if "viewBox" not in root.attributes:
        size = (width, height) if width > 0.0 and height > 0.0 else NO_SIZE
        return np.eye(3), size, size
    box = view_box(root.attributes["viewBox"])
    if width <= 0.0:
        width = height * box[2] / box[3] if height > 0.0 else box[2]
    if height <= 0.0:
        height = width * box[3] / box[2]
    return fit(box, width, height, get("preserveAspectRatio", "")), (width, height), box[2:]


class _Reader:
    """Walks through the elements; counts, for `use` can repeat repetitions."""

    def __init__(self, root: Element, whole: Size) -> None:
        self._whole = whole
        """What percentages are of, in the drawing's units."""
        self._named: dict[str, Element] = {}
        self._elements = self._points = 0
        self._index(root)

    def strokes(self, elements: list[Element], matrix: Matrix, depth: int = 0) -> Iterator[Stroke]:
        """Sheet strokes in mm from the page's upper left corner, y down."""
        for element in elements:
            self._elements += 1
            if depth > MAX_DEPTH or self._elements > MAX_ELEMENTS:
                raise DrawingError("The SVG repeats its parts too often; unlink its clones and try again.")
            if not _is_hidden(element):
                yield from self._element(element, _moved(matrix, element), depth + 1)

    def _element(self, element: Element, matrix: Matrix, depth: int) -> Iterator[Stroke]:
        if element.tag in SHAPES:
            yield from self._shape(element, matrix)
        elif element.tag in GROUPS:
            inner = self._viewport(element) if element.tag == "svg" else np.eye(3)
            yield from self.strokes(element.children, checked(matrix @ inner), depth)
        elif element.tag == "use":
            get = self._getter(element)
            target = self._named.get(element.link.strip()[1:])
            parts = target.children if target and target.tag == "symbol" else [target] if target else []
            yield from self.strokes(parts, checked(matrix @ translation(get("x"), get("y"))), depth)

    def _shape(self, element: Element, matrix: Matrix) -> Iterator[Stroke]:
        """Outlines of one shape; nothing if it is squeezed to nothing."""
        magnification = float(np.linalg.norm(matrix[:2, :2]))
        if magnification < 1e-9:
            return
        data = SHAPES[element.tag](element.attributes, self._getter(element))
        for line in path_polylines(data, TOLERANCE_MM / magnification):
            stroke = line @ matrix[:2, :2].T + matrix[:2, 2]
            self._points += len(stroke)
            if self._points > MAX_POINTS:
                raise DrawingError(f"The SVG has more than {MAX_POINTS} points; simplify its paths and try again.")
            if np.abs(stroke).max() > LARGEST_MM:
                raise DrawingError("The SVG reaches further than 100 m; correct its size, its viewBox or its units.")
            yield stroke

    def _viewport(self, element: Element) -> Matrix:
        """Of an `svg` within the `svg`."""
        get = self._getter(element)
        moved = translation(get("x"), get("y"))
        width, height = get("width") or self._whole[0], get("height") or self._whole[1]
        if "viewBox" not in element.attributes or width <= 0.0 or height <= 0.0:
            return moved
        box = view_box(element.attributes["viewBox"])
        return moved @ fit(box, width, height, element.attributes.get("preserveAspectRatio", ""))

    def _getter(self, element: Element) -> Get:
        def get(name: str) -> float:
            is_upright = name in {"y", "cy", "ry", "y1", "y2", "height"}
            return length_px(element.attributes.get(name, "0"), self._whole[is_upright])

        return get

    def _index(self, element: Element) -> None:
        self._named.setdefault(element.attributes.get("id", ""), element)
        for child in element.children:
            self._index(child)


def _moved(matrix: Matrix, element: Element) -> Matrix:
    transform = element.attributes.get("transform")
    return checked(matrix @ transform_matrix(transform)) if transform else matrix


def _is_hidden(element: Element) -> bool:
    pairs = (pair.partition(":") for pair in element.attributes.get("style", "").split(";"))
    found = element.attributes | {name.strip(): value.strip() for name, _, value in pairs}
    return found.get("display") == "none" or found.get("visibility") in {"hidden", "collapse"}


def _rect(attributes: dict[str, str], get: Get) -> str:
    x, y, width, height = get("x"), get("y"), get("width"), get("height")
    if width <= 0.0 or height <= 0.0:
        return ""
    rx = min(get("rx" if "rx" in attributes else "ry"), width / 2.0)
    ry = min(get("ry" if "ry" in attributes else "rx"), height / 2.0)
    if rx <= 0.0 or ry <= 0.0:
        return f"M{x} {y}h{width}v{height}H{x}z"
    right, bottom, arc = x + width, y + height, f"A{rx} {ry} 0 0 1"
    return (
        f"M{x + rx} {y}H{right - rx}{arc} {right} {y + ry}V{bottom - ry}{arc} {right - rx} {bottom}"
        f"H{x + rx}{arc} {x} {bottom - ry}V{y + ry}{arc} {x + rx} {y}z"
    )


def _ellipse(cx: float, cy: float, rx: float, ry: float) -> str:
    if rx <= 0.0 or ry <= 0.0:
        return ""
    arc = f"A{rx} {ry} 0 0 1"
    return f"M{cx + rx} {cy}{arc} {cx - rx} {cy}{arc} {cx + rx} {cy}z"


SHAPES: dict[str, Callable[[dict[str, str], Get], str]] = {
    "path": lambda attributes, get: attributes.get("d", ""),
    "polyline": lambda attributes, get: f"M{points}" if (points := attributes.get("points", "").strip()) else "",
    "polygon": lambda attributes, get: f"M{points}z" if (points := attributes.get("points", "").strip()) else "",
    "line": lambda attributes, get: f"M{get('x1')} {get('y1')}L{get('x2')} {get('y2')}",
    "rect": _rect,
    "circle": lambda attributes, get: _ellipse(get("cx"), get("cy"), get("r"), get("r")),
    "ellipse": lambda attributes, get: _ellipse(get("cx"), get("cy"), get("rx"), get("ry")),
}
"""The path data of every basic shape."""
