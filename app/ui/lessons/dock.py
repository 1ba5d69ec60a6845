"""Where the panel `Lesson` stands: beside the robot on a desk, above the settings on a tablet, first on a phone."""

from __future__ import annotations

import viser

from app.ui.bench import Bench
from app.ui.stage import PHONE_WIDTH_PX

LABEL = "Lesson"
WIDTH = 400
TABLET_WIDTH = 330
"""Of the list on a tablet, beside what is left of the robot."""

# On a phone viser's sheet has the settings first, and then, in a box of their own, a section for every panel.
_SECTION = f'.mantine-Tabs-root > [aria-label$="panel {LABEL}"]'
PHONE_STYLE = f"""<style>@media (max-width: {PHONE_WIDTH_PX - 1}px) {{
  :has(> div > {_SECTION}) {{ display: flex; flex-direction: column; }}
  :has(> div > {_SECTION}) > * {{ flex-shrink: 0; }}
  div:has(> {_SECTION}) {{ display: contents; }}
  .mantine-Tabs-root:has(> [aria-label$="panel {LABEL}"]) {{ order: -1; }}
}}</style>"""


class LessonDock:
    """Folds and unfolds the panel, and tells the labs how much room there is."""

    def __init__(self, client: viser.ClientHandle, bench: Bench) -> None:
        self._main = client.gui.main_panel
        self._bench = bench
        self._narrow = bench.is_narrow  # asked before this panel takes its part of the picture
        client.gui.add_html(PHONE_STYLE)
        self.panel = client.gui.add_panel()
        self.fold()

    def fold(self) -> None:
        """A small bar at the edge: for those who explore freely."""
        self._bench.make_room(lesson=False)
        self.panel.dock_left()
        self.panel.set_width(TABLET_WIDTH if self._narrow else WIDTH)
        self.panel.minimize()
        self.unfolded = False

    def unfold(self) -> None:
        """For a lesson."""
        if self.unfolded:
            return
        self.unfolded = True
        self._bench.make_room(lesson=True)
        if self._narrow:
            self.panel.dock_above(self._main)
        self.panel.expand()
