"""The board's states, and what happens in one control period."""

from __future__ import annotations

import math
from collections.abc import Sequence

from app.link.emulated.core import Outputs
from app.link.emulated.twin import guards, homing, trial
from app.link.emulated.twin.kinematics import inverse
from app.link.emulated.twin.motion import Motion
from app.link.emulated.twin.pid import JointPid
from app.link.emulated.twin.settings import Store, joints_of
from app.link.emulated.twin.tool import Tool
from app.link.protocol.codes import DriveKind, Fault, Flag, Refusal, Reset, RobotKind, State
from app.link.protocol.messages import JOINTS, Test
from app.link.protocol.settings import GEOMETRY_ID, SETTINGS

AT_TARGET_US = 100_000
LATE_TICKS = 4
"""After so many missed periods the set-point does not make up for more."""

_UNUSED = (0.0,) * JOINTS
_K = {name: setting.id for name, setting in SETTINGS.items() if setting.per_joint}
_BOARD = {name: setting.id for name, setting in SETTINGS.items() if not setting.per_joint}


class Machine:
    """Times in us of the board's clock, which wraps; positions in rad or m, one a joint."""

    def __init__(self, robot: RobotKind, drive: DriveKind, period_us: int, reset: Reset, store: Store) -> None:
        self.robot, self.drive_kind, self.period_us = robot, drive, period_us
        self.joints = joints_of(robot)
        self.store = store
        self.state, self.fault, self.fault_joint, self.refusal = State.OFF, Fault.NONE, 0, Refusal.OK
        self.homed = self.manual = self.pen_down = self.ticked = False
        self.laser = 0
        self.now_us = self.frame_us = self.setpoint_us = 0
        self.settled_us = 0
        """For so long at the target, or at home."""
        self.following_us = [0] * self.joints
        self.raw: Sequence[float] = _UNUSED
        self.switches, self.estop_open = 0, False
        self.position = [0.0] * self.joints
        self.origin = [0.0] * self.joints
        """Steppers: raw value where the joint is at `offset`."""
        self.duty = [0.0] * self.joints
        self.motion, self.tool = Motion(self.joints), Tool(robot)
        self.pids = [JointPid() for _ in range(self.joints)]
        self.homing: homing.Homing | None = None
        self.test: trial.Trial | None = None
        self.refresh()
        self.lie()
        if reset == Reset.WATCHDOG:
            self.fail(Fault.WATCHDOG)

    def refresh(self) -> None:
        """After a setting changed."""
        joint, n = self.store.joint, self.joints
        self._named = {name: self.store.values[id] for name, id in _BOARD.items()}
        low, high = joint(_K["min"], n), joint(_K["max"], n)
        self.limits = list(zip(low, high, strict=True))
        self.speeds, self.home = joint(_K["speed"], n), joint(_K["home"], n)
        self.wiring = list(zip(joint(_K["offset"], n), joint(_K["scale"], n), strict=True))
        self.gains = list(zip(*(joint(_K[name], n) for name in ("kp", "ki", "kd", "n")), strict=True))
        self.geometry = self.store.values[GEOMETRY_ID:]
        self.inverse = inverse(self.robot, self.geometry)
        self.home_speeds = [self.setting("home_speed") * speed for speed in self.speeds]
        self.stop_time = 1e-3 * self.setting("stop_time")

    def setting(self, name: str) -> float:
        """One that is not a joint's."""
        return self._named[name]

    @property
    def powered(self) -> bool:
        return self.state not in (State.OFF, State.FAULT)

    @property
    def laser_share(self) -> float:
        """0..1"""
        return self.laser / 255.0 if self.state == State.MOVING else 0.0

    @property
    def flags(self) -> Flag:
        """As telemetry tells them."""
        wanted = {
            Flag.HOMED: self.homed,
            Flag.PEN_DOWN: self.pen_down,
            Flag.LASER_ON: self.laser_share > 0.0,
            Flag.ESTOP_OPEN: self.estop_open,
            Flag.POWERED: self.powered,
            Flag.MANUAL: self.manual,
        }
        return Flag(sum(flag for flag, on in wanted.items() if on))

    def since(self, then_us: int) -> int:
        """us that have passed."""
        return self.now_us - then_us & 0xFFFFFFFF

    def tick(self, now_us: int, raw: Sequence[float], switches: int, estop_open: bool) -> Outputs:
        """One control period."""
        dt_us = now_us - self.now_us & 0xFFFFFFFF if self.ticked else 0
        self.now_us, self.ticked = now_us, True
        self.raw, self.switches, self.estop_open = raw, switches, bool(estop_open)
        self._sense()
        guards.watch(self, dt_us)
        self._move(dt_us)
        return self._outputs()

    def room(self, joint: int, position: float) -> float:
        """How far inside its limits a joint would be there."""
        low, high = self.limits[joint]
        return min(position - low, high - position)

    def place(self, joints: Sequence[float]) -> None:
        """The set-points are these now, at rest."""
        self.motion.place(joints)
        self.tool.lose(self.geometry, self.motion.setpoint)

    def lie(self) -> None:
        """Without power. Servos, which have no sensor, are taken to be at home."""
        if self.drive_kind == DriveKind.SERVO:
            self.position = list(self.home)
        self.place(self.position)

    def rest(self, state: State = State.READY) -> None:
        """Holding, the laser off."""
        self.state, self.laser = state, 0

    def power_on(self) -> None:
        """The motors hold where the joints are."""
        self.pids = [JointPid() for _ in range(self.joints)]
        self.following_us = [0] * self.joints
        self.lie()
        self.rest()

    def power_off(self, state: State) -> None:
        """Into OFF or FAULT. Only a potentiometer still knows afterwards where its joint is."""
        self.state, self.laser, self.pen_down = state, 0, False
        self.homed = self.homed and self.drive_kind == DriveKind.DC

    def fail(self, fault: Fault, joint: int = 0) -> None:
        """`joint` from 1, 0 for none."""
        self.power_off(State.FAULT)
        self.fault, self.fault_joint = fault, joint

    def stop(self, state: State) -> None:
        """A controlled stop; the state that it leads to holds at once."""
        if self.state == State.TESTING and self.test is not None:
            self.test.release(self)
        self.motion.stop(self.stop_time)
        self.rest(state)

    def begin_homing(self) -> None:
        """From READY."""
        self.state, self.homed, self.pen_down = State.HOMING, False, False
        self.homing = homing.Homing(self)

    def begin_test(self, test: Test, number: int) -> None:
        """From READY; the test is checked."""
        self.state = State.TESTING
        self.test = trial.Trial(self, test, number)

    def _sense(self) -> None:
        if self.drive_kind != DriveKind.SERVO:
            readings = zip(self.raw, self.origin, self.wiring, strict=False)
            self.position = [offset + scale * (raw - origin) for raw, origin, (offset, scale) in readings]

    def _move(self, dt_us: int) -> None:
        dt = 1e-6 * min(dt_us, LATE_TICKS * self.period_us)
        if not self.powered:
            self.lie()
        elif self.state == State.HOMING and self.homing is not None:
            self.homing.tick(self, dt, dt_us)
        elif self.state == State.TESTING and self.test is not None:
            self.test.tick(self)
        else:
            self._run(dt, dt_us)
        if self.drive_kind == DriveKind.SERVO:
            self.position = list(self.motion.setpoint)

    def _run(self, dt: float, dt_us: int) -> None:
        self._watch_tool(dt)
        self.motion.run(dt, self.limits, self.stop_time)
        if self.state == State.MOVING:
            self.settled_us = self.settled_us + dt_us if self.motion.time_left == 0.0 else 0
            if self.settled_us >= AT_TARGET_US:
                self.rest()

    def _watch_tool(self, dt: float) -> None:
        """Only manual mode needs the tool's pose. It is found at rest, and kept while the joints move in that mode."""
        motion, tool, moves = self.motion, self.tool, self.motion.time_left > 0.0
        if motion.stop_left > 0.0 or (moves and not self.manual):
            tool.known = False
        elif moves and dt > 0.0:
            tool.limit(self.geometry, motion, self.setting("tool_speed"), self.home_speeds, self.homed, dt)
        elif self.manual or self.state == State.READY:
            tool.settle(self.geometry, motion)

    def _outputs(self) -> Outputs:
        powered = self.powered
        self.duty = [self._duty(j) if powered and self.drive_kind == DriveKind.DC else 0.0 for j in range(self.joints)]
        pen_us = self.setting("pen_down" if self.pen_down else "pen_up")
        drive = (*(self._drive(j, powered) for j in range(self.joints)), *_UNUSED[self.joints :])
        return Outputs(powered, drive, pen_us, self.laser_share)

    def _drive(self, joint: int, powered: bool) -> float:
        if self.drive_kind == DriveKind.DC:
            return self.duty[joint]
        if not powered:
            return self.raw[joint] if self.drive_kind == DriveKind.STEPPER else 0.0
        offset, scale = self.wiring[joint]
        return self.origin[joint] + (self.motion.setpoint[joint] - offset) / scale

    def _duty(self, joint: int) -> float:
        """Share of the supply for a DC motor."""
        largest, supply = self.setting("duty_max"), self.setting("supply")
        pulse = self.test.pulse_on(joint) if self.state == State.TESTING and self.test is not None else math.nan
        if not math.isnan(pulse):
            return min(max(pulse, -largest), largest)
        error = self.motion.setpoint[joint] - self.position[joint]
        return self.pids[joint].step(self.gains[joint], 1e-6 * self.period_us, error, largest * supply) / supply
