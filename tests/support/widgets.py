"""viser's inputs as a person finds them: by their label.

The page sends inputs through one slot of 50 ms that they all share, so every change here waits until it has
left; otherwise the next change would overwrite it.
"""

from __future__ import annotations

import re
from pathlib import Path

from playwright.sync_api import Locator, Page

SEND_MS = 80


def settle(page: Page) -> None:
    """Wait until the last change has left the browser."""
    page.wait_for_timeout(SEND_MS)


def field(page: Page, label: str) -> Locator:
    """A number, text, checkbox or dropdown."""
    return page.get_by_label(label, exact=True)


def type_into(page: Page, label: str, value: str | float) -> None:
    """Replace what a number or text field holds, and leave the field.

    As if pasted: a number field that the server has changed meanwhile takes no notice of Playwright's `fill`, and
    between two keys the server may put its own number there.
    """
    box = field(page, label)
    box.press("ControlOrMeta+a")
    page.keyboard.insert_text(str(value))
    box.press("Tab")
    settle(page)


def toggle(page: Page, label: str) -> None:
    """Click a checkbox."""
    field(page, label).click()
    settle(page)


def choose(page: Page, label: str, option: str) -> None:
    """Pick an option of a dropdown."""
    field(page, label).click()
    page.get_by_role("option", name=option, exact=True).click()
    settle(page)


def slider_box(page: Page, label: str) -> Locator:
    """The number beside a slider."""
    return _slider(page, label).locator("xpath=..").locator("input.mantine-NumberInput-input, input[inputmode]").last


def slider_thumb(page: Page, label: str) -> Locator:
    """What a slider is pulled by; it also takes the arrow keys."""
    return _slider(page, label).get_by_role("slider")


def set_slider(page: Page, label: str, value: float) -> None:
    """Type a slider's value."""
    box = slider_box(page, label)
    box.fill(str(value))
    box.press("Tab")
    settle(page)


def step_slider(page: Page, label: str, steps: int) -> None:
    """Press an arrow key on a slider's thumb: to the right for positive `steps`."""
    thumb = slider_thumb(page, label)
    for _ in range(abs(steps)):
        thumb.press("ArrowRight" if steps > 0 else "ArrowLeft")
        settle(page)


def button(page: Page, label: str) -> Locator:
    return page.get_by_role("button", name=label, exact=True)


def press(page: Page, label: str) -> None:
    """Click a button."""
    button(page, label).click()
    settle(page)


def tab(page: Page, label: str) -> Locator:
    return page.get_by_role("tab", name=label, exact=True)


def open_tab(page: Page, label: str) -> None:
    """Bring a tab to the front."""
    tab(page, label).click()
    settle(page)


def take_robot(page: Page, title: str) -> None:
    """Take another robot than the one that every fresh page shows; only the first tab has been opened."""
    page.get_by_role("combobox", name="Robot", exact=True).click()
    page.get_by_role("option", name=title, exact=True).click()
    settle(page)


def upload(page: Page, label: str, path: Path) -> None:
    """Give a file to an upload button."""
    page.locator(f'[id="file_upload_{button(page, label).get_attribute("id")}"]').set_input_files(path)
    settle(page)


def _slider(page: Page, label: str) -> Locator:
    """A slider's label points to a `div`, so it is found by its identity."""
    named = page.locator("label", has_text=re.compile(rf"^{re.escape(label)}$")).first
    return page.locator(f'[id="{named.get_attribute("for")}"]')
