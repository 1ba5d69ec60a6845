"""What worker processes do for the tab Draw: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import cv2
import numpy as np
from numpy.typing import NDArray

from app.drawing.compose import Composition, Look, compose
from app.drawing.errors import DrawingError, TooManyStrokes
from app.drawing.exports import EXPORTS, write_gcode, write_preview_png, write_toolpath_csv
from app.drawing.modes import DRAWING_MODES
from app.drawing.order import Improvement, between_mm, ink_mm, join_touching
from app.drawing.retraced import retraced_share
from app.drawing.samples import sample_bytes
from app.drawing.source import Source, read_source, text_source
from app.drawing.toolpath import (
    PenSettings,
    Placement,
    Toolpath,
    Track,
    laser_power,
    plan_toolpath,
    track,
    unreachable,
)
from app.robots import build_robot
from app.ui.refusal import Refusal

Array = NDArray[np.float64]

PREVIEW_PX = 640
"""Long side of the picture of a sheet."""

THINNEST_PX = 1.7
"""A thinner line would fade where the picture is shown."""

ORIGINAL_PX = 420
MOST_IMPROVED = 5000
"""More strokes than this are left in the order that was found at once."""

LASER_POINTS = 400


@dataclass(frozen=True)
class Setup:
    """The robot, the sheet before it, and its pen."""

    robot: str
    dimensions: dict[str, float]
    placement: Placement
    pen: PenSettings


@dataclass(frozen=True, eq=False)
class Sketch:
    """A drawing on its sheet as it is shown, drawn and saved."""

    strokes: list[Array]
    """(n, 2) each, sheet mm, in the order of drawing."""
    look: Look
    mode: str
    reason: str
    notes: tuple[str, ...]
    similarity: float | None
    ink_mm: float
    between_mm: float
    """Way from stroke to stroke."""
    setup: Setup
    outside: list[NDArray[np.bool_]]
    """Which points of each stroke are out of reach."""
    preview: bytes
    """PNG of the sheet."""
    original: bytes | None
    """JPEG of the prepared picture."""
    retraced: float
    """0 to 1, share of the ink that runs along ink that is there already."""

    @property
    def chosen_look(self) -> Look:
        """With the mode that `auto` has chosen."""
        return replace(self.look, mode=self.mode) if self.mode in DRAWING_MODES else self.look

    @property
    def is_reachable(self) -> bool:
        return not any(mask.any() for mask in self.outside)


class TooDense(NamedTuple):
    """More strokes than make sense, and the settings that help."""

    reason: str
    coarser: dict[str, float]


class Plan(NamedTuple):
    """The robot's way along a drawing."""

    track: Track
    time_s: float
    stray_ink_mm: float
    peak_speed: float
    """Of the joints, in parts of their limits."""
    peak_acceleration: float
    laser: tuple[Array, Array, Array] | None
    """t (s), speed (mm/s), power (0..1) of a laser."""


class Improved(NamedTuple):
    """A quicker order of the same strokes."""

    state: Improvement
    sketch: Sketch
    plan: Plan


def read(name: str, data: bytes) -> Source | Refusal:
    """A file that was uploaded."""
    try:
        return read_source(name, data)
    except DrawingError as error:
        return Refusal(str(error))


def read_sample(name: str) -> Source | Refusal:
    """A picture that ships with Delta Lab."""
    return read(name, sample_bytes(name))


def read_text(text: str) -> Source | Refusal:
    """Typed letters."""
    try:
        return text_source(text)
    except DrawingError as error:
        return Refusal(str(error))


def sketch(source: Source, look: Look, setup: Setup) -> Sketch | Refusal | TooDense:
    """Strokes of a picture, and whether the robot reaches them."""
    try:
        found = compose(source, look)
        outside = outside_of(found.strokes, setup)
    except TooManyStrokes as error:
        return TooDense(str(error), error.coarser)
    except DrawingError as error:
        return Refusal(str(error))
    preview = picture_of(found.strokes, look, setup, outside)
    return Sketch(
        found.strokes,
        look,
        found.mode,
        found.reason,
        found.notes,
        found.similarity,
        ink_mm(found.strokes),
        between_mm(found.strokes),
        setup,
        outside,
        preview,
        _original(found),
        retraced_share(found.strokes),
    )


