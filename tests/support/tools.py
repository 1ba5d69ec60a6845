"""Tests that need programs or libraries which not every machine has."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

HEADERS = Path("/usr/include")


def needs(*programs: str) -> pytest.MarkDecorator:
    """Skip where one of these programs is missing; in CI a missing one is a failure, so there nothing is skipped.

    A library is asked for by its header: `needs("gcc", "simavr/sim_avr.h")`.
    """
    missing = [program for program in programs if not _is_there(program)]
    in_ci = os.environ.get("CI") == "true"
    return pytest.mark.skipif(bool(missing) and not in_ci, reason=f"needs {', '.join(missing)} on this machine")


def _is_there(program: str) -> bool:
    return (HEADERS / program).exists() if program.endswith(".h") else shutil.which(program) is not None
