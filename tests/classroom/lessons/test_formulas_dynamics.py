"""Formulas about forces, gains and frames that lessons 12 to 17 compute with."""

from __future__ import annotations

import math

import pytest

from app.classroom.lessons.formulas import FormulaMistake, formula_named


def result(name: str, arguments: dict[str, object], pick: str = "") -> float:
    """A formula's number."""
    formula = formula_named(name)
    assert formula is not None
    value = formula.quantity(arguments, pick).value
    assert isinstance(value, int | float)
    return float(value)


@pytest.mark.parametrize("pose", [{"x": 0, "y": 0, "z": -450}, {"x": 80, "y": -30, "z": -500}])
def test_the_linear_deltas_motors_hold_its_whole_weight_in_every_pose(pose: dict[str, float]) -> None:
    forces = [result("effort", {"robot": "linear", "pose": pose}, joint) for joint in ("d1", "d2", "d3")]
    masses = {"platform_mass": 1, "carriage_mass": 3, "rod_mass": 6}
    weight = 9.81 * sum(count * result("mass", {"robot": "linear", "name": name}) for name, count in masses.items())
    assert -sum(forces) == pytest.approx(weight)


def test_on_the_fast_helix_weight_and_inertia_nearly_cancel() -> None:
    weight, inertia, total = (result("force_swing", {"helix": "T2"}, cause) for cause in ("weight", "inertia", "total"))
    assert (weight, inertia, total) == pytest.approx((2.02, 2.53, 0.52), abs=0.01)


def test_on_the_slow_helix_the_weight_swings_most() -> None:
    assert result("force_swing", {"helix": "T1"}, "weight") > 2.0 * result("force_swing", {"helix": "T1"}, "inertia")


def test_the_published_gains_are_those_of_their_bandwidth() -> None:
    assert result("joint_stiffness", {"robot": "linear", "bandwidth": 60.0 / math.tau}) == pytest.approx(3.0)
    assert result("law_gain", {"robot": "linear", "law": "CTC"}, "kp") == pytest.approx(3600.0)
    assert result("law_gain", {"robot": "linear", "law": "CTC"}, "kd") == pytest.approx(120.0)
    assert result("law_gain", {"robot": "fivebar", "law": "TSIDC"}, "kp") == pytest.approx(35531, abs=1)
    assert result("law_gain", {"robot": "linear", "law": "CTC", "bandwidth": 20.0}, "bandwidth") == 20.0


def test_speed_limits_are_read_in_the_joints_own_unit() -> None:
    assert result("speed_limit", {"robot": "fivebar", "joint": "q3"}) == 12.5
    assert result("speed_limit", {"robot": "linear", "joint": "d1"}) == 1000.0


def test_a_joint_that_does_not_exist_is_refused() -> None:
    with pytest.raises(FormulaMistake):
        result("speed_limit", {"robot": "linear", "joint": "q9"})


def test_every_byte_of_a_frame_has_to_survive() -> None:
    assert result("frame_survival", {"garbled": 0.0, "count": 27.0}) == 100.0
    one, two = (result("frame_survival", {"garbled": 2.0, "count": float(n)}) for n in (27, 54))
    assert one == pytest.approx(57.96, abs=0.01)
    assert two == pytest.approx(one * one / 100.0)
