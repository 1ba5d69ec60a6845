"""The reachable space around the robot, coloured by conditioning; computed in a worker, cached for everyone."""

from __future__ import annotations

import math
from collections.abc import Hashable

import viser

from app.recent import Recent
from app.ui import jobs
from app.ui.compute import Worker
from app.ui.jobs import CloudPicture, SurfacePicture
from app.ui.session import Session

CACHE_SIZE = 48
NODE = "/robot/workspace"


WorkspaceCache = Recent[Hashable, SurfacePicture | CloudPicture]
"""Pictures that every session shares."""


class WorkspaceView:
    """Shows what the view options ask for; the previous picture stays until the new one is there."""

    def __init__(self, client: viser.ClientHandle, session: Session, worker: Worker, cache: WorkspaceCache) -> None:
        self._scene = client.scene
        self._session = session
        self._worker = worker
        self._cache = cache
        self._node: viser.SceneNodeHandle | None = None
        self._shown: Hashable = None
        session.robot_changed.connect(lambda _: self._update())
        session.view_changed.connect(lambda _: self._update())
        self._update()

    def _update(self) -> None:
        session, style = self._session, self._session.view.workspace
        angle = round(math.degrees(session.view.workspace_angle)) if session.robot.dof == 4 else 0
        key = (session.robot_name, tuple(sorted(session.dimensions.items())), style, angle)
        if key == self._shown:
            return
        self._shown = key
        if style == "Off":
            self._worker.cancel()
            self._clear()
        elif (known := self._cache.get(key)) is not None:
            self._draw(known)
        else:
            job = jobs.reachable_surface if style == "Surface" else jobs.reachable_cloud
            self._worker.request(
                lambda result: self._arrived(key, result),
                job,
                session.robot_name,
                dict(session.dimensions),
                math.radians(angle),
            )

    def _arrived(self, key: Hashable, result: SurfacePicture | CloudPicture) -> None:
        self._cache.put(key, result)
        if key == self._shown:
            self._draw(result)

    def _draw(self, picture: SurfacePicture | CloudPicture) -> None:
        self._clear()
        if isinstance(picture, SurfacePicture):
            self._node = self._scene.add_glb(NODE, picture.glb, cast_shadow=False, receive_shadow=False)
            return
        self._node = self._scene.add_point_cloud(
            NODE,
            picture.points,
            picture.colors,
            point_size=0.16 * picture.spacing,
            point_shape="circle",
            precision="float32",
        )

    def _clear(self) -> None:
        if self._node is not None:
            self._node.remove()
            self._node = None
