"""What the class does to a page: who sits there, pauses, messages, removal, and what hostile pages try."""

from __future__ import annotations

import asyncio
import html
import json
from contextlib import AsyncExitStack
from typing import Any

import pytest

from app.ui.classroom.class_page import CLOSED, LOOK_UP, MESSAGE_TITLE, REMOVED
from app.ui.classroom.hall import KEY_USED
from tests.support.class_lab import GIZMO, PIN, ClassClient, ClassLab, class_client, class_lab
from tests.support.wire import note, run_async

SCRIPT = "<img src=x onerror=alert(1)>"


async def settled(lab: ClassLab, *pages: ClassClient) -> None:
    """Wait until the server has dealt with everything that these pages have sent before."""
    for page in pages:
        noted = note(page.client, "SetPositionMessage")
        await page.client.drag(GIZMO, (0.01, 0.01, -0.3))
        await page.until(lambda noted=noted: noted, "answer")
        await page.client.end_drag(GIZMO)


def test_a_student_joins_and_is_known_after_a_reload(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url) as ada:
            assert ada.asked == ""
            await ada.say(do="join", name="Ada", code="AAAAA")
            await ada.until(lambda: ada.asked, "refusal")
            assert "not the class code" in str(ada.asked)
            await ada.join("Ada", f" {lab.code.lower()} ")
        async with class_client(lab.url, ada.browser) as again:
            assert again.asked is None and again.parts["banner"] == ""

    run_async(scene())


def test_a_student_comes_back_from_another_browser_by_the_own_code(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url, whole=False) as first, class_client(lab.url, whole=False) as second:
            await first.join("Bea", lab.code)
            member = await lab.on_the_loop(lambda: lab.classroom.member(first.browser))
            await second.say(do="join", name="bea", code=lab.code)
            await second.until(lambda: second.asked, "refusal")
            assert "already" in str(second.asked)
            await second.say(do="resume", code=member.own_code)
            await second.until(lambda: second.asked is None, "place")
            assert (await lab.on_the_loop(lambda: lab.classroom.member(second.browser))).id == member.id

    run_async(scene())


def test_a_pause_lies_over_students_only_and_outlives_a_reload(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url) as chief, class_client(lab.url, whole=False) as cem:
            await cem.join("Cem", lab.code)
            await chief.prove()
            await chief.set("Said in the pause", SCRIPT)
            await chief.press("Pause")
            await cem.until(lambda: cem.parts["pause"] == SCRIPT, "pause")  # shown as text
            assert chief.parts["pause"] is None
            async with class_client(lab.url, cem.browser, whole=False) as again:
                await again.until(lambda: again.parts["pause"] == SCRIPT, "pause after the reload")
            await chief.press("Go on")
            await cem.until(lambda: cem.parts["pause"] is None, "end of the pause")
            await chief.set("Said in the pause", "")
            await chief.press("Pause")
            await cem.until(lambda: cem.parts["pause"] == LOOK_UP, "words of a pause without a message")
            await chief.press("Go on")
            await cem.until(lambda: cem.parts["pause"] is None, "end of the pause")

    run_async(scene())


def test_a_message_reaches_whom_it_is_for(lab: ClassLab) -> None:
    async def scene() -> None:
        async with AsyncExitStack() as stack:
            chief, dan, eve, stranger = [await stack.enter_async_context(class_client(lab.url)) for _ in range(4)]
            titles = note(dan.client, "NotificationShowMessage")
            await dan.join("Dan", lab.code)
            await eve.join("Eve", lab.code)
            await chief.prove()
            await chief.press("Dan")
            await chief.set("Message", f"Well done {SCRIPT}")
            await chief.press("Send to Dan")
            await dan.until(lambda: dan.told, "message")
            await chief.set("Message", "To all of you")
            await chief.press("Send to all")
            await eve.until(lambda: eve.told, "message to all")
            await dan.until(lambda: len(dan.told) == 2, "message to all")
            assert dan.told == [f"Well done {SCRIPT}", "To all of you"] and eve.told == ["To all of you"]
            assert titles[0]["props"]["title"] == MESSAGE_TITLE
            assert stranger.told == chief.told == []

    run_async(scene())


