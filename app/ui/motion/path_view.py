"""The way of the tool in 3-D: marked where a limit of the drives is touched."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from app.motion import Motion
from app.ui import theme
from app.ui.motion.desk import MotionDesk

NODE = "/robot/motion/path"
POINTS = 800


class PathView:
    """`/robot/motion/path`: there while the tab is in front and its motion, not a simulated run, is loaded to play."""

    def __init__(self, scene: viser.SceneApi, desk: MotionDesk) -> None:
        self._scene = scene
        self._desk = desk
        self._node: viser.LineSegmentsHandle | None = None
        self._front = False
        desk.playback.loaded.connect(lambda _: self._show())
        desk.planned.connect(lambda _: self._draw())
        desk.refused.connect(lambda _: self._draw())
        desk.settings_changed.connect(lambda _: self._drop_other_robots())

    def visible(self, front: bool) -> None:
        """Whether the tab is in front."""
        self._front = front
        self._show()

    @property
    def _shown(self) -> bool:
        return self._front and self._desk.playback.run is self._desk.motion

    def _show(self) -> None:
        if self._node is not None and self._node.visible != self._shown:
            self._node.visible = self._shown

    def _drop_other_robots(self) -> None:
        if self._desk.motion is None:
            self._remove()

    def _draw(self) -> None:
        self._remove()
        motion = self._desk.motion
        if motion is None:
            return
        segments, touched = path_segments(motion)
        if self._desk.refusal:
            touched = np.zeros_like(touched)
        colors = theme.line_colors(touched, theme.MARK, theme.PLAN if self._desk.refusal else theme.REFERENCE)
        self._node = self._scene.add_line_segments(
            NODE, segments, colors, thickness=3.0, thickness_units="screen", visible=self._shown
        )

    def _remove(self) -> None:
        if self._node is not None:
            self._node.remove()
            self._node = None


def path_segments(motion: Motion) -> tuple[NDArray[np.float32], NDArray[np.bool_]]:
    """(s, 2, 3) m along the tool's way, and (s,) whether a limit is touched anywhere in a segment."""
    marks = np.unique(np.linspace(0, len(motion.t) - 1, POINTS).astype(int))
    points = np.asarray(motion.pose)[marks, :3]
    segments = np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)
    touched = np.logical_or.reduceat(np.asarray(motion.touched), marks[:-1])
    return segments, touched
