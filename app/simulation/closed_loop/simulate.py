"""From an experiment to a recorded run."""

from __future__ import annotations

import time
from collections.abc import Sequence
from itertools import chain

import numpy as np

from app.control.laws import LAWS, Law, Reference, Seen, Setup
from app.robots import Robot
from app.robots.dynamics import Dynamics, dynamics_of
from app.robots.robot import EFFORT_UNITS
from app.simulation.closed_loop.carrying import Bodies, Load, PointMass, bodies_at_start
from app.simulation.closed_loop.drives import Drives
from app.simulation.closed_loop.experiment import Experiment
from app.simulation.closed_loop.loop import Loop, Progress, Trace
from app.simulation.closed_loop.sensor import Encoders, IdealSensor, Sensor, SharedSensor
from app.simulation.controlled_run import Array, ControlledRun
from app.simulation.fivebar_plant import FiveBarPlant
from app.simulation.plant import FRICTION, ExactPlant, Plant
from app.simulation.run import SHOWN
from app.simulation.tracking import TrackingError


def simulate(experiment: Experiment, progress: Progress | None = None) -> ControlledRun:
    """Run one closed loop.

    Args:
        progress: is told the share done; what it raises ends the run.
    Raises:
        TrackingError: if the experiment makes no sense or the robot leaves its reach.
    """
    experiment.check()
    robot = experiment.build()
    model = dynamics_of(robot, experiment.model_inertia)
    reference = _reference(experiment, robot, model)
    limits = experiment.drives
    law = LAWS[experiment.law].build(Setup(model, reference, experiment.tuned, experiment.sampled_s, limits.effort))
    plant, load = _plant(experiment, robot, reference)
    loop = Loop(
        plant,
        _sensor(experiment, plant, model),
        law,
        Drives(
            limits,
            limit_effort=experiment.limit_effort,
            limit_speed=experiment.limit_speed,
            delay_samples=experiment.delay_samples,
        ),
        experiment.sampled_s,
        experiment.steps,
        {round(when / experiment.sampled_s): happens for when, happens in load.events},
        load.watch,
    )
    started = time.perf_counter()
    trace = loop.run(progress)
    return _recorded(experiment, robot, reference, loop, load, trace, time.perf_counter() - started)


def compare(experiments: Sequence[Experiment], progress: Progress | None = None) -> list[ControlledRun]:
    """One after the other; `progress` as for `simulate`, over all."""
    runs = []
    for done, experiment in enumerate(experiments):
        part = None if progress is None else _part_of(progress, done, len(experiments))
        runs.append(simulate(experiment, part))
    return runs


def _part_of(progress: Progress, done: int, count: int) -> Progress:
    return lambda share: progress((done + share) / count)


def _reference(experiment: Experiment, robot: Robot, model: Dynamics) -> Reference:
    """
    Raises:
        TrackingError: if part of the trajectory is out of reach.
    """
    pose, rate, acceleration = experiment.trajectory.sample(experiment.times)
    joints = robot.inverse(pose)
    if np.isnan(joints).any():
        raise TrackingError("Part of the motion is out of reach: make it smaller or move it to the middle.")
    terms = model.columns(pose, rate)
    speeding = terms.joint_acceleration(tuple(acceleration.T))
    rates, accelerations = (np.column_stack(columns) for columns in (terms.joint_rates, speeding))
    return Reference(pose, rate, acceleration, joints, rates, accelerations)


def _plant(experiment: Experiment, robot: Robot, reference: Reference) -> tuple[Plant, Load]:
    """The plant where the run starts, and what it carries."""
    start = experiment.start_pose or tuple(reference.pose[0].tolist())
    rate = reference.rate[0].tolist() if experiment.start == "reference" else None
    inertia, flow, payload = experiment.plant_inertia, experiment.flow, experiment.payload_kg
    friction = FRICTION[robot.name].scaled(experiment.friction) if experiment.friction else None
    if experiment.plant == "exact":
        kind = FiveBarPlant if robot.name == "fivebar" else ExactPlant
        plant = kind(robot, inertia, pose=start, rate=rate, friction=friction)
    else:
        from app.simulation.prototype import MujocoPlant

        items = bodies_at_start(flow, start, payload) if flow else ()
        plant = MujocoPlant(robot, inertia, pose=start, rate=rate, friction=friction, items=items)
        if flow:
            return plant, Bodies(plant, flow)
    return plant, PointMass(plant, payload, experiment.carried_s)


def _sensor(experiment: Experiment, plant: Plant, model: Dynamics) -> Sensor:
    if experiment.encoder_step or experiment.velocity_filter_hz:
        return Encoders(plant, model, experiment.encoder_step, experiment.velocity_filter_hz, experiment.sampled_s)
    shared = experiment.model_inertia == experiment.plant_inertia and not experiment.payload_kg
    if isinstance(plant, ExactPlant) and (shared or not LAWS[experiment.law].needs_model):
        return SharedSensor(plant)
    return IdealSensor(plant, model)


def _recorded(
    experiment: Experiment, robot: Robot, reference: Reference, loop: Loop, load: Load, trace: Trace, took_s: float
) -> ControlledRun:
    t = experiment.times
    pose, rate, joints, effort = (_table(rows) for rows in (trace.pose, trace.rate, trace.joints, trace.effort))
    limits = experiment.drives
    factor = SHOWN[robot.joint_units[0]][1]
    errors = (reference.joints - joints) * factor
    return ControlledRun(
        title=f"{LAWS[experiment.law].title}: {experiment.trajectory.title}",
        robot=robot.name,
        t=t,
        pose_ref=reference.pose,
        q_ref=reference.joints,
        q=joints,
        u=effort,
        u_max=limits.effort,
        effort_unit=EFFORT_UNITS[robot.joint_unit],
        ise=(errors**2).sum(axis=0) * experiment.sampled_s,
        dimensions=experiment.dimensions,
        pose=pose,
        rate=rate,
        components=loop.law.components(_seen(loop.law, loop.sensor, pose, rate)),
        speed_limit=limits.speed,
        law=experiment.law,
        plant=experiment.plant,
        tuning=experiment.tuned,
        flow=experiment.flow,
        seen_items=load.seen_items(),
        computed_s=took_s,
    )


def _seen(law: Law, sensor: Sensor, pose: Array, rate: Array) -> Seen:
    if isinstance(sensor, Encoders):
        pose, rate = np.array(sensor.trace).transpose(1, 0, 2)
    terms = law.setup.model.columns(pose, rate)
    joints, rates = (np.column_stack(columns) for columns in (terms.joints, terms.joint_rates))
    return Seen(terms, joints, rates, pose, rate)


def _table(rows: list[Sequence[float]]) -> Array:
    """As `np.array`, three times as fast."""
    flat = np.fromiter(chain.from_iterable(rows), float, len(rows) * len(rows[0]))
    return flat.reshape(len(rows), -1)
