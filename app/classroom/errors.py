"""What the classroom answers when something is not allowed, or not possible now."""

from __future__ import annotations

from app.errors import UserMistake


class ClassroomRefusal(UserMistake):
    """One sentence for whoever asked."""
