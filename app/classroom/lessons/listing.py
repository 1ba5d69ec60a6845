"""What lessons may read, set, press and compute, as lines of text for their authors."""

from __future__ import annotations

from app.classroom.lessons.catalogue import FACTS, PRESSES, FactKind
from app.classroom.lessons.formulas import FORMULAS


def listing() -> list[str]:
    """Facts, actions and formulas, a line each."""
    facts = [_fact(name, kind) for name, kind in FACTS.items()]
    presses = [f"press    {name:<26} {text}" for name, text in PRESSES.items()]
    formulas = [
        f"formula  {f'{name}({formula.call})':<26} {formula.text}" for name, formula in sorted(FORMULAS.items())
    ]
    return [*facts, *presses, *formulas]


def _fact(name: str, kind: FactKind) -> str:
    """For example `fact     pose.x      mm, may be set   Where the tool stands`."""
    sort = " or ".join(unit for unit in kind.units if unit) if kind.kind == "number" else kind.kind
    can = f"{sort}, may be set" if kind.writable and sort else "may be set" if kind.writable else sort
    options = f" ({' | '.join(kind.options)})" if kind.options else ""
    return f"fact     {name:<26} {can:<22} {kind.text}{options}"