def test_whoever_is_removed_has_to_join_anew(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url) as chief, class_client(lab.url, whole=False) as fay:
            await fay.join("Fay", lab.code)
            await chief.prove()
            await chief.press("Fay")
            await chief.press("Remove")
            await chief.press("Really remove?")
            await fay.until(lambda: fay.asked == REMOVED, "card")
            assert await lab.on_the_loop(lambda: lab.classroom.member(fay.browser)) is None
            await fay.join("Fay", lab.code)
            await chief.until(lambda: "Fay" in chief.buttons(), "Fay on the board again")

    run_async(scene())


def test_a_closed_door_and_a_closed_class_say_so(tmp_path: Any) -> None:
    async def scene(lab: ClassLab) -> None:
        async with AsyncExitStack() as stack:
            chief, gus, late = [await stack.enter_async_context(class_client(lab.url)) for _ in range(3)]
            await gus.join("Gus", lab.code)
            await chief.prove()
            await chief.press("Close the door")
            await chief.until(lambda: "Open the door" in chief.buttons(), "closed door")
            await late.say(do="join", name="Late", code=lab.code)
            await late.until(lambda: late.asked, "refusal")
            assert "door is closed" in str(late.asked)
            await chief.press("Close class")
            assert await lab.on_the_loop(lambda: lab.classroom.is_open), "it asks once"
            await chief.press("Really close?")
            await gus.until(lambda: gus.parts["banner"] == CLOSED, "end of the class")
            await chief.press("Export CSV")
            await chief.until(lambda: chief.files, "results of the closed class")

    with class_lab(tmp_path) as lab:
        run_async(scene(lab))


def test_the_key_of_this_computer_opens_the_instructors_page_once(lab: ClassLab) -> None:
    async def scene() -> None:
        hall = lab.lab.hall
        assert hall is not None
        key = hall.instructor_url.partition("instructor=")[2]
        async with class_client(lab.url) as chief, class_client(lab.url) as thief:
            for wrong in ("", "x" * 64, "ü\udc80", key[:-1]):
                await thief.say(do="open", key=wrong)
                await thief.until(lambda: thief.asked == KEY_USED, "refusal")
            await chief.say(do="open", key=key)
            await chief.until(lambda: chief.client.has("Student pressed"), "instructor's page")
            await thief.say(do="open", key=key)
            await settled(lab, thief)
            assert thief.asked == KEY_USED and not thief.client.has("Student pressed")

    run_async(scene())


@pytest.mark.parametrize(
    "said",
    [
        "", "{", "[1]", "null", "[" * 9000, '{"do": "join"}', '{"do": "join", "name": 7, "code": {}}',
        '{"do": "prove", "pin": "\\ud800"}', '{"do": "resume", "code": "\\ud800"}', '{"do": "__init__", "name": "x"}',
        json.dumps({"do": "join", "name": "x" * 9000, "code": "AAAAA"}), "x" * 1_000_000,
    ],
    ids=lambda said: said[:20],
)  # fmt: skip
def test_nonsense_from_a_page_changes_nothing(lab: ClassLab, said: str) -> None:
    async def scene() -> None:
        before = await lab.on_the_loop(lambda: (lab.classroom.members, lab.classroom.pace))
        async with class_client(lab.url, whole=False) as page:
            await page.set("Class said", said)
            await settled(lab, page)
            assert page.asked is not None
            assert await lab.on_the_loop(lambda: lab.classroom.member(page.browser)) is None
        assert await lab.on_the_loop(lambda: (lab.classroom.members, lab.classroom.pace)) == before

    run_async(scene())


def test_names_are_text_on_the_instructors_page(lab: ClassLab) -> None:
    async def scene() -> None:
        async with class_client(lab.url) as chief, class_client(lab.url, whole=False) as mallory:
            await chief.prove()
            await mallory.join("<b onx=1>M</b>", lab.code)
            name = (await lab.on_the_loop(lambda: lab.classroom.member(mallory.browser))).name
            await chief.until(lambda: name in chief.buttons(), "Mallory on the board")
            await chief.press(name)
            await chief.press("Show to all")
            await chief.until(lambda: f"{name}'s robot" in chief.parts["banner"], "banner")  # shown as text
            await chief.until(lambda: f"Shown: <b>{html.escape(name)}" in chief.said, "whose robot is shown")
            assert name not in chief.said
            await chief.press("End showing")

    run_async(scene())


