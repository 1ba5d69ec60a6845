"""What a worker answers when something cannot be done."""

from __future__ import annotations

from typing import NamedTuple


class Refusal(NamedTuple):
    """Why not, as a sentence for the student."""

    reason: str
