"""Playing a run on the robot, and what charts are given to draw."""

from __future__ import annotations

import asyncio
import math
from itertools import pairwise
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.simulation import Run, circle_tracking
from app.ui.panels.lab.runs_table import runs_table
from app.ui.playback import PLEASANT_S, Playback
from app.ui.plots import Axes, Curve, Plot, csv_table
from app.ui.run_view import LONGEST_ERROR_M, enlarged
from app.ui.session import Session
from app.ui.state import Memory


@pytest.fixture(scope="module")
def run() -> Run:
    return circle_tracking("auto", mode="sampled", lap_s=2.0, duration_s=2.0, u_max=12.0)


def test_playing_moves_the_robot_to_where_it_was(run: Run):
    async def play() -> None:
        session = Session(Memory("par4"))
        playback = Playback(session)
        times: list[float] = []
        playback.moved.connect(times.append)
        playback.load(run)
        playback.speed = 10.0
        playback.play()
        assert playback.playing
        await asyncio.sleep(0.5)
        assert not playback.playing and playback.time_s == pytest.approx(run.t[-1])
        assert times == sorted(times) and len(times) > 3
        assert session.stance.pose == pytest.approx(tuple(run.pose[-1]))
        assert session.stance.joints == pytest.approx(tuple(run.q[-1]))
        playback.play()
        assert playback.time_s == 0.0, "at the end it begins again"
        playback.pause()

    asyncio.run(play())


def test_a_hand_on_the_robot_pauses_the_playback(run: Run):
    async def play() -> None:
        session = Session(Memory("par4"))
        playback = Playback(session)
        playback.load(run)
        playback.speed = 0.5
        playback.play()
        await asyncio.sleep(0.12)
        session.drag(position=(0.0, -0.036, -0.32))
        assert not playback.playing
        assert session.stance.pose[2] == pytest.approx(-0.32)
        before = playback.time_s
        await asyncio.sleep(0.12)
        assert playback.time_s == before

    asyncio.run(play())


def test_it_goes_round_until_it_is_paused(run: Run):
    async def play() -> None:
        playback = Playback(Session(Memory("par4")))
        times: list[float] = []
        playback.moved.connect(times.append)
        playback.load(run)
        playback.speed, playback.repeats = 5.0, True
        playback.play()
        await asyncio.sleep(1.0)
        assert playback.playing, "it would have been over twice"
        assert any(later < earlier for earlier, later in pairwise(times))
        assert max(times) < run.t[-1]
        playback.repeats = False
        await asyncio.sleep(0.6)
        assert not playback.playing and playback.time_s == pytest.approx(run.t[-1])

    asyncio.run(play())


def test_scrubbing_shows_one_instant(run: Run):
    session = Session(Memory("par4"))
    playback = Playback(session)
    playback.load(run)
    playback.seek(1.0)
    assert session.stance.pose == pytest.approx(tuple(run.pose[100]))
    playback.seek(99.0)
    assert session.stance.pose == pytest.approx(tuple(run.pose[-1]))


def test_a_long_run_is_played_fast():
    playback = Playback(Session(Memory("par4")))
    playback.load(circle_tracking("auto", mode="sampled"))
    assert playback.speed == 10.0
    assert 100.0 / playback.speed == pytest.approx(PLEASANT_S, rel=0.5)


def test_a_speed_can_be_asked_for(run: Run):
    playback = Playback(Session(Memory("par4")))
    playback.load(run, speed=1.0)
    assert playback.speed == 1.0
    playback.load(run)
    assert playback.speed == 0.2, "2 s take about 12"


def test_it_goes_on_to_a_time_and_stops_there(run: Run):
    async def play() -> None:
        session = Session(Memory("par4"))
        playback = Playback(session)
        playback.load(run, speed=10.0)
        playback.play()
        playback.halt_at(0.77)
        assert playback.halting
        await asyncio.sleep(0.3)
        assert not playback.playing and not playback.halting
        assert playback.time_s == 0.77
        assert session.stance.joints == pytest.approx(tuple(run.q[77]))
        playback.play()
        await asyncio.sleep(0.5)
        assert playback.time_s == pytest.approx(run.t[-1]), "it halts there once"

    asyncio.run(play())


