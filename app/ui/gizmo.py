"""The handles at the tool: arrows and planes that move it, and a ring that turns it where the robot can turn.

While a drag leaves the reach, the gizmo stays under the pointer and only the robot is held back; when it is
let go, the gizmo returns to the robot.
"""

from __future__ import annotations

import math

import viser

from app.signal import Signal
from app.ui.session import Session
from app.ui.state import Stance
from app.ui.viser_adapter import NodeStream, silence_gizmo_echo

GIZMO_SIZE_M = 0.16

RING_SIZE = 1.4
"""Of the ring relative to the arrows, so that it lies outside of their planes."""


class Gizmo:
    """`/robot/gizmo` and, for a robot with a rotation, the ring `/robot/platform/turn`, which rides along."""

    def __init__(self, client: viser.ClientHandle, session: Session, stream: NodeStream) -> None:
        self.held: Signal[bool] = Signal()
        """Somebody has taken hold of it, or let it go."""
        self._client = client
        self._session = session
        self._stream = stream
        self._turn = 0.0
        """At which the ring was last shown, rad."""
        self._dragged: viser.TransformControlsHandle | None = None
        self._arrows: viser.TransformControlsHandle | None = None
        self._ring: viser.TransformControlsHandle | None = None
        self._visible = True
        session.robot_changed.connect(lambda _: self.build())
        session.stance_changed.connect(self.follow)
        self.build()

    def build(self) -> None:
        """Make the handles for the present robot."""
        for handle in (self._arrows, self._ring):
            if handle is not None:
                handle.remove()
        if self._dragged is not None:
            self.held.emit(False)
        self._dragged = self._ring = None
        self._turn = 0.0
        size = GIZMO_SIZE_M
        scene, position = self._client.scene, self._session.stance.position
        self._arrows = scene.add_transform_controls(
            "/robot/gizmo",
            size,
            disable_rotations=True,
            depth_test=False,
            position=position,
            visible=self._visible,
        )
        self._arrows.on_update(self._on_arrows)
        silence_gizmo_echo(self._arrows)
        if self._session.robot.rotation_name is None:
            return
        self._ring = scene.add_transform_controls(
            "/robot/platform/turn",
            size * RING_SIZE,
            line_width=4.0,
            active_axes=(True, True, False),
            disable_axes=True,
            disable_sliders=True,
            depth_test=False,
            visible=self._visible,
        )
        self._ring.on_update(self._on_ring)
        silence_gizmo_echo(self._ring)
        self.follow(self._session.stance)

    def visible(self, on: bool) -> None:
        """Show or hide the handles, while others are shown in the same place."""
        self._visible = on
        for handle in (self._arrows, self._ring):
            if handle is not None:
                handle.visible = on

    def follow(self, stance: Stance) -> None:
        """Keep the handles at the tool, except the one in hand."""
        if self._arrows is not None and self._arrows is not self._dragged:
            self._stream.move(self._arrows, stance.wished_position)
        if self._ring is None or self._ring is self._dragged or len(stance.wish) < 4:
            return
        if stance.wish[3] != self._turn:
            self._turn = stance.wish[3]
            self._stream.move(self._ring, (0.0, 0.0, 0.0), _about_z(self._turn))

    async def _on_arrows(self, event: viser.TransformControlsEvent) -> None:
        self._on_phase(event)
        if event.phase == "update":
            self._session.drag(position=event.target.position)

    async def _on_ring(self, event: viser.TransformControlsEvent) -> None:
        self._on_phase(event)
        if event.phase == "update":
            w, _, _, z = event.target.wxyz
            turn = 2.0 * math.atan2(float(z), float(w))
            self._session.drag(rotation=math.remainder(turn, math.tau))

    def _on_phase(self, event: viser.TransformControlsEvent) -> None:
        if event.phase == "end":
            self._dragged = None
            self._session.release()
            self.held.emit(False)
        elif self._dragged is not event.target:
            self._dragged = event.target
            self.held.emit(True)


def _about_z(angle: float) -> tuple[float, float, float, float]:
    return (math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))
