"""Each imperfection alone against its closed form; a perfect drive against python-control."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.control import PAR4_MOTOR, PID_AUTO, Motor
from app.control.sampled_pid import Sampling
from app.simulation.hardware import FINE_STEP_S, MAX_DELAY_S, Hardware, sensor, shaft
from app.simulation.sampled_loop import DriveLoop, fewest_substeps, simulate
from tests.support.oracles import control

UNTIMED = settings(deadline=None)
H = 0.001
FREE = Motor(K=1000.0, T1=20.0)
"""A true integrator: 50 units per second and volt, time constant 50 ms."""
SEEDS = st.integers(0, 2**32 - 1)


def voltages(seed: int = 0, count: int = 400) -> np.ndarray:
    """Held for 20 steps each."""
    return np.repeat(np.random.default_rng(seed).uniform(-10.0, 10.0, count // 20), 20)


def turned(motor: Motor, hardware: Hardware, u: np.ndarray, step_s: float = H, y: float = 0.0) -> np.ndarray:
    """(k + 1,) where the joint is, from before the first voltage to after the last."""
    move = shaft(motor, hardware, step_s, y)
    return np.array([y, *(move(volts) for volts in u.tolist())])


def by_control(motor: Motor, u: np.ndarray, step_s: float = H) -> np.ndarray:
    """The same of a linear motor, by python-control."""
    held = np.append(u, u[-1])
    t = step_s * np.arange(len(held))
    return np.asarray(control.forced_response(control.ss(motor.sampled(step_s)), t, held).outputs)


@pytest.mark.parametrize("motor", [PAR4_MOTOR, FREE], ids=["par4", "integrator"])
@pytest.mark.parametrize("step_s", [0.001, 0.01, 0.1])
def test_a_perfect_drive_is_the_sampled_motor(motor: Motor, step_s: float):
    u = voltages()
    y = turned(motor, Hardware(), u, step_s)
    assert np.allclose(y, by_control(motor, u, step_s), rtol=1e-7, atol=1e-7 * np.abs(y).max())


def test_a_drive_starts_at_rest_wherever_it_stands():
    assert (turned(FREE, Hardware(), np.zeros(50), y=17.0) == 17.0).all()
    u = voltages()
    assert np.allclose(turned(FREE, Hardware(), u, y=17.0), 17.0 + turned(FREE, Hardware(), u), atol=1e-9)


def test_a_perfect_sensor_tells_where_the_joint_is():
    read = sensor(Hardware(), 0, 3)
    assert [read(y) for y in (0.0, -1.234567, 1e9)] == [0.0, -1.234567, 1e9]


def test_the_supply_limits_what_the_controller_gets():
    wide, narrow = (DriveLoop(PAR4_MOTOR, PID_AUTO, hardware=Hardware(supply_v=u)) for u in (math.inf, 12.0))
    free, limited = simulate(wide, [25.0] * 100), simulate(narrow, [25.0] * 100)
    assert max(free.u) > 500.0 and max(limited.u) == 12.0
    assert limited.ise > free.ise
    assert turned(PAR4_MOTOR, Hardware(), np.array(limited.u), 0.01)[:-1] == pytest.approx(limited.y)


@UNTIMED
@given(SEEDS, st.integers(1, 1000), st.floats(5.0, 48.0))
def test_pulse_width_rounds_the_voltage_to_its_steps(seed: int, steps: int, supply: float):
    u = voltages(seed)
    rounded = np.round(u / (supply / steps)) * (supply / steps)
    assert np.abs(rounded - u).max() <= supply / steps / 2 * (1.0 + 1e-9)
    stepped = turned(PAR4_MOTOR, Hardware(supply_v=supply, pwm_steps=steps), u)
    assert np.allclose(stepped, turned(PAR4_MOTOR, Hardware(), rounded), atol=1e-9)


def test_a_voltage_below_half_a_pulse_step_does_nothing():
    hardware = Hardware(supply_v=12.0, pwm_steps=10)
    assert (turned(FREE, hardware, np.full(200, 0.59)) == 0.0).all()
    assert turned(FREE, hardware, np.full(200, 0.61))[-1] > 0.0


def test_pulse_width_without_a_limited_supply_has_no_steps():
    u = voltages()
    assert np.array_equal(turned(FREE, Hardware(pwm_steps=10), u), turned(FREE, Hardware(), u))


@UNTIMED
@given(st.integers(6, 20), st.floats(100.0, 600.0), st.floats(-300.0, 300.0))
def test_a_converter_reads_whole_steps_of_its_range(bits: int, span: float, y: float):
    step = span / 2**bits
    reading = sensor(Hardware(adc_bits=bits, sensor_range=span), 0, 1)(y)
    assert reading / step == pytest.approx(round(reading / step), abs=1e-6)
    assert abs(reading - y) <= step / 2 * (1.0 + 1e-9)


def test_noise_has_its_deviation_no_bias_and_no_memory():
    count = 40_000
    read = sensor(Hardware(noise=0.5), 3, count)
    noise = np.array([read(10.0) for _ in range(count)]) - 10.0
    assert noise.std() == pytest.approx(0.5, rel=0.02)
    assert abs(noise.mean()) < 4.0 * 0.5 / math.sqrt(count)
    assert abs(np.corrcoef(noise[1:], noise[:-1])[0, 1]) < 0.03


def test_noise_repeats_with_its_seed_only():
    def readings(seed: int) -> list[float]:
        read = sensor(Hardware(noise=0.5, adc_bits=12), seed, 20)
        return [read(1.0) for _ in range(20)]

    assert readings(1) == readings(1) != readings(2)
    step = 340.0 / 2**12
    assert np.allclose(np.array(readings(1)) / step, np.round(np.array(readings(1)) / step), atol=1e-6)


@pytest.mark.parametrize("milliseconds", [1, 7, 40])
def test_a_delay_shifts_the_response_by_exactly_itself(milliseconds: int):
    u = voltages()
    late = turned(PAR4_MOTOR, Hardware(delay_s=milliseconds * 1e-3), u)
    assert (late[: milliseconds + 1] == 0.0).all()
    assert np.array_equal(late[milliseconds:], turned(PAR4_MOTOR, Hardware(), u)[: len(late) - milliseconds])


def test_a_closed_loop_feels_the_delay_to_the_millisecond():
    """The controller computes every 10 ms; the delay is no multiple of that."""
    prompt, late = (simulate(DriveLoop(FREE, PID_AUTO, hardware=Hardware(delay_s=d)), [1.0] * 3) for d in (1e-3, 8e-3))
    assert len(late.y) == 30
    assert np.flatnonzero(late.y)[0] - np.flatnonzero(prompt.y)[0] == 7


def test_a_delay_has_an_end():
    assert np.flatnonzero(turned(FREE, Hardware(delay_s=1e6), np.ones(1500)))[0] == round(MAX_DELAY_S / H) + 1


@pytest.mark.parametrize("volts", [-0.99, 0.5, 1.0])
def test_dry_friction_holds_the_rotor_below_its_voltage(volts: float):
    for motor in (FREE, PAR4_MOTOR):
        assert (turned(motor, Hardware(coulomb_v=1.0), np.full(500, volts)) == 0.0).all()


@pytest.mark.parametrize("direction", [1.0, -1.0])
def test_dry_friction_takes_its_voltage_from_the_speed(direction: float):
    """Steady speed K (u - u_c) / T1, the way as if the motor had the rest of the voltage alone."""
    y = turned(FREE, Hardware(coulomb_v=1.5), np.full(1000, direction * 6.0))
    assert (y[-1] - y[-2]) / H == pytest.approx(direction * 1000.0 * (6.0 - 1.5) / 20.0, rel=1e-8)
    assert np.allclose(y, turned(FREE, Hardware(), np.full(1000, direction * 4.5)), rtol=1e-12)


def test_dry_friction_brings_a_coasting_rotor_to_rest():
    """v' = -T1 v - K u_c: at rest after ln(1 + v0 / a) / T1, a = K u_c / T1, having gone v0 / T1 - a t."""
    u = np.concatenate([np.full(1000, 6.0), np.zeros(1000)])
    y = turned(FREE, Hardware(coulomb_v=1.5), u)
    a, v0 = 1000.0 * 1.5 / 20.0, 1000.0 * 4.5 / 20.0
    rest_after = math.log(1.0 + v0 / a) / 20.0
    way = y[1000:] - y[1000]
    assert way[-1] == pytest.approx(v0 / 20.0 - a * rest_after, rel=2e-4)
    stands = np.flatnonzero(way == way[-1])[0]
    assert stands * H == pytest.approx(rest_after, abs=2 * H)
    assert (way[stands:] == way[-1]).all()
    smooth = turned(FREE, Hardware(), u)
    assert way[-1] < (smooth - smooth[1000])[-1]


