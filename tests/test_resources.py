"""Meshes and lessons are found, and their absence is told in a sentence."""

from __future__ import annotations

from pathlib import Path

import pytest

from app import resources
from app.errors import UserMistake
from tests.support.imports import ROOT


def test_a_checkout_uses_its_own_folders() -> None:
    assert resources.lessons_dir() == ROOT / "lessons"
    assert resources.meshes_dir() == ROOT / "meshes"


def test_an_installed_package_uses_its_own_data(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lessons = tmp_path / "app" / "_data" / "lessons"
    lessons.mkdir(parents=True)
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path / "app")
    assert resources.lessons_dir() == lessons


def test_a_missing_folder_is_named_with_the_remedy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "_PACKAGE", tmp_path / "app")
    with pytest.raises(UserMistake, match=r"meshes is missing: run `deltalab meshes`"):
        resources.meshes_dir()
    with pytest.raises(UserMistake, match=r"lessons is missing"):
        resources.lessons_dir()
