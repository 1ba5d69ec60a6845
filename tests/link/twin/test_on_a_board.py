"""Twin, identification and gains on an emulated board, whose plant and firmware are somebody else's code."""

from __future__ import annotations

import numpy as np
import pytest

from app.control.drives import DRIVES
from app.link.board_geometry import BOARD_ROBOTS
from app.link.emulated import EmulatedBoard
from app.link.protocol.codes import Command, DriveKind, Flag, State, TargetKind
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import Ack, Alive, Get, Message, Order, Sample, Setpoint, Telemetry, pack, unpack
from app.link.protocol.settings import setting_id
from app.link.twin.compare import compare
from app.link.twin.identify import identify_drive
from app.link.twin.model import board_twin
from app.link.twin.pulses import pulse_plan
from app.link.twin.recorder import Recorder
from app.robots import make_robot

ROBOT = "delta3"


class Bench:
    """A host of a few lines."""

    def __init__(self) -> None:
        self.board = EmulatedBoard(ROBOT, drive=DriveKind.DC, core="twin", boot_s=0.0)
        self.recorder = Recorder(ROBOT, supply_v=DRIVES[ROBOT].supply_v)
        self.telemetry: Telemetry | None = None
        self.acks: list[Ack] = []
        self._decoder, self._number = FrameDecoder(), 0

    def send(self, message: Message) -> None:
        self._number += 1
        self.board.receive(encode_frame(pack(message, self._number)))

    def wait(self, seconds: float) -> None:
        for _ in range(round(seconds / 0.01)):
            self.send(Alive())
            self.board.advance(0.01)
            for frame in self._decoder.feed(self.board.transmit()):
                message, _ = unpack(frame)
                if isinstance(message, Telemetry):
                    self.telemetry = message
                    self.recorder.append(message, self.board.time_s, 0.004)
                elif isinstance(message, Sample):
                    self.recorder.append_sample(message, self.board.time_s)
                elif isinstance(message, Ack):
                    self.acks.append(message)

    def setting(self, name: str, joint: int | None = None) -> float:
        self.acks.clear()
        self.send(Get(setting_id(name, joint)))
        self.wait(0.05)
        return self.acks[-1].value

    def home(self) -> None:
        self.wait(0.1)  # it wakes up
        for command in (Command.ENABLE, Command.HOME):
            self.send(Order(command))
            self.wait(0.1)
        for _ in range(100):
            self.wait(0.1)
            if self.telemetry and self.telemetry.state == State.READY and self.telemetry.flags & Flag.HOMED:
                return
        pytest.fail(f"not homed: {self.telemetry}")


@pytest.fixture(scope="module")
def bench() -> Bench:
    made = Bench()
    made.home()
    return made


def test_pulses_on_the_board_show_its_motor(bench):
    assert bench.telemetry is not None
    bench.recorder = Recorder(ROBOT, supply_v=bench.setting("supply"))
    limits = bench.setting("min", 0), bench.setting("max", 0)
    for test in pulse_plan(0, bench.telemetry.position[0], limits, DRIVES[ROBOT]):
        bench.send(test)
        bench.wait(1e-3 * test.duration_ms + 0.4)
        assert bench.telemetry.state == State.READY
    found = identify_drive([bench.recorder.recording()]).found
    true = DRIVES[ROBOT].motor
    for value, (low, high) in zip((true.K, true.T1), found.confidence, strict=False):
        assert low <= value <= high
    assert abs(found.motor.K / true.K - 1.0) < 0.05 and found.fit_percent > 98.0


def test_the_twin_moves_as_the_board_does(bench):
    names = ("kp", "ki", "kd", "n")
    settings = {setting_id(name, joint): bench.setting(name, joint) for joint in range(3) for name in names}
    settings |= {setting_id(name): bench.setting(name) for name in ("supply", "duty_max")}
    robot, period_us = make_robot(ROBOT), bench.board.model.period_us
    assert BOARD_ROBOTS[ROBOT] == bench.board.kind
    bench.recorder = Recorder(ROBOT)
    start = np.array(bench.telemetry.setpoint[:3])
    for k in range(300):
        t = 0.01 * k
        wave = 0.15 * (1.0 - np.exp(-((t / 0.4) ** 3))) * np.sin(3.0 * t + np.arange(3))
        bench.send(Setpoint(TargetKind.JOINTS, (*(start + wave).tolist(), 0.0)))
        bench.wait(0.01)
    made = bench.recorder.recording()
    found = compare(made, board_twin(ROBOT, DriveKind.DC, period_us, settings))
    resolution = np.radians(270.0 / 1024)
    assert abs(found.lag_s) < 0.005
    assert (found.rms_error < 1.5 * resolution).all()
    assert found.following_lag_s > 0.01  # the set-points are no twin
    assert found.rms_tool_error_m < 2e-3 and len(found.t) > 100
    assert made.run().tool_error_m.max() < 0.1 and robot.name == made.robot
