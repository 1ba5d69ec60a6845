"""Recordings: collected from telemetry, saved, read back, and played like any other run."""

from __future__ import annotations

import csv
import io

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.link.errors import LinkError
from app.link.protocol.codes import Fault, Flag, Refusal, State
from app.link.protocol.messages import Sample, Telemetry
from app.link.twin.recorder import FORGOTTEN_ROWS, MAX_ROWS, Recorder
from app.link.twin.recording import Recording, TestSamples
from app.robots import ROBOTS, make_robot

floats = st.floats(-6.0, 6.0, width=32)


@st.composite
def recordings(draw: st.DrawFn) -> Recording:
    robot = draw(st.sampled_from(list(ROBOTS)))
    n, k = len(ROBOTS[robot].build.joint_names), draw(st.integers(1, 5))
    rows = np.array(draw(st.lists(st.lists(floats, min_size=3 * n + 1, max_size=3 * n + 1), min_size=k, max_size=k)))
    steps = draw(st.lists(st.integers(1, 10**7), min_size=k, max_size=k))
    codes = np.array(draw(st.lists(st.tuples(st.integers(0, 7), st.integers(0, 63)), min_size=k, max_size=k)))
    latency = np.abs(rows[:, -1])
    latency[0] = np.nan
    position, setpoint, drive = np.split(rows[:, :-1], 3, axis=1)
    title = " ".join(draw(st.text(st.characters(exclude_categories=["Cs"]), max_size=20)).split())
    t, supply = 1e-6 * np.cumsum(steps), draw(st.sampled_from([5.0, 12.0, 24.5]))
    close = TestSamples(n - 1, t, rows[:, 0], rows[:, -1]) if draw(st.booleans()) else None
    dimensions = {"l": 0.371} if robot in ("par4", "linear") else {}
    return Recording(
        robot, title, t, position, setpoint, drive, codes[:, 0], codes[:, 1], latency, supply, close, dimensions
    )


@settings(max_examples=40)
@given(recordings())
def test_a_saved_recording_is_read_back(made: Recording):
    back = Recording.from_csv(made.csv())
    assert (back.robot, back.title, back.supply_v) == (made.robot, made.title, made.supply_v)
    assert back.dimensions == made.dimensions
    np.testing.assert_allclose(back.t, made.t, rtol=1e-9)
    for name in ("position", "setpoint", "drive"):
        # every digit that a board's 32-bit floats have
        np.testing.assert_array_equal(getattr(back, name).astype(np.float32), getattr(made, name).astype(np.float32))
    np.testing.assert_array_equal(back.state, made.state)
    np.testing.assert_array_equal(back.flags, made.flags)
    np.testing.assert_allclose(back.latency_s, made.latency_s, rtol=1e-9)
    assert (back.samples is None) == (made.samples is None)
    if back.samples and made.samples:
        assert back.samples.joint == made.samples.joint
        np.testing.assert_allclose(back.samples.position, made.samples.position, rtol=1e-9, atol=1e-12)


def telemetry(t_us: int, joints: list[float], state: State = State.MOVING) -> Telemetry:
    four = (*joints, *(0.0,) * (4 - len(joints)))
    ahead = tuple(value + 0.01 for value in four)
    flags = Flag.HOMED | Flag.POWERED
    return Telemetry(
        state, flags, Fault.NONE, 0, Refusal.OK, 0, t_us % 2**32, four, ahead, (0.5, -0.5, 0.0, 1.0), 1, 0, 9
    )


def recorded(robot: str, count: int = 60) -> Recording:
    built = make_robot(robot)
    recorder, home = Recorder(robot, "try", 24.0), built.inverse(built.home)
    for k in range(count):
        recorder.append(telemetry(20_000 * k, (home + 1e-3 * np.sin(0.1 * k)).tolist()), 0.02 * k, 0.004)
    return recorder.recording()


@pytest.mark.parametrize("robot", ROBOTS)
def test_the_table_has_units_people_read_and_the_run_is_the_robots(robot):
    made = recorded(robot)
    unit, factor = ("mm", 1e3) if robot == "linear" else ("deg", 180.0 / np.pi)
    lines = [line for line in made.csv().splitlines() if not line.startswith("#")]
    row = list(csv.DictReader(lines))[7]
    names = make_robot(robot).joint_names
    assert [float(row[f"{name}_{unit}"]) for name in names] == pytest.approx((factor * made.position[7]).tolist())
    assert float(row["latency_ms"]) == pytest.approx(4.0)
    run = made.run()
    np.testing.assert_allclose(np.diff(run.t), 0.02)
    np.testing.assert_allclose(run.q, made.position, atol=1e-12)
    np.testing.assert_allclose(run.u[:, 0], 12.0)  # half of 24 V
    assert len(run.csv().splitlines()) == 61
    assert run.tool_error_m.max() < 0.02
    np.testing.assert_allclose(run.pose, make_robot(robot).forward(made.position), atol=1e-9)


