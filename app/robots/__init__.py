"""The robots: geometry, kinematics, reach and workspace. Pure functions of numbers; no screen, no clock."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from app.robots.delta3 import PRESETS as DELTA3_PRESETS
from app.robots.delta3 import Delta3, Delta3Geometry
from app.robots.fivebar import FiveBar, FiveBarGeometry
from app.robots.geometry import Geometry, GeometryError
from app.robots.linear import LinearDelta, LinearGeometry
from app.robots.par4 import Par4, Par4Geometry
from app.robots.reach import Reach
from app.robots.robot import Assembly, Robot, Skeleton

__all__ = ["ROBOTS", "Assembly", "Geometry", "GeometryError", "Reach", "Robot", "Skeleton", "build_robot", "make_robot"]


@dataclass(frozen=True)
class Entry:
    """How one robot is built."""

    build: type[Robot]
    geometry: type[Geometry]
    presets: dict[str, dict[str, float]]
    """Named sets of dimensions; the empty one is the default geometry."""

    @property
    def title(self) -> str:
        return self.build.title


ROBOTS: dict[str, Entry] = {
    "par4": Entry(Par4, Par4Geometry, {"paper": {}}),
    "delta3": Entry(Delta3, Delta3Geometry, DELTA3_PRESETS),
    "linear": Entry(LinearDelta, LinearGeometry, {"thesis": {}}),
    "fivebar": Entry(FiveBar, FiveBarGeometry, {"paper": {}}),
}


def make_robot(name: str, *, preset: str | None = None, **dimensions: float) -> Robot:
    """A robot by name, with any dimension changed by its symbol, in metres and radians.

    Example: `make_robot("par4", l=0.42)`, `make_robot("delta3", preset="classic")`.

    Raises:
        GeometryError: for an unknown robot, preset or dimension, or dimensions with which nothing is in reach.
    """
    presets = _entry(name).presets
    if preset is not None and preset not in presets:
        raise GeometryError(f"{name} has no preset {preset!r}; choose one of {', '.join(presets)}.")
    return build_robot(name, {**presets.get(preset or "", {}), **dimensions})


def build_robot(name: str, dimensions: Mapping[str, float]) -> Robot:
    """`make_robot` for dimensions that come as a mapping; an empty one gives the default geometry."""
    entry = _entry(name)
    return entry.build(entry.geometry().changed(**dimensions))


def _entry(name: str) -> Entry:
    if name not in ROBOTS:
        raise GeometryError(f"There is no robot {name!r}; choose one of {', '.join(ROBOTS)}.")
    return ROBOTS[name]