def test_a_halt_is_taken_back_and_never_leads_backwards(run: Run):
    async def play() -> None:
        playback = Playback(Session(Memory("par4")))
        playback.load(run, speed=1.0)
        playback.play()
        playback.halt_at(0.5)
        playback.halt_at(None)
        assert playback.playing and not playback.halting
        await asyncio.sleep(0.2)
        before = playback.time_s
        playback.halt_at(0.0)
        await asyncio.sleep(0.12)
        assert not playback.playing and playback.time_s >= before

    asyncio.run(play())


def test_anything_with_times_poses_and_joints_is_played():
    session = Session(Memory("delta3"))
    joints = session.robot.inverse(session.robot.home[None])
    still: Any = SimpleNamespace(
        t=np.array([0.0, 1.0]), pose=np.tile(session.robot.home, (2, 1)), q=np.tile(joints, (2, 1))
    )
    playback = Playback(session)
    playback.load(still)
    playback.seek(0.5)
    assert session.stance.joints == pytest.approx(tuple(joints[0]))


def test_errors_are_enlarged_but_never_beyond_the_picture():
    errors = np.array([[1e-4, 0.0, 0.0], [0.0, 0.02, 0.0], [0.0, 0.0, 0.3], [0.0, 0.0, 0.0]])
    drawn = np.linalg.norm(enlarged(errors, 20.0), axis=1)
    assert drawn == pytest.approx([2e-3, LONGEST_ERROR_M, 0.3, 0.0])
    assert np.array_equal(enlarged(errors, 1.0), errors)


class FakeGui:
    """Notes what a chart is made of."""

    def __init__(self) -> None:
        self.chart = SimpleNamespace()

    def add_uplot(self, data: Any, series: Any, **options: Any) -> SimpleNamespace:
        self.chart = SimpleNamespace(data=data, series=series, **options)
        return self.chart


def make_plot(*curves: Curve) -> tuple[Plot, FakeGui]:
    gui = FakeGui()
    return Plot(gui, Axes("Time (s)", "Angle (deg)"), curves, "Title"), gui  # type: ignore[arg-type]


def test_a_chart_has_axes_with_units_a_legend_and_no_dates():
    _, gui = make_plot(Curve("now", (1, 2, 3)))
    assert [axis["label"] for axis in gui.chart.axes] == ["Time (s)", "Angle (deg)"]
    assert gui.chart.scales["x"]["time"] is False and gui.chart.legend["show"]


def test_gaps_do_not_spoil_the_range():
    plot, gui = make_plot(Curve("a", (1, 2, 3)), Curve("b", (4, 5, 6)))
    plot.show([0, 1, 2], [math.nan, 2.0, math.nan], [math.nan, math.nan, -7.0])
    extent = gui.chart.data[1]
    assert np.isfinite(extent).all() and (extent.min(), extent.max()) == (-7.0, 2.0)
    assert all(series.get("auto") is False for series in gui.chart.series[2:])


def test_an_optional_curve_is_in_the_legend_only_while_it_is_there():
    plot, gui = make_plot(Curve("now", (1, 2, 3)), Curve("baseline", (4, 5, 6), optional=True))
    plot.show([0, 1], [1, 2], [math.nan, math.nan])
    assert "class" in gui.chart.series[3]
    before = gui.chart.series
    plot.show([0, 1], [1, 3], [math.nan, math.nan])
    assert gui.chart.series is before, "an unchanged chart is not built again"
    plot.show([0, 1], [1, 3], [1.0, 1.0])
    assert "class" not in gui.chart.series[3]


def test_a_charts_csv_holds_what_is_shown():
    plot, _ = make_plot(Curve("now", (1, 2, 3)), Curve("a, b", (4, 5, 6)))
    plot.show([0.0, 0.5], [1.0, math.nan], [3.0, 4.0])
    assert plot.csv() == 'Time (s),now: Angle (deg),"a, b: Angle (deg)"\n0,1,3\n0.5,,4\n'
    with pytest.raises(ValueError, match="2 curves"):
        plot.show([0.0], [1.0])


def test_a_table_of_numbers():
    assert csv_table(["a"], np.array([[1 / 3], [math.nan]])) == "a\n0.33333333\n\n"


def test_kept_runs_stand_side_by_side(run: Run):
    table = runs_table([run, run], run)
    assert table.count(f"{run.ise[1]:.4g}") == 2 and "deg² s" in table
    assert "No run yet" in runs_table([], None)