def placed(drawn: Sketch, setup: Setup) -> Sketch:
    """The same strokes where the sheet lies now, under the pen as it is now."""
    outside = outside_of(drawn.strokes, setup)
    preview = picture_of(drawn.strokes, drawn.look, setup, outside)
    return replace(drawn, setup=setup, outside=outside, preview=preview)


def outside_of(strokes: list[Array], setup: Setup) -> list[NDArray[np.bool_]]:
    """Which points the robot cannot reach, (n,) a stroke."""
    return unreachable(strokes, build_robot(setup.robot, setup.dimensions), setup.placement)


def picture_of(strokes: list[Array], look: Look, setup: Setup, outside: list[NDArray[np.bool_]]) -> bytes:
    """PNG of the sheet."""
    px_per_mm = PREVIEW_PX / max(look.sheet_mm)
    return write_preview_png(
        strokes,
        look.sheet_mm,
        px_per_mm,
        pen_mm=max(look.pen_mm, THINNEST_PX / px_per_mm),
        outside=outside,
        stray=setup.pen.marks_hops,
        margin_mm=look.margin_mm,
    )


def plan(strokes: list[Array], setup: Setup) -> Plan | Refusal:
    """The trajectory, or why there is none."""
    try:
        return _summary(_toolpath(strokes, setup), setup.pen)
    except DrawingError as error:
        return Refusal(str(error))


def improve(state: Improvement, drawn: Sketch, best: Plan, seconds: float) -> Improved | None:
    """Look for a quicker order for some seconds; None where none was found or it is not worth a change."""
    state.improve(seconds)
    strokes = join_touching(state.strokes)
    found = plan(strokes, drawn.setup)
    if isinstance(found, Refusal) or found.time_s >= best.time_s:
        return None
    outside = [np.zeros(len(stroke), bool) for stroke in strokes]  # or there would be no plan
    preview = picture_of(strokes, drawn.look, drawn.setup, outside)
    lengths = {"ink_mm": ink_mm(strokes), "between_mm": between_mm(strokes)}
    return Improved(state, replace(drawn, strokes=strokes, preview=preview, outside=outside, **lengths), found)


def can_improve(drawn: Sketch) -> bool:
    """The paper's way keeps the order in which OpenCV finds its contours."""
    return drawn.mode != "paper" and 2 < len(drawn.strokes) <= MOST_IMPROVED


def export(drawn: Sketch, suffix: str, variant: dict[str, Any]) -> bytes | Refusal:
    """A file of what is shown; `variant` are settings of G-code. `timed.csv` is the robot's own path."""
    pen = drawn.setup.pen
    try:
        if suffix == ".gcode":
            speeds = {"draw_mm_s": pen.speed_mm_s, "travel_mm_s": pen.up_speed_mm_s, "lift_mm": pen.lift_mm}
            return write_gcode(drawn.strokes, **{**speeds, **variant}).encode()
        if suffix == "timed.csv":
            return write_toolpath_csv(_toolpath(drawn.strokes, drawn.setup)).encode()
        return EXPORTS[suffix].write(drawn.strokes, drawn.look.sheet_mm)
    except DrawingError as error:
        return Refusal(str(error))


def _toolpath(strokes: list[Array], setup: Setup) -> Toolpath:
    return plan_toolpath(strokes, build_robot(setup.robot, setup.dimensions), setup.placement, setup.pen)


def _summary(path: Toolpath, pen: PenSettings) -> Plan:
    laser = None
    if pen.laser:
        chosen = np.linspace(0, len(path.t) - 1, LASER_POINTS).astype(int)
        laser = (path.t[chosen], 1e3 * path.speed_m_s[chosen], laser_power(path, pen)[chosen])
    ratios = path.max_joint_speed_ratio, path.max_joint_acceleration_ratio
    return Plan(track(path), path.duration_s, path.stray_ink_mm, *ratios, laser)


def _original(found: Composition) -> bytes | None:
    """The picture as it was when lines were sought in it."""
    if found.prepared is None:
        return None
    height, width = found.prepared.shape
    scale = min(1.0, ORIGINAL_PX / max(height, width))
    size = max(1, round(width * scale)), max(1, round(height * scale))
    small = cv2.resize(found.prepared, size, interpolation=cv2.INTER_AREA)
    return cv2.imencode(".jpg", small, (cv2.IMWRITE_JPEG_QUALITY, 85))[1].tobytes()