def test_dry_friction_only_takes_energy():
    """Without voltage the speed never grows and never turns round."""
    y = turned(FREE, Hardware(coulomb_v=0.3), np.concatenate([np.full(100, 6.0), np.zeros(2000)]))
    speed = np.diff(y[100:])
    assert (speed >= -1e-6).all() and (np.diff(speed) <= 1e-6).all() and speed[-1] == 0.0


def test_dry_friction_holds_a_drooping_rotor_where_it_is():
    """The paper's motor drifts back; with friction above T2 y / K it does not."""
    u = np.concatenate([np.full(500, 12.0), np.zeros(8000)])
    rough, smooth = turned(PAR4_MOTOR, Hardware(coulomb_v=1.0), u), turned(PAR4_MOTOR, Hardware(), u)
    assert rough[-1] == rough[-5000] > 1.0 and PAR4_MOTOR.T2 / PAR4_MOTOR.K * rough[-1] < 1.0
    assert smooth[-1] < smooth[-5000] - 1.0


def test_a_droop_stronger_than_dry_friction_pulls_the_rotor_back_to_where_they_balance():
    balance = 0.5 * PAR4_MOTOR.K / PAR4_MOTOR.T2
    still = turned(PAR4_MOTOR, Hardware(coulomb_v=0.5), np.zeros(2000), 0.1, y=0.99 * balance)
    assert (still == 0.99 * balance).all()
    pulled = turned(PAR4_MOTOR, Hardware(coulomb_v=0.5), np.zeros(2000), 0.1, y=2.0 * balance)
    assert pulled[-1] == pytest.approx(balance, rel=1e-3) and (np.diff(pulled) <= 0.0).all()


