"""The drawn machines' shapes: closed, small, standing on their floor, and the same in the committed files."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from app.robots import ROBOTS, GeometryError, Robot, make_robot
from app.robots.parts import LEG, MATERIALS, library, machine_of
from app.robots.parts.shading import split_sharp_edges
from tests.support.machines import VARIANTS, reachable_poses, where

MESHES = Path(__file__).parents[2] / "meshes"


@pytest.fixture(params=VARIANTS, ids=lambda variant: f"{variant[0]}-{len(variant[1])}")
def robot(request: pytest.FixtureRequest) -> Robot:
    name, dimensions = request.param
    return make_robot(name, **dimensions)


def test_shapes_are_closed_and_turned_inside_out_nowhere(robot: Robot) -> None:
    for part in machine_of(robot).parts:
        mesh = part.mesh()
        assert mesh.is_watertight, part.name
        assert mesh.is_winding_consistent, part.name
        assert all(body.volume > 0.0 for body in mesh.split(only_watertight=False)), part.name


@pytest.mark.parametrize("name", ROBOTS)
def test_shapes_stay_closed_at_the_ends_of_every_dimension(name: str) -> None:
    tried = 0
    for symbol, dimension in ROBOTS[name].geometry.dimensions().items():
        for value in (dimension.low, dimension.high):
            try:
                robot = make_robot(name, **dict[str, Any]({symbol: value}))
            except GeometryError:
                continue
            tried += 1
            for part in machine_of(robot).parts:
                mesh = part.mesh()
                assert len(mesh.faces) > 0, f"{symbol}={value}: {part.name}"
                assert mesh.is_watertight, f"{symbol}={value}: {part.name}"
    assert tried >= 5


def test_names_and_materials_are_known(robot: Robot) -> None:
    machine = machine_of(robot)
    names = [part.name for part in machine.parts]
    assert len(set(names)) == len(names)
    assert {part.material for part in machine.parts} <= {*MATERIALS, LEG}
    for body in machine.bodies:
        if any(part.material == LEG for part in body.parts):
            assert None not in body.legs


def test_changing_a_length_changes_only_the_parts_that_have_it() -> None:
    before, after = (set(machine_of(make_robot("par4", l=l)).parts) for l in (0.386, 0.40))
    assert {part.name for part in after - before} == {"rod", "rod_fittings", "stand", "stand_fittings"}


def test_machines_stand_on_their_floor(robot: Robot) -> None:
    machine = machine_of(robot)
    lowest = min(
        part.mesh().bounds[0, 2] + float(body.fixed.positions[:, 2].min())
        for body in machine.bodies
        if body.fixed is not None and body.frame == "base"
        for part in body.parts
    )
    assert lowest == pytest.approx(machine.floor, abs=1e-6)
    tool_low = min(part.mesh().bounds[0, 2] for body in machine.bodies if body.frame == "tool" for part in body.parts)
    assert tool_low == pytest.approx(machine.tool_tip, abs=1e-6)
    heights = reachable_poses(robot, 300)[:, 2]
    assert heights.min() + tool_low > machine.floor


def test_machines_have_a_sane_size() -> None:
    for name, low, high in (("par4", 0.7, 1.1), ("delta3", 0.5, 1.1), ("linear", 0.8, 1.2), ("fivebar", 0.3, 0.8)):
        machine = machine_of(make_robot(name))
        corners = []
        for body in machine.bodies:
            if body.fixed is None or body.frame == "tool":
                continue
            for part in body.parts:
                box = part.mesh().bounding_box.vertices
                corners += [where(body.fixed, copy, corner) for copy in range(len(body.legs)) for corner in box]
        size = np.ptp(np.array(corners), axis=0)
        assert low < size.max() < high, name


def test_sharp_edges_are_split_and_round_ones_are_not() -> None:
    import trimesh

    cube = trimesh.creation.box()
    vertices, faces = split_sharp_edges(cube.vertices, cube.faces)
    assert (len(vertices), len(faces)) == (24, 12)
    ball = trimesh.creation.icosphere(subdivisions=3)
    vertices, faces = split_sharp_edges(ball.vertices, ball.faces)
    assert len(vertices) == len(ball.vertices)
    assert np.allclose(vertices[faces], ball.vertices[ball.faces], atol=1e-6)


def test_arrays_draw_the_same_triangles_as_the_mesh(robot: Robot) -> None:
    for part in machine_of(robot).parts:
        mesh, (vertices, faces) = part.mesh(), part.arrays()
        assert vertices.dtype == np.float32
        assert faces.dtype == np.uint32
        assert np.allclose(vertices[faces], mesh.vertices[mesh.faces], atol=1e-6)


@pytest.mark.parametrize("name", ROBOTS)
def test_committed_meshes_are_what_the_code_builds(name: str) -> None:
    parts = machine_of(make_robot(name)).parts
    assert {path.stem for path in (MESHES / name).glob("*.glb")} == {part.name for part in parts}
    for part in parts:
        built, read = part.mesh(), library.load(name, part.name, MESHES)
        assert read.is_watertight, part.name
        assert np.allclose(read.bounds, built.bounds, atol=1e-6), part.name
        assert read.area == pytest.approx(built.area, rel=1e-4), part.name
        assert read.volume == pytest.approx(built.volume, rel=1e-3), part.name


def test_committed_meshes_are_small() -> None:
    assert sum(path.stat().st_size for path in MESHES.glob("*/*.glb")) < 600_000


def test_meshes_are_written_anew_without_leftovers(tmp_path: Path) -> None:
    stale = tmp_path / "par4" / "propeller.glb"
    stale.parent.mkdir()
    stale.write_bytes(b"")
    written = library.build_all(tmp_path)
    assert not stale.exists()
    assert sorted(written) == sorted(tmp_path.glob("*/*.glb"))
    assert library.load("par4", "arm", tmp_path).is_watertight
    with pytest.raises(FileNotFoundError, match="propeller"):
        library.load("par4", "propeller", tmp_path)


def test_kinematics_do_not_load_solid_modelling_and_drawing_does_not_load_trimesh() -> None:
    script = (
        "import sys; from app.robots import make_robot; robot = make_robot('par4');"
        "assert 'manifold3d' not in sys.modules;"
        "from app.robots.parts import machine_of; [part.arrays() for part in machine_of(robot).parts];"
        "assert 'trimesh' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", script], check=True, cwd=MESHES.parent)
