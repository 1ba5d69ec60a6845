"""The firmware of the STM32 itself, in QEMU, with motors around it.

Everything here runs in real time on a computer that may be busy: what must be exact is read from the board's own
clock or from the plant, and waiting is patient.
"""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

import numpy as np
import pytest

from app.link.board_geometry import geometry_hash, geometry_values
from app.link.protocol.codes import (
    BoardKind,
    Command,
    DriveKind,
    Fault,
    Flag,
    Refusal,
    Reset,
    RobotKind,
    State,
    TargetKind,
)
from app.link.protocol.codes import SettingsSource as Source
from app.link.protocol.messages import Telemetry
from app.robots import make_robot
from tests.support.emulators.stm32.firmware import needs_stm32
from tests.support.emulators.stm32.host import Host
from tests.support.emulators.stm32.plant import Faults
from tests.support.emulators.stm32.qemu import LINE_RESET, WATCHDOG_RESET, Stm32, running_stm32

pytestmark = needs_stm32

ROBOT = make_robot("par4")
NEAR_RAD = 0.02
START = [0.08, -0.12, 0.10, -0.06]


@dataclass
class Bench:
    """A board on a table, and who talks to it."""

    board: Stm32
    host: Host

    @property
    def joints(self) -> np.ndarray:
        """(4,) rad, where they really are."""
        return np.array(self.board.plant.joints)

    def clean(self) -> None:
        """As just switched on, but for what was homed."""
        self.board.plant.faults = Faults()
        self.host.order(Command.OFF)
        self.host.wait(lambda now: not now.flags & Flag.ESTOP_OPEN)
        assert self.host.order(Command.CLEAR) in (Refusal.OK, Refusal.BUSY)
        assert self.host.order(Command.OFF) == self.host.order(Command.DEFAULTS) == Refusal.OK
        self.host.set("hold_after", 150.0)  # this computer may be busy
        self.host.set("off_after", 5000.0)

    def home(self) -> None:
        assert self.host.home().flags & Flag.HOMED

    def reset(self, cause: int = LINE_RESET) -> Telemetry:
        """The first telemetry after it."""
        before = self.host.fresh().t_us
        self.board.reset(cause)
        return self.host.wait(lambda now: now.t_us < before)

    def moving(self) -> None:
        """Homed, and on its way along a circle."""
        self.home()
        self.host.stream(circle(30))
        assert self.host.fresh().state in (State.MOVING, State.READY, State.HELD)


@pytest.fixture(scope="module")
def running() -> Iterator[Bench]:
    with running_stm32("par4_dc") as board:
        host = Host(board.port)
        board.plant.put(START)
        yield Bench(board, host)
        host.close()


@pytest.fixture
def bench(running: Bench) -> Bench:
    running.clean()
    return running


def circle(points: int) -> list[list[float]]:
    """Poses of a slow arc, 10 ms apart, that begins at home."""
    x, y, z, theta = ROBOT.home.tolist()
    return [[x + 0.02 * np.sin(0.01 * i), y + 0.02 * (1 - np.cos(0.01 * i)), z, theta] for i in range(points)]


def test_it_says_what_it_is(bench: Bench):
    found = bench.host.identity()
    assert (found.board, found.robot, found.drive) == (BoardKind.STM32F407, RobotKind.PAR4, DriveKind.DC)
    assert (found.joints, found.period_us, found.protocol) == (4, 1000, 1)
    assert found.geometry == geometry_hash(geometry_values(ROBOT))
    assert 0 < found.serial < 2**24


def test_telemetry_comes_every_20_ms_of_its_clock(bench: Bench):
    bench.host.telemetry.clear()
    bench.host.wait(lambda now: len(bench.host.telemetry) > 40)
    times = [message.t_us for _, message in bench.host.telemetry]
    gaps = [after - before for before, after in pairwise(times)]
    assert min(gaps) > 0
    assert abs(median(gaps) - 20_000) <= 1000
    assert bench.host.decoder.bad == 0


