"""Stop, on every page while there is a robot: one press, or Escape, from anybody."""

from __future__ import annotations

import asyncio
import logging
from concurrent.futures import CancelledError, Future
from typing import TYPE_CHECKING

import viser

from app.errors import UserMistake
from app.ui import theme
from app.ui.hardware import stop_script
from app.ui.hardware.verbs import VERBS, holds
from app.ui.hardware.words import condition
from app.ui.hardware.workshop import Workshop
from app.ui.viser_adapter import element_id, run_javascript

if TYPE_CHECKING:
    from app.link.lease import Person
    from app.link.status import LinkStatus

THERE = ("connecting", "ready", "lost")
"""Phases in which a robot may be moving."""

_log = logging.getLogger(__name__)


class StopBar:
    """Nothing is sent to a page while its bar stays as it is."""

    def __init__(self, client: viser.ClientHandle, workshop: Workshop, browser: str) -> None:
        self._client = client
        self._workshop = workshop
        self._browser = browser
        self._seen: object = None
        self._shown = stop_script.hide()
        wire = client.gui.add_text("Stop pressed", "", visible=False)
        run_javascript(client, stop_script.start(element_id(wire)))
        self._leave = workshop.watch.attend(self._look)

        @wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            what = event.target.value.partition(" ")[0]
            if what == "stop":
                self._stop()
            elif what == "clear":
                self._clear()

    def close(self) -> None:
        self._leave()

    def _stop(self) -> None:
        """Straight to the link, which writes it before anything else."""
        if self._workshop.status.phase in THERE:
            self._ask(self._workshop.link.stop(self._me))
        else:
            self._send(stop_script.answered())

    def _clear(self) -> None:
        if refusal := VERBS["clear"].why_not(self._workshop.status, self._me):
            self._send(stop_script.answered(refusal))
        else:
            self._ask(self._workshop.link.clear(self._me))

    def _ask(self, answer: Future[None]) -> None:
        loop = asyncio.get_running_loop()
        answer.add_done_callback(lambda done: loop.call_soon_threadsafe(self._hear, done))

    def _hear(self, answer: Future[None]) -> None:
        self._send(stop_script.answered(_problem(answer)))

    @property
    def _me(self) -> Person:
        return self._workshop.people.person(self._browser)

    def _look(self, status: LinkStatus) -> None:
        there = status.phase in THERE
        me = self._me if there else None
        seen = (self._workshop.watch.edition, me, _percent(status))
        if seen == self._seen:
            return
        self._seen = seen
        script = bar_script(status, me) if me is not None else stop_script.hide()
        if script != self._shown:
            self._shown = script
            self._send(script)

    def _send(self, script: str) -> None:
        run_javascript(self._client, script)
        self._client.flush()


def bar_script(status: LinkStatus, me: Person) -> str:
    """What the bar says to somebody."""
    now = condition(status)
    running = status.activity in ("run", "paused")
    return stop_script.show(
        mark=now.mark,
        color=theme.css(now.color),
        word=f"{now.word} · {_percent(status)} %" if running else now.word,
        line=_who(status, me),
        clear=not VERBS["clear"].why_not(status, me),
    )


def _who(status: LinkStatus, me: Person) -> str:
    if status.holder is None:
        return "Nobody has control"
    return "You have control" if holds(status, me) else f"{status.holder.name} has control"


def _percent(status: LinkStatus) -> int:
    return round(100.0 * status.progress)


def _problem(answer: Future[None]) -> str:
    """A sentence; empty if all went well."""
    try:
        answer.result()
    except UserMistake as refusal:
        return str(refusal)
    except CancelledError:
        return stop_script.NO_ANSWER
    except Exception:  # whatever goes wrong in the link's thread: whoever pressed Stop must know
        _log.exception("the link failed")
        return stop_script.NO_ANSWER
    return ""
