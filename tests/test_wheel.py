"""What `pip install deltalab` gives: a wheel with meshes and lessons that serves the page from anywhere."""

from __future__ import annotations

import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

from app import __version__
from tests.support.imports import ROOT
from tests.support.server import get, running_deltalab

pytestmark = pytest.mark.wheel


def run(*command: str | Path, cwd: Path) -> str:
    """Output of a command that has to succeed."""
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The wheel, built from the checkout with the build backend that is installed for the tests."""
    folder = tmp_path_factory.mktemp("wheel")
    build = ("pip", "wheel", "--no-deps", "--no-build-isolation", "--wheel-dir", folder, ROOT)
    run(sys.executable, "-m", *build, cwd=folder)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def environment(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty environment with the wheel in it.

    The libraries come from the environment of the tests, on the path after the wheel. Path files lying there
    are not followed, so that a checkout installed for editing stays out of sight.
    """
    folder = tmp_path_factory.mktemp("environment")
    venv.create(folder)
    python = folder / "bin" / "python"
    run(
        sys.executable,
        "-m",
        "pip",
        "--python",
        python,
        "install",
        "--no-deps",
        "--no-index",
        wheel,
        cwd=folder,
    )
    purelib = Path(run(python, "-c", "import sysconfig; print(sysconfig.get_path('purelib'))", cwd=folder).strip())
    libraries = {sysconfig.get_path("purelib"), sysconfig.get_path("platlib")}
    (purelib / "libraries.pth").write_text("\n".join(sorted(libraries)))
    return folder


def test_the_wheel_holds_meshes_lessons_and_the_licence(wheel: Path) -> None:
    assert wheel.name.startswith(f"deltalab-{__version__}-py3-none-any")
    names = zipfile.ZipFile(wheel).namelist()
    checkout = {f"app/_data/{path.relative_to(ROOT)}" for path in (ROOT / "meshes").rglob("*.glb")}
    assert checkout
    assert checkout <= set(names)
    assert "app/_data/lessons/README.md" in names
    assert any(name.endswith("/LICENSE") for name in names)
    assert not [name for name in names if not name.startswith(("app/", "deltalab-"))]


def test_the_installed_package_is_the_wheel_with_its_own_data(environment: Path, tmp_path: Path) -> None:
    script = "import app; from app.resources import meshes_dir, lessons_dir; print(app.__file__)\n"
    script += "print(meshes_dir()); print(lessons_dir())"
    for line in run(environment / "bin" / "python", "-c", script, cwd=tmp_path).splitlines():
        assert Path(line).is_relative_to(environment)
        assert Path(line).exists()


def test_it_serves_the_page_from_any_folder(environment: Path, tmp_path: Path) -> None:
    with running_deltalab(command=[str(environment / "bin" / "deltalab")], cwd=tmp_path) as server:
        status, page = get(server.url)
        assert status == 200
        assert "<html" in page
        assert get(f"{server.url}/healthz")[0] == 200
    assert list(tmp_path.iterdir()) == [], "serving leaves files behind"
