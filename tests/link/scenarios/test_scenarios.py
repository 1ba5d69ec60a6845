"""Every scenario, with the firmware itself in an emulator and pyserial on a pseudo terminal."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from tests.link.scenarios.machines import NEEDS
from tests.link.scenarios.script import play
from tests.link.scenarios.world import World
from tests.support.tools import needs

pytestmark = pytest.mark.long

FILES = sorted(Path(__file__).parent.glob("plays/*.toml"))


def _parameter(path: Path) -> object:
    board = tomllib.loads(path.read_text())["board"]
    programs = NEEDS.get(board.partition(" ")[0], ())
    return pytest.param(path, id=path.stem, marks=[needs(*programs)] if programs else [])


@pytest.mark.parametrize("path", [_parameter(path) for path in FILES])
def test_scenario(path: Path) -> None:
    scene = tomllib.loads(path.read_text())
    world = World(scene["board"])
    try:
        play(world, scene["script"])
    finally:
        world.close()


def test_there_are_at_least_thirty() -> None:
    assert len(FILES) >= 30
