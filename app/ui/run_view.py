"""A run in 3-D: where the tool should have gone, and where it went, its error made larger to be seen."""

from __future__ import annotations

import numpy as np
import viser
from numpy.typing import NDArray

from app.simulation import Run
from app.ui import theme

POINTS = 600
LONGEST_ERROR_M = 0.15
"""A magnified error is drawn no longer than this."""


class RunView:
    """`/robot/run/reference` and `/robot/run/actual`."""

    def __init__(self, scene: viser.SceneApi) -> None:
        self._scene = scene
        self._nodes: list[viser.LineSegmentsHandle] = []
        self._run: Run | None = None
        self._factor = 1.0

    def show(self, run: Run | None) -> None:
        """Draw a run, or nothing."""
        self._run = run
        self._draw()

    def magnify(self, factor: float) -> None:
        """Draw the tool's error this many times as large."""
        self._factor = factor
        self._draw()

    def _draw(self) -> None:
        for node in self._nodes:
            node.remove()
        self._nodes = []
        if self._run is None:
            return
        chosen = self._run.outline(POINTS)
        wanted, actual = self._run.pose_ref[chosen, :3], self._run.pose[chosen, :3]
        self._add("reference", wanted, theme.REFERENCE, 2.0)
        self._add("actual", wanted + enlarged(actual - wanted, self._factor), theme.ACTUAL, 3.5)

    def _add(self, name: str, points: NDArray[np.float64], color: theme.Rgb, thickness: float) -> None:
        segments = np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)
        self._nodes.append(
            self._scene.add_line_segments(
                f"/robot/run/{name}", segments, color, thickness=thickness, thickness_units="screen"
            )
        )


def enlarged(errors: NDArray[np.float64], factor: float) -> NDArray[np.float64]:
    """(k, 3) times the factor, none longer than `LONGEST_ERROR_M` or what it really is."""
    lengths = np.linalg.norm(errors, axis=1, keepdims=True)
    longest = np.maximum(LONGEST_ERROR_M, lengths)
    return errors * np.minimum(factor, longest / np.maximum(lengths, 1e-12))
