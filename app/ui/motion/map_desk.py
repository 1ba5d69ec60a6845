"""The maps of one browser: which map, of which slice, and the newest picture of it. No widgets here."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeGuard

import numpy as np

from app.robots import Robot
from app.robots.maps import MapSettings
from app.signal import Signal
from app.ui.compute import Worker
from app.ui.motion.map_picture import MapPicture, map_picture
from app.ui.refusal import Refusal
from app.ui.session import Session

PAPER_ACCELERATION, PAPER_SPEED = 11.3, 1.16
"""Largest of the five-bar's work cycle, m/s^2 and m/s: its maps begin with them."""


class MapDesk:
    """The state behind map, panels and plot. While maps are off nothing is computed."""

    def __init__(self, session: Session, worker: Worker) -> None:
        self.changed: Signal[MapSettings] = Signal()
        """Other settings, or on or off."""
        self.answered: Signal[None] = Signal()
        """Another picture, or a reason why there is none."""
        self._session = session
        self._worker = worker
        self.on = False
        kept = session.maps
        self.settings = kept if _fits(kept, session) else first_settings(session.robot, session.dimensions)
        self.picture: MapPicture | None = None
        self.refusal = ""
        session.robot_changed.connect(self._follow_robot)

    @property
    def robot(self) -> Robot:
        return self._session.robot

    @property
    def tool(self) -> tuple[float, float]:
        """x and y of the tool, m."""
        return self._session.stance.position[:2]

    @property
    def value_at_tool(self) -> float:
        """Of the slice, above or below the tool; NaN out of reach or without a map."""
        return float("nan") if self.picture is None else self.picture.map.at(*self.tool)

    def show(self, on: bool) -> None:
        """Switch maps on or off."""
        self.on = on
        self._ask()
        self.changed.emit(self.settings)

    def change(self, **values: Any) -> None:
        """Set some values; the picture follows."""
        self.settings = self._session.maps = replace(self.settings, **values)
        self._ask()
        self.changed.emit(self.settings)

    def tell_again(self) -> None:
        """For listeners that came later."""
        if self.on:
            self.changed.emit(self.settings)
            self.answered.emit(None)

    def _follow_robot(self, robot: Robot) -> None:
        """Another robot begins with its own slice; one of other dimensions keeps it."""
        if robot.name == self.settings.robot:
            self.change(dimensions=dict(self._session.dimensions))
            return
        fresh = first_settings(robot, self._session.dimensions)
        self._receive(None)
        self.change(**(vars(fresh) | {"quantity": self.settings.quantity}))

    def _ask(self) -> None:
        if self.on:
            self._worker.request(self._receive, map_picture, self.settings)
        else:
            self._worker.cancel()
            self._receive(None)

    def _receive(self, answer: MapPicture | Refusal | None) -> None:
        self.picture = answer if isinstance(answer, MapPicture) else None
        self.refusal = answer.reason if isinstance(answer, Refusal) else ""
        self.answered.emit(None)


def _fits(kept: MapSettings | None, session: Session) -> TypeGuard[MapSettings]:
    return kept is not None and (kept.robot, kept.dimensions) == (session.robot_name, session.dimensions)


def first_settings(robot: Robot, dimensions: dict[str, float]) -> MapSettings:
    """A slice through home."""
    usual = MapSettings(robot.name, dict(dimensions), height_m=float(np.round(robot.home[2], 3)))
    if robot.name != "fivebar":
        return usual
    return replace(usual, acceleration=PAPER_ACCELERATION, vector=(PAPER_ACCELERATION, 0.0, 0.0), speed=PAPER_SPEED)
