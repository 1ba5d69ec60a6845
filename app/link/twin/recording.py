"""What a board reported, at full rate: kept, saved as CSV, and played like any other run of the app."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from app.link.errors import LinkError
from app.link.twin.tables import Table, read_tables, write_comments, write_table
from app.robots import ROBOTS, GeometryError, Robot, build_robot
from app.simulation import Run
from app.simulation.run import SHOWN

Array = NDArray[np.float64]
Ints = NDArray[np.int64]

SAMPLE_HEAD = ("sample_t_s", "joint")


@dataclass(frozen=True, eq=False)
class TestSamples:
    """The close-up of a TEST: m instants of one joint, 4 ms apart."""

    __test__ = False  # not a test of pytest's

    joint: int
    """From 0."""
    t: Array
    """(m,) s, on the recording's clock."""
    position: Array
    """(m,) rad or m."""
    drive: Array
    """(m,) share of the supply, -1..1."""


@dataclass(frozen=True, eq=False)
class Recording:
    """k telemetry messages of one robot with n joints; SI units and radians."""

    robot: str
    """Its name in `ROBOTS`."""
    title: str
    t: Array
    """(k,) s of the board's clock, from 0, increasing."""
    position: Array
    """(k, n) measured joints, rad or m."""
    setpoint: Array
    """(k, n) where the joints should have been."""
    drive: Array
    """(k, n) share of the supply, -1..1."""
    state: Ints
    """(k,) `State`."""
    flags: Ints
    """(k,) `Flag`."""
    latency_s: Array
    """(k,) round trip of the link at that moment; NaN where it was not known."""
    supply_v: float = 12.0
    samples: TestSamples | None = None
    """Of a TEST, if there was one."""
    dimensions: dict[str, float] = field(default_factory=dict)
    """Changed dimensions of the robot, m and rad."""

    @property
    def duration_s(self) -> float:
        return float(self.t[-1]) if len(self.t) else 0.0

    def build(self) -> Robot:
        """The robot that was recorded."""
        return build_robot(self.robot, self.dimensions)

    def part(self, first_s: float, last_s: float) -> Recording:
        """The telemetry of a stretch of time, its clock kept; without the samples."""
        inside = (self.t >= first_s) & (self.t <= last_s)
        names = ("t", "position", "setpoint", "drive", "state", "flags", "latency_s")
        return replace(self, samples=None, **{name: getattr(self, name)[inside] for name in names})

    def run(self) -> Run:
        """On an even grid, for playback, plots and tables. LinkError where less than two instants were recorded."""
        if len(self.t) < 2:
            raise LinkError("Less than two messages were recorded; record for at least a second.")
        count = max(2, round(self.duration_s / float(np.median(np.diff(self.t)))) + 1)
        grid = np.linspace(float(self.t[0]), float(self.t[-1]), count)
        q, q_ref, drive = (interpolated(grid, self.t, c) for c in (self.position, self.setpoint, self.drive))
        robot = self.build()
        error = (q_ref - q) * SHOWN[robot.joint_unit][1]
        ise = (error**2).sum(axis=0) * float(grid[1] - grid[0])
        u = drive * self.supply_v
        pose_ref, t = assembled(robot, q_ref), grid - grid[0]
        return Run(self.title, self.robot, t, pose_ref, q_ref, q, u, self.supply_v, "V", ise, self.dimensions)

    def csv(self) -> str:
        """Comments, the telemetry, and where there was a TEST a second table with its samples."""
        unit, factor = SHOWN[self.build().joint_unit]
        notes = {"robot": self.robot, "title": self.title, "supply (V)": f"{self.supply_v:.10g}"}
        notes |= {f"dimension {name}": f"{value:.17g}" for name, value in self.dimensions.items()}
        joints = (self.position * factor, self.setpoint * factor, self.drive)
        values = np.column_stack([self.t, *joints, self.state, self.flags, self.latency_s * 1e3]).astype(float)
        text = write_comments(notes) + write_table(_head(self.robot, unit), values)
        if self.samples is None:
            return text
        close = self.samples
        rows = np.column_stack([close.t, np.full(len(close.t), close.joint + 1), close.position * factor, close.drive])
        return f"{text}\n{write_table((*SAMPLE_HEAD, f'position_{unit}', 'drive'), rows)}"

    @classmethod
    def from_csv(cls, text: str) -> Recording:
        """What `csv` wrote. LinkError, with the line's number where there is one, for anything else."""
        notes, tables = read_tables(text)
        robot = notes.get("robot", "")
        if robot not in ROBOTS or not tables:
            raise LinkError("This is not a recording of Delta Lab: its first lines must name the robot; save it again.")
        unit, factor = SHOWN[ROBOTS[robot].build.joint_unit]
        table, n = tables[0], len(ROBOTS[robot].build.joint_names)
        _check_times(table)
        columns = np.split(table.columns(_head(robot, unit)), [1, 1 + n, 1 + 2 * n, 1 + 3 * n, 2 + 3 * n, 3 + 3 * n], 1)
        t, position, setpoint, drive, state, flags, latency_ms = columns
        return cls(
            robot,
            notes.get("title", ""),
            t[:, 0],
            position / factor,
            setpoint / factor,
            drive,
            state[:, 0].astype(int),
            flags[:, 0].astype(int),
            latency_ms[:, 0] / 1e3,
            _number(notes, "supply (V)"),
            _samples(tables[1], unit, factor) if len(tables) > 1 else None,
            _dimensions(robot, notes),
        )


