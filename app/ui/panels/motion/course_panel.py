"""Along which curve the robot moves, how it speeds up and slows down, and how much of its drives it may use."""

from __future__ import annotations

import html
import math

import viser

from app.motion import CURVES, PROFILES, MotionSettings, WorkCycle, default_motion
from app.ui.motion.desk import MotionDesk
from app.ui.panels.motion.knob import Knob
from app.ui.panels.text import problem, small
from app.ui.viser_adapter import show_value

LARGEST = 3.0
"""The sliders' ends, in sizes that suit the robot."""

SIZE = "Radius of the circle that the curve just fits in, seen from above"
HEIGHT = "Rise of a line or a helix, lift of an arch"
LOWER = "How far the middle of the curve lies below the pose that the robot calls home"
ALWAYS = ("size_m", "lower_m", "turn_rad")
"""Knobs that every curve has."""

SHARES = {"speed_share": "Speed (%)", "acceleration_share": "Acceleration (%)", "effort_share": "Torque or force (%)"}
CURVE_TITLES = {kind.title: name for name, kind in CURVES.items()}
PROFILE_TITLES = {kind.title: name for name, kind in PROFILES.items()}


class CoursePanel:
    """The folder `Motion`: its knobs are those that the curve has.

    Args:
        tell: say among the knobs, too, why something cannot be: where the verdict is scrolled out of sight.
    """

    def __init__(self, gui: viser.GuiApi, desk: MotionDesk, *, tell: bool = False) -> None:
        self._desk = desk
        self._robot = ""
        course = desk.course
        self._folder = gui.add_folder("Motion")
        with self._folder:
            self._curve = gui.add_dropdown("Curve", tuple(CURVE_TITLES), initial_value=CURVES[course.curve].title)
            self._knobs = self._add_knobs(gui)
            self._profile = gui.add_dropdown(
                "Profile", tuple(PROFILE_TITLES), initial_value=PROFILES[course.profile].title
            )
            self._about_profile = gui.add_html("")
            self._shortest = gui.add_checkbox("As short as the limits allow", course.duration_s is None)
            self._duration = gui.add_number("Duration (s)", 1.0, min=0.01, max=60.0, step=0.001)
            self._problem = gui.add_html("")
            self._payload = Knob(gui, "Payload (kg)", (0.0, 2.0, 0.01), "payload_kg", 1.0, desk.change)
            with gui.add_folder("Limits, of what the drives can do"):
                self._shares = [
                    Knob(gui, label, (5.0, 100.0, 1.0), name, 100.0, desk.change) for name, label in SHARES.items()
                ]
            self._reset = gui.add_button("Reset the motion", icon=viser.Icon.RESTORE, color="gray")
        self._listen()
        desk.settings_changed.connect(self._follow)
        if tell:
            desk.refused.connect(lambda reason: self._tell(problem(reason)))
            desk.planned.connect(lambda _: self._tell(""))
        self._follow(desk.settings)

    def _add_knobs(self, gui: viser.GuiApi) -> list[Knob]:
        change = self._desk.change
        return [
            Knob(gui, "Size (mm)", (5.0, 300.0, 1.0), "size_m", 1e3, change, SIZE),
            Knob(gui, "Height (mm)", (0.0, 300.0, 1.0), "height_m", 1e3, change, HEIGHT),
            Knob(gui, "Below home (mm)", (-100.0, 200.0, 1.0), "lower_m", 1e3, change, LOWER),
            Knob(gui, "Turns", (0.5, 6.0, 0.5), "turns", 1.0, change),
            Knob(gui, "Corners", (3, 12, 1), "sides", 1, change),
            Knob(gui, "Turn of the tool (deg)", (-90.0, 90.0, 1.0), "turn_rad", math.degrees(1.0), change),
            Knob(gui, "Laps", (1, 5, 1), "laps", 1, change),
        ]

    def _listen(self) -> None:
        desk = self._desk

        @self._curve.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(curve=CURVE_TITLES[event.target.value])

        @self._profile.on_update
        async def _(event: viser.GuiEvent[viser.GuiDropdownHandle[str]]) -> None:
            desk.change(profile=PROFILE_TITLES[event.target.value])

        @self._shortest.on_update
        async def _(event: viser.GuiEvent[viser.GuiCheckboxHandle]) -> None:
            desk.change(duration_s=None if event.target.value else self._present_duration())

        @self._duration.on_update
        async def _(event: viser.GuiEvent[viser.GuiNumberHandle[float]]) -> None:
            desk.change(duration_s=event.target.value)

        @self._reset.on_click
        async def _(_: viser.GuiEvent[viser.GuiButtonHandle]) -> None:
            desk.reset()

    def _present_duration(self) -> float:
        """Of what is shown, rounded up: it stays possible."""
        motion = self._desk.motion
        return math.ceil(1e3 * motion.trajectory.duration_s) / 1e3 if motion is not None else 2.0

    def _tell(self, content: str) -> None:
        if content != self._problem.content:
            self._problem.content = content

    def _follow(self, settings: MotionSettings | WorkCycle) -> None:
        course = self._desk.course
        self._folder.visible = not self._desk.cycling
        if course.robot != self._robot:
            self._robot = course.robot
            self._fit(course.robot)
        kind = CURVES[course.curve]
        show_value(self._curve, kind.title)
        show_value(self._profile, PROFILES[course.profile].title)
        self._about_profile.content = small(html.escape(PROFILES[course.profile].note))
        for knob in self._knobs:
            turns = knob.name != "turn_rad" or self._desk.robot.dof == 4
            knob.visible = turns and knob.name in (*ALWAYS, *kind.parameters)
        for knob in (*self._knobs, *self._shares, self._payload):
            knob.show(getattr(course, knob.name))
        self._show_duration(course.duration_s)

    def _show_duration(self, duration_s: float | None) -> None:
        show_value(self._shortest, duration_s is None)
        self._duration.visible = duration_s is not None
        if duration_s is not None:
            show_value(self._duration, duration_s)

    def _fit(self, robot: str) -> None:
        """Sliders that end where this robot does, or soon after."""
        usual = default_motion(robot)
        for knob in self._knobs:
            if knob.name in ("size_m", "height_m"):
                knob.reach(LARGEST * getattr(usual, knob.name))
