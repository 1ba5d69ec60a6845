"""Which settings a mode takes, and that each is a number, before anything is done with them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from typing import Any

import numpy as np

from app.drawing.errors import DrawingError
from app.drawing.modes import AUTO, DRAWING_MODES, PICTURE, PORTRAIT, WEIGHT
from app.drawing.rasterise import RASTER_MODES
from app.drawing.vectorise import Settings


def accepted(mode: str) -> frozenset[str]:
    """The names of all settings that a mode takes; those that a vector mode has no use for do nothing there."""
    picture = frozenset(each.name for each in PICTURE)
    if mode in RASTER_MODES:
        return picture | {each.name for each in RASTER_MODES[mode].parameters}
    tones = frozenset({WEIGHT.name}) if mode == PORTRAIT else frozenset()
    return picture | tones | {each.name for each in fields(Settings)}


def checked_settings(mode: str, settings: Mapping[str, Any], others: frozenset[str] = frozenset()) -> dict[str, Any]:
    """Those settings of a mode that are set: not None and not "auto". DrawingError for what can be none.

    others: names that are no business of the mode, which are left out.
    """
    if mode not in DRAWING_MODES:
        raise DrawingError(f"There is no mode called {mode}; choose one of {', '.join(DRAWING_MODES)}.")
    known = accepted(mode)
    for name, value in settings.items():
        if name not in known | others:
            raise DrawingError(f"The mode {mode} has no setting {name}; it has {', '.join(sorted(known | others))}.")
        if name in known and not (value is None or value == AUTO or is_number(value)):
            raise DrawingError(f"The setting {name} cannot be {value!r}; give it a number.")
    return {name: value for name, value in settings.items() if name in known and value not in (None, AUTO)}


def is_number(value: object) -> bool:
    """Whether a setting's value is a number, and not yes or no."""
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)
