"""The architecture: imports point downwards, foreign libraries stay in their layer, files stay small."""

from __future__ import annotations

import ast
import graphlib
import importlib.metadata
import re
import sys
import tomllib
from pathlib import Path

import pytest

from tests.support.imports import ROOT, imports_of, module_name

APP = ROOT / "app"
LAYERS = [
    "foundation",
    "robots",
    "motion",
    "control",
    "simulation",
    "drawing",
    "link",
    "classroom",
    "ui",
    "cli",
]
"""From the bottom to the top; each may import itself and what stands before it."""

TOP_MODULES = {"app": "foundation", "app.errors": "foundation", "app.resources": "foundation"}
TOP_MODULES |= {"app.recent": "foundation", "app.signal": "foundation"}
TOP_MODULES |= {"app.cli": "cli", "app.commands": "cli", "app.__main__": "cli"}
TOP_MODULES |= {"app.draw_command": "cli", "app.firmware_command": "cli", "app.link_command": "cli"}
TOP_MODULES |= {"app.link_console": "cli", "app.export_command": "cli", "app.lessons_command": "cli"}
TOP_MODULES |= {"app.equations": "foundation"}
HOMES = {"viser": "ui", "serial": "link"}
"""Library -> the only layer that may import it."""

ADAPTER = APP / "ui" / "viser_adapter.py"
MAX_LINES = 400
MAX_LINES_P90 = 250

FILES = sorted(path for path in APP.rglob("*.py") if "_data" not in path.parts)


def layer_of(module: str) -> str:
    """Layer of a module of ours, by its folder."""
    return TOP_MODULES.get(module) or module.split(".")[1]


def misplaced_imports(path: Path, root: Path = ROOT) -> list[str]:
    """Imports that point upwards, or bring a library into a layer that is not its home."""
    layer = layer_of(module_name(path, root))
    wrong = []
    for found in imports_of(path, root):
        if found.module.split(".")[0] == "app":
            upward = LAYERS.index(layer_of(found.module)) > LAYERS.index(layer)
        else:
            upward = HOMES.get(found.module.split(".")[0], layer) != layer
        if upward:
            wrong.append(f"{path.relative_to(root)}:{found.line} {layer} must not import {found.module}")
    return wrong


def private_reaches(source: str) -> list[int]:
    """Lines that touch somebody else's private names: `other._name`, or `_name` imported from viser."""
    return [line for node in ast.walk(ast.parse(source)) for line, name in _foreign_names(node) if _private(name)]


def _foreign_names(node: ast.AST) -> list[tuple[int, str]]:
    match node:
        case ast.Attribute(value=ast.Name(id="self" | "cls")) | ast.Attribute(attr="_replace" | "_asdict"):
            return []  # one's own, and what every named tuple offers
        case ast.Attribute(value=ast.Name(id="os"), attr="_exit"):
            return []  # documented, whatever its name looks like
        case ast.Attribute(attr=name):
            return [(node.lineno, name)]
        case ast.ImportFrom(module=str(module)) if module.split(".")[0] == "viser":
            imported = [*module.split("."), *(alias.name for alias in node.names)]
        case ast.Import():
            imported = [part for alias in node.names for part in alias.name.split(".")]
        case _:
            return []
    return [(node.lineno, name) for name in imported]


def _private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__")


def test_every_folder_is_a_layer() -> None:
    unknown = {layer_of(module_name(path)) for path in FILES} - set(LAYERS)
    assert not unknown, f"not in the layering: {unknown}"


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(APP)))
def test_imports_point_downwards(path: Path) -> None:
    assert misplaced_imports(path) == []


@pytest.mark.parametrize(
    ("file", "source", "complaints"),
    [
        ("app/robots/a.py", "from app.ui.state import State", 1),
        ("app/robots/a.py", "def f():\n    import viser", 1),
        ("app/robots/a.py", "from ..control import pid", 1),
        ("app/control/a.py", "import serial.tools.list_ports", 1),
        ("app/ui/a.py", "import viser\nfrom app.robots import make_robot\nfrom .state import State", 0),
        ("app/resources.py", "from app.robots import ROBOTS", 1),
        ("app/cli.py", "from app.ui.options import ServeOptions", 0),
    ],
)
def test_a_wrong_import_is_found(tmp_path: Path, file: str, source: str, complaints: int) -> None:
    path = tmp_path / file
    path.parent.mkdir(parents=True)
    path.write_text(source)
    for layer in LAYERS:
        (tmp_path / "app" / layer).mkdir(exist_ok=True)
    assert len(misplaced_imports(path, tmp_path)) == complaints


def test_no_file_imports_itself_in_a_circle() -> None:
    names = {module_name(path) for path in FILES}
    graph = {
        module_name(path): {found.module for found in imports_of(path) if found.at_start} & names for path in FILES
    }
    graphlib.TopologicalSorter(graph).prepare()


def test_private_viser_names_stay_in_the_adapter() -> None:
    reaches = {
        str(path.relative_to(ROOT)): lines
        for path in FILES
        if layer_of(module_name(path)) == "ui" and path != ADAPTER and (lines := private_reaches(path.read_text()))
    }
    assert reaches == {}


@pytest.mark.parametrize(
    ("source", "lines"),
    [
        ("server._websock_server", [1]),
        ("self._server.gui\nself._server._websock_server", [2]),
        ("import viser._messages", [1]),
        ("from viser import _messages", [1]),
        ("from viser._scene_api import cast_vector", [1]),
        ("import viser\nself._state\ncls._count\nhandle.__class__", []),
    ],
)
def test_a_private_reach_is_found(source: str, lines: list[int]) -> None:
    assert sorted(set(private_reaches(source))) == lines


def test_files_are_read_in_one_sitting() -> None:
    sizes = sorted((path.read_text().count("\n"), str(path.relative_to(ROOT))) for path in FILES)
    largest, p90 = sizes[-1], sizes[int(0.9 * (len(sizes) - 1))]
    assert largest[0] <= MAX_LINES, f"{largest[1]} has {largest[0]} lines"
    assert p90[0] <= MAX_LINES_P90, f"a tenth of the files have over {p90[0]} lines"


def test_every_imported_library_is_declared() -> None:
    """A fresh machine installs what `pyproject.toml` names and nothing else."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    declared = {_normal(re.split(r"[^\w.-]", dependency)[0]) for dependency in project["dependencies"]}
    distributions = importlib.metadata.packages_distributions()
    undeclared = {
        f"{path.relative_to(ROOT)}:{found.line} {found.module}"
        for path in FILES
        for found in imports_of(path)
        if (top := found.module.split(".")[0]) not in {"app", *sys.stdlib_module_names}
        and not declared & {_normal(name) for name in distributions.get(top, [top])}
    }
    assert undeclared == set()


def _normal(distribution: str) -> str:
    return re.sub(r"[-_.]+", "-", distribution).lower()
