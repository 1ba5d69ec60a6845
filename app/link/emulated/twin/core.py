"""The twin as a core: bytes in, bytes out."""

from __future__ import annotations

import struct

from app.link.board_geometry import geometry_hash
from app.link.emulated.core import Outputs
from app.link.emulated.twin import orders
from app.link.emulated.twin.machine import Machine
from app.link.emulated.twin.reports import Reports
from app.link.emulated.twin.settings import Store
from app.link.protocol.codes import (
    PROTOCOL_VERSION,
    BoardKind,
    DriveKind,
    MessageType,
    Refusal,
    Reset,
    RobotKind,
)
from app.link.protocol.frames import FrameDecoder, encode_frame
from app.link.protocol.messages import PAYLOAD_FIELDS, PAYLOAD_LENGTHS, Identity
from app.link.protocol.settings import GEOMETRY_ID, setting_id

FIRMWARE = 0x0100
"""Version 1.0, as the C core's."""

_HEARD = frozenset(kind for kind in MessageType if kind < MessageType.TELEMETRY)
"""What comes from the host. It is read field by field: a board must refuse what `unpack` would not read."""


class TwinCore:
    """See `app.link.emulated.core.Core`."""

    def start(
        self,
        robot: RobotKind,
        drive: DriveKind,
        board: BoardKind,
        period_us: int,
        serial: int,
        reset: Reset,
        stored: bytes | None,
    ) -> None:
        """As after a reset."""
        self._store = Store(robot, drive, stored)
        if serial:
            self._store.values[setting_id("serial")] = float(serial)
        self._machine = Machine(robot, drive, period_us, reset, self._store)
        self._build = (board, robot, drive, reset)
        self._decoder = FrameDecoder()
        self._reports = Reports()
        self._setpoint_number = self._good = self._bad = 0

    def receive(self, data: bytes) -> None:
        """Bytes from the host."""
        before = self._decoder.bad
        for payload in self._decoder.feed(data):
            known = payload[0] in _HEARD and len(payload) == PAYLOAD_LENGTHS[MessageType(payload[0])]
            if known:
                self._machine.frame_us = self._machine.now_us
                self._handle(MessageType(payload[0]), payload)
            self._good, self._bad = self._good + known, self._bad + (not known)
        self._bad += self._decoder.bad - before

    def tick(self, now_us: int, raw: tuple[float, ...], limit_switches: int, estop_open: bool) -> Outputs:
        """One control period."""
        outputs = self._machine.tick(now_us, raw, limit_switches, estop_open)
        self._reports.tick(self._machine)
        return outputs

    def transmit(self) -> bytes:
        """All frames that wait."""
        if not self._reports.waiting:
            return b""
        counters = (self._setpoint_number, self._good & 0xFFFF, self._bad & 0xFFFF)
        payloads = self._reports.take(self._machine, self._identity(), *counters)
        return b"".join(map(encode_frame, payloads))

    def image(self) -> bytes:
        """The settings for permanent memory."""
        return self._store.image()

    def take_save_request(self) -> bool:
        requested, self._store.save_requested = self._store.save_requested, False
        return requested

    def _handle(self, kind: MessageType, payload: bytes) -> None:
        m, reports = self._machine, self._reports
        number, *fields = struct.unpack_from("<H" + PAYLOAD_FIELDS[kind], payload, 1)
        if kind == MessageType.SETPOINT:
            m.refusal = orders.setpoint(m, *fields)
            self._setpoint_number = number if m.refusal == Refusal.OK else self._setpoint_number
        elif kind == MessageType.COMMAND:
            self._order(number, orders.command(m, fields[0]))
        elif kind == MessageType.TEST:
            testing = m.test
            self._order(number, orders.test(m, number, *fields))
            reports.sample_due |= m.test is not testing
        elif kind == MessageType.SET:
            refusal = orders.change(m, *fields)
            reports.answer(number, refusal, orders.read(m, fields[0])[1])
        elif kind == MessageType.GET:
            reports.answer(number, *orders.read(m, fields[0]))
        elif kind == MessageType.HELLO:
            reports.identity_number = number

    def _order(self, number: int, refusal: Refusal) -> None:
        """An order that is done ends what telemetry says about the last set-point."""
        if refusal == Refusal.OK:
            self._machine.refusal = refusal
        self._reports.answer(number, refusal, 0.0)

    def _identity(self) -> Identity:
        board, robot, drive, reset = self._build
        values, m = self._store.values, self._machine
        serial, geometry = int(values[setting_id("serial")]), geometry_hash(values[GEOMETRY_ID:])
        numbers = m.joints, FIRMWARE, m.period_us, geometry, serial
        return Identity(PROTOCOL_VERSION, board, robot, drive, *numbers, reset, self._store.source)
