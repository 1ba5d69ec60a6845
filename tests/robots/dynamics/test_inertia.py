"""The declared masses, and the limits of the drives that move them."""

from __future__ import annotations

import math
from dataclasses import fields

import numpy as np
import pytest

from app.robots import ROBOTS
from app.robots.dynamics import INERTIA, InertiaError, LinearInertia, Par4Inertia, dynamics_of
from app.robots.limits import drive_limits, rate_limits
from tests.robots.dynamics.states import EVERY, states

every_inertia = pytest.mark.parametrize("inertia", INERTIA.values(), ids=INERTIA)


def test_every_robot_has_masses():
    assert list(INERTIA) == list(ROBOTS)


@every_inertia
def test_every_field_says_what_it_is(inertia):
    assert set(inertia.quantities()) == {field.name for field in fields(inertia)}
    for quantity in inertia.quantities().values():
        assert quantity.label and quantity.unit in ("kg", "kg m^2", "")


@every_inertia
def test_scaling_touches_masses_and_inertias_only(inertia):
    laden = inertia.changed(payload=0.5)
    wrong = laden.scaled(1.1)
    assert wrong.payload == 0.5 and laden.scaled(1.0) == laden
    for name, quantity in inertia.quantities().items():
        before, after = getattr(laden, name), getattr(wrong, name)
        heavy = quantity.unit and name != "payload"
        assert after == (pytest.approx(1.1 * before) if heavy else before)


@every_inertia
@pytest.mark.parametrize("values", [{"wheels": 4.0}, {"payload": -1.0}, {"payload": math.nan}, {"payload": "heavy"}])
def test_impossible_masses_are_refused_in_one_sentence(inertia, values):
    with pytest.raises(InertiaError) as refusal:
        inertia.changed(**values)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


def test_masses_of_another_robot_are_refused():
    with pytest.raises(InertiaError, match="needs a LinearInertia"):
        dynamics_of(EVERY["linear"], Par4Inertia())


def test_shares_lie_between_0_and_1():
    assert LinearInertia(lumped=1.0).changed(lumped=None).lumped is None
    for wrong in ({"lumped": 1.5}, {"rod_com": None}, {"rod_com": 2.0}):
        with pytest.raises(InertiaError):
            LinearInertia().changed(**wrong)
    with pytest.raises(InertiaError):
        Par4Inertia(link_com=-0.1)


@pytest.mark.parametrize("robot", EVERY.values(), ids=EVERY)
def test_the_drives_hold_the_robot_and_speed_it_up(robot):
    limits = drive_limits(robot)
    n = len(robot.joint_names)
    assert all(values.shape == (n,) and (values > 0.0).all() for values in limits)
    assert np.array_equal(limits.speed, rate_limits(robot).speed)
    assert np.array_equal(limits.acceleration, rate_limits(robot).acceleration)
    poses, _, _ = states(robot, 300, seed=1)
    holding = np.abs(robot.dynamics.gravity(poses, "joint"))
    assert (np.quantile(holding, 0.95, axis=0) < 0.5 * limits.effort).all()
    alone = np.abs(np.diagonal(robot.dynamics.mass_matrix(robot.home, "joint"))) * limits.acceleration
    assert (alone < limits.effort).all(), "one joint at its declared acceleration"


def test_printed_efforts_of_the_fivebar():
    assert drive_limits(EVERY["fivebar"]).effort.tolist() == [89.6, 89.6, 28.8, 28.8]
    assert drive_limits(EVERY["linear"]).effort.tolist() == [60.0] * 3
