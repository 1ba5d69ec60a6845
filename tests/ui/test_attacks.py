"""What a hostile page, program or web site tries. Each attack is also made on viser alone, where it must succeed:
otherwise it would prove nothing about the guard."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import logging
import math
import os
import socket
import time
from collections.abc import Iterator
from typing import Any

import msgspec.msgpack
import pytest
import viser
import websockets.exceptions

from app.ui.guard import MIB, Guard
from tests.support.small_lab import GIZMO, HOST, SmallLab, bare_lab, eventually, guarded_lab, round_trip
from tests.support.wire import WireClient, run_async, wire_client

GUARD = Guard(max_upload_bytes=MIB)
PART = 512 * 1024
STRICT = Guard(frames_per_second=50.0, frame_burst=100.0)

succeeds_on_bare_viser = pytest.mark.xfail(strict=True, raises=AssertionError, reason="viser alone lets it in")


@pytest.fixture(params=["guarded", pytest.param("bare", marks=succeeds_on_bare_viser)])
def lab(request: pytest.FixtureRequest) -> Iterator[SmallLab]:
    with guarded_lab(GUARD) if request.param == "guarded" else bare_lab() as lab:
        yield lab


@pytest.fixture(params=["guarded", pytest.param("bare", marks=succeeds_on_bare_viser)])
def strict_lab(request: pytest.FixtureRequest) -> Iterator[SmallLab]:
    """Reads so slowly that a few hundred frames are a flood."""
    with guarded_lab(STRICT) if request.param == "guarded" else bare_lab() as lab:
        yield lab


async def handshake(lab: SmallLab, headers: dict[str, str]) -> int:
    """HTTP status of the answer to a websocket's opening request."""
    try:
        async with wire_client(lab.url, greet=False, headers=headers):
            return 101
    except websockets.exceptions.InvalidStatus as refusal:
        return refusal.response.status_code


@pytest.mark.parametrize("origin", ["http://evil.example", "http://localhost:1", "null"])
def test_a_foreign_web_site_cannot_connect(lab: SmallLab, origin: str) -> None:
    assert run_async(handshake(lab, {"Origin": origin})) == 403


def test_a_foreign_name_for_this_machine_is_not_served(lab: SmallLab) -> None:
    """DNS rebinding: the site's own name resolves to this machine, so that browser takes it for the same site."""
    assert lab.get(headers={"Host": "evil.example"}).status == 403


def test_nobody_opens_a_public_tunnel(lab: SmallLab) -> None:
    requests: list[str] = []
    lab.server.request_share_url = lambda *_, **__: requests.append("share")

    async def scene() -> None:
        async with lab.visit() as client:
            await client.send("ShareUrlRequest")
            await client.send("ShareUrlDisconnect")
            await round_trip(client, (0.1, 0.0, 0.0))
            await asyncio.sleep(0.2)
            assert requests == []

    run_async(scene())


@pytest.mark.parametrize("forged", [{"update_cb": []}, {"removed": True}, {"sync_cb": None, "value": 0.9}])
def test_a_shared_element_cannot_be_silenced(lab: SmallLab, forged: dict[str, Any]) -> None:
    async def scene() -> None:
        async with lab.visit() as eve, lab.visit() as honest:
            await eve.send("GuiUpdateMessage", uuid=eve.uuid_of("Shared"), updates=forged)
            await round_trip(eve, (0.1, 0.0, 0.0))
            await honest.set_value("Shared", 0.25)
            await round_trip(honest, (0.2, 0.0, 0.0))
            assert lab.values("Shared") == [0.25]
            await eve.wait_for(lambda: eve.value_of("Shared") == 0.25, "the others' value", timeout=3.0)

    run_async(scene())


@pytest.mark.parametrize(
    ("label", "forged", "honest"),
    [
        ("Speed", 1e9, 0.25),
        ("Speed", math.nan, 0.25),
        ("Speed", -0.01, 0.25),
        ("Height", math.inf, 5.0),
        ("Height", -101.0, 5.0),
        ("Count", 2.5, 7),
        ("Robot", "evil<script>", "delta3"),
        ("Name", "x" * 10_001, "Ada"),
        ("Name", 17, "Ada"),
        ("Target", [0.0, math.nan, 0.0], (0.1, 0.2, 0.3)),
        ("Target", [0.0, 9.0, 0.0], (0.1, 0.2, 0.3)),
        ("Target", [0.1, 0.2], (0.1, 0.2, 0.3)),
        ("Colour", [300.0, -5.0, 0.0], (10, 20, 30)),
    ],
)
def test_a_forged_value_reaches_nobody(lab: SmallLab, label: str, forged: Any, honest: Any) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await client.set_value(label, forged)
            await client.set_value(label, honest)
            await round_trip(client, (0.1, 0.0, 0.0))
            assert lab.values(label) == [honest]

    run_async(scene())