def test_an_uneven_recording_gets_an_even_grid():
    made = recorded("delta3").part(0.1, 0.9)
    jittered = made.t + 0.004 * np.sin(np.arange(len(made.t)))
    line = 0.1 + 0.2 * jittered[:, None] + np.zeros((1, 3))
    uneven = Recording("delta3", "", jittered, line, line, 0 * line, made.state, made.flags, made.latency_s)
    run = uneven.run()
    np.testing.assert_allclose(np.diff(run.t, 2), 0.0, atol=1e-12)
    np.testing.assert_allclose(run.q[:, 0], 0.1 + 0.2 * (run.t + jittered[0]), atol=1e-12)


def test_the_boards_clock_wraps_and_a_reset_board_goes_on():
    recorder = Recorder("delta3")
    for k in range(10):
        recorder.append(telemetry(2**32 - 100_000 + 20_000 * k, [0.1] * 3), 50.0 + 0.03 * k)  # a late host
    np.testing.assert_allclose(np.diff(recorder.recording().t), 0.02, atol=1e-9)
    recorder.append(telemetry(4_000_000_000, [0.1] * 3), 51.0)  # long ago or far ahead: the host's clock counts
    recorder.append(telemetry(5_000, [0.1] * 3), 53.5)
    recorder.append(telemetry(25_000, [0.1] * 3), 53.6)
    assert np.diff(recorder.recording().t)[-2:] == pytest.approx([2.5, 0.02])


def test_a_message_that_comes_twice_is_kept_once():
    recorder = Recorder("delta3")
    for t_us in (0, 20_000, 20_000, 40_000):
        recorder.append(telemetry(t_us, [0.0] * 3), 1e-6 * t_us)
    assert recorder.recording().t.tolist() == pytest.approx([0.0, 0.02, 0.04])


def test_the_newest_half_hour_is_kept(monkeypatch):
    monkeypatch.setattr("app.link.twin.recorder.MAX_ROWS", 200)
    monkeypatch.setattr("app.link.twin.recorder.FORGOTTEN_ROWS", 50)
    assert MAX_ROWS == 30 * FORGOTTEN_ROWS == 90_000
    recorder = Recorder("delta3")
    for k in range(1000):
        recorder.append(telemetry(20_000 * k, [1e-4 * k] * 3), 0.02 * k)
    made = recorder.recording()
    assert 150 <= len(made.t) <= 200
    assert made.position[-1, 0] == pytest.approx(0.0999)
    assert made.t[0] == 0.0 and recorder.duration_s == pytest.approx(made.duration_s)


def test_samples_of_a_test_share_the_recordings_clock():
    recorder = Recorder("par4")
    for k in range(5):
        recorder.append(telemetry(1_000_000 + 20_000 * k, [0.0] * 4), 0.02 * k)
        for j in range(5):
            recorder.append_sample(Sample(1_000_000 + 20_000 * k + 4_000 * j, 2, 0.1 * j, 0.3), 0.02 * k)
    samples = recorder.recording().samples
    assert samples is not None and samples.joint == 2
    np.testing.assert_allclose(samples.t, 0.004 * np.arange(25), atol=1e-9)


GOOD = recorded("delta3", 5).csv()


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("", "not a recording"),
        ("t_s,q1_deg\n0,1\n", "must name the robot"),
        (GOOD.replace("# robot: delta3", "# robot: scara"), "must name the robot"),
        (GOOD.replace("q2_deg", "q2_rad"), "no column q2_deg"),
        (GOOD.replace("\n0.04,", "\n0.01,"), "Line 7: the time does not increase"),
        (GOOD.replace("\n0.04,", "\nx,"), "Line 7: 'x' is not a number"),
        (GOOD.replace("\n0.04,", "\nnan,"), "Line 7: a value is not finite"),
        (GOOD.replace("\n0.04,", "\n0.04,1,"), "Line 7: 14 columns instead of the head's 13"),
        (GOOD.replace("supply (V): 24", "supply (V): much"), "supply"),
        (GOOD.replace("# title", "# dimension rf: 7\n# title"), "rf"),
    ],
)
def test_a_broken_file_is_refused_with_its_line(text, complaint):
    with pytest.raises(LinkError) as refused:
        Recording.from_csv(text)
    assert complaint in str(refused.value) and str(refused.value).endswith(".")


def test_a_spreadsheets_semicolons_and_decimal_commas_are_read():
    made = recorded("delta3", 5)
    head, body = made.csv().split("t_s", 1)
    text = head + ("t_s" + body).replace(",", ";").replace(".", ",")
    np.testing.assert_allclose(Recording.from_csv(text).position, made.position, atol=1e-9)


def test_too_short_a_recording_is_no_run():
    with pytest.raises(LinkError, match="Less than two"):
        recorded("delta3", 1).run()


def test_a_table_opens_in_numpy():
    text = recorded("par4", 8).csv()
    assert np.loadtxt(io.StringIO(text), delimiter=",", skiprows=4, comments="#").shape == (8, 16)
