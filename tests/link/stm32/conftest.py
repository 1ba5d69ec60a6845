from __future__ import annotations

import pytest

from tests.support.emulators.stm32.drivers import Drivers


@pytest.fixture(scope="session")
def compiled_drivers() -> Drivers:
    return Drivers()


@pytest.fixture
def drivers(compiled_drivers: Drivers) -> Drivers:
    """The drivers of a chip that was just reset."""
    compiled_drivers.clear()
    compiled_drivers.emulated(False)
    return compiled_drivers
