"""How well the link and the board are: latency, frames, processor, switches; and what has happened."""

from __future__ import annotations

import html
import math
import time

import viser

from app.link.protocol.codes import Flag
from app.link.protocol.messages import Telemetry
from app.link.status import LinkStatus
from app.robots import Robot
from app.ui import theme
from app.ui.hardware.desk import HardwareDesk
from app.ui.pacing import Paced
from app.ui.panels.tables import table
from app.ui.panels.text import small

REFRESH_S = 2.0
LINES = 14


class HealthPanel:
    """A table, and the log."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk) -> None:
        self._desk = desk
        self.visible = True
        gui = client.gui
        with gui.add_folder("Link and board"):
            self._table = gui.add_html(small("No board yet."))
        with gui.add_folder("What has happened"):
            self._log = gui.add_html("")
        self._pace = Paced(self._refresh, REFRESH_S)
        desk.beat.connect(lambda _: self._pace.request() if self.visible else None)
        desk.status_changed.connect(self._list)
        self._list(desk.status)

    def close(self) -> None:
        self._pace.cancel()

    def _refresh(self) -> None:
        content = health_table(self._desk.status)
        if content != self._table.content:
            self._table.content = content

    def _list(self, status: LinkStatus) -> None:
        content = log_lines(status)
        if content != self._log.content:
            self._log.content = content


def health_table(status: LinkStatus) -> str:
    """HTML of what a board reports of itself."""
    telemetry, robot = status.telemetry, status.robot
    if telemetry is None or robot is None:
        return small("No board yet.")
    alarm = f'<b style="color:{theme.css(theme.WARNING)}">▲ pressed</b>'
    rows = [
        ("Round trip, median / 95 %", f"{_ms(status.round_trip_ms)} / {_ms(status.round_trip_p95_ms)}"),
        ("Frames good / bad", f"{telemetry.good} / {telemetry.bad}"),
        ("Processor", f"{telemetry.load} %"),
        ("Limit switches", _switches(telemetry, robot)),
        ("Emergency stop", alarm if telemetry.flags & Flag.ESTOP_OPEN else "released"),
        ("Pen / laser", _tools(telemetry)),
    ]
    return table(("", ""), rows)


def log_lines(status: LinkStatus) -> str:
    """HTML: the newest first, by the server's clock."""
    if not status.log:
        return small("Nothing yet.")
    epoch = time.time() - time.monotonic()
    lines = [
        f'<div><span style="opacity:.65;font-variant-numeric:tabular-nums">{_clock(epoch + line.time_s)}</span> '
        f"{html.escape(line.sentence)}</div>"
        for line in reversed(status.log[-LINES:])
    ]
    return f'<div role="log" style="padding:2px 12px 8px;font-size:0.8em;line-height:1.45">{"".join(lines)}</div>'


def _clock(time_s: float) -> str:
    return time.strftime("%H:%M:%S", time.localtime(time_s))


def _ms(value: float) -> str:
    return "–" if math.isnan(value) else f"{value:.1f} ms"


def _switches(telemetry: Telemetry, robot: Robot) -> str:
    closed = [name for k, name in enumerate(robot.joint_names) if telemetry.limit_switches >> k & 1]
    return f"closed: {', '.join(closed)}" if closed else "open"


def _tools(telemetry: Telemetry) -> str:
    pen = "down" if telemetry.flags & Flag.PEN_DOWN else "up"
    return f"{pen} / {'on' if telemetry.flags & Flag.LASER_ON else 'off'}"
