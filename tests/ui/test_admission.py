"""Which messages of a page are let through, without viser and without a network."""

from __future__ import annotations

import contextlib
import math
from types import SimpleNamespace
from typing import Any

import msgspec.msgpack
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.ui import inbound
from app.ui.admission import Admission
from app.ui.guard import MIB, Guard
from app.ui.uploads import UploadLedger, base_name

POSE = {"wxyz": [1.0, 0.0, 0.0, 0.0], "position": [0.1, 0.2, 0.3]}
DRAG = {"type": "TransformControlsUpdateMessage", "name": "/robot/gizmo", "owner": "3", **POSE}
CAMERA = {
    "type": "ViewerCameraMessage", **POSE, "fov": 1.3, "near": 0.01, "far": 1000.0,
    "image_height": 900, "image_width": 1440, "look_at": [0, 0, 0], "up_direction": [0, 0, 1],
}  # fmt: skip


def packed(message: Any) -> bytes:
    return msgspec.msgpack.encode(message)


def decoded(message: Any, **changes: Any) -> inbound.Inbound | None:
    return inbound.decode(packed({**message, **changes}))


def element(value: Any, **props: Any) -> SimpleNamespace:
    return SimpleNamespace(value=value, **{"disabled": False, **props})


class FakePage:
    number = 7

    def __init__(self, **elements: SimpleNamespace) -> None:
        self.elements = elements
        self.declined: list[str] = []

    def element(self, uuid: str) -> Any | None:
        return self.elements.get(uuid)

    def takes_files(self, uuid: str) -> bool:
        return uuid.startswith("upload")

    def has_container(self, uuid: str) -> bool:
        return uuid == "form"

    def decline_upload(self, upload: inbound.FileTransferStartUpload) -> None:
        self.declined.append(upload.transfer_uuid)


def admission(page: FakePage, guard: Guard | None = None) -> Admission:
    return Admission(page, UploadLedger(guard or Guard()))


def test_what_a_browser_sends_is_decoded() -> None:
    assert decoded(DRAG) == inbound.TransformControlsUpdateMessage(
        name="/robot/gizmo", wxyz=(1.0, 0.0, 0.0, 0.0), position=(0.1, 0.2, 0.3), owner="3"
    )
    assert isinstance(decoded(CAMERA), inbound.ViewerCameraMessage)
    assert decoded({"type": "GuiUpdateMessage", "uuid": "a", "updates": {"value": 3}}) is not None


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf, 1.1e3, -1e300, "0", None, [0], True, 2**63])
def test_a_wrong_coordinate_is_refused(wrong: Any) -> None:
    assert decoded(DRAG, position=[0.0, wrong, 0.0]) is None
    assert decoded(CAMERA, look_at=[0.0, 0.0, wrong]) is None


@pytest.mark.parametrize("wrong", [[0.1, 0.2], [0.1, 0.2, 0.3, 0.4], [], None, "abc", {"0": 1.0}])
def test_a_point_has_three_numbers(wrong: Any) -> None:
    assert decoded(DRAG, position=wrong) is None


@pytest.mark.parametrize("wrong", [[0.0] * 4, [0.1] * 4, [math.nan, 0, 0, 0], [2.0, 0, 0, 0], [1.0, 0, 0]])
def test_an_orientation_is_a_unit_quaternion(wrong: Any) -> None:
    assert decoded(DRAG, wxyz=wrong) is None


@pytest.mark.parametrize(
    "message",
    [
        {"type": "ShareUrlRequest"},
        {"type": "ShareUrlDisconnect"},
        {"type": "SetPositionMessage", "name": "/robot", "position": [0, 0, 0]},
        {"type": "RunJavascriptMessage", "source": "alert(1)"},
        {"type": "GuiRemoveMessage", "uuid": "a"},
        {"type": "Inbound"},
        {"type": "__class__"},
        {"type": 5},
        {},
    ],
)
def test_what_no_browser_sends_is_refused(message: dict[str, Any]) -> None:
    assert decoded(message) is None


@pytest.mark.parametrize(
    "updates",
    [
        {"update_cb": []},
        {"removed": True},
        {"value": 1.0, "removed": True},
        {},
        {"value": None},
        {"value": {"a": 1}},
        {"value": "x" * (inbound.MAX_TEXT + 1)},
        {"value": [0.0] * (inbound.MAX_NUMBERS + 1)},
        {"value": ["a"]},
    ],
)
def test_an_update_carries_nothing_but_a_plain_value(updates: dict[str, Any]) -> None:
    assert decoded({"type": "GuiUpdateMessage", "uuid": "a", "updates": updates}) is None


def test_missing_and_unknown_fields_are_refused() -> None:
    assert inbound.decode(packed({key: value for key, value in DRAG.items() if key != "owner"})) is None
    assert decoded(DRAG, excluded_self_client=3) is None