def test_it_boots_off_and_set_points_do_not_move_it(bench: Bench):
    assert bench.reset().state is State.OFF
    assert bench.host.identity().reset is Reset.LINE
    before = bench.joints
    bench.host.stream(circle(20))
    assert bench.host.fresh().refusal is Refusal.NOT_ENABLED
    assert not bench.board.outputs.powered
    assert bench.board.outputs.drive == (0.0,) * 4
    assert np.array_equal(bench.joints, before)


def test_home_brings_the_joints_home(bench: Bench):
    bench.board.plant.put(START)
    bench.home()
    home = ROBOT.inverse(ROBOT.home)
    assert np.abs(np.array(START) - home).max() > 0.05
    assert np.abs(bench.joints - home).max() < NEAR_RAD + 0.005


def test_the_joints_follow_a_stream_of_poses(bench: Bench):
    bench.home()
    path = circle(100)
    bench.host.stream(path + 20 * path[-1:], pen=True)
    bench.host.wait(lambda now: now.state in (State.READY, State.HELD))
    assert np.abs(bench.joints - ROBOT.inverse(np.array(path[-1]))).max() < NEAR_RAD
    assert np.abs(bench.joints - ROBOT.inverse(ROBOT.home)).max() > 0.03
    assert bench.board.outputs.pen_us == bench.host.get("pen_down")


def test_a_silent_host_is_a_controlled_stop_and_then_no_power(bench: Bench):
    bench.home()
    bench.host.order(Command.OFF)
    bench.host.set("hold_after", 100.0)
    bench.host.set("off_after", 500.0)
    bench.host.order(Command.ENABLE)
    bench.host.stream(circle(40))
    held = bench.host.wait(lambda now: now.state is State.HELD, alive=False)
    stands = bench.joints
    off = bench.host.wait(lambda now: now.state is State.OFF, alive=False)
    last = bench.host.telemetry[-1][0]  # the number of the last set-point that was accepted
    first = next(message for number, message in bench.host.telemetry if number == last)
    assert milliseconds(first, held) <= 300
    assert milliseconds(held, off) > 0
    assert milliseconds(first, off) <= 1000
    assert np.abs(bench.joints - stands).max() < 0.06
    assert not bench.board.outputs.powered
    assert off.flags & Flag.HOMED  # a potentiometer knows where it is


def milliseconds(before: Telemetry, after: Telemetry) -> float:
    """By the board's clock."""
    return (after.t_us - before.t_us) % 2**32 / 1000


def test_the_emergency_stop(bench: Bench):
    bench.moving()
    bench.board.plant.faults.estop_open = True
    stopped = bench.host.wait_for(State.FAULT)
    assert stopped.fault is Fault.ESTOP and stopped.flags & Flag.ESTOP_OPEN
    assert not bench.board.outputs.powered
    assert bench.host.order(Command.CLEAR) is Refusal.ESTOP
    bench.board.plant.faults.estop_open = False
    bench.host.wait(lambda now: not now.flags & Flag.ESTOP_OPEN)
    assert bench.host.order(Command.CLEAR) is Refusal.OK
    assert bench.host.fresh().state is State.OFF


def test_a_broken_wire_of_a_sensor(bench: Bench):
    bench.moving()
    bench.board.plant.faults.broken_sensor = 2
    found = bench.host.wait_for(State.FAULT)
    assert (found.fault, found.fault_joint) == (Fault.SENSOR, 3)


def test_a_stuck_joint(bench: Bench):
    bench.home()
    bench.host.set("following", 0.01)  # live settings only: refused
    assert bench.host.order(Command.OFF) is Refusal.OK
    assert bench.host.set("following", 0.03).result is Refusal.OK
    assert bench.host.order(Command.ENABLE) is Refusal.OK
    bench.board.plant.faults.stuck_joint = 1
    bench.host.stream(circle(200))
    found = bench.host.wait_for(State.FAULT)
    assert (found.fault, found.fault_joint) == (Fault.FOLLOWING, 2)


