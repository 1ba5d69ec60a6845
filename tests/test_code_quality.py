"""Lint and types, checked as everything else is."""

from __future__ import annotations

import json
import os
import subprocess
import sys

import pytest

from tests.support.imports import ROOT

CHECKED = ("app", "tests")
pytestmark = pytest.mark.long


def test_ruff_is_content() -> None:
    found = subprocess.run(
        [sys.executable, "-m", "ruff", "check", "--output-format", "concise", *CHECKED],
        cwd=ROOT,
        capture_output=True,
        text=True,
    )
    assert found.returncode == 0, found.stdout + found.stderr


def test_pyright_is_content() -> None:
    """Node comes from PyPI with `pyright[nodejs]`; JSON keeps it from looking for news."""
    found = subprocess.run(
        [sys.executable, "-m", "pyright", "--outputjson", "--pythonpath", sys.executable],
        cwd=ROOT,
        capture_output=True,
        text=True,
        env={**os.environ, "PYRIGHT_PYTHON_IGNORE_WARNINGS": "1"},
    )
    assert found.stdout.startswith("{"), found.stdout + found.stderr
    report = json.loads(found.stdout)
    errors = [
        f"{entry['file']}:{entry['range']['start']['line'] + 1} {entry['message']}"
        for entry in report["generalDiagnostics"]
        if entry["severity"] == "error"
    ]
    assert report["summary"]["filesAnalyzed"] > 0
    assert not errors, "\n".join(errors)
