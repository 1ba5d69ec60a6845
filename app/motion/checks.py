"""Settings that make no sense are refused before anything is computed."""

from __future__ import annotations

import math
from collections.abc import Collection

from app.motion.curves import CURVES
from app.motion.profiles import PROFILES
from app.motion.settings import MotionSettings
from app.motion.trajectory import MotionError

MAX_LAPS, MAX_TURNS, MAX_SIDES = 20, 10.0, 12


def check(settings: MotionSettings) -> None:
    """Raises:
    MotionError: for a number or name that makes no sense.
    """
    _known("curve", settings.curve, CURVES)
    _known("profile", settings.profile, PROFILES)
    within("The size", settings.size_m, 0.001, 1.0, "m")
    within("The height", settings.height_m, -0.5, 0.5, "m")
    within("The distance below home", settings.lower_m, -1.0, 1.0, "m")
    within("The number of turns", settings.turns, 0.25, MAX_TURNS)
    within("The number of sides", settings.sides, 3, MAX_SIDES)
    within("The number of laps", settings.laps, 1, MAX_LAPS)
    within("The turn of the tool", settings.turn_rad, -2 * math.pi, 2 * math.pi, "rad")
    within("The payload", settings.payload_kg, 0.0, 50.0, "kg")
    within("The share of the drives' speed", settings.speed_share, 0.01, 1.0)
    within("The share of the drives' acceleration", settings.acceleration_share, 0.01, 1.0)
    within("The share of the drives' effort", settings.effort_share, 0.01, 1.0)
    if settings.duration_s is not None:
        within("The duration", settings.duration_s, 0.01, 600.0, "s")


def within(what: str, value: float, low: float, high: float, unit: str = "") -> None:
    """Raises:
    MotionError: for a value outside its range, or none at all.
    """
    if not low <= value <= high:
        unit = f" {unit}" if unit else ""
        raise MotionError(f"{what} must lie between {low:g} and {high:g}{unit}; {value:g}{unit} does not.")


def _known(what: str, name: str, choices: Collection[str]) -> None:
    if name not in choices:
        raise MotionError(f"There is no {what} {name!r}; choose one of {', '.join(choices)}.")