def test_a_type_given_twice_does_not_smuggle_another_one() -> None:
    """Readers that disagree on which of two keys counts could let pass what was never looked at."""
    entries = [("type", "TransformControlsDragEndMessage"), ("name", "g"), ("owner", ""), ("type", "ShareUrlRequest")]
    frame = bytes([0x80 | len(entries)]) + b"".join(packed(part) for entry in entries for part in entry)
    message = inbound.decode(frame)
    assert message is None or type(message) in inbound.MESSAGE_TYPES


@pytest.mark.parametrize("frame", [b"", b"\xc1", b"\x81\xa4type", packed(DRAG) + b"\x00", packed(DRAG)[:-1]])
def test_what_is_not_msgpack_is_garbled(frame: bytes) -> None:
    with pytest.raises(inbound.Garbled):
        inbound.decode(frame)


@given(st.binary(max_size=200))
def test_any_bytes_are_a_message_or_refused_or_garbled(frame: bytes) -> None:
    try:
        message = inbound.decode(frame)
    except inbound.Garbled:
        return
    assert message is None or type(message) in inbound.MESSAGE_TYPES


@pytest.mark.parametrize("depth", [50, 5_000, 100_000])
def test_deep_nesting_ends_without_a_crash(depth: int) -> None:
    nested = b"\x91" * depth + b"\xc0"
    assert inbound.decode(nested) is None
    frame = b"\x83\xa4type\xb0GuiUpdateMessage\xa4uuid\xa1a\xa7updates\x81\xa5value" + nested
    with contextlib.suppress(inbound.Garbled):
        assert inbound.decode(frame) is None


SLIDER = element(0.5, min=0.0, max=1.0)
COLOR = element((1, 2, 3))


@pytest.mark.parametrize(
    ("value", "into", "fitted"),
    [
        (0.25, SLIDER, 0.25),
        (1.0 + 5e-8, SLIDER, 1.0),
        (-5e-8, SLIDER, 0.0),
        (3.0, element(2, min=0, max=9), 3.0),
        (1e6, element(0.0, min=None, max=None), 1e6),
        (True, element(False), True),
        ("par4", element("delta3", options=("par4", "delta3")), "par4"),
        ("any text", element(""), "any text"),
        ([0.1, 0.2], element((0.0, 0.0), min=0.0, max=1.0), [0.1, 0.2]),
        ([0.1, 5.0], element((0.0, 0.0), min=(0.0, 4.0), max=(1.0, 6.0)), [0.1, 5.0]),
        ([0.0, 128.0, 255.0], COLOR, [0.0, 128.0, 255.0]),
    ],
)
def test_a_fitting_value_is_taken(value: Any, into: Any, fitted: Any) -> None:
    assert inbound.fit(value, into) == fitted


@pytest.mark.parametrize(
    ("value", "into"),
    [
        (1.1, SLIDER),
        (-1e9, SLIDER),
        (True, SLIDER),
        ("0.5", SLIDER),
        ([0.5], SLIDER),
        (2.5, element(2, min=0, max=9)),
        (1.0, element(False)),
        (True, element("text")),
        (1.0, element("text")),
        ("evil<script>", element("par4", options=("par4", "delta3"))),
        (False, element(1)),
        ([0.1], element((0.0, 0.0), min=0.0, max=1.0)),
        ([0.1, 1.5], element((0.0, 0.0), min=0.0, max=1.0)),
        ([0.1, 3.0], element((0.0, 0.0), min=(0.0, 4.0), max=(1.0, 6.0))),
        ([0.0, 0.0, 256.0], COLOR),
        ([0.0, 0.0, 0.5], COLOR),
        ("file", element(SimpleNamespace(name="a", content=b""))),
        (1.0, element(SimpleNamespace(name="a", content=b""))),
    ],
)
def test_any_other_value_is_refused(value: Any, into: Any) -> None:
    assert inbound.fit(value, into) is None


def update(uuid: str, value: Any) -> bytes:
    return packed({"type": "GuiUpdateMessage", "uuid": uuid, "updates": {"value": value}})


def test_an_update_is_for_an_element_that_is_there_and_switched_on() -> None:
    looks = admission(FakePage(on=element(0.5, min=0.0, max=1.0), off=element(0.5, disabled=True)))
    assert looks.admit(update("on", 0.75)) == inbound.GuiUpdateMessage("on", inbound.NewValue(0.75))
    assert looks.admit(update("on", 7.5)) is None
    assert looks.admit(update("off", 0.75)) is None
    assert looks.admit(update("gone", 0.75)) is None


def test_a_form_has_to_be_there() -> None:
    looks = admission(FakePage())
    assert looks.admit(packed({"type": "GuiFormDirtyMessage", "uuid": "form"})) is not None
    assert looks.admit(packed({"type": "GuiFormDirtyMessage", "uuid": "no form"})) is None


