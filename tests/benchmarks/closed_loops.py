"""Speed of the simulations under control, as ratios in one run.

    python tests/benchmarks/closed_loops.py [--duration-s 100] [--repeats 5] [--json]

The Par4's circle, four drives: as the paper simulated it and as a microcontroller controls it, each against the
obvious loop in NumPy over all drives and the obvious loop in objects, drive by drive; without a limit the sampled
one also against python-control's `forced_response` of the closed loop, four calls. The references are there before
the clock starts, except in the seconds of the whole run. Then the step study, for each of its questions.
"""

from __future__ import annotations

import json
import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import numpy as np
import tyro

from app.control import PAR4_MOTOR, PID_APPROX, PID_AUTO, Pid
from app.control.sampled_pid import Sampling
from app.motion import Tour
from app.robots import make_robot
from app.simulation import circle_tracking, sampled_loop, simulink_loop
from app.simulation.hardware import Hardware
from app.simulation.sampled_loop import DriveLoop
from app.simulation.step_study import Question, study
from tests.support.oracles import control
from tests.support.plain_loops import PlainSimulinkLoop, numpy_ode3, numpy_sampled, object_sampled

Array = np.ndarray
H = 0.01
PID_SAMPLED = replace(PID_APPROX, n=100.0)


@dataclass(frozen=True)
class Options:
    """What to measure."""

    duration_s: float = 100.0
    """Of the circle, s."""
    repeats: int = 5
    """The best of so many runs counts."""
    json: bool = False
    """Print JSON instead of tables."""


@dataclass(frozen=True)
class Circle:
    """Set-points in degrees, and where they come from."""

    duration_s: float

    def degrees(self, t: Array) -> Array:
        robot = make_robot("par4")
        return np.degrees(robot.inverse(Tour(lap_s=100.0).poses(robot, t)))

    @property
    def t(self) -> Array:
        return H * np.arange(round(self.duration_s / H))


def seconds(repeats: int, *acts: Callable[[], object]) -> list[float]:
    """Least time of each in a few runs, in turns so that a busy moment hits all alike."""
    best = [math.inf] * len(acts)
    for _ in range(repeats):
        for k, act in enumerate(acts):
            start = time.perf_counter()
            act()
            best[k] = min(best[k], time.perf_counter() - start)
    return best


def looked_up(table: Array) -> Callable[[float], Array]:
    """A function of time over set-points that are known at every quarter of a step."""
    return lambda t: table[round(4.0 * t / H)]


def paper_mode(circle: Circle, pid: Pid, repeats: int) -> dict[str, float | str]:
    count, u_max = len(circle.t), 100.0
    quarters = circle.degrees(H / 4 * np.arange(4 * count + 4))
    stages = [[quarters[offset : 4 * count : 4, drive].tolist() for offset in (0, 2, 3)] for drive in range(4)]
    columns = quarters.T.tolist()

    def ours() -> Array:
        return np.array([simulink_loop.simulate(PAR4_MOTOR, pid, u_max, H, rows).y for rows in stages]).T

    def in_numpy() -> Array:
        return numpy_ode3(PAR4_MOTOR, pid, u_max, H, looked_up(quarters), count)[0]

    def in_objects() -> Array:
        outputs = []
        for column in columns:
            loop = PlainSimulinkLoop(PAR4_MOTOR, pid, u_max, lambda t, c=column: c[round(4.0 * t / H)])
            outputs.append([loop.ode3(k * H, H)[0] for k in range(count)])
        return np.array(outputs).T

    assert np.allclose(ours(), in_numpy(), atol=1e-8)
    assert np.allclose(ours(), in_objects(), atol=1e-8)
    whole = partial(circle_tracking, pid, "paper", u_max, duration_s=circle.duration_s)
    run_s, loop_s, numpy_s, objects_s = seconds(repeats, whole, ours, in_numpy, in_objects)
    return {
        "whole_run_s": run_s,
        "loop_s": loop_s,
        "numpy_ratio": numpy_s / loop_s,
        "objects_ratio": objects_s / loop_s,
    }