def test_a_limit_switch_in_motion(bench: Bench):
    bench.moving()
    bench.board.plant.faults.limit_switch = 3
    bench.host.stream(circle(60)[30:])
    found = bench.host.wait_for(State.FAULT)
    assert found.fault is Fault.SWITCH and found.limit_switches == 0b1000


def test_stop_puts_the_laser_out_and_keeps_the_power(bench: Bench):
    bench.home()
    bench.host.stream(circle(30), laser=255)
    assert bench.host.order(Command.STOP) is Refusal.OK
    assert any(message.flags & Flag.LASER_ON for _, message in bench.host.telemetry[-40:])
    found = bench.host.fresh()
    assert found.state is State.STOPPED and not found.flags & Flag.LASER_ON
    assert (bench.board.outputs.laser, bench.board.outputs.powered) == (0.0, True)
    stands = bench.joints
    bench.host.stream(circle(30), laser=255)
    assert bench.host.fresh().refusal is Refusal.STOPPED
    assert bench.board.outputs.laser == 0.0
    assert np.abs(bench.joints - stands).max() < 0.02


def test_settings_outlive_a_reset(bench: Bench):
    built_in = bench.host.get("kp", 2)
    assert bench.host.set("kp", 1.5 * built_in, 2).value == pytest.approx(1.5 * built_in)
    assert bench.host.order(Command.SAVE) is Refusal.OK
    assert bench.host.set("kp", 3.0 * built_in, 2).result is Refusal.OK  # not saved
    bench.reset()
    assert bench.host.identity().settings is Source.STORED
    assert bench.host.get("kp", 2) == pytest.approx(1.5 * built_in)
    assert bench.host.order(Command.DEFAULTS) is Refusal.OK
    assert bench.host.get("kp", 2) == built_in
    assert bench.host.order(Command.ENABLE) is Refusal.OK
    assert bench.host.set("min", -0.5, 0).result is Refusal.BUSY


def test_noise_on_the_line_is_counted_and_does_no_harm(bench: Bench):
    before = bench.host.fresh()
    noise = random.Random(5)
    for _ in range(10):
        bench.host.line.write(noise.randbytes(300))
        assert bench.host.order(Command.OFF) is Refusal.OK
    after = bench.host.fresh()
    assert (after.bad - before.bad) % 2**16 >= 10
    assert (after.good - before.good) % 2**16 >= 10
    assert (after.state, after.fault) == (State.OFF, Fault.NONE)


def test_after_a_reset_by_the_watchdog_it_says_so(bench: Bench):
    found = bench.reset(WATCHDOG_RESET)
    assert (found.state, found.fault) == (State.FAULT, Fault.WATCHDOG)
    assert bench.host.identity().reset is Reset.WATCHDOG
    assert bench.host.order(Command.CLEAR) is Refusal.OK
    assert bench.host.fresh().state is State.OFF


def test_a_device_file_leads_to_it_too():
    with running_stm32("fivebar_dc", "pty") as board:
        host = Host(board.port)
        found = host.identity()
        assert (found.robot, found.drive, found.joints) == (RobotKind.FIVEBAR, DriveKind.DC, 4)
        assert found.geometry == geometry_hash(geometry_values(make_robot("fivebar")))
        assert host.fresh().state is State.OFF
        host.close()


def test_steppers_find_their_switches_and_go_where_they_should():
    with running_stm32("linear_stepper") as board:
        host, linear = Host(board.port), make_robot("linear")
        board.plant.put([0.01, 0.02, 0.015, 1.0])
        host.set("hold_after", 150.0)
        host.set("off_after", 5000.0)
        assert host.home().flags & Flag.HOMED
        home = linear.inverse(linear.home)
        assert np.abs(board.plant.joints[:3] - home).max() < 1e-3
        host.stream([home + 1e-3 * min(i, 20) for i in range(40)], TargetKind.JOINTS)
        host.wait(lambda now: now.state in (State.READY, State.HELD))
        assert np.abs(board.plant.joints[:3] - home - 0.02).max() < 1e-3
        host.close()
