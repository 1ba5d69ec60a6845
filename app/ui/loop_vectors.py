"""The closed chain of one leg as vectors, named as in the papers:  B + A + l = P + D."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from app.robots.parts import machine_of
from app.ui import theme
from app.ui.session import Session

NAMES = ("B", "A", "l", "P", "D")
"""Base, arm, rod; pose, and from the tool to the platform joint."""

LEAST_LENGTH_M = 1e-3
"""A shorter vector is no arrow: the 5R's rods end at the tool's axis, so it has no D."""


class LoopVectors:
    """Arrows and their names, for the robot that the session has now."""

    def __init__(self, scene: viser.SceneApi, session: Session, leg: int) -> None:
        self._scene = scene
        self._session = session
        self._leg = leg
        self._lift = machine_of(session.robot).lift
        self._arrows: viser.ArrowsHandle | None = None
        self._labels: list[viser.LabelHandle] = []

    def show(self) -> None:
        """Draw the chain for the present stance."""
        chain = leg_chain(self._session, self._leg, self._lift)
        if self._arrows is None:
            self._create(chain)
            return
        self._arrows.points = chain
        for label, (start, end) in zip(self._labels, chain, strict=True):
            label.position = 0.5 * (start + end)

    def remove(self) -> None:
        for handle in (self._arrows, *self._labels):
            if handle is not None:
                handle.remove()

    def _create(self, chain: NDArray[np.float32]) -> None:
        colors = [theme.leg_color(self._leg)] * 3 + [theme.VECTOR] * 2
        self._arrows = self._scene.add_arrows(
            "/robot/vectors",
            chain,
            np.array(colors[: len(chain)], dtype=np.uint8),
            shaft_radius=0.0028,
            head_radius=0.007,
            head_length=0.02,
        )
        number = "₁₂₃₄"[self._leg]
        for name, (start, end) in zip(NAMES, chain, strict=False):
            self._labels.append(
                self._scene.add_label(
                    f"/robot/vector_{name}",
                    name if name == "P" else name + number,
                    position=0.5 * (start + end),
                    font_screen_scale=1.1,
                )
            )


def leg_chain(session: Session, leg: int, lift: float) -> NDArray[np.float32]:
    """(k, 2, 3) start and end of each vector, in the order of `NAMES`, raised to where the machine is drawn."""
    robot, stance = session.robot, session.stance
    skeleton = robot.skeleton(stance.pose, stance.joints)
    base, elbow, platform = (points[leg] for points in skeleton[:3])
    origin, tool = np.zeros(3), np.array(stance.position)
    if lift:
        tool[2] = platform[2]
    chain = [(origin, base), (base, elbow), (elbow, platform), (origin, tool), (tool, platform)]
    kept = [vector for vector in chain if np.linalg.norm(vector[1] - vector[0]) >= LEAST_LENGTH_M]
    return np.array(kept, dtype=np.float32) + np.array([0.0, 0.0, lift], dtype=np.float32)
