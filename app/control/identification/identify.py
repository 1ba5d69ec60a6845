"""Finding a motor's K, T1 and T2 from a recording: the output-error method.

The model y'' + T1 y' + T2 y = K u is simulated exactly (zero-order hold) from the measured input alone, and its
parameters are moved until the sum of squares of y_M - y is smallest. Their logarithms are the unknowns, so that
they stay positive and absurd starts do no harm. See Ljung, System Identification, 2nd ed., chapters 7 and 9.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.control.identification.advice import data_advice, fit_advice
from app.control.identification.output_error import fit_percent, nearest_model, uncertainty
from app.control.identification.samples import even_samples
from app.control.motor import Motor, OutputUnit

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Identification:
    """A motor, and how far it can be trusted."""

    motor: Motor
    confidence: Array
    """(3, 2) 95 % intervals of K, T1 and T2, if the residuals are white."""
    standard_deviations: Array
    """(3,) of K, T1 and T2."""
    fit_percent: float
    """100 (1 - |y - y_M| / |y - mean y|): 100 is perfect, 0 no better than a constant."""
    residuals: Array
    """(n,) y_M - y at the times `t`."""
    model_output: Array
    """(n,) y_M."""
    evaluations: int
    """Simulations of the whole recording, those for derivatives not counted."""
    warnings: tuple[str, ...]
    """Plain sentences; none if nothing is doubtful."""
    t: Array
    """(n,) s: the measured times, or the even ones if those jittered."""
    initial_state: tuple[float, float]
    """Output and speed at the first sample; zeros unless they were estimated."""


def identify(
    t: ArrayLike,
    u: ArrayLike,
    y: ArrayLike,
    *,
    unit: OutputUnit = "deg",
    start: tuple[float, float, float] | None = None,
    initial_state: Literal["zero", "estimated"] = "zero",
) -> Identification:
    """Identify a motor from (n,) times in s, volts (each held until the next time) and outputs in `unit`.

    `start` is a first guess of K, T1, T2. IdentificationError, in one sentence, for data that cannot be used.
    """
    data = even_samples(t, u, y)
    at_rest = initial_state == "zero"
    found = nearest_model(data, start, () if at_rest else (float(data.y[0]), 0.0))
    deviations, half_widths = uncertainty(found, data)
    values = found.parameters[:3]
    K, T1, T2, *state = found.parameters.tolist()
    return Identification(
        motor=Motor(K, T1, T2, unit),
        confidence=np.column_stack([np.maximum(values - half_widths, 0.0), values + half_widths]),
        standard_deviations=deviations,
        fit_percent=fit_percent(found.residuals, data),
        residuals=found.residuals,
        model_output=data.y + found.residuals,
        evaluations=found.evaluations,
        warnings=tuple(data_advice(data, at_rest) + fit_advice(found, half_widths, data)),
        t=data.t,
        initial_state=(state[0], state[1]) if state else (0.0, 0.0),
    )
