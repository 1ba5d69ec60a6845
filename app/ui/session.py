"""One browser's lab: which robot, where it stands, what is shown, and who wants to know. No widgets here.

The flow of a drag: gizmo -> `Session.drag` -> `Robot.reach` (or `nearest`) -> a new `Stance` -> the listeners.
Everything runs on the server's event loop, so there are no locks.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from app.robots import ROBOTS, Reach, Robot, build_robot
from app.signal import Signal
from app.ui.state import Joints, Memory, Pose, Stance, ViewOptions

FARTHEST_WISH_M = 2.0
"""A gizmo dragged farther away counts as this far."""


class Session:
    """The state of one browser. Poses in metres and radians."""

    def __init__(self, memory: Memory) -> None:
        self.robot_changed: Signal[Robot] = Signal()
        self.stance_changed: Signal[Stance] = Signal()
        self.view_changed: Signal[ViewOptions] = Signal()
        self.locks_changed: Signal[frozenset[str]] = Signal()
        self.locks: frozenset[str] = frozenset()
        """What a lesson does not let the student change: `robot`, `geometry`. The lesson itself may."""
        self.robot_name = memory.robot
        self.dimensions = dict(memory.dimensions)
        self.view = memory.view
        self.control = memory.control
        """Settings of the control lab, for the next visit."""
        self.drawing = memory.drawing
        """What was drawn, for the next visit."""
        self.motion = memory.motion
        """How the robot was to move, for the next visit."""
        self.comparison = memory.comparison
        """How controllers were compared, for the next visit."""
        self.maps = memory.maps
        """Which map was chosen, for the next visit."""
        self.in_lesson = memory.in_lesson
        """Whether the lessons are open, for the next visit."""
        self.robot = build_robot(self.robot_name, self.dimensions)
        pose = memory.pose if memory.pose and self.robot.reach(memory.pose).ok else tuple(self.robot.home.tolist())
        self.stance = self._standing(pose)

    @property
    def memory(self) -> Memory:
        """What to keep for the next visit."""
        place = self.robot_name, dict(self.dimensions), self.stance.pose, self.view
        return Memory(*place, self.control, self.drawing, self.motion, self.comparison, self.maps, self.in_lesson)

    def lock(self, what: frozenset[str]) -> None:
        """Let the student's panels change everything but this."""
        if what != self.locks:
            self.locks = what
            self.locks_changed.emit(what)

    def choose_robot(self, name: str) -> None:
        """Take another robot, with its default dimensions, at home."""
        self.robot_name, self.dimensions = name, {}
        self._replace_robot(build_robot(name, {}))

    def choose_preset(self, preset: str) -> None:
        """Take a named set of dimensions of the present robot."""
        self._rebuild(ROBOTS[self.robot_name].presets[preset])

    def reset_geometry(self) -> None:
        self._rebuild({})

    def reshape(self, **dimensions: float) -> None:
        """Change dimensions, in metres and radians; the pose is kept as far as it stays in reach.

        Raises:
            GeometryError: with one sentence; nothing has changed then.
        """
        self._rebuild({**self.dimensions, **dimensions})

    def drag(self, position: Iterable[float] | None = None, rotation: float | None = None) -> None:
        """Follow the gizmo: its position (3,), its rotation about z, or both."""
        wish = list(self.stance.wish)
        if position is not None:
            wish[:3] = [min(max(float(v), -FARTHEST_WISH_M), FARTHEST_WISH_M) for v in position]
        if rotation is not None and len(wish) == 4:
            wish[3] = float(rotation)
        self._stand(tuple(wish))

    def go(self, pose: Sequence[float]) -> None:
        """Stand at a typed pose, or as near to it as the robot gets; the verdict stays on screen."""
        self._stand(tuple(float(v) for v in pose))
        self.release()

    def release(self) -> None:
        """The gizmo is let go: it returns to the robot."""
        self._set_stance(dataclasses.replace(self.stance, wish=self.stance.pose))

    def go_home(self) -> None:
        self._set_stance(self._standing(tuple(self.robot.home.tolist())))

    def set_joint(self, joint: int, value: float) -> None:
        """Move one joint, the others held. A set of joints that cannot be leaves the robot where it is."""
        joints = list(self.stance.joints)
        joints[joint] = value
        pose = self.robot.forward(np.array(joints))
        if np.isnan(pose).any():
            self._hold(Reach(False, "These joints do not fit together.", None))
            return
        reach = self.robot.reach(pose)
        if reach.ok:
            self._set_stance(self._standing(tuple(pose.tolist())))
        else:
            self._hold(reach)

    def _hold(self, verdict: Reach) -> None:
        """Stay at the last pose and say so."""
        reason = f"{verdict.reason.rstrip('.')}: the robot holds the last pose."
        self._set_stance(dataclasses.replace(self.stance, reach=verdict._replace(reason=reason)))

    def replay(self, pose: Sequence[float], joints: Sequence[float]) -> None:
        """Stand as recorded, joints and pose just as they were."""
        recorded = tuple(map(float, pose)), tuple(map(float, joints))
        self._set_stance(Stance(*recorded, recorded[0], Reach(True, joints=recorded[1])))

    def show(self, **options: object) -> None:
        """Change some of the view options."""
        self.view = dataclasses.replace(self.view, **options)  # type: ignore[arg-type]
        self.view_changed.emit(self.view)

    def _rebuild(self, dimensions: Mapping[str, float]) -> None:
        robot = build_robot(self.robot_name, dimensions)
        self.dimensions = dict(dimensions)
        self._replace_robot(robot, self.stance.pose)

    def _replace_robot(self, robot: Robot, pose: Pose | None = None) -> None:
        self.robot = robot
        home = tuple(robot.home.tolist())
        self.stance = self._standing(home)
        if pose is not None:
            self.stance = self._standing(tuple(robot.nearest(pose).tolist()))
        self.robot_changed.emit(robot)
        self.stance_changed.emit(self.stance)

    def _stand(self, wish: Pose) -> None:
        reach = self.robot.reach(wish)
        if reach.ok:
            self._set_stance(Stance(wish, self._joints(reach, wish), wish, reach))
            return
        pose = tuple(self.robot.nearest(wish, seed=self.stance.pose).tolist())
        self._set_stance(Stance(pose, self.robot.solve(*pose), wish, reach))

    def _standing(self, pose: Pose) -> Stance:
        reach = self.robot.reach(pose)
        return Stance(pose, self._joints(reach, pose), pose, reach)

    def _joints(self, reach: Reach, pose: Pose) -> Joints:
        return reach.joints if reach.joints is not None else self.robot.solve(*pose)

    def _set_stance(self, stance: Stance) -> None:
        self.stance = stance
        self.stance_changed.emit(stance)
