"""The PID controller in the forms the Par4 paper uses, with set-point weights.

    u = kp (b r - y) + ki / s (r - y) + kd N s / (s + N) (c r - y)

Table 2 is this parallel form with a filtered derivative; (26), kp (1 + 1 / (Ti s) + Td s), is the ideal form.
Gains are in volts per unit of the drive's output (deg or mm).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import control


@dataclass(frozen=True)
class Pid:
    """A PID controller in parallel form. An infinite `n` is an ideal derivative."""

    kp: float
    """V / unit."""
    ki: float = 0.0
    """V / (unit s)."""
    kd: float = 0.0
    """V s / unit."""
    n: float = math.inf
    """Cut-off of the derivative's filter, rad/s."""
    b: float = 1.0
    """Weight of the set-point in the proportional part."""
    c: float = 1.0
    """Weight of the set-point in the derivative; 0 is derivative on measurement."""

    @classmethod
    def ideal(cls, kp: float, Ti: float = math.inf, Td: float = 0.0, n: float = math.inf) -> Pid:
        """From (26): kp (1 + 1 / (Ti s) + Td s), the derivative filtered at `n` rad/s."""
        return cls(kp, kp / Ti, kp * Td, n)

    @property
    def Ti(self) -> float:
        """Integral time, s; inf without an integral part."""
        return self.kp / self.ki if self.ki else math.inf

    @property
    def Td(self) -> float:
        """Derivative time, s."""
        return self.kd / self.kp if self.kp else 0.0

    def transfer_function(self) -> control.TransferFunction:
        """From -y to u, as a python-control object: what decides stability, whatever the set-point weights.

        With b = c = 1 it is also the one from error to u. Improper with an ideal derivative.
        """
        return self._from(1.0, 1.0)

    def setpoint_transfer_function(self) -> control.TransferFunction:
        """From the set-point r to u."""
        return self._from(self.b, self.c)

    def _from(self, b: float, c: float) -> control.TransferFunction:
        """(kp b s + ki) / s + kd c N s / (s + N), without the factors that are not there."""
        import control

        parts = control.TransferFunction([self.kp * b], [1.0])
        if self.ki:
            parts = control.TransferFunction([self.kp * b, self.ki], [1.0, 0.0])
        if self.kd * c:
            filtered = math.isfinite(self.n)
            derivative = ([self.kd * c * self.n, 0.0], [1.0, self.n]) if filtered else ([self.kd * c, 0.0], [1.0])
            parts = parts + control.TransferFunction(*derivative)
        return parts


PID_AUTO = Pid(4.36210, 0.38231, 0.99919, 37.2929)
"""Table 2: chosen by MATLAB's tuner."""

PID_APPROX = Pid.ideal(2.2880, 0.3178, 0.1222)
"""Table 3: from the reaction curve, in the ideal form (26)."""
