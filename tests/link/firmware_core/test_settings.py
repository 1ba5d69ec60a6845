"""Settings: what may be set when, what is kept, and what a damaged memory leads to."""

from __future__ import annotations

import binascii
import math
import struct

import numpy as np
import pytest

from app.link.board_geometry import geometry_hash, geometry_values
from app.link.emulated.compiled import IMAGE_BYTES, CompiledCore
from app.link.errors import LinkError
from app.link.protocol.codes import BoardKind, Command, DriveKind, Refusal, Reset, RobotKind, SettingsSource
from app.link.protocol.messages import Get, Hello, Identity, Set
from app.link.protocol.settings import GEOMETRY_ID, SETTING_COUNT, is_live
from app.robots import make_robot
from tests.link.firmware_core.bench import Bench
from tests.support.tools import needs

pytestmark = needs("gcc")


def identity(board: Bench) -> Identity:
    board.send(Hello())
    board.tick()
    found = board.others.pop()
    assert isinstance(found, Identity)
    return found


@pytest.mark.parametrize("state", ["off", "ready", "stopped"])
def test_live_settings_may_be_set_while_the_motors_hold_the_others_in_off(state):
    board = Bench("par4")
    if state != "off":
        board.make_ready(homed=False)
    if state == "stopped":
        board.order(Command.STOP)
    for id in range(SETTING_COUNT):
        value = board.ask(Get(id)).value
        wanted = Refusal.OK if state == "off" or is_live(id) else Refusal.BUSY
        assert board.ask(Set(id, value)).result == wanted


def test_a_setting_that_was_set_is_answered_as_it_holds_now():
    board = Bench()
    answer = board.ask(Set(0, 0.1))
    assert answer.result == Refusal.OK and answer.value == np.float32(0.1) == board.get("kp", 0)


ALLOWED = {
    "kp": (0.0, 1e6),
    "n": (0.0, 1e6),
    "speed": (1e-3, 100.0),
    "scale": (-2.0, 2.0),
    "offset": (-10.0, 10.0),
    "home": (-0.78, 0.78),
    "tool_speed": (1e-3, 0.25),
    "hold_after": (20.0, 150.0),
    "off_after": (200.0, 5000.0),
    "jump": (1e-3, 10.0),
    "following_time": (0.0, 60_000.0),
    "home_speed": (1e-3, 1.0),
    "pen_up": (500.0, 2500.0),
    "stop_time": (10.0, 80.0),
    "duty_max": (1e-3, 1.0),
}
REFUSED = {
    "kp": (-1.0, 2e6),
    "speed": (0.0, -1.0),
    "scale": (0.0, 1e-12),
    "min": (0.8, 0.7853982),
    "max": (-0.8, 1e7),
    "home": (0.8, -0.8),
    "tool_speed": (0.0, 0.251),
    "hold_after": (19.0, 151.0),
    "off_after": (199.0, 5001.0),
    "jump": (0.0, -1.0),
    "following": (0.0, -1.0),
    "following_time": (-1.0, 60_001.0),
    "home_speed": (0.0, 1.01),
    "supply": (0.0, -12.0),
    "serial": (0.5, 16_777_216.0),
    "pen_down": (499.0, 2501.0),
    "stop_time": (9.0, 81.0),
    "duty_max": (0.0, 1.01),
}
JOINT_SETTINGS = ("kp", "n", "speed", "scale", "offset", "home", "min", "max")


@pytest.mark.parametrize("name", ALLOWED)
def test_the_ends_of_what_is_allowed(name):
    for value in ALLOWED[name]:
        assert Bench().set(name, value, 0 if name in JOINT_SETTINGS else None) == Refusal.OK


@pytest.mark.parametrize("name", REFUSED)
def test_what_a_field_does_not_allow(name):
    board, joint = Bench(serial=0), 0 if name in JOINT_SETTINGS else None
    before = board.get(name, joint)
    for value in (*REFUSED[name], math.nan, math.inf, -math.inf):
        assert board.set(name, value, joint) == Refusal.VALUE
        assert board.get(name, joint) == before


def test_settings_that_do_not_exist():
    board = Bench("delta3", DriveKind.DC)
    assert board.ask(Set(30, 1.0)).result == Refusal.UNKNOWN  # it has three joints
    assert board.ask(Get(30)).value == 0.0
    assert board.ask(Get(76)).result == board.ask(Set(76, 1.0)).result == Refusal.UNKNOWN


def test_a_board_without_a_number_gets_one_once():
    board = Bench(serial=0)
    assert board.set("serial", 16_777_215.0) == Refusal.OK
    assert identity(board).serial == 16_777_215
    assert board.set("serial", 5.0) == Refusal.VALUE
    board.order(Command.DEFAULTS)
    assert identity(board).serial == 16_777_215


def test_the_geometry_hash_is_that_of_the_robot_and_follows_the_geometry():
    board = Bench("par4")
    values = list(geometry_values(make_robot("par4")))
    assert identity(board).geometry == geometry_hash(values)
    assert board.ask(Set(GEOMETRY_ID, 0.21)).result == Refusal.OK
    values[0] = 0.21
    assert identity(board).geometry == geometry_hash(values)


def saved(board: Bench) -> bytes:
    assert not board.core.take_save_request()
    assert board.order(Command.SAVE) == Refusal.OK
    assert board.core.take_save_request() and not board.core.take_save_request()
    return board.core.image()


def test_what_was_saved_is_there_after_a_reset():
    board = Bench()
    board.set("kp", 123.0, 2)
    again = Bench(stored=saved(board))
    assert again.get("kp", 2) == 123.0 and identity(again).settings == SettingsSource.STORED
    assert again.order(Command.DEFAULTS) == Refusal.OK
    assert again.get("kp", 2) == np.float32(board.values[0])


def test_an_image_is_the_values_and_a_crc_with_the_build():
    image = Bench().core.image()
    assert len(image) == IMAGE_BYTES == 306
    crc = binascii.crc_hqx(bytes([1, RobotKind.PAR4, DriveKind.DC]) + image[:-2], 0xFFFF)
    assert image[-2:] == struct.pack(">H", crc)


@pytest.mark.parametrize("place", [0, 100, 303, 304, 305])
def test_a_damaged_image_is_noticed(place):
    board = Bench()
    board.set("kp", 123.0, 0)
    image = bytearray(saved(board))
    image[place] ^= 1
    again = Bench(stored=bytes(image))
    assert identity(again).settings == SettingsSource.DAMAGED
    assert again.get("kp", 0) == np.float32(again.values[0])


def test_an_image_of_another_build_is_not_taken():
    other = Bench("par4", DriveKind.SERVO)
    assert identity(Bench(stored=saved(other))).settings == SettingsSource.DAMAGED


def test_memory_that_was_never_written_is_no_damage():
    assert identity(Bench(stored=b"\xff" * IMAGE_BYTES)).settings == SettingsSource.BUILT_IN


def test_builds_and_images_that_do_not_exist_are_refused():
    core = CompiledCore()
    with pytest.raises(LinkError, match="choose another drive"):
        core.start(RobotKind.FIVEBAR, DriveKind.SERVO, BoardKind.HOST, 1000, 1, Reset.POWER, None)
    with pytest.raises(LinkError, match="306 bytes"):
        core.start(RobotKind.PAR4, DriveKind.DC, BoardKind.HOST, 1000, 1, Reset.POWER, b"short")
