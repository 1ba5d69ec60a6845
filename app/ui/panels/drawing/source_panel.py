"""What is to be drawn: a picture of one's own, a sample, a text, or strokes by hand."""

from __future__ import annotations

import viser

from app.drawing.samples import SAMPLES
from app.drawing.source import Source
from app.ui.drawing.desk import DrawingDesk
from app.ui.drawing.jobs import TooDense
from app.ui.drawing.settings import DrawingSettings
from app.ui.panels.drawing.pad import Pad
from app.ui.panels.options import show_options
from app.ui.panels.text import problem
from app.ui.refusal import Refusal

TEXT, HAND = "A text", "Draw by hand"
KINDS = {"text": TEXT, "hand": HAND}
FILES = ".jpg,.jpeg,.png,.webp,.bmp,.gif,.tif,.tiff,.svg,.txt,image/*"
NAMES = {sample.title: name for name, sample in SAMPLES.items()}


class SourcePanel:
    """The first inputs of the tab Draw."""

    def __init__(self, client: viser.ClientHandle, desk: DrawingDesk) -> None:
        self._desk = desk
        gui = client.gui
        self._upload = gui.add_upload_button(
            "Upload a picture", icon=viser.Icon.UPLOAD, mime_type=FILES, hint="JPG, PNG, SVG and other common files"
        )
        self._choice = gui.add_dropdown("Picture", self._options(), initial_value=self._shown())
        self._text = gui.add_text("Text", desk.text, multiline=True, visible=False)
        self._sheet_mm = (0.0, 0.0)
        self._source: Source | None = None
        """What was drawn when something else was chosen."""
        self._pad_folder = gui.add_folder(None, visible=False)
        with self._pad_folder:
            self._pad = Pad(client, desk.take_strokes)
        if desk.source_name == "hand" and desk.source is not None:
            self._pad.load(desk.source.strokes or [])
        self._problem = gui.add_html("", visible=False)
        self._coarser = gui.add_button("Draw it coarser", icon=viser.Icon.FILTER, visible=False)
        self._listen()
        desk.settings_changed.connect(self._follow)
        desk.refused.connect(self._tell)
        self._follow(desk.settings)

    def _listen(self) -> None:
        desk = self._desk

        @self._upload.on_upload
        async def _(event: viser.GuiEvent[viser.GuiUploadButtonHandle]) -> None:
            desk.take_file(own_title(event.target.value.name), event.target.value.content)

        @self._choice.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            self._choose(event.target.value)

        @self._text.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            desk.take_text(event.target.value)

        @self._coarser.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.draw_coarser()

    def _choose(self, title: str) -> None:
        self._source = self._desk.source
        if title == TEXT:
            self._desk.take_text(self._text.value)
        elif title == HAND:
            self._desk.take_strokes(self._pad.strokes)
        elif title in NAMES:
            self._desk.take_sample(NAMES[title])
        self._show_inputs(title)

    def _options(self) -> tuple[str, ...]:
        return tuple(dict.fromkeys((*NAMES, TEXT, HAND, self._shown())))

    def _shown(self) -> str:
        """What the dropdown says is drawn."""
        name = self._desk.source_name
        return SAMPLES[name].title if name in SAMPLES else KINDS.get(name, name)

    def _show_inputs(self, title: str) -> None:
        for element, shown in ((self._text, title == TEXT), (self._pad_folder, title == HAND)):
            if element.visible != shown:
                element.visible = shown

    def _follow(self, settings: DrawingSettings) -> None:
        if settings.sheet_mm != self._sheet_mm:
            self._sheet_mm = settings.sheet_mm
            self._pad.show_sheet(settings.sheet_mm)
        if self._choice.value in KINDS.values() and self._desk.source is self._source:
            return  # somebody is about to write or draw
        show_options(self._choice, self._options(), self._shown())
        self._show_inputs(self._choice.value)

    def _tell(self, refusal: Refusal | TooDense | None) -> None:
        self._problem.visible = refusal is not None
        if refusal is not None:
            self._problem.content = problem(refusal.reason)
        self._coarser.visible = isinstance(refusal, TooDense) and bool(refusal.coarser)


def own_title(name: str) -> str:
    """What a file is called in the list, where no other entry is called so."""
    taken = {*NAMES, *NAMES.values(), *KINDS, *KINDS.values()}
    return f"{name} (file)" if name in taken else name
