"""The output-error search: K, T1, T2 (and, if asked, the state at the start) whose simulation is nearest the data.

Arrays of `parameters` are (3,) K, T1, T2 or (5,) K, T1, T2, y0, v0. The search moves log K, log T1, log T2 instead.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.control.identification.open_loop import open_loop
from app.control.identification.samples import IdentificationError, Samples
from app.control.motor import Motor

Array = NDArray[np.float64]
Start = tuple[float, float, float]

USUAL_START = (5.0, 2.0, 0.5)
GOOD_FIT_PERCENT = 90.0
"""A start that ends below it is not relied on alone."""
HARDLY_DROOPS = 1e-3
"""T2 as a part of T1^2 below which its logarithm has hardly any slope."""
CONFIDENCE = 0.95


class Found(NamedTuple):
    """Where a search ended."""

    parameters: Array
    residuals: Array
    """(n,) model minus measurement."""
    evaluations: int
    settled: bool


def nearest_model(data: Samples, start: Start | None, state: tuple[float, ...] = ()) -> Found:
    """The parameters with the smallest sum of squares; `state` is () for rest, or a first guess of y0 and v0.

    A search may end in the wrong place: an odd start can lead to a slow oscillation, and where the droop has nearly
    vanished its logarithm stalls. Both are tried again, the first from the usual start, the second from more droop.
    """
    usual = np.append(_usual_start(data), state)
    found = _search(data, usual if start is None else np.append(_checked(start), state))
    if start is not None and fit_percent(found.residuals, data) < GOOD_FIT_PERCENT:
        found = _better(found, _search(data, usual))
    K, T1, T2, *rest = found.parameters.tolist()
    droop = HARDLY_DROOPS * T1**2
    if droop > T2:
        found = _better(found, _search(data, np.array([K, T1, droop, *rest])))
    return found


def fit_percent(residuals: Array, data: Samples) -> float:
    """100 (1 - |y - y_M| / |y - mean y|)."""
    return 100.0 * float(1.0 - np.linalg.norm(residuals) / np.linalg.norm(data.y - data.y.mean()))


def usual_response(data: Samples) -> Array:
    """(n,) what the motor of the usual start, with K = 1, would have done."""
    _, T1, T2 = USUAL_START
    return open_loop(Motor(1.0, T1, T2), data.u, data.period_s)


def uncertainty(found: Found, data: Samples) -> tuple[Array, Array]:
    """(3,) standard deviations of K, T1, T2 and (3,) half-widths of their intervals: s^2 (J^T J)^-1, Student's t.

    J is taken in the parameters themselves: in the logarithm of a T2 near zero it would vanish.
    """
    from scipy.special import stdtrit

    jacobian = _jacobian(found.parameters, data)
    length = np.linalg.norm(jacobian, axis=0)
    scale = np.where(length > 0.0, length, 1.0)
    _, singular, directions = np.linalg.svd(jacobian / scale, full_matrices=False)
    # Directions that the data do not show at all get a huge variance instead of a division by zero.
    singular = np.maximum(singular, np.finfo(float).eps * singular[0])
    spread = np.linalg.norm(directions / singular[:, None], axis=0) / scale
    freedom = len(data.y) - len(found.parameters)
    deviations = (spread * np.sqrt(found.residuals @ found.residuals / freedom))[:3]
    return deviations, deviations * float(stdtrit(freedom, 0.5 + CONFIDENCE / 2.0))


def _search(data: Samples, first: Array) -> Found:
    from scipy.optimize import least_squares

    bounds = _bounds(data, len(first))
    end = least_squares(
        lambda unknowns: _output(_natural(unknowns), data) - data.y,
        np.clip(np.append(np.log(first[:3]), first[3:]), *bounds),
        bounds=tuple(bounds),
        method="trf",
        x_scale="jac",
    )
    return Found(_natural(end.x), np.asarray(end.fun), int(end.nfev), bool(end.success))


def _better(one: Found, other: Found) -> Found:
    best = min(one, other, key=lambda found: float(found.residuals @ found.residuals))
    return best._replace(evaluations=one.evaluations + other.evaluations)


def _usual_start(data: Samples) -> Array:
    """(3,) with the K that fits best, if it is positive."""
    K, T1, T2 = USUAL_START
    response = usual_response(data)
    gain = float(response @ data.y / (response @ response))
    return np.array([gain if gain > 0.0 else K, T1, T2])


def _checked(start: Start) -> Array:
    if len(start) != 3 or not all(0.0 < value < np.inf for value in start):
        raise IdentificationError("The start must be three positive numbers: K, T1 and T2.")
    return np.array(start, dtype=float)


def _bounds(data: Samples, count: int) -> Array:
    """(2, count) of the unknowns: motion so fast that it falls between the samples is left out."""
    fastest = np.pi / data.period_s
    bounds = np.full((2, count), [[-np.inf], [np.inf]])
    bounds[:, :3] = np.log([[1e-9, 1e-9, 1e-9], [1e12, 30.0 * fastest, fastest**2]])
    return bounds


def _natural(unknowns: Array) -> Array:
    """From log K, log T1, log T2, y0, v0."""
    return np.append(np.exp(unknowns[:3]), unknowns[3:])


def _output(parameters: Array, data: Samples) -> Array:
    K, T1, T2, *state = parameters.tolist()
    return open_loop(Motor(K, T1, T2), data.u, data.period_s, *state)


def _jacobian(parameters: Array, data: Samples) -> Array:
    """(n, p) central differences; T2 moves on the scale that T1 gives it, since it may be next to nothing."""
    K, T1, T2, *state = parameters.tolist()
    steps = np.array([1e-4 * K, 1e-4 * T1, 1e-4 * max(T2, HARDLY_DROOPS * T1**2), *np.ones(len(state))])
    columns = [_output(parameters + move, data) - _output(parameters - move, data) for move in np.diag(steps)]
    return np.column_stack(columns) / (2.0 * steps)
