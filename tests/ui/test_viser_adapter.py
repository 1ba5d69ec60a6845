"""How viser 1.1 behaves behind the adapter. Where a new version behaves differently, one of these tests fails."""

from __future__ import annotations

import asyncio
import dataclasses
import logging
import socket
import threading
import typing
from collections.abc import Iterator
from importlib.metadata import version

import numpy as np
import pytest
import viser
from viser import _messages

from app.ui import inbound
from app.ui.guard import COOKIE, Guard, new_browser_id
from app.ui.viser_adapter import (
    browser_id,
    silence_gizmo_echo,
    start_server,
    stop_server,
)
from tests.support.small_lab import (
    GIZMO,
    HOST,
    SmallLab,
    eventually,
    guarded_lab,
    round_trip,
)
from tests.support.wire import note, run_async, wire_client


@pytest.fixture
def lab() -> Iterator[SmallLab]:
    with guarded_lab() as lab:
        yield lab


def test_viser_is_the_version_that_was_looked_at() -> None:
    assert version("viser").startswith("1.1.")


@pytest.mark.parametrize("kind", inbound.MESSAGE_TYPES, ids=lambda kind: kind.__name__)
def test_messages_have_the_fields_of_visers(kind: type[inbound.Inbound]) -> None:
    known = {field.name for field in dataclasses.fields(getattr(_messages, kind.__name__))}
    assert set(kind.__struct_fields__) == known


