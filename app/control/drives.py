"""The motor that drives each joint of each robot. All joints of a robot have the same one.

Only the Par4's was measured, by its paper. The others are declared: round figures that such a machine would have,
so that the same experiments can be made on every robot.
"""

from __future__ import annotations

from dataclasses import dataclass

from app.control.motor import PAR4_MOTOR, Motor


@dataclass(frozen=True)
class Drive:
    """A motor with its gear, amplifier, sensor and controller board."""

    title: str
    motor: Motor
    supply_v: float
    """Voltage at full pulse width."""
    period_s: float
    """Of the controller."""
    adc_bits: int
    """Of the position reading."""
    sensor_range: float
    """Travel over which those bits are spread, in the motor's unit."""
    setpoint: float
    """A step that suits it, in the motor's unit."""
    note: str
    """Where the numbers come from, for students."""

    @property
    def unit(self) -> str:
        """Of its output: `deg` or `mm`."""
        return self.motor.unit


DRIVES: dict[str, Drive] = {
    "par4": Drive(
        "Geared DC motor, 264:1, on an STM32F4",
        PAR4_MOTOR,
        supply_v=12.0,
        period_s=0.01,
        adc_bits=12,
        sensor_range=340.0,
        setpoint=25.0,
        note="Identified in the paper on ±12 V. The slow pole is an artefact: a real motor does not drift back.",
    ),
    "delta3": Drive(
        "Small geared DC motor with potentiometer, on an Arduino Uno",
        Motor(K=1000.0, T1=20.0),
        supply_v=6.0,
        period_s=0.01,
        adc_bits=10,
        sensor_range=270.0,
        setpoint=20.0,
        note="Declared, not measured: 300 deg/s at 6 V, time constant 50 ms. The paper's robot has hobby servos.",
    ),
    "linear": Drive(
        "DC motor with toothed belt",
        Motor(K=420.0, T1=16.8, unit="mm"),
        supply_v=24.0,
        period_s=0.005,
        adc_bits=16,
        sensor_range=520.0,
        setpoint=50.0,
        note="Declared, not measured: 600 mm/s at 24 V, time constant 60 ms.",
    ),
    "fivebar": Drive(
        "Servo motor with gear, 64:1",
        Motor(K=620.0, T1=66.0),
        supply_v=48.0,
        period_s=0.002,
        adc_bits=20,
        sensor_range=360.0,
        setpoint=15.0,
        note="Declared from the paper's speed limit: 448 deg/s, here at 48 V, time constant 15 ms.",
    ),
}
"""By the robot's name."""
