"""Formulas of the lessons on control and on the linear delta's table: against the papers, and another way round."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from app.classroom.lessons.formulas import FORMULAS, FormulaMistake
from app.control import Pid
from app.control.sampled_pid import Sampling, sampled_pid

AUTO = "Paper, Table 2 (MATLAB)"
APPROX = "Paper, Table 3 (reaction curve)"


def value(name: str, pick: str = "", **arguments: Any) -> float:
    found = FORMULAS[name].quantity(arguments, pick).value
    assert isinstance(found, float)
    return found


@pytest.mark.parametrize(
    ("d", "printed"),
    [
        ((60, 0, 60), (6, -3.472, -34.65)),
        ((300, 335, 300), (-3.36, 1.946, -62)),
        ((350, 350, 390), (0, -3.981, -64.22)),
    ],
)
def test_with_the_slip_table_3_of_the_thesis_comes_out_and_without_it_the_rods_fit(d, printed):
    carriages = dict(zip(("d1", "d2", "d3"), d, strict=True))
    with_slip = [0.1 * value("thesis_forward", axis, **carriages, slip=True) for axis in "xyz"]
    assert with_slip == pytest.approx(printed, abs=0.04)
    pose = {axis: value("thesis_forward", axis, **carriages) for axis in "xyz"}
    rods = [value("rod_length", robot="linear", joints=carriages, pose=pose, leg=leg) for leg in (1, 2, 3)]
    assert rods == pytest.approx([365.0] * 3, abs=1e-6)


def test_the_line_and_the_quadratic_lead_to_the_height():
    row = {"d1": 170, "d2": 320, "d3": 240}
    a, b, c = (value("thesis_forward", name, **row) for name in "abc")
    z = (-b - math.sqrt(b * b - 4.0 * a * c)) / (2.0 * a)
    assert z == pytest.approx(value("thesis_forward", "z", **row))
    s_x, t_x = value("thesis_forward", "s_x", **row), value("thesis_forward", "t_x", **row)
    assert s_x * z + t_x == pytest.approx(value("thesis_forward", "x", **row))


def test_the_slip_hides_where_carriage_3_is_at_the_mean_height_of_the_others():
    assert value("thesis_miss", d1=170, d2=310, d3=240) == pytest.approx(0.0, abs=1e-6)
    assert value("thesis_miss", d1=350, d2=350, d3=390) > 30.0


def test_table_4_comes_out():
    assert value("circle", "q1", tuning=AUTO, as_in_paper=True) == pytest.approx(91.45, abs=0.005)
    assert value("circle", "q3", tuning=APPROX, as_in_paper=True) == pytest.approx(307.9, abs=0.05)
    assert value("circle", "jump", tuning=AUTO, as_in_paper=True) > 95.0
    with pytest.raises(FormulaMistake, match="methods are"):
        FORMULAS["circle"].quantity({"tuning": "mine"}, "ise")


def test_on_the_circle_itself_the_papers_ranking_is_the_other_way_round():
    auto, approx = (value("circle", "ise", tuning=tuning, start="smooth") for tuning in (AUTO, APPROX))
    assert 6.5 < auto / approx < 7.0


def test_a_hold_costs_half_a_period_of_phase():
    gains = {"kp": 4.3621, "ki": 0.38231, "kd": 0.99919, "n": 37.2929}
    ideal, crossover = (value("margin", name, gains=gains, ideal=True) for name in ("phase", "crossover"))
    lag = math.degrees(crossover * 0.04 / 2.0)
    tustin = value("margin", "phase", gains=gains, period=40, method="Tustin")
    assert ideal - tustin == pytest.approx(lag, abs=0.5)
    assert value("margin", "phase", gains=gains, period=40) < tustin - 5.0


def test_the_voltage_made_of_noise_is_that_of_the_program():
    law, noise = sampled_pid(Pid(4.0, 0.0, 1.5, 400.0), Sampling(0.01)), np.random.default_rng(1)
    volts = [law(0.0, y) for y in 0.05 * noise.standard_normal(40_000)]
    told = value("noise_voltage", gains={"kp": 4.0, "kd": 1.5, "n": 400.0}, noise=0.05)
    assert np.std(volts) == pytest.approx(told, rel=0.02)


def test_the_tuners_sliders_count():
    quick = value("tuning", "kp", method="Tuner: two sliders", response_time=0.15)
    assert quick > value("tuning", "kp", method="Tuner: two sliders", response_time=0.3)
