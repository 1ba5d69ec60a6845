"""A sheet of paper to draw on with mouse, pen or finger."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence

import numpy as np
import viser
from numpy.typing import NDArray

from app.drawing.errors import DrawingError
from app.ui.drawing import pad_script
from app.ui.drawing.pad_strokes import UNITS_PER_MM, PadStrokes, Piece, read_piece
from app.ui.stage import PHONE_WIDTH_PX
from app.ui.viser_adapter import element_id, run_javascript

HEIGHT, PHONE_HEIGHT = 55, 34
"""At most, in percent of the page's height; on a phone fingers need room beside the paper to scroll the panel."""

_log = logging.getLogger(__name__)


class Pad:
    """The paper with its buttons. `changed` hears all strokes (n, 2) in mm after each change by the student."""

    def __init__(self, client: viser.ClientHandle, changed: Callable[[list[NDArray[np.float64]]], None]) -> None:
        self._client = client
        self._changed = changed
        self._pad = PadStrokes()
        self._sheet_mm = (148.0, 210.0)
        gui = client.gui
        with gui.add_folder(None) as self._folder:
            wire = gui.add_text("Strokes drawn", "", visible=False)
            self._canvas_id = f"pad-{element_id(wire)}"
            self._paper = gui.add_html(_paper(self._canvas_id, self._sheet_mm))
            buttons = gui.add_button_group("Strokes", ("Undo", "Clear"), hint="Undo takes back the last stroke")
        run_javascript(client, pad_script.start(self._canvas_id, element_id(wire)))

        @wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            self._hear(event.target.value)

        @buttons.on_click
        async def _(event: viser.GuiEvent[viser.GuiButtonGroupHandle]) -> None:
            self._undo() if event.target.value == "Undo" else self._clear()

    @property
    def strokes(self) -> list[NDArray[np.float64]]:
        """The strokes so far: each (n, 2) in mm, n >= 2, origin in the middle of the sheet, y up."""
        return [stroke.points_mm for stroke in self._pad.kept]

    @property
    def visible(self) -> bool:
        return self._folder.visible

    @visible.setter
    def visible(self, visible: bool) -> None:
        self._folder.visible = visible

    def show_sheet(self, sheet_mm: tuple[float, float]) -> None:
        """Another paper, of this width and height; what is drawn stays where it is, even off the new sheet."""
        self._sheet_mm = sheet_mm
        self._paper.content = _paper(self._canvas_id, sheet_mm)

    def load(self, strokes: Sequence[NDArray[np.float64]]) -> None:
        """Put these strokes, in mm, in place of what is drawn; `changed` does not hear of it."""
        self._pad.load(strokes)
        self._show()

    def _hear(self, text: str) -> None:
        piece = read_piece(text)
        if piece is None:
            _log.debug("client %d: no stroke %r", self._client.client_id, text[:200])
        elif self._takes(piece):
            self._changed(self.strokes)

    def _takes(self, piece: Piece) -> bool:
        try:
            return self._pad.take(piece, self._sheet_mm)
        except DrawingError as error:
            run_javascript(self._client, pad_script.remove(self._canvas_id, piece.number))
            self._client.add_notification("The pad is full", str(error), color="red", auto_close_seconds=8)
            return False

    def _undo(self) -> None:
        undone = self._pad.undo()
        if undone is not None:
            run_javascript(self._client, pad_script.remove(self._canvas_id, undone.number))
            self._changed(self.strokes)

    def _clear(self) -> None:
        if self._pad.kept:
            self._pad.load([])
            self._show()
            self._changed([])

    def _show(self) -> None:
        run_javascript(self._client, pad_script.show(self._canvas_id, self._pad.kept, self._pad.heard))


def _paper(canvas_id: str, sheet_mm: tuple[float, float]) -> str:
    """The canvas; its data say how large the sheet is, in the units of the script."""
    width, height = (f"{UNITS_PER_MM * size:g}" for size in sheet_mm)
    place, ratio = f'[id="{canvas_id}"]', f"{width} / {height}"
    return (
        f"<style>{place} {{ display: block; aspect-ratio: {ratio}; width: min(100% - 26px, {HEIGHT}vh * {ratio});"
        " margin: 3px auto 8px; background: #fff; box-shadow: 0 0 0 1px #9aa1ab; cursor: crosshair;"
        " touch-action: none; user-select: none; -webkit-user-select: none; -webkit-touch-callout: none; }"
        f" @media (max-width: {PHONE_WIDTH_PX - 1}px) {{"
        f" {place} {{ width: min(100% - 26px, {PHONE_HEIGHT}vh * {ratio}); }} }}</style>"
        f'<canvas id="{canvas_id}" data-sheet="{width} {height}" role="img" aria-label="Sheet to draw on"></canvas>'
    )
