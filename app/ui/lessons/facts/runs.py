"""Runs of the whole robot in the control lab, and its motor's identification, as lessons read and set them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from app.classroom.lessons.lesson import Value
from app.control.drives import DRIVES
from app.control.identification import Identification
from app.robots import ROBOTS
from app.simulation import Run
from app.ui.desks import Desks
from app.ui.lab.run_book import RunBook
from app.ui.lab.settings import ControlSettings
from app.ui.lessons.facts.field import Field, Read, index_of

JUMP_S, LATE_S = 1.0, 5.0
"""The first second of a run, and what comes after the first five."""


@dataclass(frozen=True)
class RunNumbers:
    """What a run amounts to; squared errors in the joints' unit."""

    ise: tuple[float, ...]
    jump_share: float
    late_ise: float
    tool_rms_mm: float
    tool_peak_mm: float
    saturation: float


def numbers_of(run: Run) -> RunNumbers:
    """The figures of a run; some milliseconds."""
    squared = (run.joint_error**2).sum(axis=1)
    error_mm = 1e3 * run.tool_error_m
    first, late = run.t <= JUMP_S, run.t >= LATE_S
    whole = float(np.trapezoid(squared, run.t))
    jump = float(np.trapezoid(squared[first], run.t[first]))
    return RunNumbers(
        ise=tuple(run.ise.tolist()),
        jump_share=100.0 * jump / whole if whole else 0.0,
        late_ise=float(np.trapezoid(squared[late], run.t[late])),
        tool_rms_mm=float(np.sqrt(np.mean(error_mm**2))),
        tool_peak_mm=float(error_mm.max()),
        saturation=100.0 * run.saturation_share,
    )


NUMBERS: Mapping[str, Callable[[RunNumbers], Value]] = {
    "ise": lambda n: sum(n.ise),
    "jump_share": lambda n: n.jump_share,
    "late_ise": lambda n: n.late_ise,
    "tool_rms": lambda n: n.tool_rms_mm,
    "tool_peak": lambda n: n.tool_peak_mm,
    "saturation": lambda n: n.saturation,
}
ASKED: Mapping[str, Callable[[ControlSettings], Value]] = {
    "used_tuning": lambda s: s.tuning,
    "used_start": lambda s: s.run.start,
    "used_path": lambda s: s.run.tour.path,
    "used_supply": lambda s: s.hardware.supply_v,
    "used_as_in_paper": lambda s: s.run.as_in_paper,
}
SETTINGS: Mapping[str, tuple[Callable[[ControlSettings], Value], str, float]] = {
    "path": (lambda s: s.run.tour.path, "path", 1.0),
    "size": (lambda s: 1e3 * s.run.tour.size_m, "size_m", 1e-3),
    "lap": (lambda s: s.run.tour.lap_s, "lap_s", 1.0),
    "start": (lambda s: s.run.start, "start", 1.0),
    "clockwise": (lambda s: s.run.tour.clockwise, "clockwise", 1.0),
    "as_in_paper": (lambda s: s.run.as_in_paper, "as_in_paper", 1.0),
}
"""Reader, name on the desk, and the factor from what is read."""


