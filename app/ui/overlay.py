"""Drawings over the robot: the loop of one leg, coordinate frames, and the trace of the tool."""

from __future__ import annotations

import math
from collections import deque

import numpy as np
import viser

from app.ui import theme
from app.ui.loop_vectors import LoopVectors
from app.ui.pacing import Paced
from app.ui.session import Session

TRACE_POINTS = 600
TRACE_STEP_M = 0.001
"""The tool must move this far before its trace grows."""

REFRESH_S = 0.05


class Overlay:
    """What the view options add to the robot of one browser."""

    def __init__(self, client: viser.ClientHandle, session: Session) -> None:
        self._scene = client.scene
        self._session = session
        self._trace: deque[tuple[float, ...]] = deque(maxlen=TRACE_POINTS)
        self._trace_lines: viser.LineSegmentsHandle | None = None
        self._vectors: LoopVectors | None = None
        self._frames: list[viser.FrameHandle] = []
        self._pace = Paced(self._refresh, REFRESH_S)
        session.robot_changed.connect(lambda _: self._rebuild())
        session.view_changed.connect(lambda _: self._rebuild())
        session.stance_changed.connect(lambda _: self._request())
        self._rebuild()

    def clear_trace(self) -> None:
        self._trace.clear()
        self._draw_trace()

    def close(self) -> None:
        self._pace.cancel()

    def _rebuild(self) -> None:
        view = self._session.view
        for frame in self._frames:
            frame.remove()
        self._frames = self._add_frames() if view.frames else []
        if self._vectors is not None:
            self._vectors.remove()
            self._vectors = None
        if view.vectors_leg is not None and view.vectors_leg < self._session.robot.legs:
            self._vectors = LoopVectors(self._scene, self._session, view.vectors_leg)
        self.clear_trace()
        self._refresh()

    def _request(self) -> None:
        if self._vectors is not None or self._session.view.trace:
            self._pace.request()

    def _add_frames(self) -> list[viser.FrameHandle]:
        names = ("/robot/base_frame", "/robot/tool/frame")
        return [self._scene.add_frame(n, axes_length=0.08, axes_radius=0.0022, origin_radius=0.004) for n in names]

    def _refresh(self) -> None:
        if self._vectors is not None:
            self._vectors.show()
        if self._session.view.trace:
            self._lengthen_trace()

    def _lengthen_trace(self) -> None:
        point = self._session.stance.position
        if not self._trace or math.dist(point, self._trace[-1]) >= TRACE_STEP_M:
            self._trace.append(point)
            self._draw_trace()

    def _draw_trace(self) -> None:
        if len(self._trace) < 2:
            if self._trace_lines is not None:
                self._trace_lines.remove()
                self._trace_lines = None
            return
        points = np.array(self._trace, dtype=np.float32)
        segments = np.stack([points[:-1], points[1:]], axis=1)
        if self._trace_lines is None:
            self._trace_lines = self._scene.add_line_segments(
                "/robot/trace", segments, theme.TRACE, thickness=3.0, thickness_units="screen"
            )
        else:
            self._trace_lines.points = segments
