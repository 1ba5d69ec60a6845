"""Every way to find gains, under one name each, as a student chooses among them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import NamedTuple

from app.control.motor import PAR4_MOTOR, Motor
from app.control.pid import PID_APPROX, PID_AUTO, Pid
from app.control.tuning.loop_shaping import tune as shape_loop
from app.control.tuning.relay import RelayTest, relay_test
from app.control.tuning.rules import DEFAULT_N, RULES, Rule


class Wish(NamedTuple):
    """What some methods ask for: the two sliders of the tuner, and the sampling period."""

    response_time_s: float
    """2 / crossover."""
    transient: float
    """0 quick, 1 calm: the phase margin, as a share of 90 degrees."""
    period_s: float = 0.01
    """Of the controller, which a relay test runs at."""


class Tuned(NamedTuple):
    """Gains, and what there is to say about them."""

    pid: Pid
    note: str = ""
    """One sentence for the student, or empty."""


@dataclass(frozen=True)
class TuningMethod:
    """One entry of the list."""

    explanation: str
    """One sentence."""
    latex: str
    """Its formulas, or empty."""
    tune: Callable[[Motor, Wish], Tuned]
    """Raises `TuningError` where the method does not apply."""
    only_for: Motor | None = None
    """The motor for which a paper printed these gains."""
    needs_final_value: bool = False
    """Whether the motor must come to rest under a constant voltage."""


TUNER = "Tuner: two sliders"
TABLE_2 = "Paper, Table 2 (MATLAB)"
TABLE_3 = "Paper, Table 3 (reaction curve)"


def methods_for(motor: Motor) -> dict[str, TuningMethod]:
    """What can be chosen for a motor: printed gains for their own motor only, and no reaction curve without an end."""
    return {
        name: method
        for name, method in METHODS.items()
        if method.only_for in (None, motor) and (motor.T2 > 0.0 or not method.needs_final_value)
    }


def _by_rule(name: str, rule: Rule) -> TuningMethod:
    on_curve = not name.startswith("simc")
    return TuningMethod(
        rule.explanation, rule.latex, lambda motor, _: Tuned(rule.tune(motor)), needs_final_value=on_curve
    )


def _shaped(motor: Motor, wish: Wish) -> Tuned:
    design = shape_loop(motor, wish.response_time_s, wish.transient)
    return Tuned(design.pid, design.note)


def _by_relay(gains: Callable[[RelayTest], Pid]) -> Callable[[Motor, Wish], Tuned]:
    def tune(motor: Motor, wish: Wish) -> Tuned:
        test = relay_test(motor, period_s=wish.period_s)
        return Tuned(gains(test), f"The relay made it swing with Ku = {test.Ku:.3g}, Tu = {test.Tu:.3g} s.")

    return tune


METHODS: dict[str, TuningMethod] = {
    TABLE_2: TuningMethod(
        "The gains that the paper printed: MATLAB's tuner, asked for a phase margin of 73°.",
        r"k_p = 4.36210,\quad k_i = 0.38231,\quad k_d = 0.99919,\quad N = 37.2929",
        lambda *_: Tuned(PID_AUTO),
        only_for=PAR4_MOTOR,
    ),
    TABLE_3: TuningMethod(
        "The gains that the paper printed beside them: from the reaction curve, much livelier.",
        r"k_p = 2.2880,\quad T_i = 0.3178\,\mathrm{s},\quad T_d = 0.1222\,\mathrm{s}",
        lambda *_: Tuned(replace(PID_APPROX, n=DEFAULT_N)),
        only_for=PAR4_MOTOR,
    ),
    TUNER: TuningMethod(
        "Say how fast and how calm; the loop is shaped to cross there with that margin, as MATLAB's tuner does.",
        r"|L(j\omega_c)| = 1,\quad \omega_c = \frac{2}{t_r},\quad \varphi_m = 90^\circ \cdot \text{calm}",
        _shaped,
    ),
    **{rule.title: _by_rule(name, rule) for name, rule in RULES.items()},
    "Relay test, Ziegler-Nichols": TuningMethod(
        "A relay makes the loop swing by itself; gain and period of that swing give the gains.",
        r"k_p = 0.6\,K_u,\quad T_i = \frac{T_u}{2},\quad T_d = \frac{T_u}{8}",
        _by_relay(RelayTest.ziegler_nichols),
    ),
    "Relay test, Tyreus-Luyben": TuningMethod(
        "The same swing, read more carefully: calmer, with a slow integral.",
        r"k_p = \frac{K_u}{2.2},\quad T_i = 2.2\,T_u,\quad T_d = \frac{T_u}{6.3}",
        _by_relay(RelayTest.tyreus_luyben),
    ),
}
"""By the name that a student reads."""