class RunFacts:
    """`run.*` and `before.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks
        self._numbers: WeakKeyDictionary[Run, RunNumbers] = WeakKeyDictionary()

    def field(self) -> Field:
        read: dict[str, Read] = {"run.count": lambda: len(self._book.runs)}
        for name, (find, _, _) in SETTINGS.items():
            read[f"run.{name}"] = partial(lambda find: find(self._desks.control.settings), find)
        for prefix, which in (("run", self._shown), ("before", self._before)):
            for name, get in NUMBERS.items():
                read[f"{prefix}.{name}"] = partial(self._number, which, get)
            for name, ask in ASKED.items():
                read[f"{prefix}.{name}"] = partial(self._asked, which, ask)
        each = {"run.ise.": partial(self._joint, self._shown), "before.ise.": partial(self._joint, self._before)}
        write = {f"run.{name}": partial(self._set, name) for name in SETTINGS}
        return Field(read, {**write, "run.count": self._forget}, read_each=each)

    @property
    def _book(self) -> RunBook:
        return self._desks.runs

    def _shown(self) -> Run | None:
        return self._book.run

    def _before(self) -> Run | None:
        """The run that was made before the one that is shown."""
        runs, shown = self._book.runs, self._book.run
        k = next((k for k, run in enumerate(runs) if run is shown), 0)
        return runs[k - 1] if k else None

    def _figures(self, run: Run) -> RunNumbers:
        found = self._numbers.get(run)
        if found is None:
            found = self._numbers[run] = numbers_of(run)
        return found

    def _number(self, which: Callable[[], Run | None], get: Callable[[RunNumbers], Value]) -> Value | None:
        run = which()
        return None if run is None else get(self._figures(run))

    def _asked(self, which: Callable[[], Run | None], ask: Callable[[ControlSettings], Value]) -> Value | None:
        run = which()
        return None if run is None else ask(self._book.asked(run))

    def _joint(self, which: Callable[[], Run | None], name: str) -> Value | None:
        run = which()
        k = None if run is None else index_of(name, ROBOTS[run.robot].build.joint_names)
        return None if run is None or k is None else self._figures(run).ise[k]

    def _set(self, name: str, value: Any) -> None:
        _, field, factor = SETTINGS[name]
        changes: dict[str, object] = {field: value * factor if type(value) in (int, float) else value}
        if name == "start":
            changes["as_in_paper"] = False
        elif name == "as_in_paper" and value:
            changes["start"] = "rest"
        self._desks.control.set_run(**changes)

    def _forget(self, count: float) -> None:
        if count == 0:
            self._book.clear()


class MotorFacts:
    """`motor.*`, `identify.*` and `found.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks

    def field(self) -> Field:
        desks = self._desks
        read: dict[str, Read] = {
            "motor.K": lambda: desks.control.settings.motor.K,
            "motor.T1": lambda: desks.control.settings.motor.T1,
            "motor.T2": lambda: desks.control.settings.motor.T2,
            "motor.time_constant": lambda: 1.0 / desks.control.settings.motor.T1,
            "motor.identified": lambda: desks.control.settings.motor != DRIVES[desks.session.robot_name].motor,
            "identify.signal": lambda: desks.motor.settings.excitation,
            "identify.voltage": lambda: desks.motor.settings.amplitude_v,
            "identify.duration": lambda: desks.motor.settings.duration_s,
            "identify.noise": lambda: desks.motor.settings.noise,
            "found.fit": partial(self._found, lambda found: found.fit_percent),
            "found.swing": partial(self._found, lambda found: _swing(found.model_output - found.residuals)),
            "found.warnings": partial(self._found, lambda found: len(found.warnings)),
            "found.count": lambda: desks.motor.count,
        }
        for k, name in enumerate(("K", "T1", "T2")):
            read[f"found.{name}"] = partial(self._found, partial(lambda name, found: getattr(found.motor, name), name))
            read[f"found.error_{name}"] = partial(self._error, name)
            read[f"found.width_{name}"] = partial(self._found, partial(_width, k, name))
        write = {
            "identify.signal": lambda name: desks.motor.change(excitation=name),
            "identify.voltage": lambda volts: desks.motor.change(amplitude_v=volts),
            "identify.duration": lambda seconds: desks.motor.change(duration_s=seconds),
            "identify.noise": lambda noise: desks.motor.change(noise=noise),
            "found.count": lambda count: desks.motor.forget() if count == 0 else None,
        }
        return Field(read, write)

    def _found(self, get: Callable[[Identification], Value]) -> Value | None:
        desk = self._desks.motor
        if desk.result is None or desk.tested not in (None, desk.settings):
            return None
        return get(desk.result.found)

    def _error(self, name: str) -> Value | None:
        known = getattr(DRIVES[self._desks.session.robot_name].motor, name)
        found = self._found(lambda found: getattr(found.motor, name))
        return None if found is None or not known else 100.0 * abs(float(found) / known - 1.0)


def _swing(measured: np.ndarray) -> float:
    return float(np.abs(measured).max())


def _width(k: int, name: str, found: Identification) -> float:
    low, high = found.confidence[k].tolist()
    return 100.0 * (high - low) / getattr(found.motor, name)