def test_starting_and_stopping_prints_nothing(
    capfd: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    async def scene(lab: SmallLab) -> None:
        async with lab.visit() as client:
            await round_trip(client, (0.1, 0.0, 0.0))

    with guarded_lab() as lab:
        run_async(scene(lab))
    assert capfd.readouterr() == ("", "")
    assert [record for record in caplog.records if record.levelno >= logging.WARNING] == []


def test_stopping_ends_connections_callbacks_and_threads(
    capfd: pytest.CaptureFixture[str], caplog: pytest.LogCaptureFixture
) -> None:
    """Also with a page open, with a connection that a browser opened in advance, and with a callback at work."""
    before = set(threading.enumerate())
    server = start_server(HOST, 0, Guard())
    lab = SmallLab(server)
    begun: list[str] = []

    @server.on_client_connect
    async def _(client: viser.ClientHandle) -> None:
        begun.append("callback")
        await asyncio.sleep(3600)

    async def scene() -> None:
        async with wire_client(lab.url) as client:
            await eventually(lambda: begun, "callback")
            stop_server(server)
            await eventually(lambda: client.closed_because, "goodbye")

    with socket.create_connection((HOST, server.get_port())):
        run_async(scene())
    assert [thread for thread in set(threading.enumerate()) - before if not thread.name.startswith("ThreadPool")] == []
    with socket.create_server((HOST, server.get_port())):
        pass
    assert capfd.readouterr() == ("", "")
    assert [record.getMessage() for record in caplog.records if record.levelno >= logging.WARNING] == []


def test_a_page_of_another_version_is_told_to_reload(lab: SmallLab, capfd: pytest.CaptureFixture[str]) -> None:
    async def scene() -> None:
        async with wire_client(lab.url, greet=False, version="1.0.0") as client:
            await eventually(lambda: client.closed_because, "close")
            assert "1002" in (client.closed_because or "")
            assert "Reload the page" in (client.closed_because or "")

    run_async(scene())
    assert lab.server.get_clients() == {}
    assert capfd.readouterr() == ("", "")


def test_a_browser_is_known_by_its_cookie(lab: SmallLab) -> None:
    identity = new_browser_id()
    ids: list[str] = []

    async def identify(cookie: str | None) -> None:
        async with lab.visit({"Cookie": cookie} if cookie else None) as client:
            handle = lab.client_of(client)
            ids.append(browser_id(handle))
        await eventually(lambda: handle.client_id not in lab.server.get_clients(), "farewell")
        assert browser_id(handle) == ids[-1], "the same after it has left"

    async def scene() -> None:
        for cookie in (f"a=b; {COOKIE}={identity}", f"{COOKIE}={identity}", None, None, f"{COOKIE}=<script>"):
            await identify(cookie)

    run_async(scene())
    assert ids[:2] == [identity, identity]
    assert len(set(ids)) == 4


def test_messages_are_handled_in_their_order_and_none_is_lost() -> None:
    """Far more than the bucket holds: who sends too fast is read more slowly, that is all."""
    values = [round(number / 1000, 3) for number in range(501, 1000)]
    with guarded_lab(Guard(frames_per_second=400.0, frame_burst=50.0)) as lab:

        async def scene() -> None:
            async with lab.visit() as client:
                for value in values:
                    await client.set_value("Speed", value)
                await round_trip(client, (0.1, 0.0, 0.0), timeout=30.0)

        run_async(scene())
        assert lab.values("Speed") == values


def test_an_upload_arrives_whole(lab: SmallLab) -> None:
    content = np.random.default_rng(1).bytes(3_000_001)
    part_size = 512 * 1024
    parts = [content[start : start + part_size] for start in range(0, len(content), part_size)]

    async def scene() -> None:
        async with lab.visit() as client:
            button = client.uuid_of("Drawing")
            await client.send(
                "FileTransferStartUpload", source_component_uuid=button, transfer_uuid="t", filename="photo.jpg",
                mime_type="image/jpeg", part_count=len(parts), size_bytes=len(content),
            )  # fmt: skip
            for index, part in enumerate(parts):
                await client.send(
                    "FileTransferPart", source_component_uuid=button, transfer_uuid="t", part_index=index, content=part
                )
            await eventually(lambda: lab.values("Drawing"), "file")

    run_async(scene())
    assert lab.values("Drawing") == [("photo.jpg", content)]


def test_a_declined_upload_frees_the_button_and_says_why() -> None:
    with guarded_lab(Guard(max_upload_bytes=1024 * 1024)) as lab:

        async def scene() -> None:
            async with lab.visit() as client:
                told = note(client, "FileTransferPartAck", "NotificationShowMessage")
                await client.send(
                    "FileTransferStartUpload", source_component_uuid=client.uuid_of("Drawing"), transfer_uuid="t",
                    filename="film.mp4", mime_type="video/mp4", part_count=4, size_bytes=2 * 1024 * 1024,
                )  # fmt: skip
                await client.wait_for(lambda: len(told) == 2, "answer")
                assert {message["type"] for message in told} == {"FileTransferPartAck", "NotificationShowMessage"}
                notice = next(message for message in told if "props" in message)
                assert notice["props"]["body"] == "Up to 1 MB are taken."

        run_async(scene())


@pytest.mark.parametrize(
    ("silenced", "heard_back"), [(True, True), (False, False)], ids=["silenced", "as viser has it"]
)
def test_a_gizmo_can_be_corrected_while_it_is_dragged(lab: SmallLab, silenced: bool, heard_back: bool) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            gizmo = lab.gizmos[lab.client_of(client).client_id]
            if silenced:
                silence_gizmo_echo(gizmo)

            @gizmo.on_update
            async def _(event: viser.TransformControlsEvent) -> None:
                gizmo.position = (0.5, 0.0, 0.0)

            await round_trip(client, (0.9, 0.0, 0.0))
            await round_trip(client, (0.8, 0.0, 0.0))
            assert (client.positions.get(GIZMO) == (0.5, 0.0, 0.0)) is heard_back

    run_async(scene())


def test_types_of_properties_are_looked_up_once(lab: SmallLab) -> None:
    async def scene() -> None:
        async with lab.visit() as client:
            gui = lab.client_of(client).gui
            one, two = gui.add_slider("One", 0.0, 1.0, 0.1, 0.5), gui.add_slider("Two", 0.0, 1.0, 0.1, 0.5)
            assert one._prop_hints is two._prop_hints
            assert one._prop_hints == typing.get_type_hints(_messages.GuiSliderProps)
            await client.wait_for(lambda: client.has("One"), "slider")
            one.disabled = True
            await client.wait_for(lambda: client.inputs[client.uuid_of("One")]["props"]["disabled"], "disabled slider")

    run_async(scene())
