"""Boards emulated in this process: the very core of the firmware, with a machine and a cable that can be at fault."""

from __future__ import annotations

from app.link.emulated.board import EmulatedBoard
from app.link.emulated.faults import Faults
from app.link.emulated.sim_transport import SimTransport

__all__ = ["EmulatedBoard", "Faults", "SimTransport"]
