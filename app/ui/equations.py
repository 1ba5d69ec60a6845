"""Equations on the page: LaTeX becomes MathML, which browsers draw themselves."""

from __future__ import annotations

import functools


def formulas(latex: str) -> str:
    """Several equations, parted by `\\quad` in the source, as one line that may break between them."""
    return " &ensp; ".join(mathml(part, block=False) for part in latex.split(r"\quad"))


@functools.lru_cache(maxsize=512)
def mathml(latex: str, block: bool = True) -> str:
    """MathML of an equation; about 2 ms the first time."""
    from latex2mathml.converter import convert

    return convert(latex, display="block" if block else "inline")
