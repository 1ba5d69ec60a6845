"""What a law is shown: its model, evaluated at the state that the sensors tell."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Protocol

from app.robots.dynamics import Dynamics, Terms
from app.simulation.plant import ExactPlant, Plant


class Sensor(Protocol):
    """Read once a period."""

    def read(self) -> Terms: ...


class SharedSensor:
    """Nothing is measured wrongly and the law's model is the plant's own, or unused: one evaluation serves both."""

    def __init__(self, plant: ExactPlant) -> None:
        self._plant = plant

    def read(self) -> Terms:
        return self._plant.terms


class IdealSensor:
    """Nothing is measured wrongly, but the model is another."""

    def __init__(self, plant: Plant, model: Dynamics) -> None:
        self._plant, self._model = plant, model

    def read(self) -> Terms:
        return self._model.at(self._plant.pose, self._plant.rate)


class Encoders:
    """Joints in steps; their rates as filtered differences of the readings, or as they are.

    First order, as a microcontroller filters: v += (1 - exp(-2 pi f T)) ((q_k - q_k-1) / T - v).
    """

    def __init__(self, plant: Plant, model: Dynamics, step: float, filter_hz: float, period_s: float) -> None:
        self._plant, self._model = plant, model
        self._step, self._period_s = step, period_s
        self._share = 1.0 - math.exp(-math.tau * filter_hz * period_s) if filter_hz else 0.0
        self._pose = plant.pose
        self._rates: Sequence[float] = plant.joint_rates
        self._last: list[float] | None = None
        self.trace: list[tuple[Sequence[float], Sequence[float]]] = []
        """Pose and rate that were shown."""

    def read(self) -> Terms:
        joints = self._readings()
        rates = self._filtered(joints) if self._share else self._plant.joint_rates
        pose, rate = self._model.locate(joints, rates, self._pose)
        self._pose = pose
        self.trace.append((pose, rate))
        return self._model.at(pose, rate)

    def _readings(self) -> list[float]:
        if not self._step:
            return list(self._plant.joints)
        return [self._step * round(joint / self._step) for joint in self._plant.joints]

    def _filtered(self, joints: list[float]) -> Sequence[float]:
        if self._last is not None:
            moved = zip(self._rates, joints, self._last, strict=True)
            share, per_s = self._share, 1.0 / self._period_s
            self._rates = [v + share * (per_s * (new - old) - v) for v, new, old in moved]
        self._last = joints
        return self._rates
