"""Pages of the tab Motion: nothing is dragged there, so they need not be painted often."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser

from tests.conftest import visitors
from tests.support.browser import SLOW_SCREEN, PageFactory


@pytest.fixture
def visit(browser: Browser) -> Iterator[PageFactory]:
    with visitors(browser, SLOW_SCREEN) as make:
        yield make


@pytest.fixture(scope="module")
def lasting_visit(browser: Browser) -> Iterator[PageFactory]:
    with visitors(browser, SLOW_SCREEN) as make:
        yield make
