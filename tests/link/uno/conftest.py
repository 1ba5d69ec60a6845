"""Robots with an emulated Uno."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest

from tests.support.emulators.uno.plants import Plant
from tests.support.emulators.uno.rig import Rig


@pytest.fixture
def new_rig() -> Iterator[Callable[..., Rig]]:
    """`new_rig("delta3_dc", plant)`: a robot just switched on; gone after the test."""
    rigs: list[Rig] = []

    def make(variant: str, plant: Plant | None = None, eeprom: bytes | None = None) -> Rig:
        rigs.append(Rig(variant, plant, eeprom))
        return rigs[-1]

    yield make
    for rig in rigs:
        rig.close()