def begin(size: int, parts: int, *, transfer: str = "t", button: str = "upload", name: str = "photo.jpg") -> bytes:
    return packed(
        {
            "type": "FileTransferStartUpload", "source_component_uuid": button, "transfer_uuid": transfer,
            "filename": name, "mime_type": "image/jpeg", "part_count": parts, "size_bytes": size,
        }
    )  # fmt: skip


def part(index: int, size: int, *, transfer: str = "t", button: str = "upload") -> bytes:
    return packed(
        {
            "type": "FileTransferPart", "source_component_uuid": button, "transfer_uuid": transfer,
            "part_index": index, "content": bytes(size),
        }
    )  # fmt: skip


BUTTONS = {"upload": element(None), "upload2": element(None), "slider": element(0.5)}


def test_an_upload_as_declared_is_taken() -> None:
    looks = admission(FakePage(**BUTTONS))
    assert looks.admit(begin(MIB + 3, 3)) is not None
    assert [looks.admit(part(index, size)) is not None for index, size in [(2, 3), (0, MIB // 2), (1, MIB // 2)]] == [
        True
    ] * 3
    assert looks.admit(part(2, 3)) is None, "the upload has ended"
    assert looks.admit(begin(MIB + 3, 3)) is not None, "and its place is free"


def test_an_empty_file_is_taken() -> None:
    looks = admission(FakePage(**BUTTONS))
    assert looks.admit(begin(0, 0)) is not None
    assert looks.admit(part(0, 1)) is None


@pytest.mark.parametrize("button", ["slider", "gone"])
def test_only_an_upload_button_takes_files(button: str) -> None:
    assert admission(FakePage(**BUTTONS)).admit(begin(10, 1, button=button)) is None


def test_a_file_never_has_more_bytes_or_parts_than_declared() -> None:
    looks = admission(FakePage(**BUTTONS))
    looks.admit(begin(100_000, 2))
    assert looks.admit(part(0, 100_001)) is None
    assert looks.admit(part(2, 10)) is None
    assert looks.admit(part(0, 60_000)) is not None
    assert looks.admit(part(0, 10)) is None, "the same part again"
    assert looks.admit(part(1, 39_999)) is None, "the last part brings too little"
    assert looks.admit(part(1, 40_000, button="slider")) is None, "the file was meant for the button"
    assert looks.admit(part(1, 40_000)) is not None


@pytest.mark.parametrize(("size", "parts"), [(10, 0), (0, 1), (10, 2), (MIB, 1000)])
def test_a_file_has_a_plausible_number_of_parts(size: int, parts: int) -> None:
    assert admission(FakePage(**BUTTONS)).admit(begin(size, parts)) is None


def test_unfinished_uploads_are_bounded() -> None:
    page = FakePage(**BUTTONS)
    looks = admission(page, Guard(max_uploads=3, max_upload_bytes=1000))
    taken = [looks.admit(begin(size, 1, transfer=str(size))) is not None for size in (1001, 400, 500, 200, 50, 10)]
    assert taken == [False, True, True, False, True, False]
    assert page.declined == ["1001", "200", "10"]


def test_all_pages_together_are_bounded_and_leaving_frees() -> None:
    ledger = UploadLedger(Guard(max_upload_bytes=1000, max_upload_bytes_in_all=1500))
    one, two = FakePage(**BUTTONS), FakePage(**BUTTONS)
    two.number = 8
    assert Admission(one, ledger).admit(begin(1000, 1, transfer="a")) is not None
    assert Admission(two, ledger).admit(begin(1000, 1, transfer="b")) is None
    assert Admission(two, ledger).admit(part(0, 1000, transfer="a")) is None, "another page's upload"
    ledger.forget(one.number)
    assert Admission(two, ledger).admit(begin(1000, 1, transfer="b")) is not None


@pytest.mark.parametrize(
    ("path", "name"),
    [
        ("photo.jpg", "photo.jpg"),
        ("../../etc/passwd", "passwd"),
        ("C:\\Users\\eve\\photo.jpg", "photo.jpg"),
        ("/", "upload"),
        ("..", "upload"),
        ("", "upload"),
        (".bashrc", "bashrc"),
        ("a\x00b\n.png", "ab.png"),
        (" Zeichnung ä.svg ", "Zeichnung ä.svg"),
        ("x" * 500 + ".png", "x" * 116 + ".png"),
    ],
)
def test_a_file_name_is_only_a_name(path: str, name: str) -> None:
    assert base_name(path) == name


def test_an_upload_reaches_the_callback_under_its_base_name() -> None:
    admitted = admission(FakePage(**BUTTONS)).admit(begin(10, 1, name="../../etc/passwd"))
    assert isinstance(admitted, inbound.FileTransferStartUpload)
    assert admitted.filename == "passwd"
