"""Tuning rules: the published constants, the loops that result, and which motors each rule serves."""

from __future__ import annotations

import math

import control
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.control.motor import PAR4_MOTOR, Motor
from app.control.pid import Pid
from app.control.tuning import rules
from app.control.tuning.reaction_curve import ReactionCurve, TuningError, exact, paper_reaction_curve
from app.control.tuning.rules import RULES, imc, simc, simc_pi
from tests.robots.golden import golden

CURVE = ReactionCurve.through(k=2.0, t_inflection=1.0, y_inflection=0.25, slope=0.5)
"""T0 = 0.5, T = 4: k T0 / T = 0.25."""

SERVING_INTEGRATORS = {"simc", "simc_pi"}


def slowest_pole(pid: Pid, motor: Motor) -> float:
    """Real part of the closed loop's rightmost pole, 1/s."""
    return float(np.real(control.poles(control.feedback(pid.transfer_function() * motor.transfer_function(), 1))).max())


@pytest.mark.parametrize(
    ("rule", "kp", "Ti", "Td"),
    [
        ("paper", 5.6, 0.65, 0.25),
        ("ziegler_nichols", 4.8, 1.0, 0.25),
        # R = 1/8: (4/3 + 1/32) / 0.25, 0.5 * 32.75 / 14, 2 / 11.25
        ("cohen_coon", 5.4583333333333, 1.1696428571429, 0.1777777777778),
        ("chr_setpoint_0", 2.4, 4.0, 0.25),
        ("chr_setpoint_20", 3.8, 5.6, 0.235),
        ("chr_load_0", 3.8, 1.2, 0.21),
        # lambda = 0.4: 4.25 / (2 * 0.65), 4.25, 2 / 8.5
        ("imc", 3.2692307692308, 4.25, 0.2352941176471),
    ],
)
def test_published_constants(rule, kp, Ti, Td):
    assert (CURVE.T0, CURVE.T) == (0.5, 4.0)
    pid = getattr(rules, rule)(CURVE)
    assert [pid.kp, pid.Ti, pid.Td] == pytest.approx([kp, Ti, Td], rel=1e-12)


def test_the_paper_rule_on_the_golden_curve():
    by_model, by_recording = RULES["paper"].tune(PAR4_MOTOR), rules.paper(paper_reaction_curve())
    for pid, name in ((by_model, "exact"), (by_recording, "paper_emulation")):
        expected = golden("motor_steps")["reaction_curve"][name]
        assert [pid.kp, pid.Ti, pid.Td] == pytest.approx([expected["kp"], expected["Ti"], expected["Td"]], rel=1e-9)


@pytest.mark.parametrize("name", RULES)
def test_every_rule_holds_the_paper_motor(name):
    assert slowest_pole(RULES[name].tune(PAR4_MOTOR), PAR4_MOTOR) < 0.0


@pytest.mark.parametrize("name", RULES)
def test_every_rule_is_told_in_a_sentence_and_a_formula(name):
    rule = RULES[name]
    assert rule.title and rule.latex.count("{") == rule.latex.count("}") > 0
    assert rule.explanation.endswith(".") and rule.explanation.count(". ") == 0


@pytest.mark.parametrize("name", RULES)
def test_integrating_motors(name):
    motor = Motor(9.4, 3.6)
    if name in SERVING_INTEGRATORS:
        assert slowest_pole(RULES[name].tune(motor), motor) < 0.0
    else:
        with pytest.raises(TuningError, match="SIMC"):
            RULES[name].tune(motor)


@pytest.mark.parametrize("name", RULES)
def test_a_motor_that_overshoots_by_itself_is_refused(name):
    with pytest.raises(TuningError, match="loop shaping"):
        RULES[name].tune(Motor(1.0, 1.0, 5.0))


def test_filter_of_the_derivative():
    assert RULES["ziegler_nichols"].tune(PAR4_MOTOR).n == 100.0
    assert rules.ziegler_nichols(exact(PAR4_MOTOR), n=math.inf).n == math.inf


@given(st.floats(0.1, 1e3), st.floats(0.01, 2.0), st.floats(1.2, 100.0), st.floats(0.2, 2.0))
def test_simc_with_ideal_derivative_gives_the_loop_it_was_asked_for(gain, slow, ratio, speed):
    """With tau1 <= 4 tauc both lags are cancelled exactly: C G = 1 / (tauc s)."""
    fast = slow * ratio
    motor = Motor(gain, slow + fast, slow * fast)
    closed_loop_s = speed / slow
    pid = simc(motor, closed_loop_s, n=math.inf)
    s = 1j * np.array([0.1, 1.0, 10.0]) / closed_loop_s
    loop = (pid.kp + pid.ki / s + pid.kd * s) * motor.K / (s * s + motor.T1 * s + motor.T2)
    if speed >= 0.25:
        assert np.allclose(loop, 1.0 / (closed_loop_s * s), rtol=1e-9, atol=0)
    elif speed < 0.24:
        assert not np.allclose(loop, 1.0 / (closed_loop_s * s), rtol=1e-3, atol=0)


def test_simc_on_an_integrator_is_skogestads_table():
    """k' / (s (tau2 s + 1)) with delay 0.2: kc = 1 / (k' 0.5), tauI = 4 * 0.5, tauD = tau2, in series form."""
    pid = simc(Motor(6.0, 2.0), closed_loop_s=0.3, delay_s=0.2, n=math.inf)
    kc, Ti, Td = 1.0 / (3.0 * 0.5), 2.0, 0.5
    assert [pid.kp, pid.ki, pid.kd] == pytest.approx([kc * (1.0 + Td / Ti), kc / Ti, kc * Td], rel=1e-12)


def test_simc_pi_uses_the_half_rule():
    """Lags of 2 s and 0.5 s become one of 2.25 s and a delay of 0.25 s; the slowest integral is 8 theta = 2 s."""
    pid = simc_pi(Motor(3.0, 2.5, 1.0))
    assert [pid.kp, pid.Ti, pid.kd] == pytest.approx([2.25 / (3.0 * 0.5), 2.0, 0.0], rel=1e-12)
    patient = simc_pi(Motor(3.0, 2.5, 1.0), closed_loop_s=1.0)
    assert [patient.kp, patient.Ti] == pytest.approx([2.25 / (3.0 * 1.25), 2.25], rel=1e-12)


def test_simc_pi_on_an_integrator():
    pid = simc_pi(Motor(6.0, 2.0), closed_loop_s=0.3)
    assert [pid.kp, pid.Ti] == pytest.approx([1.0 / (3.0 * 0.55), 4.0 * 0.55], rel=1e-12)


def test_imc_slower_on_request():
    assert imc(CURVE, 2.0).kp < imc(CURVE, 1.0).kp
