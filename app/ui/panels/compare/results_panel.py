"""What came of a comparison: verdict and table, then errors, efforts and their parts, each with bars and curves."""

from __future__ import annotations

import viser

from app.ui.compare.desk import CompareDesk, Comparison, Look
from app.ui.compare.score import STRETCHES, quantities
from app.ui.panels.compare.bars import effort_bars, error_bars
from app.ui.panels.compare.law_plots import LivePlot, Runs, draw_efforts, draw_errors, draw_parts, moments
from app.ui.panels.compare.ranking_table import law_notes, shares_table
from app.ui.panels.compare.standings import Standings
from app.ui.panels.options import show_options
from app.ui.viser_adapter import show_value

BEST_ONE = "The best one"


class ResultsPanel:
    """Everything but playback."""

    def __init__(self, gui: viser.GuiApi, desk: CompareDesk) -> None:
        self._desk = desk
        Standings(gui, desk)
        names = desk.robot.pose_names
        self._folders = [gui.add_folder(title, visible=False) for title in ("Errors", "Efforts", "Parts of an effort")]
        with self._folders[0]:
            self._quantity = gui.add_dropdown("Error in", quantities(names), initial_value=desk.look.quantity)
            self._stretch = gui.add_dropdown("Over", tuple(STRETCHES), initial_value=desk.look.stretch)
            self._errors = gui.add_html("")
            self._error_plot = LivePlot(gui, "Error of the tool")
        with self._folders[1]:
            self._joint = gui.add_dropdown("Joint", desk.robot.joint_names)
            self._efforts = gui.add_html("")
            self._effort_plot = LivePlot(gui, "Effort of the joint")
        with self._folders[2]:
            self._law = gui.add_dropdown("Law", (BEST_ONE, *desk.settings.laws))
            self._parts_plot = LivePlot(gui, "What it is made of")
            self._shares = gui.add_html("")
        self._folders.append(gui.add_folder("What each law does", expand_by_default=False, visible=False))
        with self._folders[3]:
            self._about = gui.add_html("")
        self._listen()
        desk.answered.connect(self._show)
        desk.looked.connect(lambda _: self._show(desk.comparison))

    def _listen(self) -> None:
        desk = self._desk

        @self._quantity.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.look_at(quantity=event.target.value)

        @self._stretch.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.look_at(stretch=event.target.value)

        @self._joint.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.look_at(joint=desk.robot.joint_names.index(event.target.value))

        @self._law.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.look_at(law="" if event.target.value == BEST_ONE else event.target.value)

    def _show(self, comparison: Comparison | None) -> None:
        self._show_choices(self._desk.look)
        answered = comparison is not None and bool(comparison.results)
        for folder in self._folders:
            if folder.visible != answered:
                folder.visible = answered
        if comparison is not None and answered:
            self._show_tables(comparison, self._desk.look)
            runs = {law: result.run for law, result in comparison.results.items()}
            self._draw(comparison.settings.laws, runs, self._desk.look)

    def _show_tables(self, comparison: Comparison, look: Look) -> None:
        scores, names = comparison.scores, self._desk.robot.joint_names
        unit = next(iter(comparison.results.values())).run.effort_unit
        self._errors.content = error_bars(scores, look)
        self._efforts.content = effort_bars(scores, look, names[look.joint], unit)
        self._about.content = law_notes(comparison.settings.laws)
        if law := self._law_looked_at(comparison):
            self._shares.content = shares_table(law, scores[law], names)

    def _draw(self, laws: tuple[str, ...], runs: Runs, look: Look) -> None:
        t = moments(runs, look.stretch)
        draw_errors(self._error_plot, t, laws, runs, self._desk.robot.pose_names, look.quantity)
        draw_efforts(self._effort_plot, t, laws, runs, look.joint)
        if (law := self._law_looked_at(self._desk.comparison)) is not None:
            draw_parts(self._parts_plot, t, runs[law], look.joint)

    def _law_looked_at(self, comparison: Comparison | None) -> str | None:
        chosen = self._desk.look.law
        return chosen if comparison is not None and chosen in comparison.results else self._desk.best()

    def _show_choices(self, look: Look) -> None:
        robot, compared = self._desk.robot, self._desk.comparison
        show_options(self._quantity, quantities(robot.pose_names), look.quantity)
        show_value(self._stretch, look.stretch)
        show_options(self._joint, robot.joint_names, robot.joint_names[look.joint])
        laws = tuple(compared.results) if compared is not None else ()
        show_options(self._law, (BEST_ONE, *laws), look.law if look.law in laws else BEST_ONE)
