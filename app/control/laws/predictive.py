"""Model predictive control: it knows the efforts' limits and the reference ahead, and plans within them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from app.control.laws.law import Array, Law, Seen, Setup, inertial_of_joints, joint_bias
from app.robots.dynamics import Terms


class Predictive(Law):
    """f = M(q)(qdd_d + w) + H: with the bias cancelled each joint error is a double integrator, edd = -w.

    Over N steps of length T the cost is sum of w_e^4 e^2 + (4 zeta^2 - 2) w_e^2 ed^2 + w^2 per joint, which without
    limits is a linear law with bandwidth w_e and damping zeta; its limits are those of the efforts,
    |f_ref(j) + f - f_ref(0) + M w_j| <= f_max for each step j ahead. Everything in shares of the peak effort.
    """

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        reference, tuning = setup.reference, setup.tuning
        self._joints, self._rates = reference.joints.tolist(), reference.joint_rates.tolist()
        self._accelerations = reference.joint_accelerations.tolist()
        self._feed = setup.model.inverse(reference.pose, reference.rate, reference.acceleration) / setup.effort_limit
        self._steps = tuning.horizon
        slowest = min(tuning.bandwidth_hz)
        span = 1.0 / slowest / setup.period_s / self._steps
        self._stride = tuning.horizon_step or max(1, round(span))
        self._scale = setup.effort_limit / np.array(tuning.inertia)
        self._hessian, self._slope = self._cost()
        self._unlimited = -np.linalg.solve(self._hessian, self._slope)
        self._trace: list[list[float]] = []

    def effort(self, k: int, state: Terms, applied: Sequence[float]) -> Sequence[float]:
        errors = [wanted - is_ for wanted, is_ in zip(self._joints[k], state.joints, strict=True)]
        rates = [wanted - is_ for wanted, is_ in zip(self._rates[k], state.joint_rates, strict=True)]
        base = state.effort(state.pose_acceleration(self._accelerations[k]))
        mass = np.array([state.inertial(state.to_pose(unit)) for unit in np.eye(len(base)).tolist()]).T
        shares = self._plan(k, np.array(errors + rates), np.array(base), mass)
        push = self._scale * shares[: len(base)]
        self._trace.append(push.tolist())
        return (np.array(base) + mass @ push).tolist()

    def _plan(self, k: int, state: Array, base: Array, mass: Array) -> Array:
        """(N n) accelerations w over the horizon, step by step, in units of `_scale`."""
        limit = self.setup.effort_limit
        n, rows = len(base), np.minimum(k + self._stride * np.arange(self._steps), len(self._feed) - 1)
        ahead = (self._feed[rows] - self._feed[k] + base / limit).ravel()
        through = mass * self._scale / limit[:, None]
        free = self._unlimited @ state
        shares = ahead + (free.reshape(-1, n) @ through.T).ravel()
        if np.abs(shares).max() <= 1.0:
            return free
        import daqp

        answer, _, flag, _ = daqp.solve(
            self._hessian, self._slope @ state, np.kron(np.eye(self._steps), through), 1.0 - ahead, -1.0 - ahead
        )
        return answer if flag > 0 else free

    def _cost(self) -> tuple[Array, Array]:
        """Hessian (N n, N n) and the gradient's dependence (N n, 2 n) on the errors and their rates."""
        tuning, step = self.setup.tuning, self._stride * self.setup.period_s
        n, steps = len(tuning.inertia), self._steps
        hessian, slope = np.zeros((steps, n, steps, n)), np.zeros((steps, n, 2, n))
        for axis, (hertz, zeta, scale) in enumerate(
            zip(tuning.bandwidth_hz, tuning.damping, self._scale.tolist(), strict=True)
        ):
            square, linear = _tracking_cost(math.tau * hertz, zeta, step, steps)
            hessian[:, axis, :, axis] = square
            slope[:, axis, :, axis] = linear / scale
        return hessian.reshape(steps * n, -1), slope.reshape(steps * n, -1)

    def components(self, seen: Seen) -> dict[str, Array]:
        terms = seen.terms
        return {
            "qp": inertial_of_joints(terms, np.array(self._trace)),
            "M": inertial_of_joints(terms, self.setup.reference.joint_accelerations),
            "n": joint_bias(terms, len(seen.joints)),
        }


def _tracking_cost(omega: float, zeta: float, step: float, steps: int) -> tuple[Array, Array]:
    """(N, N) and (N, 2) of 1/2 w' H w + w' G (e, ed) for one double integrator; beyond the horizon goes the cost
    of the unlimited optimum (discrete Riccati equation)."""
    a, b = np.array([[1.0, step], [0.0, 1.0]]), np.array([[-0.5 * step * step], [-step]])
    weight, final = _weights(omega, zeta, a, b)
    powers = [np.linalg.matrix_power(a, j) for j in range(steps + 1)]
    free = np.concatenate(powers[1:])
    forced = np.zeros((2 * steps, steps))
    for row in range(steps):
        for column in range(row + 1):
            forced[2 * row : 2 * row + 2, column : column + 1] = powers[row - column] @ b
    cost = np.kron(np.eye(steps), weight)
    cost[-2:, -2:] = final
    return forced.T @ cost @ forced + np.eye(steps), forced.T @ cost @ free


def _weights(omega: float, zeta: float, a: Array, b: Array) -> tuple[Array, Array]:
    """(2, 2) of the error and its rate within the horizon and at its end, such that the first step's gain on the
    error is omega^2: steps make the optimum softer than in continuous time, so the weights aim higher."""
    from scipy.linalg import solve_discrete_are

    aim = omega
    for _ in range(8):
        weight = np.diag([aim**4, max(4.0 * zeta * zeta - 2.0, 0.0) * aim**2])
        final = solve_discrete_are(a, b, weight, np.eye(1))
        gain = float((b.T @ final @ a)[0, 0] / (1.0 + (b.T @ final @ b)[0, 0]))
        aim *= omega / math.sqrt(abs(gain))
    return weight, final
