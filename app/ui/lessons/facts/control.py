"""The control lab as lessons read and set it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import NamedTuple

import numpy as np

from app.classroom.lessons.lesson import Value
from app.control.margins import Margins
from app.errors import UserMistake
from app.simulation.step_study import Frequency, Response, Study
from app.ui.desks import Desks
from app.ui.lab.desk import ControlDesk
from app.ui.lab.jobs import Answer
from app.ui.lab.settings import ControlSettings
from app.ui.lessons.facts.field import Field

LAST = 0.2
"""Share of a step response at its end, in which ripple is looked for."""


class _Knob(NamedTuple):
    """One setting."""

    read: Callable[[ControlSettings], Value]
    name: str
    """As the desk changes it."""
    si: Callable[[float], object] = lambda value: value
    """What is read -> what the desk takes."""


SETTINGS: Mapping[str, _Knob] = {
    "kp": _Knob(lambda s: s.pid.kp, "kp"),
    "ki": _Knob(lambda s: s.pid.ki, "ki"),
    "kd": _Knob(lambda s: s.pid.kd, "kd"),
    "n": _Knob(lambda s: s.pid.n, "n"),
    "setpoint_weight": _Knob(lambda s: s.pid.b, "b"),
    "derivative_on_measurement": _Knob(lambda s: s.pid.c == 0.0, "c", lambda on: 0.0 if on else 1.0),
    "tuning": _Knob(lambda s: s.tuning, "tuning"),
    "response_time": _Knob(lambda s: s.response_time_s, "response_time_s"),
    "transient": _Knob(lambda s: s.transient, "transient"),
    "period": _Knob(lambda s: 1e3 * s.sampling.period_s, "period_s", lambda ms: 1e-3 * ms),
    "method": _Knob(lambda s: s.sampling.method, "method"),
    "anti_windup": _Knob(lambda s: s.sampling.anti_windup, "anti_windup"),
    "supply": _Knob(lambda s: s.hardware.supply_v, "supply_v"),
    "pwm_steps": _Knob(lambda s: s.hardware.pwm_steps, "pwm_steps", round),
    "adc_bits": _Knob(lambda s: s.hardware.adc_bits, "adc_bits", round),
    "noise": _Knob(lambda s: s.hardware.noise, "noise"),
    "delay": _Knob(lambda s: 1e3 * s.hardware.delay_s, "delay_s", lambda ms: 1e-3 * ms),
    "dry_friction": _Knob(lambda s: s.hardware.coulomb_v, "coulomb_v"),
    "viscous": _Knob(lambda s: s.hardware.viscous, "viscous"),
    "inertia": _Knob(lambda s: s.hardware.inertia_factor, "inertia_factor"),
    "backlash": _Knob(lambda s: s.hardware.backlash, "backlash"),
    "setpoint": _Knob(lambda s: s.setpoint, "setpoint"),
    "duration": _Knob(lambda s: s.duration_s, "duration_s"),
}
POSITIVE = frozenset({"period", "supply", "setpoint", "duration", "response_time", "inertia", "n"})
"""Must be above 0; the others at least 0."""

STEP: Mapping[str, Callable[[Response, ControlSettings], float]] = {
    "overshoot": lambda r, s: r.metrics.overshoot_pct,
    "rise": lambda r, s: r.metrics.rise_s,
    "settling": lambda r, s: r.metrics.settling_s,
    "peak": lambda r, s: r.metrics.peak,
    "peak_time": lambda r, s: r.metrics.peak_s,
    "steady_error": lambda r, s: 100.0 * r.metrics.steady_state_error / s.setpoint,
    "ise": lambda r, s: r.metrics.ise,
    "iae": lambda r, s: r.metrics.iae,
    "peak_control": lambda r, s: float(np.abs(r.u).max()),
    "ripple": lambda r, s: float(np.std(r.u[-max(2, round(LAST * len(r.u))) :])),
    "energy": lambda r, s: r.metrics.control_energy,
    "saturation": lambda r, s: r.metrics.saturation_pct,
}
MARGINS: Mapping[str, Callable[[Margins], Value]] = {
    "phase": lambda m: m.phase_margin_deg,
    "gain": lambda m: 20.0 * math.log10(m.gain_margin) if m.gain_margin > 0.0 else math.nan,
    "crossover": lambda m: m.crossover_rad_s,
    "dead_time": lambda m: 1e3 * m.delay_margin_s,
    "Ms": lambda m: m.Ms,
    "bandwidth": lambda m: m.bandwidth_rad_s,
    "stable": lambda m: m.stable,
}


class ControlFacts:
    """One drive, its controller, the step response, and the baseline that was kept."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks

    def field(self) -> Field:
        answer = self._answer
        read: dict[str, Callable[[], Value | None]] = {
            "control.refused": lambda: None if (found := answer()) is None else found.refused,
            "kept.on": lambda: self._desk.baseline is not None,
        }
        for name, knob in SETTINGS.items():
            read[f"control.{name}"] = partial(self._setting, knob)
            read[f"kept.{name}"] = partial(self._kept_setting, knob)
        for name in STEP:
            read[f"step.{name}"] = partial(self._of_step, name, lambda study: study.board)
            read[f"ideal.{name}"] = partial(self._of_step, name, lambda study: study.ideal)
            read[f"kept.{name}"] = partial(self._kept_step, name)
        for name, find in MARGINS.items():
            read[f"margin.{name}"] = partial(self._of_margins, find)
            read[f"kept.{name}"] = partial(self._kept_margins, find)
        write = {f"control.{name}": partial(self._set, name, knob) for name, knob in SETTINGS.items()}
        return Field(read, {**write, "kept.on": lambda on: self._desk.keep_baseline(on)})

    @property
    def _desk(self) -> ControlDesk:
        return self._desks.control

    def _setting(self, knob: _Knob) -> Value:
        return knob.read(self._desk.settings)

    def _set(self, name: str, knob: _Knob, value: float | bool | str) -> None:
        if isinstance(value, float | int) and not isinstance(value, bool):
            least = 1e-6 if name in POSITIVE else 0.0
            if not value >= least:
                raise UserMistake(f"control.{name} cannot be {value:g}: choose a larger number.")
        self._desk.change(**{knob.name: knob.si(value)})  # type: ignore[arg-type]

    def _answer(self) -> Answer | None:
        """What came of the present settings; None while it is not there."""
        desk = self._desk
        if not desk.active:
            desk.open()
        found = desk.answer
        return found if found is not None and _same_experiment(found.settings, desk.settings) else None

    def _kept(self) -> tuple[ControlSettings, Study] | None:
        return self._desk.baseline

    def _kept_setting(self, knob: _Knob) -> Value | None:
        kept = self._kept()
        return None if kept is None else knob.read(kept[0])

    def _of_step(self, name: str, part: Callable[[Study], Response]) -> Value | None:
        found = self._answer()
        return None if found is None else STEP[name](part(found.study), found.settings)

    def _kept_step(self, name: str) -> Value | None:
        kept = self._kept()
        return None if kept is None else STEP[name](kept[1].board, kept[0])

    def _of_margins(self, find: Callable[[Margins], Value]) -> Value | None:
        found = self._answer()
        return None if found is None else find(_margins(found.study.board_frequency))

    def _kept_margins(self, find: Callable[[Margins], Value]) -> Value | None:
        kept = self._kept()
        return None if kept is None else find(_margins(kept[1].board_frequency))


def _margins(frequency: Frequency) -> Margins:
    return frequency.margins


def _same_experiment(one: ControlSettings, other: ControlSettings) -> bool:
    """Whether two settings differ at most in how the whole robot is to run."""
    if one is other:
        return True
    tuned = (one.tuning, one.response_time_s, one.transient) == (other.tuning, other.response_time_s, other.transient)
    return tuned and one.robot == other.robot and one.question == other.question
