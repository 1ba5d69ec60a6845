"""The control lab without a page: settings, desk, runs, traps, identification jobs."""

from __future__ import annotations

import asyncio
import math
from collections.abc import Awaitable, Callable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from app.control import PAR4_MOTOR, PID_AUTO, Motor
from app.control.drives import DRIVES
from app.control.identification.recordings import write_recording
from app.control.tuning.methods import METHODS, TABLE_2, TABLE_3, TUNER, methods_for
from app.robots import ROBOTS
from app.simulation import circle_tracking
from app.ui.compute import Worker
from app.ui.lab.desk import ControlDesk
from app.ui.lab.jobs import answer, run_csv, run_robot
from app.ui.lab.motor_jobs import Identified, MotorTest, move_and_identify, read_and_identify, record
from app.ui.lab.run_book import KEPT, RunBook
from app.ui.lab.settings import BY_HAND, ControlSettings, changed, default_settings
from app.ui.lab.traps import TRAPS, entered, traps_for
from app.ui.refusal import Refusal
from app.ui.session import Session
from app.ui.state import Memory

PAR4 = default_settings("par4")


def with_worker(scene: Callable[[Worker, list[str]], Awaitable[None]]) -> None:
    """Run a scene on an event loop, with a worker that says here what went wrong."""

    async def play() -> None:
        told: list[str] = []
        with ThreadPoolExecutor(1) as pool:
            await scene(Worker(pool, told.append), told)

    asyncio.run(play())


async def until(condition: Callable[[], object], what: str) -> None:
    for _ in range(1000):
        if condition():
            return
        await asyncio.sleep(0.01)
    raise AssertionError(f"no {what}")


@pytest.mark.parametrize(
    ("values", "read"),
    [
        ({"kp": 2.0}, lambda s: s.pid.kp == 2.0),
        ({"period_s": 0.02, "anti_windup": "clamping"}, lambda s: s.sampling.anti_windup == "clamping"),
        ({"noise": 0.3}, lambda s: s.hardware.noise == 0.3),
        ({"lap_s": 50.0, "start": "smooth"}, lambda s: (s.run.tour.lap_s, s.run.start) == (50.0, "smooth")),
        ({"setpoint": 5.0}, lambda s: s.setpoint == 5.0),
    ],
)
def test_a_value_is_changed_where_it_lives_and_nothing_else(values, read: Callable[[ControlSettings], bool]):
    settings = changed(PAR4, **values)
    assert read(settings) and settings != PAR4
    assert default_settings("par4") == PAR4, "settings are never changed in place"


def test_an_unknown_value_is_a_mistake():
    with pytest.raises(TypeError):
        changed(PAR4, gain=3.0)


@pytest.mark.parametrize("robot", ROBOTS)
@pytest.mark.parametrize("method", METHODS)
def test_every_method_offered_for_a_motor_gives_a_loop(robot: str, method: str):
    settings = default_settings(robot)
    if method not in methods_for(settings.motor):
        assert method in (TABLE_2, TABLE_3) or METHODS[method].needs_final_value
        return
    result = answer(changed(settings, tuning=method))
    assert not result.refused and result.settings.pid.kp > 0.0
    assert result.study.ideal_frequency.margins.stable


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_defaults_are_stable_as_sampled(robot: str):
    result = answer(default_settings(robot))
    assert result.study.board_frequency.margins.stable
    assert result.study.board_frequency.margins.phase_margin_deg > 45.0


def test_the_desk_tunes_and_tells_its_panels():
    async def scene(worker: Worker, told: list[str]) -> None:
        desk = ControlDesk(Session(Memory("par4")), worker)
        heard: list[ControlSettings] = []
        desk.settings_changed.connect(heard.append)
        desk.change(tuning=TUNER, response_time_s=0.5)
        assert desk.answer is None, "nobody looks yet"
        desk.open()
        await until(lambda: desk.answer, "answer")
        assert desk.settings.pid != PID_AUTO and heard[-1].pid == desk.settings.pid
        assert desk.answer is not None
        assert desk.answer.study.ideal_frequency.margins.crossover_rad_s == pytest.approx(4.0)
        desk.change(kp=1.0)
        assert desk.settings.tuning == BY_HAND
        desk.keep_baseline()
        assert desk.baseline is not None and desk.baseline.study is desk.answer.study
        await until(lambda: desk.answer and desk.answer.settings.pid.kp == 1.0, "newest answer")
        desk.reset()
        assert desk.settings == PAR4 and desk.baseline is None
        assert told == []

    with_worker(scene)