def sampled_mode(circle: Circle, pid: Pid, u_max: float, repeats: int) -> dict[str, float | str]:
    references = circle.degrees(circle.t)
    columns = references.T.tolist()
    loop = DriveLoop(PAR4_MOTOR, pid, Sampling(H), Hardware(supply_v=u_max))

    def ours() -> Array:
        return np.array([sampled_loop.simulate(loop, column).y for column in columns]).T

    def in_numpy() -> Array:
        return numpy_sampled(PAR4_MOTOR, pid, u_max, H, references)[0]

    def in_objects() -> Array:
        return np.array([object_sampled(PAR4_MOTOR, pid, u_max, H, column)[0] for column in columns]).T

    assert np.allclose(ours(), in_numpy(), atol=1e-8)
    assert np.allclose(ours(), in_objects(), atol=1e-8)
    whole = partial(circle_tracking, pid, "sampled", u_max, duration_s=circle.duration_s)
    contenders: list[Callable[[], object]] = [whole, ours, in_numpy, in_objects]
    if math.isinf(u_max):
        closed = closed_loop(pid)

        def by_control() -> Array:
            return np.array([control.forced_response(closed, circle.t, row).outputs for row in references.T]).T

        assert np.allclose(ours(), by_control(), atol=1e-8)
        contenders.append(by_control)
    run_s, loop_s, *others = seconds(repeats, *contenders)
    ratios = dict(zip(("numpy_ratio", "objects_ratio", "control_ratio"), others, strict=False))
    return {"whole_run_s": run_s, "loop_s": loop_s, **{name: spent / loop_s for name, spent in ratios.items()}}


def closed_loop(pid: Pid) -> Any:
    """Backward Euler, put together by python-control."""
    gain = pid.n * H
    law = control.tf([pid.kp], [1.0], H) + control.tf([pid.ki * H, 0.0], [1.0, -1.0], H)
    law = control.ss(law) + control.ss(pid.kd * pid.n * control.tf([1.0, -1.0], [1.0 + gain, -1.0], H))
    return control.feedback(control.ss(PAR4_MOTOR.sampled(H)) * law, 1)


QUESTIONS = {
    "ideal hardware": Hardware(),
    "12 V": Hardware(supply_v=12.0),
    "12 V, converter, pulse width, noise": Hardware(12.0, 100, 12, noise=0.1),
    "all imperfections": Hardware(12.0, 100, 12, 340.0, 0.1, 0.005, 0.5, 1.0, 1.5, 0.5),
}


def studies(repeats: int) -> list[dict[str, float | str]]:
    rows: list[dict[str, float | str]] = []
    for name, hardware in QUESTIONS.items():
        for duration in (3.0, 30.0):
            question = Question(DriveLoop(PAR4_MOTOR, PID_AUTO, Sampling(), hardware), 25.0, duration)
            study(question)
            (spent,) = seconds(3 * repeats, partial(study, question))
            rows.append({"question": f"{name}, {duration:g} s", "ms": 1e3 * spent})
    return rows


def circles(options: Options) -> list[dict[str, float | str]]:
    circle, repeats = Circle(options.duration_s), options.repeats
    return [
        {"run": "paper, auto", **paper_mode(circle, PID_AUTO, repeats)},
        {"run": "paper, approx", **paper_mode(circle, PID_APPROX, repeats)},
        {"run": "sampled, auto, 12 V", **sampled_mode(circle, PID_AUTO, 12.0, repeats)},
        {"run": "sampled, approx, 12 V", **sampled_mode(circle, PID_SAMPLED, 12.0, repeats)},
        {"run": "sampled, auto, no limit", **sampled_mode(circle, PID_AUTO, math.inf, repeats)},
    ]


def main() -> None:
    options = tyro.cli(Options, description=__doc__)
    tracked, studied = circles(options), studies(options.repeats)
    if options.json:
        print(json.dumps({"circle": tracked, "study": studied}, indent=2))
        return
    head = ["whole run s", "loop s", "NumPy / ours", "objects / ours", "control / ours"]
    print(f"| {options.duration_s:g} s, 4 drives | {' | '.join(head)} |")
    print("|---|---|---|---|---|---|")
    for row in tracked:
        beside = f"{row['control_ratio']:.2f}" if "control_ratio" in row else "-"
        print(
            f"| {row['run']} | {row['whole_run_s']:.3f} | {row['loop_s']:.3f} | {row['numpy_ratio']:.1f} | "
            f"{row['objects_ratio']:.1f} | {beside} |"
        )
    print("\n| step study | ms |\n|---|---|")
    for row in studied:
        print(f"| {row['question']} | {row['ms']:.1f} |")


if __name__ == "__main__":
    main()
