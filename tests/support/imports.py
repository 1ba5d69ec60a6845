"""What a Python source imports, read from its syntax tree; nothing is executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Import:
    """One imported module, `app.robots.par4` or `numpy`, and where."""

    module: str
    line: int
    at_start: bool
    """Carried out when the file itself is imported, not inside a function or for the type checker only."""


def module_name(path: Path, root: Path = ROOT) -> str:
    """`app/robots/__init__.py` -> `app.robots`."""
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports_of(path: Path, root: Path = ROOT) -> list[Import]:
    """Every import of a file. `from package import name` counts as `package.name` where that is a module."""
    package = path.parent.relative_to(root).parts
    return [
        Import(_as_module(name, root), line, at_start)
        for node, at_start in _import_nodes(ast.parse(path.read_text()), True)
        for name, line in _targets(node, package)
    ]


def _import_nodes(node: ast.AST, at_start: bool) -> Iterator[tuple[ast.Import | ast.ImportFrom, bool]]:
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.Import | ast.ImportFrom):
            yield child, at_start
        else:
            later = isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef) or _type_checking(child)
            yield from _import_nodes(child, at_start and not later)


def _type_checking(node: ast.AST) -> bool:
    return isinstance(node, ast.If) and ast.unparse(node.test).endswith("TYPE_CHECKING")


def _targets(node: ast.Import | ast.ImportFrom, package: tuple[str, ...]) -> Iterator[tuple[str, int]]:
    if isinstance(node, ast.Import):
        yield from ((alias.name, node.lineno) for alias in node.names)
        return
    above = package[: len(package) - node.level + 1] if node.level else ()
    base = ".".join([*above, *([node.module] if node.module else [])])
    yield from ((f"{base}.{alias.name}", node.lineno) for alias in node.names)


def _as_module(name: str, root: Path) -> str:
    """Drop a last part that names something inside a module of ours."""
    path = root.joinpath(*name.split("."))
    is_ours = name.split(".")[0] == "app"
    if is_ours and not path.is_dir() and not path.with_suffix(".py").exists():
        return name.rpartition(".")[0]
    return name
