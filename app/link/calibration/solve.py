"""Least squares with priors: the most likely unknowns, how far they can be trusted, and whether they should be.

In units of the tolerances the unknowns are z, the prior is |z|^2, and with residuals in units of the noise the
posterior is normal with covariance C = (I + A^T A)^-1, A the derivatives of the residuals.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from app.link.calibration.measurements import Measurements
from app.link.calibration.problem import Problem, observed
from app.link.errors import LinkError
from app.robots import GeometryError

Array = NDArray[np.float64]

CONFIDENCE = 1.959964
"""Standard deviations to either side that hold 95 % of a normal distribution."""
ROW_CHANCE = 0.01
"""Probability of naming any good row an outlier."""
FIT_CHANCE = 1e-3
"""A fit is bad if chance alone would be worse so rarely."""
HUBER = 2.5
"""A row's distance, in standard deviations, from which the robust fit gives it less weight."""
NO_WEIGHT = 1e-6
ROUNDS = 6
STARTS = 4
TOO_FAR = 1e6
"""Residual of joints that do not assemble: the search turns back."""


@dataclass(frozen=True, eq=False)
class Solution:
    """p unknowns from k rows."""

    problem: Problem
    data: Measurements
    values: Array
    """(p,) rad and m."""
    covariance: Array
    """(p, p)"""
    information: Array
    """(p, p) A^T A: what the measurements say, in units of the tolerances."""
    residuals: Array
    """(k, 4) measured minus predicted: m, m, m, rad; 0 where nothing was measured."""
    weights: Array
    """(k,) of the rows; 1 but in a robust fit."""
    outliers: tuple[int, ...] = ()
    """Names of the rows that do not fit to the others, the worst first."""
    chance: float = 1.0
    """Probability that chance alone fits worse, in a robust fit without the outliers; NaN: nothing left to check."""
    robust: bool = False

    @property
    def deviations(self) -> Array:
        """(p,) standard deviations."""
        return np.sqrt(np.diag(self.covariance))

    @property
    def intervals(self) -> Array:
        """(p, 2) that hold each unknown with 95 %."""
        half = CONFIDENCE * self.deviations
        return np.column_stack([self.values - half, self.values + half])

    @property
    def correlation(self) -> Array:
        """(p, p)"""
        return self.covariance / np.outer(self.deviations, self.deviations)

    @property
    def shrinkage(self) -> Array:
        """(p,) standard deviation after by before: 1 for what the measurements do not show."""
        return self.deviations / self.problem.tolerances

    @property
    def tool_rms_m(self) -> float:
        """What is left between measured and predicted tool, a coordinate."""
        return float(np.sqrt(np.mean(self.residuals[:, :3] ** 2)))

    @property
    def trusted(self) -> bool:
        """Whether the measurements fit to one machine. Never send a solution to a board that is not."""
        return self.chance >= FIT_CHANCE and (self.robust or not self.outliers)


def solve(problem: Problem, data: Measurements, *, robust: bool = False) -> Solution:
    """The unknowns from all rows; `robust` gives rows that stand out less weight.

    Raises:
        LinkError: for too few rows, for joints that do not assemble, or of another robot.
    """
    _check(problem, data)
    plain = _fitted(problem, data, _start(problem, data))
    outliers = _outliers(plain)
    if not robust:
        return replace(plain, outliers=outliers, chance=_chance(plain))
    others = _fitted(problem, data.without(outliers), plain.values) if outliers else plain
    gentle = _gently_fitted(problem, data, others.values, outliers)
    return replace(gentle, outliers=outliers, chance=_chance(others), robust=True)


def scaled_jacobian(problem: Problem, values: Array, joints: Array, noise: Array) -> Array:
    """(k, 4, p) A: derivatives in units of noise (k, 4) and tolerances."""
    return problem.jacobian(values, joints) / noise[..., None] * problem.tolerances


def _check(problem: Problem, data: Measurements) -> None:
    if problem.robot != data.robot:
        raise LinkError(f"These measurements are of {data.robot}, not of {problem.robot}; choose the same robot.")
    p = len(problem.unknowns)
    if data.values <= p:
        needed = p // 3 + 1
        raise LinkError(f"{len(data.lines)} rows are too few for {p} unknowns; measure at least {needed} poses.")


