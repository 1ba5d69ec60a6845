"""What a browser may say: every message type it sends, with the form and the bounds of its fields.

viser takes whatever arrives: a slider's value beyond its end, NaN for a position, a GUI element's callbacks
overwritten by name. Here a message is decoded only if it is one of these types, with all of their fields and
no others. Bounds refuse NaN and infinities as well. The types and their fields bear viser's names.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeAlias

import msgspec
from msgspec import Meta

MAX_TEXT = 10_000
MAX_NUMBERS = 64
LIMIT_SLACK = 1e-6
"""How far a value may lie outside its limits: a browser rounds to at most 7 decimals."""

Identifier: TypeAlias = Annotated[str, Meta(max_length=256)]
Text: TypeAlias = Annotated[str, Meta(max_length=MAX_TEXT)]
Count: TypeAlias = Annotated[int, Meta(ge=0, le=2**40)]
Number: TypeAlias = Annotated[float, Meta(ge=-1e9, le=1e9)]
Metres: TypeAlias = Annotated[float, Meta(ge=-1e3, le=1e3)]
Component: TypeAlias = Annotated[float, Meta(ge=-1.001, le=1.001)]
Point: TypeAlias = tuple[Metres, Metres, Metres]
Direction: TypeAlias = tuple[Component, Component, Component]
Quaternion: TypeAlias = tuple[Component, Component, Component, Component]
ScreenPoint: TypeAlias = tuple[Number, Number]
Modifier: TypeAlias = Literal[
    "cmd/ctrl", "alt", "shift", "cmd/ctrl+alt", "cmd/ctrl+shift", "alt+shift", "cmd/ctrl+alt+shift"
]
Value: TypeAlias = bool | Number | Text | Annotated[list[Number], Meta(max_length=MAX_NUMBERS)]


class Inbound(msgspec.Struct, tag=True, forbid_unknown_fields=True):
    """A message from a browser."""


class ViewerCameraMessage(Inbound):
    wxyz: Quaternion
    position: Point
    fov: Number
    near: Number
    far: Number
    image_height: Count
    image_width: Count
    look_at: Point
    up_direction: Point


class ScenePointerMessage(Inbound):
    event_type: Literal["click", "rect-select"]
    ray_origin: Point | None
    ray_direction: Direction | None
    screen_pos: Annotated[tuple[ScreenPoint, ...], Meta(max_length=2)]
    modifier: Modifier | None


class SceneNodeClickMessage(Inbound):
    name: Identifier
    instance_index: Count | None
    ray_origin: Point
    ray_direction: Direction
    screen_pos: ScreenPoint
    modifier: Modifier | None
    owner: Identifier


class SceneNodeDragMessage(Inbound):
    phase: Literal["start", "update", "end"]
    name: Identifier
    instance_index: Count | None
    start_position: Point
    start_screen_pos: ScreenPoint
    end_position: Point
    end_screen_pos: ScreenPoint
    button: Literal["left", "middle", "right"]
    modifier: Modifier | None
    owner: Identifier


class TransformControlsDragStartMessage(Inbound):
    name: Identifier
    owner: Identifier


class TransformControlsUpdateMessage(Inbound):
    name: Identifier
    wxyz: Quaternion
    position: Point
    owner: Identifier


class TransformControlsDragEndMessage(Inbound):
    name: Identifier
    owner: Identifier


class NewValue(msgspec.Struct, forbid_unknown_fields=True):
    value: Value


class GuiUpdateMessage(Inbound):
    uuid: Identifier
    updates: NewValue


class GuiButtonHoldMessage(Inbound):
    uuid: Identifier
    frequency: Number


class GuiFormSubmitMessage(Inbound):
    uuid: Identifier


class GuiFormDirtyMessage(Inbound):
    uuid: Identifier


class CommandTriggerMessage(Inbound):
    uuid: Identifier


class FileTransferStartUpload(Inbound):
    source_component_uuid: Identifier
    transfer_uuid: Identifier
    filename: Text
    mime_type: Identifier
    part_count: Count
    size_bytes: Count


class FileTransferPart(Inbound):
    source_component_uuid: Identifier
    transfer_uuid: Identifier
    part_index: Count
    content: bytes


class LocalStorageGetItemResponseMessage(Inbound):
    value: Text | None
    error: Text | None
    request_uuid: Identifier


class GetRenderResponseMessage(Inbound):
    payload: bytes
    render_uuid: Identifier


MESSAGE_TYPES: tuple[type[Inbound], ...] = tuple(Inbound.__subclasses__())
_DECODER = msgspec.msgpack.Decoder(functools.reduce(operator.or_, MESSAGE_TYPES))


class Garbled(ValueError):
    """A frame that is not a message at all."""


def decode(frame: bytes) -> Inbound | None:
    """The message in a frame; None if it is none that a browser sends.

    Raises `Garbled` if the frame is not msgpack.
    """
    try:
        message = _DECODER.decode(frame)
    except msgspec.ValidationError:
        return None
    except (msgspec.DecodeError, RecursionError) as error:
        raise Garbled(str(error)) from None
    wxyz = getattr(message, "wxyz", None)
    return message if wxyz is None or math.hypot(*wxyz) > 0.5 else None


def fields(message: Inbound) -> dict[str, Any]:
    """A message's fields as plain data."""
    return {name: _plain(getattr(message, name)) for name in message.__struct_fields__}


def _plain(value: Any) -> Any:
    return msgspec.structs.asdict(value) if isinstance(value, msgspec.Struct) else value


def fit(value: Value, element: Any) -> Value | None:
    """`value` as an input element may take it; None if it does not fit.

    It has to be of the same kind (and length) as `element.value`, among `element.options` and between
    `element.min` and `element.max`, where it has them. What lies outside by no more than a browser's rounding is
    clamped.
    """
    current = element.value
    if isinstance(value, bool) or isinstance(current, bool):
        return value if isinstance(value, bool) and isinstance(current, bool) else None
    if isinstance(value, str):
        options = getattr(element, "options", None)
        return value if isinstance(current, str) and (options is None or value in options) else None
    lower, upper = getattr(element, "min", None), getattr(element, "max", None)
    if isinstance(value, list):
        return _fit_numbers(value, current, lower, upper) if isinstance(current, tuple) else None
    return _fit_number(value, current, lower, upper) if isinstance(current, int | float) else None


def _fit_numbers(values: list[float], current: tuple[float, ...], lower: Any, upper: Any) -> list[float] | None:
    """Limits are for all numbers, or one for each; a colour has whole numbers and needs none to be limited."""
    if len(values) != len(current):
        return None
    is_color = lower is None and upper is None and all(isinstance(number, int) for number in current)
    lowest = lower if isinstance(lower, Sequence) else [0 if is_color else lower] * len(values)
    highest = upper if isinstance(upper, Sequence) else [255 if is_color else upper] * len(values)
    fitted = [number for number in map(_fit_number, values, current, lowest, highest) if number is not None]
    return fitted if len(fitted) == len(values) else None


def _fit_number(value: float, current: float, lower: float | None, upper: float | None) -> float | None:
    if isinstance(current, int) and not value.is_integer():
        return None
    low = -math.inf if lower is None else lower
    high = math.inf if upper is None else upper
    return min(max(value, low), high) if low - LIMIT_SLACK <= value <= high + LIMIT_SLACK else None
