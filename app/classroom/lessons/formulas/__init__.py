"""The table of formulas that lessons compute with, one file a field."""

from __future__ import annotations

from app.classroom.lessons.formulas import (  # noqa: F401  entering their formulas is all they are imported for
    arithmetic,
    circle,
    control,
    drawing,
    dynamics,
    kinematics,
    legs,
    linear,
    link,
    mobility,
    papers,
    par4_print,
    workspace,
)
from app.classroom.lessons.formulas.registry import FORMULAS, Formula, FormulaMistake, Quantity, formula

__all__ = ["FORMULAS", "Formula", "FormulaMistake", "Quantity", "formula", "formula_named"]


def formula_named(name: str) -> Formula | None:
    """None where there is no such formula."""
    return FORMULAS.get(name)
