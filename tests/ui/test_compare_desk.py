"""Comparing controllers without a page: who is asked to run, what is kept, and how the order changes."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest

from app.ui.compare import desk as desk_module
from app.ui.compare.desk import CompareDesk, Comparison
from app.ui.compare.jobs import Result
from app.ui.compare.score import LATER, STRETCHES, WHOLE, Score, quantities, ranking
from app.ui.compare.settings import CompareSettings, default_compare, difference, tasks_for
from app.ui.compute import Worker
from app.ui.motion.desk import MotionDesk
from app.ui.panels.compare.bars import effort_bars, error_bars
from app.ui.panels.compare.ranking_table import ranking_table, verdict
from app.ui.refusal import Refusal
from app.ui.series import Series
from app.ui.session import Session
from app.ui.state import Memory
from tests.support.small_lab import eventually

RMS_Z = {0.0: {"PD": 2.785, "PID": 0.0005, "CTC": 0.0001}, 1.0: {"PD": 2.509, "PID": 0.057, "CTC": 0.264}}
"""mm, by friction and law: the linear delta's helix T1 after the first second."""


def score(z_mm: float, xy_mm: float = 0.1) -> Score:
    values = ((z_mm**2 + 2.0 * xy_mm**2) ** 0.5, 1.414 * xy_mm, xy_mm, xy_mm, z_mm)
    same = dict.fromkeys(STRETCHES, values)
    peak = dict.fromkeys(STRETCHES, tuple(2.0 * value for value in values))
    return Score(
        quantities(("x", "y", "z")),
        same,
        peak,
        (9.0,) * 3,
        (8.0,) * 3,
        (60.0,) * 3,
        (0.0, 0.25, 0.0),
        {"p": (1.0,) * 3},
    )


def fake_law(settings: CompareSettings, law: str, dimensions: dict[str, float], planned: Any) -> Result | Refusal:
    if law == "MPC":
        return Refusal("MPC finds no way within the limits.")
    return Result(law, None, score(RMS_Z[settings.friction][law]))  # type: ignore[arg-type]


class Table:
    """A desk whose laws answer at once."""

    def __init__(self, pool: ThreadPoolExecutor, robot: str = "linear") -> None:
        self.told: list[str] = []
        self.session = Session(Memory(robot))
        worker = Worker(pool, self.told.append)
        series = Series(worker)
        self.desk = CompareDesk(self.session, MotionDesk(self.session, worker, worker), series, self.told.append)
        self.answers: list[Comparison | None] = []
        self.finished: list[Comparison] = []
        self.desk.answered.connect(self.answers.append)
        self.desk.finished.connect(self.finished.append)

    async def run(self) -> Comparison:
        before = len(self.finished)
        self.desk.run()
        await eventually(lambda: len(self.finished) > before, "finished comparison")
        return self.finished[-1]


def at(scene: Callable[[Table], Awaitable[None]], robot: str = "linear") -> None:
    async def play() -> None:
        with ThreadPoolExecutor(1) as pool:
            await scene(Table(pool, robot))

    asyncio.run(play())


