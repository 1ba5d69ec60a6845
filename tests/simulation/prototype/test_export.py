"""`deltalab export`: files that MuJoCo loads, shapes where the machine has them, loops that stay closed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from app.cli import EXIT_MISTAKE, main
from app.robots import ROBOTS, make_robot
from app.robots.parts.machines import machine_of
from app.simulation.prototype.drawn import LEG_COLORS, copies, geom_of
from app.simulation.prototype.engine import Data, Model, mujoco
from app.ui import theme

PUSH = {"par4": 1.0, "delta3": 0.4, "linear": 6.0, "fivebar": 20.0}
"""N m or N on the first motor beside the robot's weight; half of it backwards on the second."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("models")


@pytest.fixture(params=ROBOTS, scope="module")
def exported(request: pytest.FixtureRequest, folder: Path) -> tuple[str, Path]:
    path = folder / f"{request.param}.xml"
    assert main(["export", request.param, "-o", str(path)]) == 0
    return request.param, path


def load(path: Path) -> tuple[Model, Data]:
    model = mujoco().MjModel.from_xml_path(str(path))
    return model, mujoco().MjData(model)


def widest_gap(m: Model, d: Data) -> float:
    """m, between the ends of the loops."""
    loops = m.eq_type[d.efc_id[: d.ne]] == mujoco().mjtEq.mjEQ_CONNECT
    return float(np.linalg.norm(d.efc_pos[: d.ne][loops].reshape(-1, 3), axis=1).max())


def test_loops_stay_closed_in_free_fall_onto_the_stops(exported: tuple[str, Path]):
    name, path = exported
    m, d = load(path)
    before, gap = d.qpos.copy(), 0.0
    while d.time < 1.0:
        mujoco().mj_step(m, d, 5)
        gap = max(gap, widest_gap(m, d))
    assert gap < 50e-6
    assert np.isfinite(d.qpos).all()
    low, high = make_robot(name).joint_limits.T
    joints = [float(d.joint(joint).qpos[0]) for joint in make_robot(name).joint_names]
    assert (joints > low - 0.02).all() and (joints < high + 0.02).all()
    assert np.abs(d.qpos - before).max() > 1e-4, "it fell"


def test_the_key_home_holds_the_robot_up(exported: tuple[str, Path]):
    name, path = exported
    m, d = load(path)
    mujoco().mj_resetDataKeyframe(m, d, m.key("home").id)
    mujoco().mj_step(m, d, 1000)
    assert np.allclose(d.site("tool").xpos, make_robot(name).home[:3], rtol=0, atol=2e-5)


def test_shapes_are_where_the_machine_has_them(exported: tuple[str, Path]):
    """After a push, in the pose in which MuJoCo then finds the robot: every corner of every part."""
    name, path = exported
    robot = make_robot(name)
    m, d = load(path)
    mujoco().mj_resetDataKeyframe(m, d, 0)
    d.ctrl[:2] += (PUSH[name], -0.5 * PUSH[name])
    if name == "fivebar":
        d.ctrl[2:] = (9.0, -7.0)
    while d.time < 0.25:
        mujoco().mj_step(m, d)
    mujoco().mj_forward(m, d)
    pose, joints = ([float(d.joint(key).qpos[0]) for key in keys] for keys in (robot.pose_names, robot.joint_names))
    assert np.linalg.norm(np.subtract(pose, robot.home)) > 0.01
    shown = 0
    for copy in copies(machine_of(robot), pose, joints):
        for part in copy.body.parts:
            expected = np.array([copy.frame.point(corner) for corner in extremes(part.mesh().vertices)])
            assert np.allclose(corners_in_mujoco(m, d, geom_of(part, copy.number), expected), expected, atol=2e-5), part
            shown += 1
    assert shown == (m.geom_type == mujoco().mjtGeom.mjGEOM_MESH).sum()


def extremes(vertices: np.ndarray) -> np.ndarray:
    """Twelve vertices that lie outermost along some directions."""
    directions = np.random.default_rng(0).normal(size=(12, 3))
    return np.asarray(vertices)[np.argmax(directions @ np.asarray(vertices).T, axis=1)]


def corners_in_mujoco(m: Model, d: Data, geom: str, wanted: np.ndarray) -> np.ndarray:
    """The vertices of a mesh in the world that are nearest to some points."""
    shape = m.geom(geom)
    mesh = int(shape.dataid[0])
    first, count = m.mesh_vertadr[mesh], m.mesh_vertnum[mesh]
    vertices = m.mesh_vert[first : first + count] @ d.geom(geom).xmat.reshape(3, 3).T + d.geom(geom).xpos
    distances = np.linalg.norm(vertices[None] - wanted[:, None], axis=2)
    return vertices[np.argmin(distances, axis=1)]


def test_legs_have_the_colours_of_the_page():
    assert LEG_COLORS == theme.LEGS


def test_dimensions_can_be_set(folder: Path, capsys: pytest.CaptureFixture[str]):
    path = folder / "long.xml"
    assert main(["export", "par4", "-o", str(path), "--set", "l=0.42", "--set", "h=0.06"]) == 0
    assert "mujoco.viewer" in capsys.readouterr().out
    m, _ = load(path)
    loops = {m.body(row).name: data for row, data in zip(m.eq_obj1id, m.eq_data, strict=True)}
    assert loops["rod1a"][:3] == pytest.approx([0.0, 0.0, -0.42])
    assert loops["link2"][:3] == pytest.approx([0.0, 0.06, 0.0])


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["par5"], "There is no robot 'par5'"),
        (["par4", "--set", "l"], "A dimension is written name=number, say l=0.42, not 'l'."),
        (["par4", "--set", "l=long"], "A dimension is written name=number"),
        (["par4", "--set", "lenght=0.4"], "is not a dimension of this robot"),
        (["par4", "--set", "l=5"], "Rod length (l) must lie between"),
        (["par4", "-o", "robot.stl"], "choose a file ending in .xml"),
    ],
)
def test_a_mistake_is_one_sentence(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    assert main(["export", *arguments]) == EXIT_MISTAKE
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 1 and message in said[0]
    assert not list(tmp_path.iterdir())


def test_an_unwritable_place_is_named(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    (tmp_path / "taken").write_text("a file, no folder")
    assert main(["export", "linear", "-o", str(tmp_path / "taken" / "robot.xml")]) == EXIT_MISTAKE
    said = capsys.readouterr().err.strip().splitlines()
    assert len(said) == 1 and said[0].startswith("Cannot write")
