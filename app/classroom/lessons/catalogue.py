"""Everything that a lesson may read, set and press, by name.

Names begin with their namespace: what `may_change` lists, and what belongs together on the page. A fact that is not
there yet has no value; no check holds for it then.
"""

from __future__ import annotations

from fnmatch import fnmatchcase

from app.classroom.lessons.known.control import CONTROL, CONTROL_PRESSES
from app.classroom.lessons.known.drawing import DRAWING, DRAWING_PRESSES
from app.classroom.lessons.known.kind import FactKind
from app.classroom.lessons.known.link import LINK, LINK_PRESSES
from app.classroom.lessons.known.motion import COMPARE, MAP, MOTION, MOTION_PRESSES
from app.classroom.lessons.known.robot import ROBOT, ROBOT_PRESSES

__all__ = ["FACTS", "PRESSES", "FactKind", "fact_kind", "namespace"]

FACTS: dict[str, FactKind] = {**ROBOT, **CONTROL, **MOTION, **MAP, **COMPARE, **DRAWING, **LINK}
"""Name, or pattern with `*` at its end -> what is known about it."""

PRESSES: dict[str, str] = {
    **ROBOT_PRESSES,
    **CONTROL_PRESSES,
    **MOTION_PRESSES,
    **DRAWING_PRESSES,
    **LINK_PRESSES,
}
"""Action -> what it does. A press counts as done when what it began has ended."""

_PATTERNS = tuple(name for name in FACTS if name.endswith("*"))


def fact_kind(name: str) -> FactKind | None:
    """What is known about a fact; None where there is no such fact."""
    kind = FACTS.get(name)
    if kind is not None and not name.endswith("*"):
        return kind
    return next((FACTS[pattern] for pattern in _PATTERNS if fnmatchcase(name, pattern) and name != pattern), None)


def namespace(name: str) -> str:
    """What comes before the first point: `pose` of `pose.x`."""
    return name.partition(".")[0]
