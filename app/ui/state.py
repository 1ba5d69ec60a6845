"""What a session is in at one moment. Immutable: a change makes a new one."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, NamedTuple

from app.robots import Reach
from app.ui.lab.settings import ControlSettings

if TYPE_CHECKING:
    from app.drawing.source import Source
    from app.motion import MotionSettings, WorkCycle
    from app.robots.maps import MapSettings
    from app.ui.compare.settings import CompareSettings
    from app.ui.drawing.settings import DrawingSettings

Pose = tuple[float, ...]
Joints = tuple[float, ...]
Position = tuple[float, float, float]

WorkspaceStyle = Literal["Off", "Surface", "Cloud"]


@dataclass(frozen=True)
class Stance:
    """Where the robot stands and where it was asked to stand."""

    pose: Pose
    """(dof,) inside reach, m and rad."""
    joints: Joints
    wish: Pose
    """(dof,) the gizmo; equals `pose` inside reach."""
    reach: Reach
    """Verdict on the wish."""

    @property
    def position(self) -> Position:
        """(3,) of the pose, m."""
        return self.pose[0], self.pose[1], self.pose[2]

    @property
    def wished_position(self) -> Position:
        """(3,) of the wish, m."""
        return self.wish[0], self.wish[1], self.wish[2]

    @property
    def blocked_leg(self) -> int | None:
        """The leg, counted from 0, that stops the robot."""
        return None if self.reach.ok or self.reach.leg is None else self.reach.leg - 1


@dataclass(frozen=True)
class ViewOptions:
    """What is shown beside the robot."""

    workspace: WorkspaceStyle = "Off"
    workspace_angle: float = 0.0
    """theta or phi at which the workspace is cut, rad."""
    vectors_leg: int | None = None
    """Leg, counted from 0, whose loop is drawn as vectors."""
    frames: bool = False
    trace: bool = False
    elbows: bool = False
    """Ghosts of the other elbow solutions."""
    assemblies: bool = False
    """Ghosts of the other assembly modes."""
    measured: bool = True
    """Ghost of the robot on the table, where its sensors see it."""
    follow: bool = False
    """Stand where the robot on the table is commanded to be while it moves."""
    dark: bool = False
    shadows: bool = True
    """Shadows cost a computer without a graphics processor half of its frames."""


class DrawingMemory(NamedTuple):
    """What was drawn, and how."""

    robot: str
    settings: DrawingSettings
    source: Source | None
    source_name: str
    text: str
    """As it was typed."""


class MotionMemory(NamedTuple):
    """How the robot was to move."""

    course: MotionSettings
    cycle: WorkCycle
    cycling: bool
    """Whether the work cycle was shown."""


@dataclass(frozen=True)
class Memory:
    """What a browser finds again after a reload."""

    robot: str
    dimensions: dict[str, float] = field(default_factory=dict)
    """Changed dimensions by symbol, m or rad."""
    pose: Pose | None = None
    view: ViewOptions = ViewOptions()
    control: ControlSettings | None = None
    """None before the control lab was used."""
    drawing: DrawingMemory | None = None
    """None before anything was drawn."""
    motion: MotionMemory | None = None
    """None before the tab Motion was used."""
    comparison: CompareSettings | None = None
    """None before controllers were compared."""
    maps: MapSettings | None = None
    """None before a map was chosen."""
    in_lesson: bool | None = None
    """Whether the lessons were open; None before anybody opened or closed them."""
