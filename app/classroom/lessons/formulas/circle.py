"""The Par4 paper's four drives on a circle, its Table 4."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, get_args

from app.classroom.lessons.formulas.registry import Quantity, formula

if TYPE_CHECKING:
    from app.simulation.run import Run

PERCENT = 100.0
"""The paper's limit of the control signal."""
DRIVE_NAMES = ("q1", "q2", "q3", "q4")


@formula("circle")
def circle(
    tuning: str, start: str = "rest", supply: float = 12.0, as_in_paper: bool = False, anti_windup: str = "none"
) -> dict[str, Quantity]:
    """ise (deg^2 s) of one lap of 100 s, of all drives together and of q1 to q4; jump (%), its share in the first
    second; first_1 to first_4 (deg), the errors with which the drives begin. `tuning` as the Control tab calls it.
    """
    run = _run(tuning, start, supply, as_in_paper, anti_windup)
    squares = run.joint_error**2
    jump = float(squares[run.t < 1.0].sum() / squares.sum())
    return {
        "ise": Quantity(float(run.ise.sum()), "deg^2 s"),
        **{name: Quantity(float(ise), "deg^2 s") for name, ise in zip(DRIVE_NAMES, run.ise, strict=True)},
        "jump": Quantity(100.0 * jump, "%"),
        **{f"first_{k}": Quantity(float(abs(error)), "deg") for k, error in enumerate(run.joint_error[0], 1)},
    }


@functools.lru_cache(maxsize=16)
def _run(tuning: str, start: str, supply: float, as_in_paper: bool, anti_windup: str) -> Run:
    from app.control import PAR4_MOTOR, PID_APPROX
    from app.control.sampled_pid import Sampling
    from app.control.tuning.methods import METHODS, TABLE_3, Wish
    from app.simulation.hardware import Hardware
    from app.simulation.tracking import Start, Task, follow_sampled, follow_simulink

    if tuning not in METHODS:
        raise ValueError(f"the methods are {', '.join(METHODS)}.")
    if start not in get_args(Start) or anti_windup not in ("none", "clamping", "back-calculation"):
        raise ValueError("start is rest, reference or smooth; anti_windup none, clamping or back-calculation.")
    task = Task(start=start)  # pyright: ignore[reportArgumentType]
    pid = METHODS[tuning].tune(PAR4_MOTOR, Wish(0.2, 0.8)).pid
    if as_in_paper:
        return follow_simulink(task, PID_APPROX if tuning == TABLE_3 else pid, PERCENT)
    return follow_sampled(task, PAR4_MOTOR, pid, Sampling(anti_windup=anti_windup), Hardware(supply_v=supply))
