"""What a lesson can press: every action of the catalogue, begun on the desks as its button begins it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import NamedTuple

from app.errors import UserMistake
from app.ui.desks import Desks
from app.ui.drawing import jobs
from app.ui.refusal import Refusal

HURRY = 1000.0
"""How many times as fast as the robot something is played that nobody watches."""


class Press(NamedTuple):
    """One action."""

    begin: Callable[[], None]
    done: Callable[[], bool] = lambda: True
    """Whether what it began has ended."""


def desk_presses(desks: Desks) -> Mapping[str, Press]:
    """Of the robot on the page, and of the tabs Control, Motion and Draw."""
    rested = lambda: not desks.staff.busy  # noqa: E731
    session = desks.session
    return {
        "home": Press(session.go_home),
        "release": Press(session.release),
        "reset_geometry": Press(session.reset_geometry),
        "keep": Press(lambda: _keep(desks)),
        "forget": Press(lambda: desks.control.keep_baseline(False)),
        "reset_control": Press(lambda: desks.control.reset(), rested),
        "run": Press(lambda: desks.runs.request(desks.control.settings), rested),
        "forget_runs": Press(lambda: desks.runs.clear()),
        "identify": Press(lambda: desks.motor.record(), rested),
        "use_motor": Press(lambda: _use_motor(desks), rested),
        "plan": Press(lambda: desks.motion.look(), rested),
        "play": Press(lambda: _play(desks), lambda: not desks.motion.playback.playing),
        "reset_motion": Press(lambda: desks.motion.reset(), rested),
        "compare": Press(lambda: desks.compare.run(), rested),
        "draw": Press(lambda: _draw(desks), lambda: desks.player.state == "done"),
        "improve": Press(lambda: desks.drawing.improve_now(), rested),
        "coarser": Press(lambda: desks.drawing.draw_coarser(), rested),
        "save": Press(lambda: _save(desks), rested),
    }


def _keep(desks: Desks) -> None:
    if desks.control.answer is None:
        raise UserMistake("There is no step response to keep yet: wait a moment.")
    desks.control.keep_baseline()


def _use_motor(desks: Desks) -> None:
    if desks.motor.result is None:
        raise UserMistake("No motor was identified yet: record it first.")
    desks.motor.use()


def _play(desks: Desks) -> None:
    playback = desks.motion.playback
    if playback.run is None:
        raise UserMistake("There is no motion to play: plan one first.")
    playback.speed = HURRY
    playback.play()


def _draw(desks: Desks) -> None:
    if desks.player.track is None:
        raise UserMistake("The robot has no way to draw this: look at what stands above the button Draw.")
    desks.player.speed = HURRY
    desks.player.play()


def _save(desks: Desks) -> None:
    sketch = desks.drawing.sketch
    if sketch is None:
        raise UserMistake("There is no drawing to save yet: wait a moment.")

    def deliver(result: bytes | Refusal) -> None:
        if isinstance(result, bytes):
            desks.drawing.note_saved()
        else:
            desks.staff.tell(result.reason)

    desks.staff.slow().request(deliver, jobs.export, sketch, ".svg", {})
