"""Forces and torques of a robot, with the masses it is declared to have."""

from __future__ import annotations

from typing import Any

from app.classroom.lessons.formulas.quantities import pose_of, robot_of
from app.classroom.lessons.formulas.registry import Quantity, formula

Table = dict[str, float]
NOTHING: Any = {}
EFFORT = {"rad": "N m", "m": "N"}


@formula("effort")
def effort(
    robot: str,
    pose: Table,
    velocity: Table = NOTHING,
    acceleration: Table = NOTHING,
    payload: float = 0.0,
    preset: str = "",
) -> dict[str, Quantity]:
    """Torque (N m) or force (N) of each joint for a motion of the tool (mm, mm/s, mm/s^2; deg); payload in kg.

    Without velocity and acceleration: what holds the robot against gravity.
    """
    from app.robots.dynamics import INERTIA, dynamics_of

    machine = robot_of(robot, preset)
    equations = dynamics_of(machine, INERTIA[robot].changed(payload=payload))
    state = (pose_of(machine, pose), pose_of(machine, velocity), pose_of(machine, acceleration))
    efforts = equations.inverse(*state)
    unit = EFFORT[machine.joint_unit]
    return {name: Quantity(float(f), unit) for name, f in zip(machine.joint_names, efforts, strict=True)}


@formula("mass")
def mass(robot: str, name: str) -> Quantity:
    """A mass (kg) or inertia (kg m^2) that a robot is declared to have, by its name in the code."""
    from app.robots.dynamics import INERTIA

    known = INERTIA[robot].quantities()
    if name not in known:
        raise ValueError(f"{robot} has {', '.join(known)}, not {name}.")
    return Quantity(float(getattr(INERTIA[robot], name)), known[name].unit)


@formula("force_swing", "N")
def force_swing(helix: str) -> dict[str, float]:
    """How much the force of linear's first motor swings about its mean on helix T1 or T2 (N, RMS).

    By cause: `weight`, `inertia`, and `total`, in which the two may cancel.
    """
    import numpy as np

    from app.robots.dynamics import INERTIA, dynamics_of
    from app.simulation.helix import HELICES

    path = HELICES[helix]
    moving = path.sample(np.linspace(0.0, path.duration_s, 500)[1:-1])
    equations = dynamics_of(robot_of("linear"), INERTIA["linear"])
    total = equations.inverse(*moving)[:, 0]
    weight = equations.gravity(moving.pose, "joint")[:, 0]
    parts = {"weight": weight, "inertia": total - weight, "total": total}
    return {cause: float(np.std(force)) for cause, force in parts.items()}


@formula("joint_stiffness")
def joint_stiffness(robot: str, bandwidth: float) -> Quantity:
    """Kp of a robot's first joint under PD at a bandwidth (Hz): N/mm, or N m/rad where joints turn."""
    from app.control.laws import Tuning

    machine = robot_of(robot)
    stiffness = Tuning.equal(robot, "PD", bandwidth).joint_gains()[0][0]
    return Quantity(stiffness / 1e3, "N/mm") if machine.joint_unit == "m" else Quantity(stiffness, "N m/rad")


@formula("law_gain")
def law_gain(robot: str, law: str, bandwidth: float = 0.0) -> dict[str, Quantity]:
    """kp (1/s^2), kd (1/s), damping and bandwidth (Hz) of a model-based law's first axis; 0 Hz: the usual bandwidth."""
    from app.control.laws import Tuning

    tuning = Tuning.equal(robot, law, bandwidth) if bandwidth else Tuning.default(robot, law)
    kp, kd, _ = tuning.gains()
    return {
        "kp": Quantity(kp[0], "1/s^2"),
        "kd": Quantity(kd[0], "1/s"),
        "damping": Quantity(tuning.damping[0], ""),
        "bandwidth": Quantity(tuning.bandwidth_hz[0], "Hz"),
    }


@formula("speed_limit")
def speed_limit(robot: str, joint: str) -> Quantity:
    """Largest speed of a joint's drive: rad/s or mm/s."""
    from app.robots.limits import drive_limits

    machine = robot_of(robot)
    number = machine.joint_names.index(joint)
    speed = float(drive_limits(machine).speed[number])
    return Quantity(1e3 * speed, "mm/s") if machine.joint_units[number] == "m" else Quantity(speed, "rad/s")
