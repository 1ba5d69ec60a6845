"""The motor of a real joint, from the samples of TEST pulses: y'' + T1 y' + T2 y = K u, one motor for all pulses.

Every pulse, and every part of one that a lost message cut in two, starts at a place and speed of its own. These and K
enter linearly, so that only T1 and T2 are searched. T2, which real motors do not have, is kept at 0 unless the data
contradict that.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.control import Motor
from app.control.identification import Identification, IdentificationError
from app.control.identification.advice import fit_advice
from app.control.identification.open_loop import open_loop
from app.control.identification.output_error import Found, fit_percent
from app.control.identification.recordings import Recording as ControlRecording
from app.control.identification.samples import FEWEST_SAMPLES, Samples, even_samples
from app.link.errors import LinkError
from app.link.twin.recording import Recording, TestSamples
from app.robots import ROBOTS
from app.simulation.run import SHOWN

Array = NDArray[np.float64]

GAP = 1.5
"""A step longer than this many usual ones separates two pieces."""
POLES = np.geomspace(0.5, 200.0, 14)
"""T1 (1/s) at which the search begins."""
HARDLY_DROOPS = 1e-4
"""T2 as a part of T1^2 that is not worth looking for."""


class DriveIdentification(NamedTuple):
    """For the control lab: what was recorded, in volts and deg or mm, and the motor in it."""

    recording: ControlRecording
    found: Identification


class _Fit(NamedTuple):
    motor: Motor
    solution: Array
    """(1 + 2 pieces,) K, then place and speed at the start of each piece."""
    residuals: Array
    """(n,) model minus measurement, all pieces."""
    deviations: Array
    """(3,) standard deviations of K, T1, T2."""
    half_widths: Array
    """(3,) of their 95 % intervals."""
    evaluations: int


def identify_drive(recordings: Sequence[Recording]) -> DriveIdentification:
    """The motor from the TEST pulses of one joint, in one recording or in several.

    Raises:
        LinkError: without samples, with samples of different joints, or where no motor can be found in them.
    """
    tests = [recording.samples for recording in recordings if recording.samples is not None]
    if not tests:
        raise LinkError("There are no samples of a pulse; run a pulse on a joint first.")
    if len({test.joint for test in tests}) > 1 or len({recording.robot for recording in recordings}) > 1:
        raise LinkError("These pulses are of different joints; give those of one joint.")
    unit, factor = SHOWN[ROBOTS[recordings[0].robot].build.joint_unit]
    pieces = [piece for r in recordings if r.samples for piece in _pieces(r.samples, r.supply_v, factor)]
    if not pieces:
        raise LinkError(f"No pulse has {FEWEST_SAMPLES} samples in which the joint moves; make the pulses longer.")
    fit = _best(pieces, unit)
    together = _joined(pieces)
    found = Found(np.array([fit.motor.K, fit.motor.T1, fit.motor.T2]), fit.residuals, fit.evaluations, True)
    values = found.parameters
    identification = Identification(
        motor=fit.motor,
        confidence=np.column_stack([np.maximum(values - fit.half_widths, 0.0), values + fit.half_widths]),
        standard_deviations=fit.deviations,
        fit_percent=fit_percent(fit.residuals, together),
        residuals=fit.residuals,
        model_output=together.y + fit.residuals,
        evaluations=fit.evaluations,
        warnings=tuple(fit_advice(found, fit.half_widths, together)),
        t=together.t,
        initial_state=(float(fit.solution[1]), float(fit.solution[2])),
    )
    return DriveIdentification(ControlRecording(together.t, together.u, together.y, unit), identification)


def _pieces(test: TestSamples, supply_v: float, factor: float) -> list[Samples]:
    """Evenly sampled parts in which the joint was driven and moved; volts, and deg or mm."""
    steps = np.diff(test.t)
    usual = float(np.median(steps)) if len(steps) else math.inf
    cuts = np.flatnonzero(steps > GAP * usual) + 1
    pieces = []
    for part in np.split(np.arange(len(test.t)), cuts):
        u, y = supply_v * test.drive[part], factor * test.position[part]
        if len(part) >= FEWEST_SAMPLES and np.ptp(y) > 0.0 and np.any(u[:-1] != 0.0):
            try:
                pieces.append(even_samples(test.t[part], u, y))
            except IdentificationError as error:
                raise LinkError(str(error)) from None
    return pieces


def _joined(pieces: list[Samples]) -> Samples:
    """One after another; where the clock begins anew (several recordings) a second lies between."""
    times, end = [], -math.inf
    for piece in pieces:
        later = max(0.0, end + 1.0 - float(piece.t[0])) if piece.t[0] <= end else 0.0
        times.append(piece.t + later)
        end = float(times[-1][-1])
    u, y = (np.concatenate([getattr(piece, name) for piece in pieces]) for name in ("u", "y"))
    return Samples(np.concatenate(times), u, y, pieces[0].period_s)


def _best(pieces: list[Samples], unit: str) -> _Fit:
    """Without droop, unless the interval of T2 excludes 0."""
    plain = _search(pieces, unit, 0.0)
    droop = _droop(pieces, plain)
    if droop <= HARDLY_DROOPS * plain.motor.T1**2:
        return plain
    free = _search(pieces, unit, droop)
    return free if free.half_widths[2] < free.motor.T2 else plain


def _droop(pieces: list[Samples], plain: _Fit) -> float:
    """T2 by one linear step from a fit without it; 0 where it is not significant."""
    solution, T1 = plain.solution, plain.motor.T1
    jacobian = _jacobian(pieces, solution, T1, 0.0, droops=True)
    step = -np.linalg.lstsq(jacobian, plain.residuals, rcond=None)[0][-1]
    _, half_widths = _uncertainty(jacobian, solution, plain.residuals, droops=True)
    return float(step) if step > half_widths[2] else 0.0


def _search(pieces: list[Samples], unit: str, droop: float) -> _Fit:
    """The best motor; with a droop near the one given, if that is not 0."""
    from scipy.optimize import least_squares

    def residuals(unknowns: Array) -> Array:
        return _linear(pieces, *_natural(unknowns))[1]

    start = math.log(min(POLES, key=lambda T1: float(np.sum(_linear(pieces, float(T1), droop)[1] ** 2))))
    first = [start, math.log(droop)] if droop else [start]
    end = least_squares(residuals, first, x_scale="jac", diff_step=1e-5)
    T1, T2 = _natural(end.x)
    solution, rest = _linear(pieces, T1, T2)
    K = float(solution[0])
    if not (K > 0.0 and 0.0 < T1 < 1e4):
        raise LinkError("The joint moves against the voltage; swap the motor's wires, or change the sign of its scale.")
    jacobian = _jacobian(pieces, solution, T1, T2, droops=bool(droop))
    deviations, half_widths = _uncertainty(jacobian, solution, rest, droops=bool(droop))
    return _Fit(Motor(K, T1, T2, unit), solution, rest, deviations, half_widths, int(end.nfev) + len(POLES))


def _natural(unknowns: Array) -> tuple[float, float]:
    """T1 and T2 from their logarithms; T2 is 0 where it is not looked for."""
    values = np.exp(np.minimum(unknowns, 20.0)).tolist()
    return values[0], values[1] if len(values) > 1 else 0.0


def _basis(pieces: list[Samples], T1: float, T2: float) -> Array:
    """(n, 1 + 2 pieces): answer to the voltage for K = 1, then to each piece's own start in place and speed."""
    total, longest = sum(len(piece.t) for piece in pieces), max(len(piece.t) for piece in pieces)
    basis, row = np.zeros((total, 1 + 2 * len(pieces))), 0
    unit_motor, period_s, still = Motor(1.0, T1, T2), pieces[0].period_s, np.zeros(longest)
    place = open_loop(unit_motor, still, period_s, 1.0, 0.0)
    speed = open_loop(unit_motor, still, period_s, 0.0, 1.0)
    for number, piece in enumerate(pieces):
        rows, first = slice(row, row + len(piece.t)), 1 + 2 * number
        basis[rows, 0] = open_loop(unit_motor, piece.u, period_s)
        basis[rows, first], basis[rows, first + 1] = place[: len(piece.t)], speed[: len(piece.t)]
        row = rows.stop
    return basis


