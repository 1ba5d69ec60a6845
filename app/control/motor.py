"""The geared DC motor that drives one joint: y'' + T1 y' + T2 y = K u, as transfer function and sampled.

(24) of Laski & Smykowski 2021. T1 and T2 are not times, as the paper prints them: their units are 1/s and 1/s^2.
T2 makes the position droop back under constant voltage, which no real motor does: it is an artefact of the
identification, kept as published.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import control

OutputUnit = str
"""`deg` or `mm`: what a motor's output is measured in."""


class Zoh(NamedTuple):
    """Exact step of the state (y, v) under an input held for one period: x+ = A x + B u."""

    a11: float
    a12: float
    a21: float
    a22: float
    b1: float
    b2: float

    @property
    def polynomials(self) -> tuple[list[float], list[float]]:
        """Numerator and denominator in z of y / u = [1 0] (zI - A)^-1 B, highest power first."""
        numerator = [self.b1, self.a12 * self.b2 - self.a22 * self.b1]
        return numerator, [1.0, -(self.a11 + self.a22), self.a11 * self.a22 - self.a12 * self.a21]


@dataclass(frozen=True)
class Motor:
    """y'' + T1 y' + T2 y = K u; y in `unit`, u in volts."""

    K: float
    """Gain, unit / (V s^2)."""
    T1: float
    """Damping, 1/s."""
    T2: float = 0.0
    """Droop, 1/s^2; 0 for a true integrator."""
    unit: OutputUnit = "deg"

    @property
    def dc_gain(self) -> float:
        """Output per volt in the long run; inf for an integrator."""
        return self.K / self.T2 if self.T2 else float("inf")

    @property
    def poles(self) -> NDArray[np.complex128]:
        """(2,) rad/s, the slow one last."""
        return np.roots([1.0, self.T1, self.T2]).astype(complex)

    def transfer_function(self) -> control.TransferFunction:
        """G(s) = K / (s^2 + T1 s + T2) as a python-control object."""
        import control

        return control.TransferFunction([self.K], [1.0, self.T1, self.T2])

    def sampled(self, period_s: float) -> control.TransferFunction:
        """G(z) behind a zero-order hold of `period_s`, as a python-control object."""
        import control

        return control.sample_system(self.transfer_function(), period_s, method="zoh")

    def zoh(self, period_s: float) -> Zoh:
        """The exact step of one period under a held input."""
        from scipy.linalg import expm

        augmented = np.array([[0.0, 1.0, 0.0], [-self.T2, -self.T1, self.K], [0.0, 0.0, 0.0]])
        step = expm(augmented * period_s)
        return Zoh(*step[0, :2].tolist(), *step[1, :2].tolist(), *step[:2, 2].tolist())

    def loaded(self, inertia_factor: float = 1.0, viscous: float = 0.0) -> Motor:
        """The same motor with its inertia multiplied, and with more viscous friction (1/s, at its own inertia)."""
        return replace(
            self,
            K=self.K / inertia_factor,
            T1=(self.T1 + viscous) / inertia_factor,
            T2=self.T2 / inertia_factor,
        )


PAR4_MOTOR = Motor(K=9.4138, T1=3.5865, T2=0.1790)
"""Identified by the paper on +-12 V (its section 4.3)."""
