"""What a machine is made of: bodies that move as one piece, each of one or more parts of one material."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots.parts.shading import Arrays, split_sharp_edges
from app.robots.parts.solids import Solid, Solids

if TYPE_CHECKING:
    from trimesh import Trimesh

LEG = "leg"
"""The material of parts that are painted in the colour of the leg they belong to."""


Frame = Literal["base", "platform", "tool"]
"""`platform` has its origin at the pose's position and never turns; `tool` is there too and turns with the tool."""


class Placement(NamedTuple):
    """Where the copies of a body are, in the body's `Frame`."""

    positions: NDArray[np.float32]
    """(n, 3) metres."""
    wxyzs: NDArray[np.float32]
    """(n, 4) unit quaternions. An array that never changes is the same object every time."""


@dataclass(frozen=True)
class Part:
    """One shape of one material in its body's frame. Equal parts have equal shapes."""

    name: str
    """Unique in its machine; the name of its file."""
    material: str
    """A key of `MATERIALS`, or `LEG`."""
    build: Callable[..., Solid | Solids]
    dimensions: tuple[Any, ...]
    """What `build` is called with: everything that decides the shape."""
    casts_shadow: bool = True
    """Off for large plates, which a renderer covers with stripes of their own shadow."""

    def arrays(self) -> Arrays:
        """Vertices (v, 3) float32 and faces (f, 3) uint32 to draw with smooth normals: sharp edges are split."""
        return _arrays(self.build, self.dimensions)

    def mesh(self) -> Trimesh:
        """The closed mesh, metres."""
        from trimesh import Trimesh

        vertices, faces = _closed(self.build, self.dimensions)
        return Trimesh(vertices, faces, process=False)


@dataclass(frozen=True)
class Body:
    """A rigid piece of the machine, drawn once for each copy."""

    name: str
    parts: tuple[Part, ...]
    legs: tuple[int | None, ...] = (None,)
    """One entry a copy: the leg it belongs to, counted from 0."""
    frame: Frame = "base"
    """Where its placements are meant. A body that rests in the frame of the platform or the tool needs no
    update of its own while that moves."""
    fixed: Placement | None = field(default=None, compare=False)
    """Where its copies stand in `frame`; None for a body that `Machine.place` places."""


@lru_cache(maxsize=256)
def _arrays(build: Callable[..., Solid | Solids], dimensions: tuple[Any, ...]) -> Arrays:
    arrays = split_sharp_edges(*_closed(build, dimensions))
    for array in arrays:
        array.flags.writeable = False
    return arrays


def _closed(build: Callable[..., Solid | Solids], dimensions: tuple[Any, ...]) -> tuple[NDArray, NDArray]:
    """Vertices (v, 3) and faces (f, 3) of all solids of a shape together."""
    built = build(*dimensions)
    meshes = [solid.to_mesh64() for solid in (built if isinstance(built, list) else [built])]
    starts = np.cumsum([0, *(len(mesh.vert_properties) for mesh in meshes)])
    vertices = np.vstack([mesh.vert_properties for mesh in meshes])
    faces = np.vstack([mesh.tri_verts.astype(np.int64) + k for mesh, k in zip(meshes, starts[:-1], strict=True)])
    return vertices, faces
