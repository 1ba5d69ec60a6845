"""Input signals: shapes, and that a mounted arm stays within its range."""

from __future__ import annotations

import numpy as np
import pytest

from app.control.drives import DRIVES
from app.control.identification.excitation import EXCITATIONS, prbs, pulses, square, staircase, step
from app.control.identification.open_loop import open_loop
from app.control.motor import PAR4_MOTOR


@pytest.mark.parametrize("name", EXCITATIONS)
def test_every_signal_fills_its_grid_within_the_amplitude(name):
    excitation = EXCITATIONS[name]
    t, u = excitation.signal(6.0, 20.0, 0.01)
    assert t.shape == u.shape == (2000,)
    assert t[0] == 0.0 and np.allclose(np.diff(t), 0.01)
    assert np.abs(u).max() == 6.0
    assert excitation.title and excitation.explanation.count(".") - excitation.explanation.count("0.5") == 1


@pytest.mark.parametrize("name", EXCITATIONS)
@pytest.mark.parametrize("grid", [(0.0, 0.01), (1.0, 0.0), (1.0, 2.0), (np.inf, 0.01), (np.nan, 0.01), (1.0, np.nan)])
def test_an_impossible_grid_is_refused(name, grid):
    with pytest.raises(ValueError, match="positive sampling period"):
        EXCITATIONS[name].signal(12.0, *grid)


def test_step_and_square():
    assert (step(3.0, 1.0, 0.1)[1] == 3.0).all()
    t, u = square(12.0, 20.0, 0.01)
    assert (u == np.where((np.arange(len(t)) % 800) < 400, 12.0, -12.0)).all()
    assert square(1.0, 1.0, 0.1, cycle_s=0.4)[1].tolist() == [1, 1, -1, -1, 1, 1, -1, -1, 1, 1]


def test_prbs_is_held_and_the_same_for_the_same_seed():
    _, u = prbs(12.0, 20.0, 0.01, seed=3)
    blocks = u.reshape(-1, 50)
    assert (blocks == blocks[:, :1]).all()
    assert set(u) == {-12.0, 12.0}
    assert (u == prbs(12.0, 20.0, 0.01, seed=3)[1]).all()
    assert (u != prbs(12.0, 20.0, 0.01, seed=4)[1]).any()
    assert len(prbs(12.0, 1.03, 0.01)[1]) == 103


def test_staircase_has_eight_equal_levels():
    _, u = staircase(12.0, 20.0, 0.01)
    assert u[::250].tolist() == [12, 0, -12, 0, 6, -6, 12, -12]
    assert (u.reshape(8, 250) == u[::250, None]).all()


def test_a_free_shaft_turns_far_with_the_square_wave():
    _, u = square(12.0, 8.0, 0.01)
    assert open_loop(PAR4_MOTOR, u, 0.01).max() == pytest.approx(110.0, abs=0.1)


@pytest.mark.parametrize("drive", DRIVES)
@pytest.mark.parametrize("swing", [10.0, 45.0])
@pytest.mark.parametrize("amplitude", [1.0, 6.0, -12.0])
def test_pulses_keep_a_mounted_joint_within_its_range(drive, swing, amplitude):
    """Even if its motor is a tenth stronger than the model."""
    motor, period_s = DRIVES[drive].motor, 0.001
    _, u = pulses(amplitude, 60.0, period_s, swing_deg=swing, motor=motor)
    y = open_loop(motor, 1.1 * u, period_s)
    assert y.max() <= swing and y.min() >= -swing
    assert y.max() > 0.1 * swing and y.min() < -0.1 * swing


def test_pulses_that_would_go_too_far_in_one_sample_are_refused():
    with pytest.raises(ValueError, match="lower the voltage"):
        pulses(12.0, 20.0, 0.1, swing_deg=1.0)
    assert not pulses(0.0, 20.0, 0.01)[1].any()
