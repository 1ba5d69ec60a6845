"""Which kind of limit a verdict names: the robots say it in a sentence for students."""

from __future__ import annotations

from app.robots import Reach

IN_REACH, OTHER = "in reach", "other"
_SIGNS = {
    "do not fit together": "no assembly",
    "too short": "too short",
    "too long": "too long",
    "singularity": "singular",
    "too flat": "rods too flat",
    "floor": "floor",
    "platform turns": "turn",
    "tool turns": "turn",
    "rm at": "arm stop",
    "end": "arm stop",
    "stop": "arm stop",
}
"""What a sentence has in it -> its kind; the first that fits."""


def reach_kind(reach: Reach) -> str:
    """One of the words of the fact `reach.kind`."""
    if reach.ok:
        return IN_REACH
    return next((kind for sign, kind in _SIGNS.items() if sign in reach.reason), OTHER)
