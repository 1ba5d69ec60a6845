"""The paper's (15)-(19) and (23) as it prints them, for any arm and rod: what its slips do can be computed."""

from __future__ import annotations

import numpy as np

from app.robots.par4 import ARM_AZIMUTHS, Par4, Par4Geometry
from app.robots.robot import Array
from app.robots.rotary_arm import outer_angle


def coefficients(poses: Array, geometry: Par4Geometry) -> tuple[Array, Array, Array]:
    """E, F and G of poses (..., 4) in m and rad, each (..., arms): E sin q + F cos q + G = 0.

    The printed sums are those of |u|^2, u = P + DP - B, multiplied out.
    """
    arms = np.array([[np.cos(a), np.sin(a), 0.0] for a in ARM_AZIMUTHS])
    platform = Par4(Par4Geometry()).platform
    u = platform.joints(poses) - geometry.R * arms - [0.0, 0.0, geometry.B_z]
    E, F = 2.0 * geometry.L * u[..., 2], -2.0 * geometry.L * (u * arms).sum(-1)
    return E, F, (u * u).sum(-1) + geometry.L**2 - geometry.l**2


def arm_angles(poses: Array, geometry: Par4Geometry, printed_f3: bool = False) -> Array:
    """(..., arms) rad; NaN where a loop cannot close. `printed_f3` takes the sign of d_3 in (18) as it stands."""
    E, F, G = coefficients(poses, geometry)
    if printed_f3:
        F[..., 2] -= 4.0 * geometry.L * geometry.d_i * np.cos(ARM_AZIMUTHS[2])
    return outer_angle(E, F, G)
