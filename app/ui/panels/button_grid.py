"""Small buttons side by side; viser has only wide ones, one below the other, whose hints a finger never sees.

A button that makes no sense now stays where it is, greyed; pressed all the same, it says why.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Sequence
from typing import NamedTuple

import viser

from app.ui.viser_adapter import element_id, run_javascript

CLASS = "deltalab-grid"
STYLE = f"""<style>
.{CLASS} {{ display: grid; gap: 6px; padding: 3px 12px 7px; }}
.{CLASS} button {{ min-height: 30px; padding: 3px 2px; border-radius: 6px; font: inherit; font-size: 0.84em;
  line-height: 1.2; color: var(--mantine-color-text); background: var(--mantine-color-default);
  border: 1px solid var(--mantine-color-default-border); cursor: pointer; touch-action: manipulation;
  user-select: none; -webkit-user-select: none; }}
.{CLASS} button:hover {{ background: var(--mantine-color-default-hover); }}
.{CLASS} button:focus-visible {{ outline: 2px solid var(--mantine-color-blue-filled); outline-offset: 1px; }}
.{CLASS} button.main {{ color: #fff; background: #1c6fc4; border-color: transparent; }}
.{CLASS} button.risky {{ color: #fff; background: #b3341c; border-color: transparent; }}
.{CLASS} button[aria-disabled=true] {{ color: var(--mantine-color-dimmed); background: transparent;
  border: 1px dashed var(--mantine-color-default-border); cursor: not-allowed; }}
@media (pointer: coarse) {{ .{CLASS} button {{ min-height: 42px; }} }}
</style>"""

_SCRIPT = """
if (!window.deltalabGrids) {
  window.deltalabGrids = true;
  let number = 0;
  document.addEventListener("click", (event) => {
    const button = event.target.closest?.("button[data-press]");
    if (!button) return;
    const value = `${button.dataset.press} ${++number}`;
    window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: button.dataset.wire, updates: {value}});
  });
}
"""


class Cell(NamedTuple):
    """One button."""

    key: str
    """What is heard when it is pressed; no spaces."""
    label: str
    hint: str = ""
    why_not: str = ""
    """Why it makes no sense now; empty if it does."""
    tone: str = ""
    """`main`, `risky`, or nothing."""


class ButtonGrid:
    """A few buttons in columns."""

    def __init__(
        self,
        client: viser.ClientHandle,
        name: str,
        pressed: Callable[[str], None],
        refused: Callable[[str], None],
        columns: int = 3,
    ) -> None:
        self._columns = columns
        self._pressed = pressed
        self._refused = refused
        self._cells: dict[str, Cell] = {}
        self._wire = client.gui.add_text(f"{name} pressed", "", visible=False)
        self._html = client.gui.add_html("")
        run_javascript(client, _SCRIPT)

        @self._wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            self._hear(event.target.value.partition(" ")[0])

    def show(self, cells: Sequence[Cell]) -> None:
        """Exchange the buttons; nothing is sent where nothing has changed."""
        if tuple(cells) != tuple(self._cells.values()):
            self._cells = {cell.key: cell for cell in cells}
            self._html.content = self._content()

    @property
    def visible(self) -> bool:
        return self._html.visible

    @visible.setter
    def visible(self, visible: bool) -> None:
        if visible != self._html.visible:
            self._html.visible = visible

    def _hear(self, key: str) -> None:
        cell = self._cells.get(key)
        if cell is None:
            return
        if cell.why_not:
            self._refused(cell.why_not)
        else:
            self._pressed(key)

    def _content(self) -> str:
        buttons = "".join(_button(cell, element_id(self._wire)) for cell in self._cells.values())
        columns = f"grid-template-columns:repeat({self._columns},minmax(0,1fr))"
        return f'<div class="{CLASS}" style="{columns}">{buttons}</div>'


def _button(cell: Cell, wire: str) -> str:
    attributes = [f'data-press="{html.escape(cell.key)}"', f'data-wire="{wire}"', 'type="button"']
    if cell.tone and not cell.why_not:
        attributes.append(f'class="{cell.tone}"')
    if cell.why_not:
        attributes.append('aria-disabled="true"')
    if title := cell.why_not or cell.hint:
        attributes.append(f'title="{html.escape(title)}"')
    return f"<button {' '.join(attributes)}>{html.escape(cell.label)}</button>"
