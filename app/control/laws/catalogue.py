"""The laws by name, with what students read about them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from app.control.laws.computed_torque import ComputedTorque, ObservedTorque
from app.control.laws.joint_pid import JointPid
from app.control.laws.law import Law, Setup
from app.control.laws.predictive import Predictive
from app.control.laws.sliding_mode import SlidingMode
from app.control.laws.task_space import TaskSpace


class LawError(ValueError):
    """A law that does not exist; the message is one sentence for the user."""


@dataclass(frozen=True)
class LawKind:
    """One law."""

    title: str
    note: str
    """One sentence."""
    parts: tuple[str, ...]
    """Components of its efforts: p, d, i, M (what accelerates the masses), n (Coriolis, gravity), ff (fed forward),
    dob (observer), s (sliding), qp (MPC's optimum)."""
    build: Callable[[Setup], Law]
    needs_model: bool = True
    """Whether it evaluates the dynamics at the measured state."""


LAWS: dict[str, LawKind] = {
    "PD": LawKind("PD", "Each joint for itself: a spring and a damper.", ("p", "d"), JointPid, needs_model=False),
    "PID": LawKind(
        "PID",
        "PD, and an integral that takes away what stays: sag and friction.",
        ("p", "d", "i"),
        partial(JointPid, integral=True),
        needs_model=False,
    ),
    "PD+": LawKind(
        "PD + gravity",
        "PD, and the efforts that hold the robot where it is.",
        ("p", "d", "n"),
        partial(JointPid, gravity=True),
    ),
    "PDff": LawKind(
        "PD + feed-forward",
        "PD, and the efforts that the reference needs, computed beforehand.",
        ("p", "d", "ff"),
        partial(JointPid, forward=True),
        needs_model=False,
    ),
    "CTC": LawKind(
        "Computed torque",
        "The model cancels inertia, Coriolis forces and gravity; every joint becomes a unit mass.",
        ("p", "d", "M", "n"),
        ComputedTorque,
    ),
    "CTC+DOB": LawKind(
        "Computed torque + observer",
        "Computed torque, and an observer that estimates what the model misses and takes it away.",
        ("p", "d", "M", "n", "dob"),
        ObservedTorque,
    ),
    "MPC": LawKind(
        "Model predictive control",
        "Plans a few steps ahead within the drives' limits, takes the first step, and plans again.",
        ("qp", "M", "n"),
        Predictive,
    ),
    "SMC": LawKind(
        "Sliding mode",
        "Super-twisting: strong enough for any disturbance that does not change too fast.",
        ("d", "s", "M", "n"),
        SlidingMode,
    ),
    "TSIDC": LawKind(
        "Task-space inverse dynamics",
        "Computed torque for the tool instead of the joints: its coordinates are decoupled.",
        ("p", "d", "M", "n"),
        TaskSpace,
    ),
    "TSIIDC": LawKind(
        "Task-space inverse dynamics + integral",
        "The same with an integral that stops adding up at its bound.",
        ("p", "d", "i", "M", "n"),
        partial(TaskSpace, integral=True),
    ),
}
"""In the order in which they build on each other."""