def test_what_is_switched_off_cannot_be_changed(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await client.set_value("Locked", 5.0)
            await round_trip(client, (0.1, 0.0, 0.0))
            assert lab.values("Locked") == []

    run_async(scene())


@pytest.mark.parametrize("forged", [(math.nan, 0.0, 0.0), (0.0, math.inf, 0.0), (0.0, 0.0, 1e4)])
def test_a_gizmo_cannot_be_dragged_to_nowhere(lab: SmallLab, forged: tuple[float, float, float]) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await client.drag(GIZMO, forged)
            await round_trip(client, (0.1, 0.0, 0.0))
            await client.drag(GIZMO, (0.3, 0.0, 0.0), wxyz=(0.0, 0.0, 0.0, 0.0))
            await round_trip(client, (0.2, 0.0, 0.0))
            assert lab.values("drag") == [(0.1, 0.0, 0.0), (0.2, 0.0, 0.0)]

    run_async(scene())


def test_a_camera_cannot_be_nowhere(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await client.send(
                "ViewerCameraMessage", wxyz=(1.0, 0.0, 0.0, 0.0), position=(math.nan, 0.0, 0.0), fov=1.0,
                near=0.01, far=10.0, image_height=9, image_width=9, look_at=(0.0, 0.0, 0.0),
                up_direction=(0.0, 0.0, 1.0),
            )  # fmt: skip
            await round_trip(client, (0.1, 0.0, 0.0))
            assert all(map(math.isfinite, lab.client_of(client).camera.position))

    run_async(scene())


MALFORMED = {
    "text": "a text frame",
    "nothing": b"",
    "noise": bytes(range(255, 191, -1)),
    "number": msgspec.msgpack.encode(5),
    "list": msgspec.msgpack.encode([1, 2]),
    "unknown type": msgspec.msgpack.encode({"type": "Evil"}),
    "missing fields": msgspec.msgpack.encode({"type": "GuiUpdateMessage"}),
    "unknown fields": msgspec.msgpack.encode({"type": "CommandTriggerMessage", "uuid": "a", "evil": 1}),
    "text for numbers": msgspec.msgpack.encode(
        {"type": "TransformControlsUpdateMessage", "name": GIZMO, "owner": "", "wxyz": "abcd", "position": "abc"}
    ),
    "deep": b"\x91" * 100_000,
}


@pytest.mark.parametrize("frame", MALFORMED.values(), ids=list(MALFORMED))
def test_a_malformed_frame_disturbs_nobody_and_leaves_no_trace(
    lab: SmallLab, frame: str | bytes, caplog: pytest.LogCaptureFixture
) -> None:
    async def scene() -> None:
        async with lab.visit() as honest, lab.visit() as eve:
            await eve.connection.send(frame)
            await asyncio.sleep(0.2)
            await round_trip(honest, (0.1, 0.0, 0.0))

    run_async(scene())
    assert [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING] == []


def test_an_oversized_message_closes_only_its_sender(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as honest, lab.visit() as eve:
            await eve.set_value("Name", "x" * (3 * MIB))
            await eventually(lambda: eve.closed_because, "close of the sender's connection", timeout=3.0)
            assert "1009" in (eve.closed_because or "")
            await round_trip(honest, (0.1, 0.0, 0.0))

    run_async(scene())


async def begin_upload(client: WireClient, transfer: str, size: int, name: str = "a.png") -> None:
    await client.send(
        "FileTransferStartUpload", source_component_uuid=client.uuid_of("Drawing"), transfer_uuid=transfer,
        filename=name, mime_type="image/png", part_count=math.ceil(size / PART), size_bytes=size,
    )  # fmt: skip


async def send_part(client: WireClient, transfer: str, index: int, content: bytes, button: str = "Drawing") -> None:
    await client.send(
        "FileTransferPart", source_component_uuid=client.uuid_of(button), transfer_uuid=transfer,
        part_index=index, content=content,
    )  # fmt: skip


def held_bytes(lab: SmallLab) -> int:
    """What viser keeps in memory for unfinished uploads."""
    guis = [lab.server.gui, *(client.gui for client in lab.clients.values())]
    states = [state for gui in guis for state in gui._current_file_upload_states.values()]
    return sum(len(content) for state in states for content in state["parts"].values())


@pytest.mark.parametrize("declared", [MIB, 2 * PART, 10 * MIB], ids=["fitting", "small", "huge"])
def test_unfinished_uploads_do_not_fill_the_memory(lab: SmallLab, declared: int) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            for number in range(8):
                await begin_upload(client, f"upload {number}", declared)
                await send_part(client, f"upload {number}", 0, bytes(PART))
            await round_trip(client, (0.1, 0.0, 0.0))
            assert held_bytes(lab) <= GUARD.max_upload_bytes

    run_async(scene())


@pytest.mark.filterwarnings("ignore:.*Dropping upload")
def test_an_upload_brings_no_more_than_it_declared(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await begin_upload(client, "liar", PART + 1)
            await send_part(client, "liar", 0, bytes(PART))
            await send_part(client, "liar", 1, bytes(MIB))
            await send_part(client, "liar", 2, bytes(MIB))
            await begin_upload(client, "dwarf", 10)
            await send_part(client, "dwarf", 0, bytes(MIB))
            await round_trip(client, (0.1, 0.0, 0.0))
            assert held_bytes(lab) == PART

    run_async(scene())


def test_an_upload_cannot_overwrite_another_input(lab: SmallLab) -> None:
    """viser stores the file as the value of whatever input the last part names."""

    async def scene() -> None:
        async with lab.visit() as client:
            await begin_upload(client, "t", 4)
            await send_part(client, "t", 0, b"evil", button="Name")
            await round_trip(client, (0.1, 0.0, 0.0))
            assert lab.values("Name") == []

    run_async(scene())


def test_an_uploaded_file_has_only_a_base_name(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            await begin_upload(client, "t", 4, name="../../etc/passwd")
            await send_part(client, "t", 0, b"root")
            await eventually(lambda: lab.values("Drawing"), "uploaded file")
            assert lab.values("Drawing") == [("passwd", b"root")]

    run_async(scene())


def test_a_forged_form_is_not_told_to_every_later_visitor(lab: SmallLab) -> None:
    """viser keeps such a message for good, one for every identity that a page invents."""
    kept = lab.server._websock_server.get_message_buffer().message_from_id

    async def scene() -> None:
        async with lab.visit() as client:
            before = len(kept)
            for number in range(50):
                await client.send("GuiFormDirtyMessage", uuid=f"invented {number}")
            await round_trip(client, (0.1, 0.0, 0.0))
            assert len(kept) == before

    run_async(scene())


def test_one_flood_of_messages_delays_nobody_else(strict_lab: SmallLab) -> None:
    """The flood is read at its rate, the other client's drags are all answered meanwhile."""

    async def flood(client: WireClient) -> None:
        for number in range(20_000):
            await client.set_value("Speed", number % 1000 / 1000)

    async def scene() -> None:
        async with strict_lab.visit() as eve, strict_lab.visit() as honest:
            started = time.monotonic()
            flooding = asyncio.create_task(flood(eve))
            for number in range(20):
                await round_trip(honest, (0.01 + number / 100, 0.0, 0.0))
                await asyncio.sleep(0.05)
            elapsed = time.monotonic() - started
            served = len(strict_lab.values("Speed"))
            flooding.cancel()
            await asyncio.gather(flooding, return_exceptions=True)
            eve.connection.transport.abort()
            assert 0 < served <= 2 * (STRICT.frame_burst + STRICT.frames_per_second * elapsed) + 500

    run_async(scene())


def small_frame(first_byte: int, payload: bytes = b"") -> bytes:
    """A websocket frame from a client, with a mask of zeros."""
    return bytes([first_byte, 0x80 | len(payload), 0, 0, 0, 0]) + payload


FIRST_FRAGMENT, NEXT_FRAGMENT, LAST_FRAGMENT, BINARY, PING = 0x02, 0x00, 0x80, 0x82, 0x89
FLOODS = {
    "pings": (b"", PING, BINARY),
    "empty fragments": (small_frame(FIRST_FRAGMENT), NEXT_FRAGMENT, LAST_FRAGMENT),
}


@pytest.mark.parametrize("kind", list(FLOODS))
def test_a_flood_below_the_messages_is_held_up_too(strict_lab: SmallLab, kind: str) -> None:
    """The websocket itself answers pings and gathers fragments. The message behind 20 000 of them has to wait."""
    start, filler, last = FLOODS[kind]
    message = {"type": "GuiUpdateMessage", "uuid": strict_lab.shared._impl.uuid, "updates": {"value": 0.9}}
    flood = start + 20_000 * small_frame(filler) + small_frame(last, msgspec.msgpack.encode(message))

    async def scene(connection: socket.socket) -> None:
        async with strict_lab.visit() as honest:
            connection.sendall(flood)
            for number in range(20):
                await round_trip(honest, (0.01 + number / 100, 0.0, 0.0))
            with contextlib.suppress(AssertionError):
                await eventually(lambda: strict_lab.shared.value != 0.5, "end of the flood", timeout=3.0)
            assert strict_lab.shared.value == 0.5

    with raw_websocket(strict_lab) as connection:
        run_async(scene(connection))


def raw_websocket(lab: SmallLab) -> socket.socket:
    """A connection past its opening handshake."""
    connection = socket.create_connection((HOST, lab.server.get_port()), timeout=10)
    key = base64.b64encode(os.urandom(16)).decode()
    connection.sendall(
        (
            f"GET / HTTP/1.1\r\nHost: {HOST}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\n"
            f"Sec-WebSocket-Protocol: viser-v{viser.__version__}\r\n\r\n"
        ).encode()
    )
    assert b" 101 " in connection.recv(4096)
    return connection