def test_a_student_cannot_press_the_instructors_buttons(lab: ClassLab) -> None:
    """Neither are they on his page, nor does it help to know their names."""

    async def scene() -> None:
        async with class_client(lab.url) as chief, class_client(lab.url) as ivo, class_client(lab.url) as jan:
            await ivo.join("Ivo", lab.code)
            await jan.join("Jan", lab.code)
            own = set(ivo.client.inputs)
            await chief.prove()
            await chief.press("Jan")
            await chief.until(lambda: "Send to Jan" in chief.buttons(), "chosen Jan")
            assert not {"Show to all", "Remove", "Pause", "Close class"} & ivo.buttons().keys()
            wires = {button["data-wire"]: [] for button in chief.buttons().values()}
            for button in chief.buttons().values():
                wires[button["data-wire"]].append(button["data-press"])
            assert not own & wires.keys()
            before = await lab.on_the_loop(lambda: _state(lab))
            for number, (wire, keys) in enumerate(wires.items()):
                for key in [*keys, "remove", "close", "mine"]:
                    for value in (f"{key} {number}a", f"{key} {number}b"):
                        await ivo.client.send("GuiUpdateMessage", uuid=wire, updates={"value": value})
            for label in ("Said in the pause", "Message", "Up to step", "Up to lesson"):
                uuid = chief.client.uuid_of(label)
                await ivo.client.send("GuiUpdateMessage", uuid=uuid, updates={"value": "forged"})
            await settled(lab, ivo, jan)
            assert await lab.on_the_loop(lambda: _state(lab)) == before
            assert jan.asked is None and jan.told == []

    run_async(scene())


def test_a_student_is_nobody_else_and_guesses_no_pin(lab: ClassLab) -> None:
    """After some wrong PINs the right one is refused too: else the limit would be of no use."""

    async def scene() -> None:
        async with class_client(lab.url) as kim:
            await kim.join("Kim", lab.code)
            mine = await lab.on_the_loop(lambda: lab.classroom.member(kim.browser))
            for code in ("", mine.own_code[::-1], "AAAA-AAAA", "a" * 9000):
                await kim.say(do="resume", code=code)
            for pin in [*map(str, range(10)), PIN]:
                await kim.say(do="prove", pin=pin)
            await settled(lab, kim)
            assert (await lab.on_the_loop(lambda: lab.classroom.member(kim.browser))).id == mine.id
            assert not await lab.on_the_loop(lambda: lab.classroom.is_instructor(kim.browser))

    run_async(scene())


def test_a_flood_of_joins_fills_neither_board_nor_file(lab: ClassLab) -> None:
    """Ten thousand tries from four pages; what they do to the file is tried at the classroom itself."""

    async def scene() -> None:
        before = await lab.on_the_loop(lambda: len(lab.classroom.everybody))
        async with AsyncExitStack() as stack:
            pages = [await stack.enter_async_context(class_client(lab.url, whole=False)) for _ in range(4)]
            speakers = [page for page in (await lab.on_the_loop(lambda: _speakers(lab))) if page.member is None]
            assert len(speakers) == 4
            said = [json.dumps({"do": "join", "name": f"Bot {k}", "code": lab.code}) for k in range(2500)]
            for speaker in speakers:
                await lab.on_the_loop(lambda speaker=speaker: [speaker.hear(what) for what in said])
            await settled(lab, *pages)
        assert await lab.on_the_loop(lambda: len(lab.classroom.everybody)) <= before + 4
        async with class_client(lab.url, whole=False) as honest:
            await honest.join("Lea", lab.code)

    run_async(scene())


def _speakers(lab: ClassLab) -> list[Any]:
    assert lab.lab.hall is not None
    return list(lab.lab.hall.pages)


def _state(lab: ClassLab) -> tuple[Any, ...]:
    classroom = lab.classroom
    shown = classroom.spotlight, classroom.overlay, classroom.pace
    return classroom.members, shown, classroom.door_open, classroom.is_open


def test_nobody_waits_for_a_page_that_has_gone(lab: ClassLab) -> None:
    """Signals of the class reach only pages that are open."""

    async def scene() -> None:
        async with class_client(lab.url, whole=False) as one:
            await one.join("Max", lab.code)
        for _ in range(200):
            if not any(page.browser == one.browser for page in await lab.on_the_loop(lambda: _speakers(lab))):
                break
            await asyncio.sleep(0.02)
        else:
            raise AssertionError("the page is still there")
        async with class_client(lab.url) as chief:
            await chief.prove()
            await chief.until(lambda: "away" in chief.said, "Max as away")

    run_async(scene())
