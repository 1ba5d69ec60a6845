"""The parts as GLB files, one a part: what each robot looks like with its default dimensions.

They are for whoever wants the machines outside of this program. A file says in its `extras` which part it shows
and for which dimensions it was made.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from app.robots import ROBOTS, make_robot
from app.robots.parts.machines import machine_of
from app.robots.parts.materials import MATERIALS, Material
from app.robots.parts.part import LEG, Part

if TYPE_CHECKING:
    from trimesh import Trimesh

LEG_IN_FILES = Material((120, 130, 145), 0.2, 0.5)
"""A file has no leg to take a colour from."""


def build_all(directory: Path) -> list[Path]:
    """Write `<robot>/<part>.glb` for every part of every robot; files of parts that no longer exist go."""
    written = []
    for name in ROBOTS:
        folder = directory / name
        folder.mkdir(parents=True, exist_ok=True)
        for part in machine_of(make_robot(name)).parts:
            path = folder / f"{part.name}.glb"
            path.write_bytes(glb(part))
            written.append(path)
    for path in directory.glob("*/*.glb"):
        if path not in written:
            path.unlink()
    return written


def load(robot_name: str, part_name: str, directory: Path) -> Trimesh:
    """A part's closed mesh from its file, metres, z up.

    Raises:
        FileNotFoundError: where there is no such file.
    """
    import trimesh

    path = directory / robot_name / f"{part_name}.glb"
    if not path.is_file():
        raise FileNotFoundError(f"There is no {path}; write the meshes anew.")
    mesh = trimesh.load(path, force="mesh", process=False)
    assert isinstance(mesh, trimesh.Trimesh)
    return mesh


def glb(part: Part) -> bytes:
    """A part as binary glTF."""
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    look = LEG_IN_FILES if part.material == LEG else MATERIALS[part.material]
    mesh = part.mesh().copy()
    mesh.visual = TextureVisuals(
        material=PBRMaterial(
            name=part.material,
            baseColorFactor=[*look.color, 255],
            metallicFactor=look.metallic,
            roughnessFactor=look.roughness,
        )
    )
    mesh.metadata = {"part": part.name, "dimensions": repr(part.dimensions)}
    exported = mesh.export(file_type="glb")
    assert isinstance(exported, bytes)
    return exported
