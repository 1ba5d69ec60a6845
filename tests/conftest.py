"""Fixtures: a running Delta Lab, and browsers to look at it."""

from __future__ import annotations

import functools
import os
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from typing import Any

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # as `app.cli` does, before anything loads NumPy

import pytest
from hypothesis import settings
from playwright.sync_api import Browser, Page, expect, sync_playwright
from xdist.scheduler import LoadFileScheduling

from tests.support.browser import CHROMIUM, DESKTOP, PHONE, SKETCHY, SLOW_SCREEN, PageFactory, Screen, launch, new_page
from tests.support.imports import ROOT
from tests.support.server import RunningServer, ServerFactory, running_deltalab

_user_data = tempfile.TemporaryDirectory(prefix="deltalab-test-")
os.environ["XDG_DATA_HOME"] = _user_data.name  # nobody's own progress is touched

# Speed lives in the benchmarks. CI tries the same examples every time; new ones are found at the desk.
IN_CI = os.environ.get("CI") == "true"
settings.register_profile("unhurried", deadline=None, derandomize=IN_CI, max_examples=50 if IN_CI else 100)
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


class PageFiles:
    """What the files that draw pages share, since each start of it takes seconds."""

    def __init__(self) -> None:
        self._open = ExitStack()
        self._browser: Browser | None = None
        self._server: RunningServer | None = None

    @property
    def browser(self) -> Browser:
        if self._browser is None:
            playwright = self._open.enter_context(sync_playwright())
            self._browser = launch(playwright, SKETCHY)
            self._open.callback(self._browser.close)
        return self._browser

    @property
    def server(self) -> RunningServer:
        """Without shadows, which a machine without a graphics processor draws slowly."""
        if self._server is None:
            self._server = self._open.enter_context(running_deltalab("--no-shadows"))
        return self._server

    def close(self) -> None:
        self._browser = self._server = None
        self._open.close()


PAGE_FILES = PageFiles()


def pytest_runtest_setup(item: pytest.Item) -> None:
    """Other files need the main thread without the loop that Playwright keeps on it."""
    if not draws_pages(item.nodeid.partition("::")[0]):
        PAGE_FILES.close()


def pytest_sessionfinish() -> None:
    PAGE_FILES.close()


@pytest.fixture(scope="module")
def browser() -> Browser:
    """Chromium; a machine without it skips the test, in CI that is a failure."""
    if not CHROMIUM.exists():
        reason = f"needs Chromium at {CHROMIUM}"
        if IN_CI:
            pytest.fail(reason)
        pytest.skip(reason)
    return PAGE_FILES.browser


@contextmanager
def visitors(browser: Browser) -> Iterator[PageFactory]:
    """Pages of fresh visitors; an uncaught script error in one of them is a failure."""
    pages: list[Page] = []
    errors: list[str] = []

    def make(screen: Screen = DESKTOP) -> Page:
        page = new_page(browser, screen)
        page.add_init_script(SLOW_SCREEN)
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
def server(request: pytest.FixtureRequest) -> Iterator[RunningServer]:
    """One `deltalab` with its defaults, shared by a module's tests; those that draw pages share one among them."""
    if draws_pages(str(request.path.relative_to(ROOT))):
        yield PAGE_FILES.server
        return
    with running_deltalab() as running:
        yield running