def interpolated(at: Array, t: Array, columns: Array) -> Array:
    """(len(at), n) between the instants t (k,) of columns (k, n)."""
    return np.column_stack([np.interp(at, t, column) for column in columns.T])


def assembled(robot: Robot, joints: Array) -> Array:
    """(k, dof) poses of joints (k, n); where they do not assemble the last pose that did, home before the first."""
    pose = robot.forward(joints)
    good = ~np.isnan(pose).any(axis=1)
    last = np.maximum.accumulate(np.where(good, np.arange(len(pose)), -1))
    return np.where(last[:, None] < 0, robot.home, pose[np.maximum(last, 0)])


def _head(robot: str, unit: str) -> list[str]:
    names = ROBOTS[robot].build.joint_names
    joints = [f"{name}_{kind}" for kind in (unit, f"setpoint_{unit}", "drive") for name in names]
    return ["t_s", *joints, "state", "flags", "latency_ms"]


def _check_times(table: Table) -> None:
    """Finite values, times that increase. Only a latency may be missing."""
    finite = np.isfinite(np.delete(table.values, [k for k, n in enumerate(table.names) if n == "latency_ms"], 1))
    wrong = ~finite.all(axis=1)
    if wrong.any():
        raise LinkError(f"Line {table.lines[int(np.argmax(wrong))]}: a value is not finite; delete the line.")
    back = np.diff(table.values[:, 0]) <= 0.0
    if back.any():
        line = table.lines[int(np.argmax(back)) + 1]
        raise LinkError(f"Line {line}: the time does not increase; sort the rows and delete repeated ones.")


def _samples(table: Table, unit: str, factor: float) -> TestSamples:
    t, joint, position, drive = table.columns((*SAMPLE_HEAD, f"position_{unit}", "drive")).T
    if not len(t):
        raise LinkError("The table of samples is empty; delete its head or save the recording again.")
    _check_times(table)
    return TestSamples(int(joint[0]) - 1, t, position / factor, drive)


def _number(notes: dict[str, str], name: str) -> float:
    try:
        return float(notes[name])
    except (KeyError, ValueError):
        raise LinkError(f"The comment '# {name}: ...' must give a number; save the recording again.") from None


def _dimensions(robot: str, notes: dict[str, str]) -> dict[str, float]:
    names = [name for name in notes if name.startswith("dimension ")]
    dimensions = {name.removeprefix("dimension "): _number(notes, name) for name in names}
    try:
        build_robot(robot, dimensions)
    except GeometryError as error:
        raise LinkError(str(error)) from None
    return dimensions
