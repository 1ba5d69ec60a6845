"""Independently computed values to test against, turned into metres."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

FOLDER = Path(__file__).parents[1] / "golden"


def golden(name: str) -> dict[str, Any]:
    return json.loads((FOLDER / f"{name}.json").read_text())


def poses_from_mm(poses: Any) -> np.ndarray:
    """(..., dof) with the first three components in millimetres."""
    array = np.array(poses, dtype=float)
    array[..., :3] /= 1e3
    return array