def _start(problem: Problem, data: Measurements) -> Array:
    """Values with which all joints assemble: those assumed, or where some do not, those that fit to the others."""
    values = problem.assumed
    for _ in range(STARTS):
        open_loops = np.isnan(problem.poses(values, data.joints)).any(axis=1)
        if not open_loops.any():
            return values
        others = np.flatnonzero(~open_loops)
        if len(others) < max(3, len(data.lines) // 2):
            break
        values = _fitted(problem, data.rows(others.tolist()), values).values
    line = data.lines[int(np.argmax(open_loops))]
    raise LinkError(f"Row {line}: the robot cannot stand with these joints; correct or delete the row.")


def _fitted(problem: Problem, data: Measurements, start: Array) -> Solution:
    return _weighted(problem, data, start, np.ones(len(data.lines)))


def _gently_fitted(problem: Problem, data: Measurements, start: Array, outliers: Sequence[int]) -> Solution:
    """Huber's weights, and next to none for outliers."""
    good = ~np.isin(data.lines, outliers)
    solution = _weighted(problem, data, start, np.where(good, 1.0, NO_WEIGHT))
    for _ in range(ROUNDS):
        gentle = np.minimum(1.0, HUBER / np.maximum(_distances(solution), 1e-9))
        solution = _weighted(problem, data, solution.values, np.where(good, gentle, NO_WEIGHT))
    return solution


def _weighted(problem: Problem, data: Measurements, start: Array, weights: Array) -> Solution:
    from scipy.optimize import least_squares

    measured, noise = observed(problem, data)
    noise = noise / np.sqrt(weights)[:, None]
    size, p = problem.tolerances, len(problem.unknowns)

    def misfit(z: Array) -> Array:
        try:
            rest = (measured - problem.predict(problem.assumed + size * z, data.joints)) / noise
        except GeometryError:
            rest = np.full_like(measured, np.nan)
        return np.concatenate([np.where(np.isnan(rest), TOO_FAR, rest).ravel(), z])

    def slope(z: Array) -> Array:
        A = scaled_jacobian(problem, problem.assumed + size * z, data.joints, noise)
        return np.vstack([-A.reshape(-1, p), np.eye(p)])

    edges = np.array([[u.low, u.high] for u in problem.unknowns]).T
    bounds = tuple((edges - problem.assumed) / size)
    found = least_squares(misfit, (start - problem.assumed) / size, jac=slope, bounds=bounds, xtol=1e-10)  # pyright: ignore[reportArgumentType]
    values = problem.assumed + size * found.x
    A = scaled_jacobian(problem, values, data.joints, noise).reshape(-1, p)
    information = A.T @ A
    covariance = np.outer(size, size) * np.linalg.inv(np.eye(p) + information)
    residuals = np.where(np.isfinite(noise), measured - problem.predict(values, data.joints), 0.0)
    return Solution(problem, data, values, covariance, information, residuals, weights)


def _distances(solution: Solution) -> Array:
    """(k,) how far each row is from its prediction, in standard deviations of the noise."""
    _, noise = observed(solution.problem, solution.data)
    return np.linalg.norm(solution.residuals / noise, axis=1)


def _outliers(solution: Solution) -> tuple[int, ...]:
    """The worst row goes and all is fitted anew, until the others agree; at most a third of the rows."""
    found: list[int] = []
    rest = solution
    for _ in range(len(solution.data.lines) // 3):
        line = _worst_row(rest)
        if line is None or rest.data.values - 4 <= len(solution.problem.unknowns):
            break
        found.append(line)
        rest = _fitted(solution.problem, solution.data.without(found), solution.values)
    return tuple(found)


def _worst_row(solution: Solution) -> int | None:
    """The row least likely by the others' verdict, if it is too unlikely for so many rows."""
    from scipy.special import chdtrc

    problem, data = solution.problem, solution.data
    _, noise = observed(problem, data)
    A = scaled_jacobian(problem, solution.values, data.joints, noise)
    C = solution.covariance / np.outer(problem.tolerances, problem.tolerances)
    r = solution.residuals / noise
    # the fit follows a row in part: its residual has the covariance I - A C A^T of the noise's
    S = np.eye(4) - np.einsum("kip,pq,kjq->kij", A, C, A)
    square = np.einsum("ki,ki->k", r, np.linalg.solve(S + 1e-9 * np.eye(4), r[..., None])[..., 0])
    unlikely = chdtrc(np.isfinite(noise).sum(axis=1), square)
    worst = int(np.argmin(unlikely))
    return data.lines[worst] if unlikely[worst] < ROW_CHANCE / len(data.lines) else None


def _chance(solution: Solution) -> float:
    """Of the sum of squares, the unknowns that the data determine taken off its freedom."""
    from scipy.special import chdtrc

    shown = np.linalg.eigvalsh(solution.information)
    freedom = solution.data.values - float(np.sum(shown / (1.0 + shown)))
    if freedom < 0.5:
        return float("nan")
    return float(chdtrc(freedom, float(np.sum(_distances(solution) ** 2))))
