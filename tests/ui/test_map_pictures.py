"""Maps of the tab Motion without a page: how they are drawn, when they are computed."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from app.robots.maps import MapSettings, compute_map
from app.ui import theme
from app.ui.compute import Worker
from app.ui.motion.map_desk import MapDesk
from app.ui.motion.map_picture import MapPicture, level_line, map_picture
from app.ui.panels.motion.map_texts import color_bar, with_unit
from app.ui.refusal import Refusal
from app.ui.session import Session
from app.ui.state import Memory


def test_a_level_line_of_a_cone_is_a_circle():
    x, y = np.linspace(-1.0, 1.0, 81), np.linspace(-0.8, 1.2, 81)
    line = level_line(x, y, np.hypot(x[None, :], y[:, None]), 0.5)
    assert np.hypot(line[..., 0], line[..., 1]) == pytest.approx(0.5, abs=1e-3)
    assert np.linalg.norm(line[:, 1] - line[:, 0], axis=1).sum() == pytest.approx(math.pi, rel=1e-3)
    assert not len(level_line(x, y, np.full((81, 81), np.nan), 0.5))


def picture_of(**values: Any) -> MapPicture:
    picture = map_picture(MapSettings("fivebar", **values))
    assert isinstance(picture, MapPicture)
    return picture


def test_the_picture_is_clear_out_of_reach_and_striped_beyond_a_limit():
    calm, wild = picture_of(acceleration=11.3), picture_of(acceleration=30.0)
    inside = np.isfinite(calm.map.values)
    opaque = calm.rgba[..., 3]
    assert opaque[inside].mean() > 0.95 * opaque.max() and opaque[~inside].mean() < 0.05 * opaque.max()
    assert not len(calm.limit_line) and not calm.map.beyond.any()
    assert wild.map.beyond.any() and not wild.map.beyond.all()
    ends = [wild.map.at(float(x), float(y)) for x, y in wild.limit_line.reshape(-1, 2)[::25]]
    assert np.nanmax(np.abs(np.array(ends) - 100.0)) < 0.3, "on the line a drive is just at its limit"
    marked = (wild.rgba[..., :3] == np.array(theme.MARK)).all(axis=-1)
    assert marked.any() and not (marked & ~wild.map.beyond).any()
    assert "over its limit" in color_bar(wild) and "over its limit" not in color_bar(calm)


def test_bright_is_good():
    for quantity, best in (("conditioning", np.nanargmin), ("available", np.nanargmax)):
        picture = picture_of(quantity=quantity)
        where = np.unravel_index(best(picture.map.values), picture.map.values.shape)
        assert picture.rgba[where][:3].tolist() == theme.ramp(1.0).tolist(), quantity


def test_a_slice_out_of_reach_is_refused_in_words():
    refusal = map_picture(MapSettings("par4", height_m=-2.0))
    assert isinstance(refusal, Refusal) and "move the slice" in refusal.reason


def test_values_are_read_with_their_unit():
    assert with_unit(43.21, "%") == "43.2 %" and with_unit(math.nan, "%") == "–"
    assert with_unit(12345.0, "N") == "12345 N" and with_unit(1.234, "") == "1.23"


def with_maps(scene: Callable[[MapDesk, Session], Awaitable[None]]) -> None:
    """Play a scene on an event loop; no worker may have anything to complain of."""
    told: list[str] = []

    async def play() -> None:
        with ThreadPoolExecutor(1) as pool:
            session, worker = Session(Memory("fivebar")), Worker(pool, told.append)
            await scene(MapDesk(session, worker), session)
            worker.cancel()

    asyncio.run(play())
    assert told == []


async def until(condition: Callable[[], object]) -> None:
    for _ in range(1000):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError("nothing happened")


def test_a_map_is_computed_only_when_wanted_and_follows_robot_and_tool():
    async def scene(desk: MapDesk, session: Session) -> None:
        desk.change(acceleration=9.0)
        await asyncio.sleep(0.05)
        assert desk.picture is None and math.isnan(desk.value_at_tool)
        desk.show(True)
        await until(lambda: desk.picture)
        session.drag(position=(0.10, 0.35, 0.0))
        expected = compute_map(replace(desk.settings), 0.002).at(0.10, 0.35)
        assert desk.value_at_tool == pytest.approx(expected, rel=1e-3)
        session.choose_robot("linear")
        assert desk.picture is None, "another robot's map is not shown"
        await until(lambda: desk.picture)
        assert desk.picture is not None and desk.picture.map.settings.robot == "linear"
        assert desk.settings.height_m == pytest.approx(-0.4) and desk.settings.joint == 0
        desk.change(height_m=-3.0)
        await until(lambda: desk.refusal)
        assert desk.picture is None
        desk.show(False)
        assert desk.refusal == ""

    with_maps(scene)


def test_the_newest_map_wins():
    async def scene(desk: MapDesk, _: Session) -> None:
        seen: list[float] = []
        desk.answered.connect(lambda _: seen.append(desk.picture.map.settings.acceleration if desk.picture else 0.0))
        desk.show(True)
        for acceleration in (5.0, 6.0, 7.0, 8.0):
            desk.change(acceleration=acceleration)
        await until(lambda: seen and seen[-1] == 8.0)
        assert len(seen) <= 2, "what was overtaken is never shown"

    with_maps(scene)
