"""The lesson panel over the wire: what is sent, and that a page which lies gets nowhere."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator

import pytest

from tests.support.lesson_server import running_course
from tests.support.server import RunningServer
from tests.support.wire import WireClient, note, run_async, wire_client

WIRE = "Lesson"
pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    with running_course(tmp_path_factory.mktemp("course")) as running:
        yield running


def page_of(client: WireClient) -> str:
    return " ".join(str(made["props"]["content"]) for made in client.inputs.values() if "content" in made["props"])


async def say(client: WireClient, what: str) -> None:
    await client.set_value(WIRE, f"1 {what}")


async def shows(client: WireClient, text: str) -> None:
    await client.wait_for(lambda: text in page_of(client), f"{text!r} on the page")


async def enter(client: WireClient, lesson: str = "") -> None:
    await client.wait_for(lambda: client.has(WIRE), "wire")
    await say(client, f"hello 1440 {lesson}")


def test_a_step_is_done_over_the_wire(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await enter(client, "01")
            await shows(client, "Which way?")
            page = page_of(client)
            assert "First &amp; foremost" in page and "Yes, down." not in page and "Ask the class" not in page
            await say(client, "predict 2")
            await shows(client, "It stands at 40 mm.")
            await say(client, "check")
            await shows(client, "Move it to the right.")
            await client.set_value("x (mm)", 40.0)
            await shows(client, "Your robot shows it.")
            await shows(client, "Yes, down.")
            await say(client, "explain 40,2 mm")
            await shows(client, "Right, 40.")
            await say(client, "next")
            await shows(client, "Is it so?")

    run_async(scene())


def test_a_drag_sends_only_the_check_marks(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await enter(client, "01")
            await shows(client, "Which way?")
            await say(client, "predict 2")
            await shows(client, "It stands at 40 mm.")
            await shows(client, "done")
            sent = note(client, "GuiUpdateMessage")
            await client.set_value("x (mm)", 10.0)
            await shows(client, ">10 mm<")
            contents = {message["uuid"] for message in sent if "It stands at" in str(message["updates"].get("content"))}
            others = [message for message in sent if "Some text." in str(message["updates"].get("content"))]
            assert len(contents) == 1 and not others

    run_async(scene())


LIES = ("next", "explain 40", "more 80", "go 2", "redo 01-first 1", "hint-yes", "back", "go -1", "go 1e9", "open 99")


def test_a_page_that_lies_stays_where_it_is(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await enter(client, "01")
            await shows(client, "Which way?")
            for lie in LIES:
                await say(client, lie)
            await say(client, "predict 2")
            await shows(client, "You will see whether it holds.")
            page = page_of(client)
            assert "Is it so?" not in page and "How far?" not in page and "Where is it?" not in page

    run_async(scene())


def test_nonsense_is_neither_shown_as_html_nor_an_end(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await enter(client, "<img src=x onerror=alert(1)>")
            await shows(client, "There is no lesson")
            for nonsense in (
                "",
                "open",
                "predict",
                "<script>alert(1)</script> x",
                "explain " + "9" * 9000,
                "hello 9 01",
                "\0",
            ):
                await client.set_value(WIRE, nonsense)
                await say(client, nonsense)
            await say(client, "open 01")
            await shows(client, "Which way?")
            await say(client, "predict <script>alert(1)</script>")
            await shows(client, "Choose one of the options first.")
            assert "<script>" not in page_of(client) and "<img src=x" not in page_of(client)

    run_async(scene())


def test_the_list_shows_what_is_broken_and_why(server: RunningServer):
    async def scene() -> None:
        async with wire_client(server.url) as client:
            await enter(client)
            await shows(client, "03-broken")
            page = page_of(client)
            assert "Cannot be read. Line " in page and "Numbers that differ" in page and "Drawing delta" in page

    run_async(scene())


def test_ten_pages_get_their_step_soon(server: RunningServer):
    async def scene() -> None:
        async def visit() -> None:
            async with wire_client(server.url) as client:
                await enter(client, "02")
                await shows(client, "Yours is")

        await asyncio.gather(*(visit() for _ in range(10)))

    run_async(scene())
    assert "Traceback" not in server.output()
