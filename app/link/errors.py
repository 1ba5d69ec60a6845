"""What can go wrong with the link, as sentences."""

from __future__ import annotations

from app.errors import UserMistake


class LinkError(UserMistake):
    """Something about the link that a person can put right; the message is one sentence."""


class LinkLost(LinkError):
    """The cable or the board is gone."""


class ProtocolError(LinkError):
    """Bytes that no board of this version sends."""
