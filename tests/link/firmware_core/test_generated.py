"""`robots.h` is what the robots say."""

from __future__ import annotations

import numpy as np
import pytest

from app.link.firmware.generate import BUILDS, ROBOTS_H, robots_h, settings
from app.link.protocol.codes import DriveKind
from app.link.protocol.settings import SETTINGS, setting_id
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs


def test_the_header_in_the_tree_is_the_generated_one():
    assert ROBOTS_H.read_text() == robots_h(), "run `python -m app.link.firmware.generate`"


@needs("gcc")
@pytest.mark.parametrize(("robot", "drive"), BUILDS)
def test_the_board_begins_with_them(robot, drive):
    board = Bench(robot, drive, serial=0)
    image = np.frombuffer(board.core.image()[:-2], "<f4")
    np.testing.assert_array_equal(image, np.array(settings(robot, drive), dtype=np.float32))


@pytest.mark.parametrize(("robot", "drive"), BUILDS)
def test_limits_and_home_are_within_what_the_sensor_sees(robot, drive):
    """Potentiometers stay clear of their rails (0.02 and 0.98), servo pulses within 500 to 2500 us."""
    values = settings(robot, drive)
    low, high = {DriveKind.DC: (0.03, 0.97), DriveKind.SERVO: (499.99, 2500.01)}.get(drive, (-np.inf, np.inf))
    joints = [j for j in range(4) if values[setting_id("speed", j)]]
    for joint in joints:
        one = {name: values[setting_id(name, joint)] for name, setting in SETTINGS.items() if setting.per_joint}
        for at in (one["min"], one["home"], one["max"]):
            assert low <= (at - one["offset"]) / one["scale"] <= high
        assert one["min"] < one["home"] < one["max"]
