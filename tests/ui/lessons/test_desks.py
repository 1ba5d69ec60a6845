"""Desks are made when they are wanted, by a lesson or by a tab, and whoever comes later finds what is there."""

from __future__ import annotations

from typing import Any

from app.signal import Signal
from app.ui.lessons.play import Stage
from tests.support.lesson_stage import on_stage, settled


def heard(*signals: Signal[Any]) -> list[Any]:
    """What the signals say from now on."""
    news: list[Any] = []
    for signal in signals:
        signal.connect(news.append)
    return news


def test_a_tab_that_is_opened_after_a_lesson_used_it_shows_what_is_there():
    async def scene(stage: Stage) -> None:
        desks, lab = stage.desks, stage.apparatus
        lab.set("drawing.text", "L")
        lab.set("map.on", True)
        await settled(stage, "step.overshoot", "motion.planned", "drawing.time")
        answers = heard(desks.control.answered)
        motions = heard(desks.motion.planned)
        drawings = heard(desks.drawing.sketched, desks.drawing.planned)
        maps = heard(desks.maps.answered)
        for open_tab in (desks.control.open, desks.motion.open, desks.drawing.open, desks.maps.tell_again):
            open_tab()
        assert answers == [desks.control.answer] and motions == [desks.motion.motion]
        assert drawings == [desks.drawing.sketch, desks.drawing.plan] and len(maps) == 1
        assert not lab.busy, "nothing is computed again"

    on_stage(scene)


def test_opening_a_tab_does_not_disturb_a_drawing_under_way():
    async def scene(stage: Stage) -> None:
        desks, lab = stage.desks, stage.apparatus
        lab.set("drawing.text", "L")
        await settled(stage, "drawing.time")
        desks.player.seek(1.0)
        desks.drawing.open()
        assert desks.player.time_s == 1.0

    on_stage(scene)


def test_looking_at_the_robot_or_the_link_makes_no_desk():
    async def scene(stage: Stage) -> None:
        for fact in ("pose.x", "link.phase", "link.holder", "link.finished", "tab", "view.trace"):
            stage.apparatus.value(fact)
        assert not stage.desks.has_hardware and stage.desks.run is None
        assert not {"control", "motion", "drawing", "compare", "maps"} & vars(stage.desks).keys()

    on_stage(scene)


def test_a_lock_is_told_once_and_stops_no_lesson():
    async def scene(stage: Stage) -> None:
        session = stage.desks.session
        news = heard(session.locks_changed)
        session.lock(frozenset({"robot"}))
        session.lock(frozenset({"robot"}))
        assert news == [frozenset({"robot"})]
        stage.apparatus.set("robot", "linear")
        assert session.robot_name == "linear"

    on_stage(scene)