def _linear(pieces: list[Samples], T1: float, T2: float) -> tuple[Array, Array]:
    """Best (K, starts) for given T1 and T2, and the (n,) residuals model minus measurement."""
    basis = _basis(pieces, T1, T2)
    y = np.concatenate([piece.y for piece in pieces])
    scale = np.linalg.norm(basis, axis=0)
    scale[scale == 0.0] = 1.0
    solution = np.linalg.lstsq(basis / scale, y, rcond=None)[0] / scale
    return solution, basis @ solution - y


def _jacobian(pieces: list[Samples], solution: Array, T1: float, T2: float, *, droops: bool) -> Array:
    """(n, 2 + 2 pieces + droops) derivatives of the output: K, the starts, T1, and T2 if it is looked for."""
    step = 1e-4 * max(T2, 1e-3 * T1**2)
    ends = [(T1 * (1.0 + 1e-4), T2, T1 * (1.0 - 1e-4), T2)]
    ends += [(T1, T2 + step, T1, max(T2 - step, 0.0))] if droops else []
    slopes = [(_basis(pieces, a, b) - _basis(pieces, c, d)) @ solution / (a - c + b - d) for a, b, c, d in ends]
    return np.column_stack([_basis(pieces, T1, T2), *slopes])


def _uncertainty(jacobian: Array, solution: Array, residuals: Array, *, droops: bool) -> tuple[Array, Array]:
    """(3,) standard deviations of K, T1, T2 and half-widths of their 95 % intervals, all starts estimated too."""
    from scipy.special import stdtrit

    scale = np.linalg.norm(jacobian, axis=0)
    scale[scale == 0.0] = 1.0
    inverse = np.linalg.pinv(jacobian / scale)
    freedom = max(len(residuals) - jacobian.shape[1], 1)
    spread = np.linalg.norm(inverse, axis=1) / scale * math.sqrt(float(residuals @ residuals) / freedom)
    place = len(solution)
    deviations = np.array([spread[0], spread[place], spread[place + 1] if droops else 0.0])
    return deviations, deviations * float(stdtrit(freedom, 0.975))
