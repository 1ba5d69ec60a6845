"""What has been drawn until now, on the sheet: it grows with the pen, and shrinks when somebody scrubs back."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from app.ui import theme
from app.ui.drawing.ink import BLOCKS, Ink, lay_ink, parts
from app.ui.pacing import Paced

REFRESH_S = 0.1
THINNEST_M = 0.0005
"""A thinner line would fade: from where one sees the whole sheet well, this is a pixel and a half."""

ABOVE = 1.5
"""Height of a line's middle above the paper, in widths. Where lines meet, the page errs by half a width in depth: from
lower down the plan would shine through."""

NOTHING = -1, 0.0, 0
"""Drawn before anything is."""


class InkView:
    """`/robot/sheet/ink` and its parts. A part that is complete is sent once; only the tip is sent again."""

    def __init__(self, scene: viser.SceneApi) -> None:
        self._scene = scene
        self._ink: Ink | None = None
        self._width_m = THINNEST_M
        self._parts: dict[tuple[int, int], viser.LineSegmentsHandle] = {}
        self._tip: viser.LineSegmentsHandle | None = None
        self._drawn = NOTHING
        self._pace = Paced(self._draw, REFRESH_S)

    def load(
        self,
        strokes_m: Sequence[NDArray[np.float64]],
        pen_m: float,
        stray: bool,
        lengths_m: NDArray[np.float64] | None = None,
    ) -> None:
        """Take another drawing; nothing of it is drawn yet.

        Args:
            strokes_m: (n, 2) each, sheet metres, in their order.
            pen_m: width of the pen.
            stray: draw the ways between the strokes too, for want of a lift.
            lengths_m: (k,) of the strokes as `show` will count them: a robot rounds the corners, which adds up.
        """
        self.clear()
        self._width_m = max(pen_m, THINNEST_M)
        self._ink = lay_ink(strokes_m, ABOVE * self._width_m, stray, lengths_m)

    def show(self, stroke: int, along_m: float, done: int) -> None:
        """Show, soon, what is drawn when `along_m` of a stroke is, or `done` strokes in a hop (`stroke` is -1)."""
        self._drawn = stroke, along_m, done
        if self._ink is not None:
            self._pace.request()

    def clear(self) -> None:
        """Show nothing, and forget the drawing."""
        self._pace.cancel()
        self._ink, self._drawn = None, NOTHING
        for node in self._parts.values():
            node.remove()
        if self._tip is not None:
            self._tip.remove()
        self._parts, self._tip = {}, None

    def close(self) -> None:
        """Stop what is still due."""
        self._pace.cancel()

    def _draw(self) -> None:
        if self._ink is None:
            return
        begun, share = self._ink.extent(*self._drawn)
        complete = parts(begun if share == 1.0 else begun - 1)
        for start, stop in complete:
            if (start, stop) not in self._parts:
                self._parts[start, stop] = self._add(f"{start}-{stop}", self._ink, *self._ink.cut(start, stop))
        self._show_only(set(complete))
        self._show_tip(self._ink, complete[-1][1] if complete else 0, begun, share)

    def _show_only(self, complete: set[tuple[int, int]]) -> None:
        """Hide the large parts that are not drawn now, for the next time; small ones are not worth keeping."""
        for part in list(self._parts):
            if part[1] - part[0] == BLOCKS[0]:
                self._parts[part].visible = part in complete
            elif part not in complete:
                self._parts.pop(part).remove()

    def _show_tip(self, ink: Ink, start: int, stop: int, share: float) -> None:
        """Draw what belongs to no complete part."""
        segments, stray = ink.cut(start, stop, share)
        if self._tip is not None:
            self._tip.visible = stop > start
        if stop == start:
            return
        if self._tip is None:
            self._tip = self._add("tip", ink, segments, stray)
        else:
            self._tip.points, self._tip.colors = segments, _colors(ink, stray)

    def _add(
        self, name: str, ink: Ink, segments: NDArray[np.float32], stray: NDArray[np.bool_]
    ) -> viser.LineSegmentsHandle:
        return self._scene.add_line_segments(
            f"/robot/sheet/ink/{name}", segments, _colors(ink, stray), thickness=self._width_m
        )


def _colors(ink: Ink, stray: NDArray[np.bool_]) -> NDArray[np.uint8]:
    """(n, 2, 3) where anything of the drawing is stray, else (3,)."""
    if not ink.stray.any():
        return np.array(theme.INK, dtype=np.uint8)
    return theme.line_colors(stray, theme.MARK, theme.INK)