def test_viscous_friction_is_added_damping():
    u = voltages()
    y = turned(FREE, Hardware(viscous=30.0), u)
    assert np.allclose(y, by_control(Motor(K=1000.0, T1=50.0), u), rtol=1e-7, atol=1e-7)
    steady = turned(FREE, Hardware(viscous=30.0), np.full(1000, 6.0))
    assert (steady[-1] - steady[-2]) / H == pytest.approx(1000.0 * 6.0 / 50.0, rel=1e-9)


@pytest.mark.parametrize("factor", [0.5, 3.0])
def test_inertia_slows_the_motor_and_keeps_its_final_speed(factor: float):
    u = voltages()
    loaded = Motor(K=9.4138 / factor, T1=3.5865 / factor, T2=0.1790 / factor)
    y = turned(PAR4_MOTOR, Hardware(inertia_factor=factor), u)
    assert np.allclose(y, by_control(loaded, u), rtol=1e-6, atol=1e-6)
    steady = turned(FREE, Hardware(inertia_factor=factor), np.full(2000, 6.0))
    assert (steady[-1] - steady[-2]) / H == pytest.approx(300.0, rel=1e-5)


@UNTIMED
@given(SEEDS, st.floats(0.01, 5.0))
def test_play_lets_the_joint_rest_until_a_flank_touches_it(seed: int, play: float):
    u = voltages(seed)
    gear, joint = turned(FREE, Hardware(), u), turned(FREE, Hardware(backlash=play), u)
    assert (np.abs(gear - joint) <= play / 2 + 1e-9).all()
    for g, (before, after) in zip(gear[1:], pairwise(joint), strict=True):
        if after > before:
            assert after == pytest.approx(g - play / 2, abs=1e-9)
        elif after < before:
            assert after == pytest.approx(g + play / 2, abs=1e-9)


def test_a_reversal_loses_the_whole_play():
    u = np.concatenate([np.full(500, 6.0), np.full(500, -6.0)])
    gear, joint = turned(FREE, Hardware(), u), turned(FREE, Hardware(backlash=2.0), u)
    assert joint.max() == pytest.approx(gear.max() - 1.0, abs=1e-9), "half of it before the first motion"
    moves_back = np.flatnonzero(np.diff(joint) < 0.0)[0]
    assert gear[moves_back] >= gear.max() - 2.0 > gear[moves_back + 1], "and all of it where the motor turns round"


@pytest.mark.parametrize(
    ("hardware", "fine"),
    [
        (Hardware(12.0, 100, 12, 300.0, 0.1, viscous=1.0, inertia_factor=2.0), False),
        (Hardware(delay_s=0.001), True),
        (Hardware(coulomb_v=0.1), True),
        (Hardware(backlash=0.1), True),
    ],
)
def test_only_what_needs_it_is_computed_finely(hardware: Hardware, fine: bool):
    assert hardware.needs_fine_steps == fine
    assert fewest_substeps(hardware, 0.01) == (10 if fine else 1)
    assert fewest_substeps(hardware, FINE_STEP_S / 2) == 1
    trace = simulate(DriveLoop(FREE, PID_AUTO, Sampling(), hardware), [1.0] * 20)
    assert len(trace.y) == len(trace.u) == 20 * (10 if fine else 1)


def test_values_between_the_instants_change_nothing_at_them():
    loop = DriveLoop(PAR4_MOTOR, PID_AUTO, hardware=Hardware(supply_v=12.0))
    coarse, fine = simulate(loop, [5.0] * 200), simulate(loop, [5.0] * 200, substeps=7)
    assert np.allclose(fine.y[::7], coarse.y, atol=1e-9) and np.allclose(fine.u[::7], coarse.u, atol=1e-7)
    assert fine.ise == pytest.approx(coarse.ise) and len(fine.y) == 1400


@UNTIMED
@given(
    st.builds(
        Hardware,
        supply_v=st.floats(1.0, 48.0),
        pwm_steps=st.integers(0, 1000),
        adc_bits=st.integers(0, 16),
        noise=st.floats(0.0, 1.0),
        delay_s=st.floats(0.0, 0.05),
        coulomb_v=st.floats(0.0, 2.0),
        viscous=st.floats(0.0, 20.0),
        inertia_factor=st.floats(0.2, 5.0),
        backlash=st.floats(0.0, 3.0),
    ),
    SEEDS,
)
def test_all_imperfections_together_stay_finite_within_the_supply_and_repeatable(hardware: Hardware, seed: int):
    loop = DriveLoop(FREE, PID_AUTO, Sampling(), hardware)
    trace = simulate(loop, [10.0] * 40, seed=seed)
    assert np.isfinite(trace.y).all() and np.abs(trace.u).max() <= hardware.supply_v
    assert simulate(loop, [10.0] * 40, seed=seed) == trace
