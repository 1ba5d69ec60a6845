"""The robot on the table as lessons read it; of an emulated board they may set the faults."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from app.classroom.lessons.lesson import Value
from app.errors import UserMistake
from app.ui.desks import Desks
from app.ui.lessons.facts.field import Field, Read, index_of
from app.ui.lessons.facts.link_deeds import LinkDeeds
from app.ui.lessons.facts.robot import FACTOR, POSE_UNITS

if TYPE_CHECKING:
    from app.link.emulated.faults import Faults
    from app.link.protocol.messages import Telemetry
    from app.link.status import LinkStatus

NO_EMULATED = "No emulated board is connected: connect one first."
SIM = "sim:"
UNPOWERED = frozenset({"off", "fault"})


class LinkFacts:
    """`link.*` and `twin.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks
        self.deeds = LinkDeeds(desks)

    def field(self) -> Field:
        return Field(
            {**self._connection(), **self._board(), **self._people(), **self._work(), **self._faults()},
            self._writers(),
            read_each={"link.pose.": self._pose, "link.joint.": self._joint},
        )

    def _connection(self) -> dict[str, Read]:
        return {
            "link.phase": lambda: self._status.phase,
            "link.connected": lambda: self._status.phase == "ready",
            "link.emulated": lambda: self._status.port.startswith(SIM),
            "link.robot": lambda: None if self._status.robot is None else self._status.robot.name,
            "link.same_robot": lambda: self._desks.has_hardware and self._desks.hardware.shows_it,
            "link.round_trip": lambda: self._status.round_trip_ms,
            "link.override": lambda: 100.0 * self._status.override,
        }

    def _board(self) -> dict[str, Read]:
        return {
            "link.state": self._state,
            "link.enabled": lambda: self._state() not in UNPOWERED | {"none"},
            "link.homed": self._homed,
            "link.stopped": lambda: self._state() == "stopped",
            "link.held": lambda: self._state() == "held",
            "link.fault": lambda: self._of_board(lambda board: board.fault.name.lower()),
            "link.frames_ok": lambda: self._of_board(lambda board: board.good),
            "link.frames_bad": lambda: self._of_board(lambda board: board.bad),
            "link.board_load": lambda: self._of_board(lambda board: board.load),
            "link.pose_error": self._pose_error,
        }

    def _people(self) -> dict[str, Read]:
        return {"link.holder": self._holder, "link.place": self._place}

    def _work(self) -> dict[str, Read]:
        return {
            "link.activity": lambda: self._status.activity,
            "link.progress": lambda: 100.0 * self._status.progress,
            "link.finished": lambda: self.deeds.finished,
            "link.drawn": lambda: self.deeds.drawn,
            "link.jogged": lambda: self.deeds.moved_mm,
            "link.recording": lambda: self._status.recording_s > 0.0,
            "link.recorded": self._recorded,
            "twin.lag": lambda: self._of_twin("lag_s"),
            "twin.tool_rms": lambda: self._of_twin("rms_tool_error_m"),
            "twin.tool_peak": lambda: self._of_twin("largest_tool_error_m"),
        }

    def _faults(self) -> dict[str, Read]:
        return {
            "link.line_noise": lambda: self._of_faults(lambda faults: 100.0 * faults.noise),
            "link.line_loss": lambda: self._of_faults(lambda faults: 100.0 * faults.loss),
            "link.line_delay": lambda: self._of_faults(lambda faults: 1e3 * faults.delay_s),
            "link.unplugged": lambda: self._of_faults(lambda faults: faults.unplugged),
            "link.estop": lambda: self._of_faults(lambda faults: faults.estop),
            "link.stuck_joint": lambda: self._of_faults(
                lambda faults: 0 if faults.stuck_joint is None else faults.stuck_joint + 1
            ),
        }

    def _writers(self) -> dict[str, Callable[[Any], None]]:
        return {
            "link.line_noise": lambda percent: self._break(noise=0.01 * percent),
            "link.line_loss": lambda percent: self._break(loss=0.01 * percent),
            "link.line_delay": lambda ms: self._break(delay_s=1e-3 * ms),
            "link.unplugged": lambda on: self._break(unplugged=on),
            "link.estop": lambda on: self._break(estop=on),
            "link.stuck_joint": lambda joint: self._break(stuck_joint=None if joint == 0 else round(joint) - 1),
            "link.override": lambda percent: self._desks.hardware.set_override(0.01 * percent),
            "link.finished": partial(self.deeds.forget, "finished"),
            "link.drawn": partial(self.deeds.forget, "drawn"),
            "link.jogged": partial(self.deeds.forget, "moved"),
        }

    @property
    def _status(self) -> LinkStatus:
        self.deeds.attend()
        return self._desks.workshop.status

    def _of_board(self, get: Callable[[Telemetry], Value]) -> Value | None:
        telemetry = self._status.telemetry
        return None if telemetry is None else get(telemetry)

    def _state(self) -> str:
        telemetry = self._status.telemetry
        return "none" if telemetry is None else telemetry.state.name.lower()

    def _homed(self) -> bool:
        from app.link.protocol.codes import Flag

        telemetry = self._status.telemetry
        return telemetry is not None and Flag.HOMED in telemetry.flags

    def _holder(self) -> str:
        holder = self._status.holder
        if holder is None:
            return "none"
        return "me" if holder.key == self._desks.me.key else "other"

    def _place(self) -> int:
        from app.ui.hardware.verbs import place_in_queue

        return place_in_queue(self._status, self._desks.me)

    def _pose_error(self) -> Value | None:
        measured, commanded = self._status.measured_pose, self._status.commanded_pose
        return None if measured is None or commanded is None else 1e3 * math.dist(measured[:3], commanded[:3])

    def _pose(self, name: str) -> Value | None:
        status = self._status
        k = None if status.robot is None else index_of(name, status.robot.pose_names)
        pose = status.measured_pose
        return None if k is None or pose is None else pose[k] * FACTOR[POSE_UNITS[k]]

    def _joint(self, name: str) -> Value | None:
        status = self._status
        k = None if status.robot is None else index_of(name, status.robot.joint_names)
        if k is None or status.robot is None or status.telemetry is None:
            return None
        return status.telemetry.position[k] * FACTOR[status.robot.joint_units[k]]

    def _recorded(self) -> float:
        recording = self._desks.hardware.recording if self._desks.has_hardware else None
        return 0.0 if recording is None else recording.duration_s

    def _of_twin(self, figure: str) -> Value | None:
        """In ms or mm."""
        found = self._desks.twin.result if self._desks.has_hardware else None
        return None if found is None else 1e3 * float(np.float64(getattr(found, figure)))

    def _of_faults(self, get: Callable[[Faults], Value]) -> Value | None:
        faults = self._desks.workshop.faults
        return None if faults is None else get(faults)

    def _break(self, **changes: object) -> None:
        faults = self._desks.workshop.faults
        if faults is None:
            raise UserMistake(NO_EMULATED)
        changed = dataclasses.replace(faults, **changes)  # type: ignore[arg-type]
        if refusal := self._desks.hardware.break_board(changed):
            raise UserMistake(refusal)