def test_the_newest_of_many_changes_wins():
    async def scene(worker: Worker, told: list[str]) -> None:
        desk = ControlDesk(Session(Memory("par4")), worker)
        answers: list[float] = []
        desk.answered.connect(lambda result: answers.append(result.settings.pid.kp))
        desk.open()
        for k in range(50):
            desk.change(kp=1.0 + 0.1 * k)
        await until(lambda: answers and answers[-1] == pytest.approx(5.9), "last value")
        assert len(answers) < 10, "what nobody waits for is not computed"

    with_worker(scene)


def test_another_robot_brings_its_own_motor_and_a_reload_the_same_settings():
    async def scene(worker: Worker, told: list[str]) -> None:
        session = Session(Memory("par4"))
        desk = ControlDesk(session, worker)
        desk.change(kd=0.5)
        again = ControlDesk(Session(session.memory), worker)
        assert again.settings == desk.settings and again.settings.pid.kd == 0.5
        session.choose_robot("linear")
        assert desk.settings == default_settings("linear")

    with_worker(scene)


def test_gains_of_a_table_end_with_their_motor():
    async def scene(worker: Worker, told: list[str]) -> None:
        desk = ControlDesk(Session(Memory("par4")), worker)
        desk.change(motor=Motor(9.0, 3.0, 0.1), motor_origin="mine")
        assert desk.settings.tuning == BY_HAND and desk.settings.pid == PID_AUTO

    with_worker(scene)


def test_runs_are_the_papers_and_are_kept():
    async def scene(worker: Worker, told: list[str]) -> None:
        book = RunBook(Session(Memory("par4")), worker, told.append)
        book.request(changed(PAR4, as_in_paper=True), changed(PAR4, supply_v=100.0))
        assert book.busy
        await until(lambda: not book.busy, "end of both runs")
        assert [run.effort_unit for run in book.runs] == ["%", "V"]
        assert book.runs[0].ise == pytest.approx(circle_tracking("auto").ise)
        assert book.runs[1].ise == pytest.approx(circle_tracking("auto", mode="sampled").ise)
        assert book.run is book.runs[1]
        short = changed(PAR4, lap_s=1.0, size_m=0.01)
        book.request(*[short] * (KEPT + 2))
        await until(lambda: not book.busy, "end of many runs")
        assert len(book.runs) == KEPT
        book.clear()
        assert book.run is None and book.runs == [] and told == []

    with_worker(scene)


def test_table_3_as_in_the_paper_has_no_filter():
    run = run_robot(changed(PAR4, as_in_paper=True, tuning=TABLE_3, lap_s=10.0), {})
    assert not isinstance(run, Refusal)
    assert run.ise == pytest.approx(circle_tracking("approx", lap_s=10.0, duration_s=10.0).ise)


def test_a_run_can_be_cancelled_and_an_impossible_one_is_refused():
    async def scene(worker: Worker, told: list[str]) -> None:
        book = RunBook(Session(Memory("par4")), worker, told.append)
        finished: list[object] = []
        book.finished.connect(finished.append)
        book.request(PAR4, PAR4)
        book.cancel()
        assert not book.busy
        await asyncio.sleep(0.5)
        assert book.runs == []
        book.request(changed(PAR4, size_m=0.2), PAR4)
        await until(lambda: not book.busy, "refusal")
        assert book.runs == [] and finished == [] and len(told) == 1
        assert "out of reach" in told[0] and told[0].endswith("make it smaller.")

    with_worker(scene)


