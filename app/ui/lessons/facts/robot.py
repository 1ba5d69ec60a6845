"""The robot on the page, as lessons read and set it."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any, TypeVar

import numpy as np

from app.classroom.lessons.lesson import Value
from app.errors import UserMistake
from app.robots import ROBOTS, GeometryError
from app.ui.lessons.facts.field import Field, deg, index_of
from app.ui.lessons.facts.reach_kind import reach_kind
from app.ui.session import Session
from app.ui.state import Stance, ViewOptions

Found = TypeVar("Found")

FACTOR = {"m": 1e3, "rad": math.degrees(1.0)}
"""From SI to what people read."""

POSE_UNITS = ("m", "m", "m", "rad")
COORDINATES = ("x", "y", "z", "theta", "phi")
CHANGED = "changed"


class RobotFacts:
    """Poses and joints that are set one number after the other count as one: the last number decides."""

    def __init__(self, session: Session) -> None:
        self._session = session
        self._left: Stance | None = None
        """Where a lesson left the robot."""
        self._pose: dict[int, float] = {}
        self._joints: dict[int, float] = {}
        """What it set there, in SI units."""
        self._found: dict[str, tuple[Stance, Any]] = {}

    def field(self) -> Field:
        pose = {f"pose.{name}": partial(self._coordinate, name, False) for name in COORDINATES}
        wish = {f"wish.{name}": partial(self._coordinate, name, True) for name in COORDINATES}
        stance = {
            "pose.radius": lambda: 1e3 * math.hypot(*self._session.stance.position[:2]),
            "reach.ok": lambda: self._session.stance.reach.ok,
            "reach.reason": lambda: self._session.stance.reach.reason,
            "reach.kind": lambda: reach_kind(self._session.stance.reach),
            "reach.leg": lambda: self._session.stance.reach.leg or 0,
            "conditioning": lambda: self._once("conditioning", self._conditioning),
            "solutions.elbows": lambda: self._once("elbows", self._elbows),
            "solutions.assemblies": lambda: self._once("assemblies", self._assemblies),
        }
        return Field(
            read={"robot": lambda: self._session.robot_name, "preset": self._preset, **pose, **wish, **stance},
            write={
                "robot": self._choose,
                "preset": self._choose_preset,
                **{f"pose.{name}": partial(self._set_pose, name) for name in COORDINATES},
                **{f"wish.{name}": partial(self._set_wish, name) for name in COORDINATES},
            },
            read_each={"joint.": self._joint, "geometry.": self._dimension},
            write_each={"joint.": self._set_joint, "geometry.": self._set_dimension},
        )

    def _coordinate(self, name: str, wished: bool) -> Value | None:
        k = index_of(name, self._session.robot.pose_names)
        if k is None:
            return None
        stance = self._session.stance
        return (stance.wish if wished else stance.pose)[k] * FACTOR[POSE_UNITS[k]]

    def _joint(self, name: str) -> Value | None:
        robot = self._session.robot
        k = index_of(name, robot.joint_names)
        return None if k is None else self._session.stance.joints[k] * FACTOR[robot.joint_units[k]]

    def _dimension(self, symbol: str) -> Value | None:
        dimension = self._session.robot.geometry.dimensions().get(symbol)
        if dimension is None:
            return None
        return getattr(self._session.robot.geometry, symbol) * FACTOR[dimension.unit]

    def _preset(self) -> str:
        """The first named set of dimensions that the robot has."""
        kind, now = ROBOTS[self._session.robot_name], self._session.robot.geometry
        usual = kind.geometry()
        named = ((name, usual.changed(**dict(values))) for name, values in kind.presets.items())
        return next((name for name, geometry in named if geometry == now), CHANGED)

    def _once(self, what: str, find: Callable[[], Found]) -> Found:
        """Found once for where the robot stands."""
        stance = self._session.stance
        known = self._found.get(what)
        if known is None or known[0] is not stance:
            known = self._found[what] = stance, find()
        return known[1]

    def _conditioning(self) -> float:
        return float(self._session.robot.conditioning(self._session.stance.pose))

    def _elbows(self) -> int:
        return len(self._session.robot.working_modes(self._session.stance.pose))

    def _assemblies(self) -> int:
        return len(self._session.robot.assemblies(self._session.stance.joints))

    def _choose(self, name: str) -> None:
        if name == self._session.robot_name and not self._session.dimensions:
            self._session.go_home()
        else:
            self._session.choose_robot(name)

    def _choose_preset(self, name: str) -> None:
        presets = ROBOTS[self._session.robot_name].presets
        if name not in presets:
            raise UserMistake(f"This robot has no dimensions called {name}: choose one of {', '.join(presets)}.")
        self._session.choose_preset(name)

    def _set_dimension(self, symbol: str, value: float) -> None:
        dimension = self._session.robot.geometry.dimensions().get(symbol)
        if dimension is None:
            raise UserMistake(f"This robot has no dimension {symbol}: choose another robot first.")
        try:
            self._session.reshape(**{symbol: value / FACTOR[dimension.unit]})
        except GeometryError as mistake:
            raise UserMistake(str(mistake)) from mistake

    def _set_pose(self, name: str, value: float) -> None:
        self._keep_pose(name, value)
        pose = list(self._session.stance.pose)
        for k, wanted in self._pose.items():
            pose[k] = wanted
        self._session.go(pose)
        self._left = self._session.stance

    def _set_wish(self, name: str, value: float) -> None:
        self._keep_pose(name, value)
        wish = list(self._session.stance.wish)
        for k, wanted in self._pose.items():
            wish[k] = wanted
        self._session.drag(wish[:3], *wish[3:])
        self._left = self._session.stance

    def _keep_pose(self, name: str, value: float) -> None:
        k = index_of(name, self._session.robot.pose_names)
        if k is None:
            raise UserMistake(f"The pose of this robot has no {name}: choose another robot first.")
        self._begin_anew()
        self._pose[k] = value / FACTOR[POSE_UNITS[k]]

    def _set_joint(self, name: str, value: float) -> None:
        session = self._session
        k = index_of(name, session.robot.joint_names)
        if k is None:
            raise UserMistake(f"This robot has no joint {name}: choose one of {', '.join(session.robot.joint_names)}.")
        self._begin_anew()
        self._joints[k] = value / FACTOR[session.robot.joint_units[k]]
        if not self._stand_with_joints():
            session.set_joint(k, self._joints[k])
        self._left = session.stance

    def _stand_with_joints(self) -> bool:
        """All joints that were set, at once: in between they may not fit together."""
        joints = np.array(self._session.stance.joints)
        for k, value in self._joints.items():
            joints[k] = value
        pose = self._session.robot.forward(joints)
        if np.isnan(pose).any() or not self._session.robot.reach(pose).ok:
            return False
        self._session.go(pose.tolist())
        return True

    def _begin_anew(self) -> None:
        if self._left is not self._session.stance:  # somebody else has moved the robot
            self._pose.clear()
            self._joints.clear()


def view_field(session: Session) -> Field:
    """What is shown beside the robot."""
    names = {"workspace": "workspace", "frames": "frames", "trace": "trace"}
    names |= {"elbows": "elbows", "assemblies": "assemblies"}

    def show(name: str, value: object) -> None:
        session.show(**{name: value})

    def show_vectors(leg: float) -> None:
        legs = len(session.robot.joint_names)
        if not 0 <= leg <= legs:
            raise UserMistake(f"There is no leg {leg:g}: choose one from 1 to {legs}, or 0 for none.")
        session.show(vectors_leg=None if leg == 0 else round(leg) - 1)

    return Field(
        read={
            **{f"view.{name}": partial(_shown, session, field) for name, field in names.items()},
            "view.workspace_angle": lambda: deg(session.view.workspace_angle),
            "view.vectors": lambda: 0 if session.view.vectors_leg is None else session.view.vectors_leg + 1,
        },
        write={
            **{f"view.{name}": partial(show, field) for name, field in names.items()},
            "view.workspace_angle": lambda angle: session.show(workspace_angle=math.radians(angle)),
            "view.vectors": show_vectors,
        },
    )


def _shown(session: Session, option: str) -> Value:
    view: ViewOptions = session.view
    return getattr(view, option)
