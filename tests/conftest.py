"""Fixtures: a running Delta Lab, and browsers to look at it."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as `app.cli` does, before anything loads NumPy

import pytest
from hypothesis import settings
from playwright.sync_api import Browser, Page, expect, sync_playwright
from xdist.scheduler import LoadFileScheduling

from tests.support.browser import CHROMIUM, DESKTOP, PHONE, SKETCHY, PageFactory, Screen, launch, new_page
from tests.support.imports import ROOT
from tests.support.server import RunningServer, ServerFactory, running_deltalab

# Speed lives in the benchmarks. CI tries the same examples every time; new ones are found at the desk.
settings.register_profile("unhurried", deadline=None, derandomize=os.environ.get("CI") == "true")
settings.load_profile("unhurried")
expect.set_options(timeout=20_000)  # a page may have little of the processor


class ByFile(LoadFileScheduling):
    """A file's tests stay together, and one worker draws all pages: two would take each other's time."""

    def _split_scope(self, nodeid: str) -> str:
        path = nodeid.partition("::")[0]
        return "browser" if draws_pages(path) else path


@functools.cache
def draws_pages(path: str) -> bool:
    """Whether a test file, relative to the project, works with Chromium."""
    return "tests.support.browser" in (ROOT / path).read_text()


def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> ByFile:
    config.option.loadscopereorder = False  # the order of the files is that of the tests, see below
    return ByFile(config, log)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what needs Chromium, and put the tests in order.

    What takes longest starts first, or one worker would be at it when the others have finished. In a file,
    Chromium comes last: from then on Playwright has a loop on the main thread.
    """
    for item in items:
        if "browser" in getattr(item, "fixturenames", ()):
            item.add_marker("browser")

    def turn(item: pytest.Item) -> tuple[bool, bool]:
        long = item.get_closest_marker("long") is not None or draws_pages(item.nodeid.partition("::")[0])
        return not long, item.get_closest_marker("browser") is not None

    items.sort(key=turn)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium; a machine without it skips the test, in CI that is a failure."""
    if not CHROMIUM.exists():
        reason = f"needs Chromium at {CHROMIUM}"
        if os.environ.get("CI") == "true":
            pytest.fail(reason)
        pytest.skip(reason)
    with sync_playwright() as playwright:
        chromium = launch(playwright, SKETCHY)
        yield chromium
        chromium.close()


@contextmanager
def visitors(browser: Browser, script: str = "") -> Iterator[PageFactory]:
    """Pages of fresh visitors, which run `script` first; an uncaught script error in one of them is a failure."""
    pages: list[Page] = []
    errors: list[str] = []

    def make(screen: Screen = DESKTOP) -> Page:
        page = new_page(browser, screen)
        page.add_init_script(script)
        page.on("pageerror", lambda error: errors.append(str(error)))
        pages.append(page)
        return page

    yield make
    for page in pages:
        page.context.close()
    assert not errors, f"script errors on the page: {errors}"


@pytest.fixture
def visit(browser: Browser) -> Iterator[PageFactory]:
    """`visit(PHONE)`: a fresh visitor's page on that screen."""
    with visitors(browser) as make:
        yield make


@pytest.fixture(scope="module")
def lasting_visit(browser: Browser) -> Iterator[PageFactory]:
    """`lasting_visit()`: a page for a module's tests. Each costs seconds to draw without a graphics processor."""
    with visitors(browser) as make:
        yield make


@pytest.fixture
def page(visit: PageFactory) -> Page:
    """A page of 1440x900 with a mouse."""
    return visit(DESKTOP)


@pytest.fixture
def phone_page(visit: PageFactory) -> Page:
    """A page of 390x844 with a finger."""
    return visit(PHONE)


@pytest.fixture
def running_server() -> Iterator[ServerFactory]:
    """`running_server("--robot", "linear")`: a listening `deltalab`; all of them must stop cleanly."""
    with ExitStack() as servers:
        yield lambda *arguments: servers.enter_context(running_deltalab(*arguments))


@pytest.fixture(scope="module")
def server() -> Iterator[RunningServer]:
    """One `deltalab` with its defaults, shared by a module's tests."""
    with running_deltalab() as running:
        yield running