def test_a_changed_geometry_forgets_runs_that_no_longer_fit():
    async def scene(worker: Worker, told: list[str]) -> None:
        session = Session(Memory("par4"))
        book = RunBook(session, worker, told.append)
        book.request(changed(PAR4, lap_s=1.0))
        await until(lambda: book.runs, "run")
        session.reshape(l=0.4)
        assert book.runs == [] and book.run is None

    with_worker(scene)


def test_a_run_uses_the_tuning_method_not_the_last_gains():
    run = run_robot(replace(changed(PAR4, supply_v=100.0), tuning=TABLE_3), {})
    assert not isinstance(run, Refusal)
    assert run.ise == pytest.approx(circle_tracking("approx", mode="sampled").ise)
    assert run_csv(run).startswith(b"t_s,x_ref_mm")


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_trap_shows_what_it_says(robot: str):
    start = answer(default_settings(robot)).settings
    for name in traps_for(robot):
        settings = entered(name, start)
        study = answer(settings).study
        plain = answer(default_settings(robot)).study
        if name == "Windup":
            cured = answer(changed(settings, anti_windup="clamping")).study.board.metrics
            assert cured.overshoot_pct < 0.7 * study.board.metrics.overshoot_pct
        elif name == "Derivative kick":
            calm = answer(changed(settings, c=0.0)).study.board
            assert abs(study.board.u[0]) > 3.0 * abs(calm.u[0])
        elif name == "Too slow sampling":
            margin = study.board_frequency.margins.phase_margin_deg
            assert margin < plain.board_frequency.margins.phase_margin_deg - 25.0
        elif name == "Noise and a large kd":
            calm = answer(changed(settings, n=20.0)).study.board
            tail = slice(len(study.board.u) // 2, None)
            assert np.std(study.board.u[tail]) > 3.0 * np.std(calm.u[tail])
        else:
            assert robot == "par4" and len(TRAPS[name].runs) == 4


@pytest.mark.parametrize("robot", ROBOTS)
def test_a_motor_is_recorded_and_found_again(robot: str):
    drive = DRIVES[robot]
    test = MotorTest("prbs", drive.supply_v, 60.0, 0.2, seed=1)
    result = move_and_identify(robot, default_settings(robot).hardware, test)
    assert isinstance(result, Identified)
    assert pytest.approx(drive.motor.K, rel=0.01) == result.found.motor.K
    assert pytest.approx(drive.motor.T1, rel=0.01) == result.found.motor.T1
    again = read_and_identify("file.csv", write_recording(result.recording).encode())
    assert isinstance(again, Identified)
    assert pytest.approx(result.found.motor.K, rel=1e-3) == again.found.motor.K


def test_short_pulses_keep_every_arm_within_its_stops():
    for robot in ("par4", "delta3", "fivebar"):
        drive = DRIVES[robot]
        recording = record(robot, default_settings(robot).hardware, MotorTest("pulses", drive.supply_v, 20.0, 0.0, 0))
        assert 5.0 < np.max(np.abs(recording.y)) < 45.0


def test_dry_friction_is_not_in_the_model_and_the_student_is_told():
    test = MotorTest("square", 3.0, 40.0, 0.1, seed=0)
    smooth = move_and_identify("par4", PAR4.hardware, test)
    rough = move_and_identify("par4", replace(PAR4.hardware, coulomb_v=1.0), test)
    assert isinstance(smooth, Identified) and isinstance(rough, Identified)
    assert pytest.approx(PAR4_MOTOR.K, rel=0.01) == smooth.found.motor.K and not smooth.found.warnings
    assert rough.found.motor.K < 0.9 * PAR4_MOTOR.K and rough.found.warnings


def test_a_bad_file_is_refused_in_one_sentence():
    for content in (b"", b"\x00\x01", b"t,u,y\n0,1\n", b"t,u,y\n" + b"0,0,0\n" * 50):
        result = read_and_identify("bad.csv", content)
        assert isinstance(result, Refusal)
        assert result.reason[0].isupper() and result.reason.endswith(".")


def test_the_papers_motor_is_the_par4s():
    assert PAR4.motor == PAR4_MOTOR and PAR4.hardware.supply_v == 12.0 and math.isclose(PAR4.sampling.period_s, 0.01)
