"""PID gains by rule: a few numbers that describe the motor go in, the three gains come out.

The reaction-curve rules are for k e^(-T0 s) / (T s + 1), in the ideal form kp (1 + 1 / (Ti s) + Td s). SIMC takes
the motor's own poles instead, so it serves motors without droop (T2 = 0) as well. Constants as in Astrom and
Hagglund, "PID Controllers", 2nd ed. 1995 (ZN, CHR, CC); Rivera, Morari and Skogestad 1986 (IMC);
Skogestad 2003 (SIMC).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from app.control.motor import Motor
from app.control.pid import Pid
from app.control.tuning.reaction_curve import ReactionCurve, exact, real_poles

DEFAULT_N = 100.0
"""Derivative filter of every rule, rad/s: the published rules know none, a real controller needs one."""


@dataclass(frozen=True)
class Rule:
    """One entry of the list that a student chooses from."""

    title: str
    explanation: str
    """One sentence."""
    latex: str
    """Its formulas."""
    tune: Callable[[Motor], Pid]
    """Raises `TuningError` where the rule does not apply."""


def proportional_to_delay(curve: ReactionCurve, p: float, i: float, d: float, n: float = DEFAULT_N) -> Pid:
    """kp = p T / (k T0), Ti = i T0, Td = d T0: the shape that most reaction-curve rules share."""
    return Pid.ideal(p * curve.T / (curve.k * curve.T0), i * curve.T0, d * curve.T0, n)


def paper(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """The rule of Laski & Smykowski 2021, behind Table 3: smallest integral of the squared error."""
    return proportional_to_delay(curve, 1.4, 1.3, 0.5, n)


def ziegler_nichols(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """Ziegler and Nichols 1942, from the reaction curve."""
    return proportional_to_delay(curve, 1.2, 2.0, 0.5, n)


def cohen_coon(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """Cohen and Coon 1953: Ziegler-Nichols with a correction for the ratio R = T0 / T."""
    R = curve.T0 / curve.T
    p, i, d = 4.0 / 3.0 + R / 4.0, (32.0 + 6.0 * R) / (13.0 + 8.0 * R), 4.0 / (11.0 + 2.0 * R)
    return proportional_to_delay(curve, p, i, d, n)


def chr_setpoint_0(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """Chien, Hrones and Reswick 1952: following the set-point without overshoot."""
    return Pid.ideal(0.6 * curve.T / (curve.k * curve.T0), curve.T, 0.5 * curve.T0, n)


def chr_setpoint_20(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """Chien, Hrones and Reswick 1952: following the set-point with 20 % overshoot."""
    return Pid.ideal(0.95 * curve.T / (curve.k * curve.T0), 1.4 * curve.T, 0.47 * curve.T0, n)


def chr_load_0(curve: ReactionCurve, n: float = DEFAULT_N) -> Pid:
    """Chien, Hrones and Reswick 1952: rejecting disturbances without overshoot."""
    return proportional_to_delay(curve, 0.95, 2.4, 0.42, n)


def imc(curve: ReactionCurve, closed_loop_s: float | None = None, n: float = DEFAULT_N) -> Pid:
    """Rivera 1986, the delay by its first Pade approximation; `closed_loop_s` is the time constant asked for.

    By default the larger of 0.1 T and 0.8 T0, the usual brisk choice.
    """
    wanted = max(0.1 * curve.T, 0.8 * curve.T0) if closed_loop_s is None else closed_loop_s
    Ti = curve.T + curve.T0 / 2.0
    return Pid.ideal(Ti / (curve.k * (wanted + curve.T0 / 2.0)), Ti, curve.T * curve.T0 / (2.0 * Ti), n)


def simc(motor: Motor, closed_loop_s: float | None = None, delay_s: float = 0.0, n: float = DEFAULT_N) -> Pid:
    """Skogestad 2003 for two lags and a delay: the derivative cancels the fast one, the integral the slow one.

    Series form kc = tau1 / (k (tauc + delay)), tauI = min(tau1, 4 (tauc + delay)), tauD = tau2; tau1 / k = b / K
    stays finite for T2 = 0. By default tauc is half the fast lag, or the delay if that is longer.
    Raises `TuningError` for a motor that oscillates by itself.
    """
    a, b = real_poles(motor)
    wanted = max(0.5 / b, delay_s) if closed_loop_s is None else closed_loop_s
    response = wanted + delay_s
    return _from_series(b / (motor.K * response), 1.0 / max(a, 0.25 / response), 1.0 / b, n)


def simc_pi(motor: Motor, closed_loop_s: float | None = None, delay_s: float = 0.0) -> Pid:
    """Skogestad 2003 without derivative: the half rule gives half of the fast lag to the delay.

    tau1 = 1/a + 1/(2b), theta = delay + 1/(2b), and tauc = theta unless given. Raises `TuningError` as `simc`.
    """
    a, b = real_poles(motor)
    theta = delay_s + 0.5 / b
    response = theta + (theta if closed_loop_s is None else closed_loop_s)
    # tau1 and tau1 / k written so that both make sense for a = 0
    gain = (b + 0.5 * a) / motor.K
    return Pid.ideal(gain / response, 1.0 / max(a / (1.0 + 0.5 * a / b), 0.25 / response))


def _from_series(kc: float, Ti: float, Td: float, n: float) -> Pid:
    """kc (1 + 1 / (Ti s)) (1 + Td s), multiplied out into the ideal form."""
    share = 1.0 + Td / Ti
    return Pid.ideal(kc * share, Ti * share, Td / share, n)


def _on_curve(rule: Callable[[ReactionCurve], Pid]) -> Callable[[Motor], Pid]:
    return lambda motor: rule(exact(motor))


RULES: dict[str, Rule] = {
    "paper": Rule(
        "Reaction curve (Par4 paper)",
        "The rule behind the paper's Table 3: it wants a small squared error and accepts much overshoot.",
        r"k_p = 1.4\,\frac{T}{k T_0},\quad T_i = 1.3\,T_0,\quad T_d = 0.5\,T_0",
        _on_curve(paper),
    ),
    "ziegler_nichols": Rule(
        "Ziegler-Nichols",
        "The classic of 1942: each swing is about a quarter of the one before, so expect a lively arm.",
        r"k_p = 1.2\,\frac{T}{k T_0},\quad T_i = 2\,T_0,\quad T_d = 0.5\,T_0",
        _on_curve(ziegler_nichols),
    ),
    "cohen_coon": Rule(
        "Cohen-Coon",
        "Ziegler-Nichols corrected for long delays; where the delay is short, like this motor's, it is just as lively.",
        r"k_p = \frac{T}{k T_0}\left(\frac{4}{3} + \frac{R}{4}\right),\quad T_i = T_0\frac{32 + 6R}{13 + 8R},\quad"
        r" T_d = \frac{4\,T_0}{11 + 2R},\quad R = \frac{T_0}{T}",
        _on_curve(cohen_coon),
    ),
    "chr_setpoint_0": Rule(
        "CHR, set-point, 0 %",
        "Follows the set-point calmly: the integral is as slow as the motor, so little or no overshoot.",
        r"k_p = 0.6\,\frac{T}{k T_0},\quad T_i = T,\quad T_d = 0.5\,T_0",
        _on_curve(chr_setpoint_0),
    ),
    "chr_setpoint_20": Rule(
        "CHR, set-point, 20 %",
        "Follows the set-point faster and pays with overshoot, about 20 % on the motors it was made for.",
        r"k_p = 0.95\,\frac{T}{k T_0},\quad T_i = 1.4\,T,\quad T_d = 0.47\,T_0",
        _on_curve(chr_setpoint_20),
    ),
    "chr_load_0": Rule(
        "CHR, disturbance",
        "Made to push back against a load, not to follow a set-point: the integral is fast.",
        r"k_p = 0.95\,\frac{T}{k T_0},\quad T_i = 2.4\,T_0,\quad T_d = 0.42\,T_0",
        _on_curve(chr_load_0),
    ),
    "imc": Rule(
        "Lambda (IMC)",
        "You name the closed loop's time constant and the motor's own lag is cancelled: smooth, not fast.",
        r"k_p = \frac{T + T_0/2}{k(\lambda + T_0/2)},\quad T_i = T + \frac{T_0}{2},\quad"
        r" T_d = \frac{T T_0}{2T + T_0},\quad \lambda = \max(0.1\,T,\ 0.8\,T_0)",
        _on_curve(imc),
    ),
    "simc": Rule(
        "SIMC",
        "Skogestad's rule cancels the fast lag with the derivative; it works for motors that never settle, too.",
        r"k_c = \frac{\tau_1}{k\,\tau_c},\quad \tau_I = \min(\tau_1, 4\tau_c),\quad \tau_D = \tau_2,\quad"
        r" \tau_c = \frac{\tau_2}{2}\quad\text{(series form)}",
        simc,
    ),
    "simc_pi": Rule(
        "SIMC, PI only",
        "The same without derivative: gentle on a noisy encoder, but slower.",
        r"\theta = \frac{\tau_2}{2},\quad k_p = \frac{\tau_1 + \theta}{2 k\,\theta},\quad"
        r" T_i = \min(\tau_1 + \theta, 8\,\theta)",
        simc_pi,
    ),
}