@pytest.fixture(autouse=True)
def quick_laws(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(desk_module, "run_law", fake_law)


def test_results_come_one_by_one_in_the_order_of_the_laws():
    async def scene(table: Table) -> None:
        done = await table.run()
        assert [[*answer.results] for answer in table.answers if answer] == [
            ["PD"],
            ["PD", "PID"],
            ["PD", "PID", "CTC"],
        ]
        assert done.settings == table.desk.settings and not table.desk.busy

    at(scene)


def test_friction_turns_the_order_in_z_and_the_page_says_so():
    async def scene(table: Table) -> None:
        desk = table.desk
        await table.run()
        desk.look_at(quantity="z")
        assert desk.best() == "CTC" and not desk.places_before()
        desk.change(friction=1.0)
        done = await table.run()
        assert ranking(done.scores, "z", LATER) == ["PID", "CTC", "PD"]
        assert desk.places_before() == {"CTC": 1, "PID": 2, "PD": 3}
        assert desk.what_changed() == "friction 0× → 1×"
        said = verdict(done, desk.look, desk.what_changed(), desk.places_before())
        assert said.index("PID") < said.index("CTC") < said.index("PD</") and "friction 0× → 1×" in said
        table_html = ranking_table(done, desk.look, desk.places_before())
        assert "▲1" in table_html and "▼1" in table_html
        assert table_html.count("★") == len(quantities(("x", "y", "z"))), "one best a column shown, and the legend"

    at(scene)


def test_a_law_that_cannot_run_says_why_and_the_others_go_on():
    async def scene(table: Table) -> None:
        table.desk.change(laws=("PD", "MPC", "CTC"))
        done = await table.run()
        assert [*done.results] == ["PD", "CTC"] and [*done.refusals] == ["MPC"]
        assert "MPC finds no way" in ranking_table(done, table.desk.look, {}) and not table.told

    at(scene)


@pytest.mark.parametrize("laws", [(), ("PD",), ("PD", "PID", "PD+", "PDff", "CTC", "CTC+DOB", "MPC")])
def test_too_few_or_too_many_laws_are_refused_in_a_sentence(laws: tuple[str, ...]):
    async def scene(table: Table) -> None:
        done = await table.run()
        table.desk.change(laws=laws)
        table.desk.run()
        assert len(table.told) == 1 and table.told[0].startswith("Choose 2 to 6 controllers")
        assert table.desk.comparison is done, "the last comparison stays"

    at(scene)


def test_a_planned_motion_must_be_there():
    async def scene(table: Table) -> None:
        table.desk.run()
        assert table.told == ["There is no planned motion yet: plan one under Motion, or choose another task."]

    at(scene, "delta3")


def test_another_robot_forgets_the_runs_and_offers_its_own_task():
    async def scene(table: Table) -> None:
        await table.run()
        table.session.choose_robot("fivebar")
        assert table.desk.comparison is None and table.answers[-1] is None
        assert table.desk.settings == default_compare("fivebar")
        assert (table.desk.settings.task, table.desk.settings.friction) == ("W1", 1.0)
        assert [*tasks_for("fivebar")] == ["W1", "W2", "planned"]

    at(scene)


def test_other_dimensions_forget_the_runs_and_keep_the_settings():
    async def scene(table: Table) -> None:
        table.desk.change(laws=("PD", "CTC"))
        await table.run()
        table.session.reshape(l=0.37)
        assert table.desk.comparison is None and table.desk.settings.laws == ("PD", "CTC")

    at(scene)


def test_the_order_before_belongs_to_the_same_task_and_laws():
    async def scene(table: Table) -> None:
        desk = table.desk
        await table.run()
        desk.change(laws=("PD", "CTC"))
        await table.run()
        assert not desk.places_before(), "other laws"
        desk.change(task="T2")
        await table.run()
        assert desk.before is None, "another task"

    at(scene)


def test_what_is_kept_when_cancelled_is_what_is_there():
    async def scene(table: Table) -> None:
        desk = table.desk
        desk.answered.connect(lambda answer: desk.cancel() if answer and len(answer.results) == 2 else None)
        desk.run()
        await eventually(lambda: not desk.busy, "end")
        assert desk.comparison is not None and [*desk.comparison.results] == ["PD", "PID"] and not table.finished

    at(scene)


def test_helices_are_judged_after_their_first_second():
    async def scene(table: Table) -> None:
        await table.run()
        assert table.desk.look.stretch == LATER
        table.desk.look_at(stretch=WHOLE)
        await table.run()
        assert table.desk.look.stretch == WHOLE, "as the student left it"

    at(scene)


def test_each_gain_choice_gives_each_law_its_bandwidth():
    settings = default_compare("linear")
    assert settings.bandwidth_of("PD") is None
    fair = CompareSettings("linear", "T1", ("PD", "CTC"), "equal", 20.0)
    assert fair.bandwidth_of("PD") == fair.bandwidth_of("CTC") == 20.0
    own = CompareSettings("linear", "T1", ("PD", "CTC"), "own", 20.0, {"PD": 45.0})
    assert (own.bandwidth_of("PD"), own.bandwidth_of("CTC")) == (45.0, 20.0)
    assert "gains" in difference(fair, own) and difference(fair, fair) == ""


def test_bars_are_as_long_as_their_numbers_say():
    scores = {"PD": score(2.0, 0.0), "CTC": score(1.0, 0.0)}
    look = desk_module.Look(quantity="z")
    shown = error_bars(scores, look)
    assert shown.count("width:100.0%") == 1, "the largest peak"
    assert shown.count("width:50.0%") == 2, "PD's RMS, and CTC's peak"
    assert shown.index("CTC") < shown.index(">PD<")
    assert "width:15.0%" in effort_bars(scores, look, "d1", "N"), "9 N of 60 N"


def test_the_newest_comparison_wins():
    async def scene(table: Table) -> None:
        desk = table.desk
        desk.run()
        desk.change(friction=1.0)
        done = await table.run()
        await asyncio.sleep(0.1)
        assert len(table.finished) == 1 and done.settings.friction == 1.0
        assert {law: result.score.rms_of("z", WHOLE) for law, result in done.results.items()} == RMS_Z[1.0]

    at(scene)


def test_settings_are_found_again_after_a_reload():
    async def scene(table: Table) -> None:
        table.desk.change(laws=("PID", "MPC"), friction=0.5)
        again = Session(table.session.memory)
        assert again.comparison == table.desk.settings
        worker = Worker(ThreadPoolExecutor(1), print)
        found = CompareDesk(again, MotionDesk(again, worker, worker), Series(worker), print)
        assert found.settings.laws == ("PID", "MPC") and found.settings.friction == 0.5
        other = Session(Memory("fivebar", comparison=table.desk.settings))
        fresh = CompareDesk(other, MotionDesk(other, worker, worker), Series(worker), print)
        assert fresh.settings == default_compare("fivebar")

    at(scene)
