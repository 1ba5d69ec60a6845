"""What state the robot is in, and which port leads to it."""

from __future__ import annotations

import html

import viser

from app.link.ports import Port
from app.link.protocol.codes import State
from app.link.status import LinkStatus
from app.robots import ROBOTS
from app.ui import theme
from app.ui.compute import Worker
from app.ui.hardware import jobs
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.words import condition
from app.ui.panels.button_grid import ButtonGrid, Cell
from app.ui.panels.options import show_options
from app.ui.panels.text import small
from app.ui.viser_adapter import show_value

LOOKING: str = "Looking for ports …"
CONNECTED = ("connecting", "ready", "lost")


class ConnectionPanel:
    """The line of state, and the choice of the port while there is no connection."""

    def __init__(self, client: viser.ClientHandle, desk: HardwareDesk, worker: Worker) -> None:
        self._desk = desk
        self._worker = worker
        self._ports: dict[str, str] = {}
        gui = client.gui
        self._state = gui.add_html("")
        self._board = gui.add_html("")
        self._port = gui.add_dropdown("Port", (LOOKING,), hint="A board on USB, or one that is emulated here")
        self._grid = ButtonGrid(client, "Connection", self._press, desk.tell)
        self._other = ButtonGrid(client, "Board's robot", lambda _: self._show_robot(), desk.tell, columns=1)
        self._other.visible = False
        desk.status_changed.connect(self._follow)
        desk.me_changed.connect(lambda _: self._follow(desk.status))
        desk.session.robot_changed.connect(lambda _: self._follow(desk.status))
        self._follow(desk.status)
        self.refresh()

    def refresh(self) -> None:
        """Look for ports anew."""
        self._worker.request(self._receive, jobs.ports)

    def _receive(self, ports: list[Port]) -> None:
        self._ports = {port_title(port): port.device for port in ports}
        titles = tuple(self._ports)
        kept = next((t for t, device in self._ports.items() if device == self._desk.status.port), None)
        chosen = self._port.value if self._port.value in self._ports else self._suited(ports)
        show_options(self._port, titles, kept or chosen)
        self._follow(self._desk.status)

    def _suited(self, ports: list[Port]) -> str:
        """A real board where there is one, else an emulated one of the robot on the page."""
        mine = next((p for p in ports if p.simulated and p.device.endswith(self._desk.session.robot_name)), ports[0])
        return port_title(next((p for p in ports if p.vid is not None), mine))

    def _press(self, key: str) -> None:
        if key == "connect":
            self._desk.connect(self._ports[self._port.value])
        elif key == "disconnect":
            self._desk.disconnect()
        else:
            self.refresh()

    def _show_robot(self) -> None:
        self._desk.show_it()

    def _follow(self, status: LinkStatus) -> None:
        line, board = state_line(status), board_line(status)
        if line != self._state.content:
            self._state.content = line
        if board != self._board.content:
            self._board.content = board
        connected = status.phase in CONNECTED
        if self._port.visible == connected:
            self._port.visible = not connected
        self._grid.show(self._cells(connected))
        other = status.robot is not None and not self._desk.shows_it
        self._other.visible = other
        if other and status.robot is not None:
            self._other.show([Cell("show", f"Show this {status.robot.title}", "The picture shows another robot")])
        self._forget_old_choice(status)

    def _cells(self, connected: bool) -> list[Cell]:
        refusal = self._desk.workshop.why_no_port(self._desk.me)
        if connected:
            return [Cell("disconnect", "Disconnect", "Free the port", refusal)]
        missing = refusal or ("" if self._ports.get(self._port.value) else LOOKING)
        return [
            Cell("connect", "Connect", "Open the port and ask the board what it is", missing, "main"),
            Cell("refresh", "Refresh", "Look for ports again"),
        ]

    def _forget_old_choice(self, status: LinkStatus) -> None:
        title = next((t for t, device in self._ports.items() if device == status.port), None)
        if title is not None and status.phase in CONNECTED:
            show_value(self._port, title)


def port_title(port: Port) -> str:
    """For the list: what it is, and what tells two of a kind apart."""
    if port.simulated:
        return f"{port.device} – {port.description.removeprefix('Emulated board: ')}, emulated"
    parts = [port.device]
    if port.description not in ("", "n/a", port.device):
        parts.append(port.description)
    if port.vid is not None and port.pid is not None:
        parts.append(f"{port.vid:04X}:{port.pid:04X}")
    if port.serial_number:
        parts.append(f"no. {port.serial_number}")
    return " – ".join(parts)


def state_line(status: LinkStatus) -> str:
    """HTML: colour, mark, word and sentence; below them, for some seconds, what has just happened."""
    now = condition(status)
    room = "min-height:4.2em" if status.phase == "ready" else ""  # what is below must not jump under a finger
    news = news_of(status)
    fresh = f"<div><i>{html.escape(news)}</i></div>" if news and news != now.sentence else ""
    return (
        '<div role="status" data-robot="state" style="padding:4px 12px 2px;font-size:0.9em;line-height:1.4">'
        f'<span style="color:{theme.css(now.color)};font-size:1.1em">{now.mark}</span> <b>{html.escape(now.word)}</b>'
        f'<div style="font-size:0.9em;opacity:0.9;{room}">{html.escape(now.sentence)}{fresh}</div></div>'
    )


def news_of(status: LinkStatus) -> str:
    """The newest line of the log while it is new; a latched state has its own sentence."""
    latched = status.telemetry is None or status.telemetry.state in (State.HELD, State.STOPPED, State.FAULT)
    is_new = status.phase == "ready" and status.log[-1:] and status.log[-1].sentence == status.sentence
    return status.sentence if is_new and not latched else ""


def board_line(status: LinkStatus) -> str:
    """HTML of what is connected; empty without a board."""
    identity = status.identity
    if identity is None or status.phase not in CONNECTED:
        return ""
    boards = {1: "Arduino Uno", 2: "STM32F407", 3: "emulated board"}
    drives = {1: "RC servos", 2: "DC motors", 3: "steppers"}
    title = status.robot.title if status.robot else next(iter(ROBOTS.values())).title
    parts = [f"<b>{html.escape(title)}</b>", boards[identity.board], drives[identity.drive]]
    parts += [f"firmware {identity.version}", f"no. {identity.serial}", html.escape(status.port)]
    return small(" · ".join(parts))
