"""The room around the robot: floor, light, theme and camera."""

from __future__ import annotations

from typing import Literal

import numpy as np
import viser
from numpy.typing import NDArray

from app.robots import Robot
from app.robots.parts import machine_of
from app.ui import theme
from app.ui.picture_width import PictureWidth
from app.ui.session import Session
from app.ui.state import ViewOptions

View = Literal["3-D", "Front", "Side", "Top"]

FIELD_OF_VIEW = np.radians(38.0)
"""Vertical; narrow enough that parallel rods look parallel."""

PHONE_WIDTH_PX = 576
"""Below this width the panels are a sheet over the lower part of the picture."""

SHEET_HEIGHT = 0.42
"""Share of a phone's height that the sheet takes."""

SHEET_STYLE = f"""<style>@media (max-width: {PHONE_WIDTH_PX - 1}px) {{
  .mantine-Paper-root[style*="20em"] {{ width: 100vw !important; max-height: {SHEET_HEIGHT:.0%} !important; }}
  .mantine-Paper-root[style*="20em"] > * [style*="20em"] {{ width: 100vw !important; }}
  div:has(> .uplot-container):first-child {{ position: sticky; top: 0; z-index: 4; }}
  div:has(> div > div > .mantine-Tabs-root) {{ overflow: clip !important; max-width: 100vw; }}
  .uplot-container {{ background: var(--mantine-color-body); }}
}}</style>"""
"""viser's sheet is half as wide as a phone and covers more than half of its height. A first plot stays in sight while
what is below it scrolls."""

DIRECTIONS: dict[View, tuple[float, float, float] | None] = {
    "3-D": None,
    "Front": (0.0, -1.0, 0.02),
    "Side": (1.0, 0.0, 0.02),
    "Top": (0.0, -0.02, 1.0),
}
"""From what is looked at towards the eye; each machine has its own for `3-D`."""

DOWN = (0.15, -1.0, 0.85)
"""The same for a sheet below a machine."""


def light_the_room(server: viser.ViserServer) -> None:
    """Lights shared by everyone, beside viser's key light: soft light from the sky, and some from one side."""
    server.scene.configure_environment_map(None)
    server.scene.add_light_hemisphere(
        "/light/sky", sky_color=(255, 255, 255), ground_color=(150, 150, 158), intensity=1.1
    )
    server.scene.add_light_directional("/light/side", intensity=0.9, position=(1.0, -0.5, 0.5))


class Stage:
    """Floor, theme and camera of one browser."""

    def __init__(self, client: viser.ClientHandle, session: Session, width: PictureWidth) -> None:
        self._client = client
        self._session = session
        self._dark = session.view.dark
        self._shadows: bool | None = None
        self._guest: Robot | None = None
        self._robot_name = session.robot_name
        session.robot_changed.connect(lambda _: self._receive())
        session.view_changed.connect(self._follow)
        self._apply_theme()
        self._follow(session.view)
        client.gui.add_html(SHEET_STYLE)
        self._on_a_phone = width.px < PHONE_WIDTH_PX
        self.look("3-D")
        width.known.connect(self._learn_width)

    @property
    def _robot(self) -> Robot:
        return self._guest or self._session.robot

    def host(self, guest: Robot | None) -> None:
        """Somebody else's robot stands here; None: one's own again."""
        self._guest = guest
        self._receive()

    def look(self, view: View) -> None:
        """Turn the camera to a preset that shows the whole machine, on a wide screen or a tall one."""
        low, high = _extent(self._robot)
        direction = np.array(DIRECTIONS[view] or machine_of(self._robot).seen_from)
        self._aim(0.5 * (low + high), float(np.linalg.norm(high - low)), direction)

    def look_down_on(self, focus: tuple[float, float, float], size: float) -> None:
        """Turn the camera to something of this size (m) that lies flat, as near as the machine lets one look."""
        self._aim(np.array(focus), size, np.array(DOWN))

    def _aim(self, focus: NDArray[np.float64], size: float, direction: NDArray[np.float64]) -> None:
        camera = self._client.camera
        direction = direction / np.linalg.norm(direction)
        aspect = camera.image_width / max(camera.image_height, 1)
        distance = 0.5 * size / np.tan(0.5 * FIELD_OF_VIEW) / min(1.0, max(aspect, 0.3))
        if self._on_a_phone:
            focus = focus - np.array([0.0, 0.0, 0.5 * SHEET_HEIGHT * size / max(aspect, 0.3)])
        camera.fov = FIELD_OF_VIEW
        camera.up_direction = (0.0, 0.0, 1.0)
        camera.position = focus + direction * distance
        camera.look_at = focus

    def _learn_width(self, width_px: int) -> None:
        """Of the whole picture, before side panels narrow it; until then a phone may pass for a desktop."""
        if (width_px < PHONE_WIDTH_PX) != self._on_a_phone:
            self._on_a_phone = not self._on_a_phone
            self.look("3-D")

    def _receive(self) -> None:
        """Another robot is looked at anew; the same one in other dimensions is not."""
        self._lay_floor()
        if self._robot.name != self._robot_name:
            self._robot_name = self._robot.name
            self.look("3-D")

    def _follow(self, view: ViewOptions) -> None:
        if view.dark != self._dark:
            self._dark = view.dark
            self._apply_theme()
        if view.shadows != self._shadows:
            self._shadows = view.shadows
            self._client.scene.configure_default_lights(enabled=True, cast_shadow=view.shadows)

    def _apply_theme(self) -> None:
        self._client.gui.configure_theme(dark_mode=self._dark, show_logo=False, show_share_button=False)
        self._lay_floor()

    def _lay_floor(self) -> None:
        plane = theme.DARK_FLOOR if self._dark else theme.LIGHT_FLOOR
        line = (62, 67, 75) if self._dark else (214, 217, 222)
        section = (84, 90, 100) if self._dark else (186, 190, 197)
        self._client.scene.set_background_image(np.full((2, 2, 3), plane, dtype=np.uint8))
        self._client.scene.add_grid(
            "/floor",
            infinite_grid=True,
            cell_size=0.05,
            section_size=0.25,
            cell_color=line,
            section_color=section,
            cell_thickness=0.6,
            section_thickness=1.0,
            fade_distance=3.5,
            fade_strength=1.6,
            shadow_opacity=0.35 if self._dark else 0.22,
            plane_color=plane,
            plane_opacity=1.0,
            position=(0.0, 0.0, machine_of(self._robot).floor),
        )


def _extent(robot: Robot) -> tuple[np.ndarray, np.ndarray]:
    """Corners of a box around the machine and its floor."""
    machine, home = machine_of(robot), robot.home.tolist()
    skeleton = robot.skeleton(home, robot.solve(*home))
    points = np.vstack([*skeleton[:3], robot.home[None, :3]])
    low, high = points.min(axis=0), points.max(axis=0)
    low[2] = min(low[2], machine.floor)
    high[2] += 2.0 * machine.lift
    return low - 0.05, high + 0.1
