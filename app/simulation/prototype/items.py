"""Things that ride on belts until a tool takes them along: bodies, held by welds that are switched.

While an item rides, it is welded to a seat, a body that MuJoCo moves as it is told and that goes with the belt. To
grasp an item is to weld it to the tool as it lies there: from then on the robot feels its mass and its inertia.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import SubElement

from app.robots.parts.quaternions import about_z
from app.simulation.prototype.draft import STIFFNESS_S, Draft, text
from app.simulation.prototype.engine import Data, Model, mujoco
from app.simulation.prototype.frames import Frame

BeltSpeed = tuple[float, float]
"""m/s along x and y."""


@dataclass(frozen=True)
class Item:
    """A box and the belt on which it lies at first."""

    pose: tuple[float, float, float, float]
    """x, y, z of its centre (m) and its turn about z (rad)."""
    belt: BeltSpeed = (0.0, 0.0)
    mass: float = 0.2
    """kg"""
    size: tuple[float, float, float] = (0.040, 0.030, 0.012)
    """m"""


def add_items(draft: Draft, items: Sequence[Item]) -> None:
    """Add every item with its seat and both welds, that to the tool switched off."""
    for k, item in enumerate(items):
        a, b, c = item.size
        m = item.mass / 12.0
        frame = Frame(item.pose[:3], about_z(item.pose[3]))
        draft.body(seat(k), "world", frame)
        draft.bodies[seat(k)].set("mocap", "true")
        about = (m * (b * b + c * c), m * (a * a + c * c), m * (a * a + b * b))
        draft.body(name(k), "world", frame, mass=item.mass, inertia=about)
        SubElement(draft.bodies[name(k)], "freejoint")
        look = {"type": "box", "size": text(a / 2, b / 2, c / 2), "rgba": "0.85 0.55 0.2 1"}
        SubElement(draft.bodies[name(k)], "geom", look, contype="0", conaffinity="0", mass="0")
        for holder, active in ((seat(k), "true"), ("tool", "false")):
            SubElement(draft.equality, "weld", name=f"{holder}_{name(k)}", body1=holder, body2=name(k), active=active)


def name(k: int) -> str:
    """Of the body of item k, counted from 0."""
    return f"item{k + 1}"


def seat(k: int) -> str:
    """Of the body that carries item k on its belt."""
    return f"seat{k + 1}"


class Grasps:
    """Switches the welds of a running model and moves the seats."""

    def __init__(self, model: Model, data: Data, items: Sequence[Item]) -> None:
        self._model, self._data = model, data
        self._bodies = [int(model.body(name(k)).id) for k in range(len(items))]
        self._seats = [int(model.body(seat(k)).mocapid[0]) for k in range(len(items))]
        self._on_belt = [int(model.equality(f"{seat(k)}_{name(k)}").id) for k in range(len(items))]
        self._in_tool = [int(model.equality(f"tool_{name(k)}").id) for k in range(len(items))]
        self._tool = int(model.body("tool").id)
        self._places = [int(model.jnt_qposadr[model.body_jntadr[body]]) for body in self._bodies]
        self._turns = [item.pose[3] for item in items]
        self._speeds = [(0.0, 0.0)] * len(items)
        for k, item in enumerate(items):
            self.release(k, item.belt)
            dof = int(model.body_dofadr[self._bodies[k]])
            data.qvel[dof : dof + 2] = item.belt

    def grasp(self, k: int) -> None:
        """Weld item k to the tool as it lies."""
        d, weld = self._data, self._in_tool[k]
        tool, item = self._tool, self._bodies[k]
        back, turn = d.xquat[tool] * (1, -1, -1, -1), self._model.eq_data[weld, 6:10]
        mujoco().mju_rotVecQuat(self._model.eq_data[weld, 3:6], d.xpos[item] - d.xpos[tool], back)
        mujoco().mju_mulQuat(turn, back, d.xquat[item])
        d.eq_active[weld], d.eq_active[self._on_belt[k]] = 1, 0

    def release(self, k: int, belt: BeltSpeed) -> None:
        """Leave item k where it is, on a belt that moves at a speed."""
        d = self._data
        lead = 2.0 * STIFFNESS_S  # a weld pulls like a damped spring: what it carries lags behind by this time
        d.mocap_pos[self._seats[k]] = d.xpos[self._bodies[k]] + (lead * belt[0], lead * belt[1], 0.0)
        d.mocap_quat[self._seats[k]] = d.xquat[self._bodies[k]]
        d.eq_active[self._in_tool[k]], d.eq_active[self._on_belt[k]] = 0, 1
        self._speeds[k] = belt

    def carry(self, duration_s: float) -> None:
        """Move the seats with their belts."""
        for seat_id, (vx, vy) in zip(self._seats, self._speeds, strict=True):
            place = self._data.mocap_pos[seat_id]
            place[0] += vx * duration_s
            place[1] += vy * duration_s

    def poses(self) -> list[tuple[float, float, float, float]]:
        """x, y, z of its centre (m) and turn about z (rad) of every item."""
        rows = [self._data.qpos[start : start + 7].tolist() for start in self._places]
        # a turn goes on counting beyond half a turn, as that of the tool does
        self._turns = [
            turn + math.remainder(turn_about_z(wxyz) - turn, math.tau)
            for turn, (_, _, _, *wxyz) in zip(self._turns, rows, strict=True)
        ]
        return [(x, y, z, turn) for (x, y, z, *_), turn in zip(rows, self._turns, strict=True)]


def turn_about_z(wxyz: Sequence[float]) -> float:
    """Heading of the x axis of a frame, rad."""
    w, x, y, z = wxyz
    return math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
