"""Where meshes and lessons lie: package data in a wheel, the top folders in a checkout."""

from __future__ import annotations

from pathlib import Path

from app.errors import UserMistake

_PACKAGE = Path(__file__).parent


def data_root() -> Path:
    """Folder that holds `meshes` and `lessons`."""
    packaged = _PACKAGE / "_data"
    return packaged if packaged.is_dir() else _PACKAGE.parent


def meshes_dir() -> Path:
    """Folder of the robots' parts, one GLB file each.

    Raises `UserMistake` when it is missing.
    """
    return _existing("meshes", "run `deltalab meshes` to make it again")


def lessons_dir() -> Path:
    """Folder of the lessons, one Markdown file each.

    Raises `UserMistake` when it is missing.
    """
    return _existing("lessons", "install Delta Lab again")


def _existing(name: str, remedy: str) -> Path:
    folder = data_root() / name
    if not folder.is_dir():
        raise UserMistake(f"The folder {folder} is missing: {remedy}.")
    return folder
