"""Who is first: the verdict and the table of all laws; on a phone it also stands below the button that runs them."""

from __future__ import annotations

import viser

from app.ui.compare.desk import CompareDesk, Comparison
from app.ui.panels.compare.ranking_table import ranking_table, verdict
from app.ui.panels.text import small

NOTHING_YET = small(
    "Nothing compared yet. Choose two to six control laws under <b>Compare controllers</b>, then <b>Compare them</b>."
)


class Standings:
    """A few lines of HTML."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._desk = desk
        self._html = gui.add_html("")
        desk.answered.connect(self._show)
        desk.looked.connect(lambda _: self._show(desk.comparison))
        self._show(desk.comparison)

    def _show(self, comparison: Comparison | None) -> None:
        desk = self._desk
        if comparison is None or not (comparison.results or comparison.refusals):
            self._html.content = NOTHING_YET
            return
        places = desk.places_before()
        said = verdict(comparison, desk.look, desk.what_changed(), places)
        self._html.content = said + ranking_table(comparison, desk.look, places)
