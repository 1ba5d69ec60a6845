"""The Par4 paper's sections 4.3 and 4.4: the motor's model, and two tunings of its controller."""

from __future__ import annotations

import math
from dataclasses import replace

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Motor
from app.control.tuning.loop_shaping import tune_loop
from app.control.tuning.phase_margin import smallest_margin
from app.control.tuning.reaction_curve import exact, paper_reaction_curve, real_poles
from app.control.tuning.rules import paper as paper_rule
from app.simulation.reproduce.figure import Figure, Section

ROUNDED = Motor(K=9.414, T1=3.586, T2=0.179)
"""(25)."""
MARGIN_DEG = 73.0
"""What Table 2 must have been tuned for."""


def identification() -> list[Figure]:
    """Section 4.3."""
    section, motor = Section("4.3 Identification"), PAR4_MOTOR
    slow, fast = sorted(-1.0 / motor.poles.real, reverse=True)
    not_times = (
        "Not in seconds, as T_1 and T_2 are printed: by (24) their units are 1/s and 1/s^2. The time constants are"
        f" {slow:.1f} s and {fast:.2f} s."
    )
    droop = f"No geared motor has it: it stops this one at {motor.dc_gain:.1f} deg per volt. Kept as published."
    half = "Off by half a unit of the last digit: rounded down, or from digits that are not printed."
    return [
        section.given("voltage +-", "V", "12"),
        section.given(
            "K", "deg/V/s2", "9.4138", "The measurements are not published, so the identification cannot be repeated."
        ),
        section.given("T_1", "1/s", "3.5865", not_times),
        section.given("T_2", "1/s2", "0.1790", droop),
        section.compared("(25): K", "deg/V/s2", "9.414", motor.K),
        section.compared("(25): T_1", "1/s", "3.586", motor.T1, half),
        section.compared("(25): T_2", "1/s2", "0.179", motor.T2),
    ]


def table_2() -> list[Figure]:
    """MATLAB's tuner: what it was asked for is not printed, but shows."""
    section, pid = Section("Table 2"), PID_AUTO
    crossover, margin = smallest_margin(pid, PAR4_MOTOR)
    ours = tune_loop(PAR4_MOTOR, crossover, MARGIN_DEG).pid
    circular = (
        "Ours is by our tuner, asked for the margin and crossover below. How MATLAB shares the work among P, I and N"
        " is not published: our tuner's shares were read off this table, so that three of the four are no proof."
    )
    follows = "This one is: with P, I and N as printed, a margin of 73 deg leaves no other D."
    form = "(26) has no N. The margin is a round number only if this is the parallel form, P + I / s + D N s / (s + N)."
    return [
        section.given("P_auto", "V/deg", "4.36210", circular, ours.kp),
        section.given("I_auto", "V/deg/s", "0.38231", computed=ours.ki),
        section.compared("D_auto", "V s/deg", "0.99919", _derivative_for_the_margin(), follows),
        section.given("N_auto", "rad/s", "37.2929", form, ours.n),
        section.open("phase margin", "deg", margin, "Found: so round a number must be what the tuner was asked for."),
        section.open("crossover", "rad/s", crossover, "The response time that was asked for is 2 / crossover."),
    ]


def _derivative_for_the_margin() -> float:
    """D for a margin of exactly 73 deg with Table 2's other settings, V s / deg."""
    from scipy.optimize import brentq

    def excess(kd: float) -> float:
        return smallest_margin(replace(PID_AUTO, kd=kd), PAR4_MOTOR)[1] - MARGIN_DEG

    return float(brentq(excess, 0.9, 1.1, xtol=1e-12))  # pyright: ignore[reportArgumentType]


def table_3() -> list[Figure]:
    """The reaction curve and the rule that makes settings of it."""
    section, curve = Section("Table 3"), paper_reaction_curve()
    pid, rounded = paper_rule(curve), paper_rule(exact(ROUNDED))
    k, T0, T = 52.5561, 0.2445, 20.9963
    not_25 = (
        f"The caption says (25), but the digits need T_1 and T_2 unrounded: with (25) k_p would be {rounded.kp:.4f}."
    )
    earliest, latest = (_time_to_reach(k + off) for off in (-5e-5, 5e-5))
    end = (
        f"Found: k is short of its final {exact(PAR4_MOTOR).k:.4f}, and has its digits from {earliest:.2f} to"
        f" {latest:.2f} s. T hangs on it too, the settings do not."
    )
    chosen = "No proof: the end of the step, below, was found by this number. T_0 and T are."
    rule = "Found from the digits printed: 1.4. The paper does not name its rule."
    swings = "Table 2 has 73 deg. With this one a small step overshoots by half of itself."
    return [
        section.compared("k", "deg/V", "52.5561", curve.k, chosen),
        section.compared("T_0", "s", "0.2445", curve.T0),
        section.compared("T", "s", "20.9963", curve.T),
        section.compared("k_p", "V/deg", "2.2880", pid.kp, not_25),
        section.compared("T_i", "s", "0.3178", pid.Ti),
        section.compared("T_d", "s", "0.1222", pid.Td),
        section.open("end of the recorded step", "s", _time_to_reach(k), end),
        section.open("rule: k_p k T_0 / T", "", PID_APPROX.kp * k * T0 / T, rule),
        section.open("rule: T_i / T_0", "", PID_APPROX.Ti / T0, "Likewise: 1.3."),
        section.open("rule: T_d / T_0", "", PID_APPROX.Td / T0, "Likewise: 0.5."),
        section.beyond("phase margin", "deg", smallest_margin(PID_APPROX, PAR4_MOTOR)[1], swings),
    ]


def _time_to_reach(y: float) -> float:
    """When the step response is at y deg per volt, s: y = k (1 - b / (b - a) e^(-a t)), the fast part long gone."""
    a, b = real_poles(PAR4_MOTOR)
    return -math.log((1.0 - y / PAR4_MOTOR.dc_gain) * (b - a) / b) / a
