"""What worker processes do for the page: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.robots import build_robot, workspace
from app.robots.parts.part import Part
from app.robots.parts.shading import Arrays
from app.ui import theme

CLOUD_POINTS = 6000
"""About this many points make a cloud that reads well and stays quick on a tablet."""

SURFACE_OPACITY = 0.38


class SurfacePicture(NamedTuple):
    """The boundary of the reachable space, coloured by conditioning."""

    glb: bytes


class CloudPicture(NamedTuple):
    """Reachable points, coloured by conditioning."""

    points: NDArray[np.float32]
    """(k, 3) m"""
    colors: NDArray[np.uint8]
    """(k, 3)"""
    spacing: float
    """Distance of neighbours, m."""


def reachable_surface(name: str, dimensions: dict[str, float], rotation: float) -> SurfacePicture:
    """Picture of the workspace at one angle of the platform (rad)."""
    from trimesh import Trimesh
    from trimesh.visual.material import PBRMaterial
    from trimesh.visual.texture import TextureVisuals

    surface = workspace.boundary(build_robot(name, dimensions), rotation)
    colors = theme.conditioning_colors(surface.conditioning)
    opacity = np.full((len(colors), 1), round(255 * SURFACE_OPACITY), dtype=np.uint8)
    mesh = Trimesh(surface.vertices, surface.faces, process=False)
    material = PBRMaterial(alphaMode="BLEND", doubleSided=True, metallicFactor=0.0, roughnessFactor=0.9)
    mesh.visual = TextureVisuals(uv=np.zeros((len(colors), 2)), material=material)
    mesh.visual.vertex_attributes["color"] = np.hstack([colors, opacity])
    glb = mesh.export(file_type="glb")
    assert isinstance(glb, bytes)
    return SurfacePicture(glb)


def reachable_cloud(name: str, dimensions: dict[str, float], rotation: float) -> CloudPicture:
    """Cloud of the workspace at one angle of the platform (rad)."""
    robot = build_robot(name, dimensions)
    step = workspace.step_for(robot, rotation, CLOUD_POINTS)
    cloud = workspace.cloud(robot, rotation, step)
    return CloudPicture(cloud.points.astype(np.float32), theme.conditioning_colors(cloud.conditioning), step)


def part_arrays(parts: tuple[Part, ...]) -> list[Arrays]:
    """Vertices and faces of each part, for shapes whose dimensions have changed."""
    return [part.arrays() for part in parts]


def warm_up() -> None:
    """Start a worker before someone waits for it."""
