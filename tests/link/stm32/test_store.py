"""Settings in the flash memory, byte by byte."""

from __future__ import annotations

import binascii
import ctypes

import pytest

from app.link.protocol.frames import encode_frame
from app.link.protocol.messages import Set, pack
from tests.support.emulators.stm32.drivers import Drivers, Machine
from tests.support.emulators.stm32.firmware import needs_drivers

pytestmark = needs_drivers

SECTOR_3 = 0x0800_C000
FLASH_CR = 0x4002_3C10
ERASED = 0xFFFF_FFFF
PROTOCOL, PAR4, DC = 1, 1, 2


@pytest.fixture
def blank(drivers: Drivers) -> Drivers:
    """A chip whose sector was erased."""
    for word in range(128):
        drivers.write(SECTOR_3 + 4 * word, ERASED)
    drivers.library.store_read.restype = ctypes.c_void_p
    return drivers


def test_a_new_chip_has_nothing_stored(blank):
    assert blank.library.store_read() is None


def test_an_image_is_programmed_into_its_sector_and_locked(blank):
    machine = Machine(blank)
    blank.library.store_write(machine.memory)
    words = [blank.read(SECTOR_3 + 4 * i) for i in range(128)]
    stored = b"".join(word.to_bytes(4, "little") for word in words)
    assert stored[:4] == b"DLS1"
    image = stored[4 : 4 + 306]
    assert image == machine.image
    assert int.from_bytes(image[-2:], "big") == binascii.crc_hqx(bytes([PROTOCOL, PAR4, DC]) + image[:-2], 0xFFFF)
    assert set(words[78:]) == {ERASED}
    assert blank.read(FLASH_CR) == 1 << 31


def test_what_was_stored_is_read_back(blank):
    built_in, before = Machine(blank).image, Machine(blank)
    before.tick(1000, [0.5] * 4)
    before.receive(encode_frame(pack(Set(0, 12.5), 1)))
    assert before.image != built_in
    blank.library.store_write(before.memory)
    address = blank.library.store_read()
    assert Machine(blank, ctypes.c_void_p(address)).image == before.image
