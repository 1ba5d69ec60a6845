"""A comparison in 3-D: the reference path, the path under each law, and the robots as ghosts in the laws' colours."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import viser
from numpy.typing import NDArray

from app.robots.parts import Machine, Part, machine_of
from app.simulation.controlled_run import ControlledRun
from app.ui import theme
from app.ui.compare.desk import CompareDesk
from app.ui.compare.magnified import APART_M, ghost, worst_error_m
from app.ui.ghost_nodes import GhostNodes
from app.ui.motion.surroundings import MotionSurroundings
from app.ui.pacing import Paced
from app.ui.playback import instant_at
from app.ui.run_view import enlarged

ROOT = "/robot/compare"
POINTS = 500
REFRESH_S = 0.1
OPACITY = 0.4


class CompareScene:
    """Shown while the room is in front and a run of the comparison is what the robot plays."""

    def __init__(self, surroundings: MotionSurroundings, desk: CompareDesk) -> None:
        self._client = surroundings.client
        self._session = surroundings.session
        self._desk = desk
        self._ghosts = GhostNodes(self._client.scene, surroundings.shapes, f"{ROOT}/ghosts", _paint, OPACITY)
        self._lines: list[viser.LineSegmentsHandle] = []
        self._machine: Machine | None = None
        self._factor = 1.0
        self._ghosts_wanted = True
        self.in_front = False
        """Whether the tab Motion is."""
        self._pace = Paced(self._show_ghosts, REFRESH_S)
        playback = desk.motion.playback
        desk.answered.connect(lambda _: self.refresh())
        playback.loaded.connect(lambda _: self.refresh())
        playback.moved.connect(lambda _: self._pace.request())
        self._session.robot_changed.connect(lambda _: self._forget_machine())

    def visible(self, visible: bool) -> None:
        if visible != self.in_front:
            self.in_front = visible
            self.refresh()

    def magnify(self, factor: float) -> None:
        """Draw the tool's error this many times as large."""
        self._factor = factor
        self.refresh()

    def want_ghosts(self, wanted: bool) -> None:
        self._ghosts_wanted = wanted
        self._show_ghosts()

    def close(self) -> None:
        self._pace.cancel()

    @property
    def runs(self) -> Mapping[str, ControlledRun]:
        """What is shown, by law."""
        compared = self._desk.comparison
        runs = {law: result.run for law, result in compared.results.items()} if compared is not None else {}
        playing = any(run is self._desk.motion.playback.run for run in runs.values())
        return runs if self.in_front and playing else {}

    def refresh(self) -> None:
        """Draw everything anew."""
        for line in self._lines:
            line.remove()
        self._lines = []
        runs = self.runs
        if runs:
            self._add_paths(runs)
        self._show_ghosts()

    def _add_paths(self, runs: Mapping[str, ControlledRun]) -> None:
        for k, (law, run) in enumerate(runs.items()):
            chosen = np.linspace(0, len(run.t) - 1, min(POINTS, len(run.t))).astype(int)
            wanted, actual = run.pose_ref[chosen, :3], run.pose[chosen, :3]
            if k == 0:
                self._add("reference", wanted, theme.REFERENCE, 2.0)
            self._add(f"path-{k}", wanted + enlarged(actual - wanted, self._factor), theme.law_color(law), 2.5)

    def _add(self, name: str, points: NDArray[np.float64], color: theme.Rgb, thickness: float) -> None:
        segments = np.stack([points[:-1], points[1:]], axis=1).astype(np.float32)
        line = self._client.scene.add_line_segments(
            f"{ROOT}/{name}", segments, color, thickness=thickness, thickness_units="screen"
        )
        self._lines.append(line)

    def _show_ghosts(self) -> None:
        """One for each law whose errors can be seen; the robot itself plays one of the runs as it was."""
        factor, time_s = self._factor, self._desk.motion.playback.time_s
        runs = {law: run for law, run in self.runs.items() if factor * worst_error_m(run) > APART_M}
        if not runs or not self._ghosts_wanted:
            if self._ghosts.shown:
                self._ghosts.clear()
                self._client.flush()
            return
        robot = self._session.robot
        if self._machine is None:
            self._machine = machine_of(robot)
        places = [ghost(robot, run, instant_at(run.t, time_s), factor) for run in runs.values()]
        self._ghosts.show(self._machine, places, [theme.law_color(law) for law in runs])
        self._client.flush()

    def _forget_machine(self) -> None:
        self._machine = None
        self._ghosts.clear()


def _paint(part: Part, leg: int | None) -> theme.Rgb:
    return theme.ACTUAL
