"""The papers' printed numbers beside ours: `deltalab reproduce`."""

from __future__ import annotations

from app.simulation.reproduce.figure import Figure, Section, Verdict
from app.simulation.reproduce.fivebar import FIVEBAR
from app.simulation.reproduce.linear import LINEAR
from app.simulation.reproduce.paper import Paper
from app.simulation.reproduce.par4 import PAR4

__all__ = ["PAPERS", "Figure", "Paper", "Section", "Verdict"]

PAPERS: dict[str, Paper] = {"par4": PAR4, "linear": LINEAR, "fivebar": FIVEBAR}
"""By the name of the paper's robot. A further paper is a folder like `par4` and one line here."""
