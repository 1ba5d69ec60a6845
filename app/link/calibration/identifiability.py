"""Which unknowns the measurements cannot separate, in sentences.

A direction in the space of unknowns, in units of their tolerances, is unseen where the measurements say less about it
than was assumed before: an eigenvalue of A^T A below 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from app.link.calibration.problem import Problem, Unknown

Array = NDArray[np.float64]

SEEN = 1.0
TAKES_PART = 0.1
"""Two unknowns are in one group if their part of the projection on the unseen directions is larger."""


class Group(NamedTuple):
    """Unknowns that only show in combination."""

    names: tuple[str, ...]
    unseen: int
    """Directions among them that the measurements do not show: all of them if this is the number of names."""
    sentence: str


def unseparated(problem: Problem, information: Array) -> tuple[Group, ...]:
    """Groups of unknowns, from A^T A (p, p)."""
    eigenvalues, vectors = np.linalg.eigh(information)
    unseen = vectors[:, eigenvalues < SEEN]
    projection = unseen @ unseen.T
    return tuple(_group(problem, members, projection) for members in _connected(projection))


def _connected(projection: Array) -> list[list[int]]:
    """Places that hang together by entries of the projection; without those that take no part."""
    linked = np.abs(projection) > TAKES_PART
    left = [k for k in range(len(linked)) if linked[k].any()]
    groups = []
    while left:
        group = [left.pop(0)]
        for member in group:  # grows while it is walked
            near = [k for k in left if linked[member, k]]
            group += near
            left = [k for k in left if k not in near]
        groups.append(sorted(group))
    return groups


def _group(problem: Problem, members: Sequence[int], projection: Array) -> Group:
    unknowns = [problem.unknowns[k] for k in members]
    part = projection[np.ix_(members, members)]
    unseen = max(1, round(float(np.trace(part))))
    names = tuple(unknown.name for unknown in unknowns)
    return Group(names, unseen, _sentence(unknowns, unseen, part))


def _sentence(unknowns: Sequence[Unknown], unseen: int, part: Array) -> str:
    names = [unknown.name for unknown in unknowns]
    if len(names) == 1:
        return f"These measurements say nothing about {names[0]}: it stays as uncertain as assumed."
    listed = f"{', '.join(names[:-1])} and {names[-1]}"
    if unseen >= len(names):
        return f"These measurements say nothing about {listed}: they stay as uncertain as assumed."
    if len(names) > 2:
        shown = len(names) - unseen
        how = "one combination shows" if shown == 1 else f"{shown} combinations show"
        return f"{listed} cannot be separated: only {how} in these measurements."
    combination = _combination(unknowns, np.linalg.eigh(part)[1][:, -1])
    return f"{listed} cannot be separated: they appear only as {combination} in these measurements."


def _combination(unknowns: Sequence[Unknown], direction: Array) -> str:
    """What stays the same while two unknowns move along an unseen direction (in units of their tolerances)."""
    one, other = unknowns
    a, b = direction[0] * one.tolerance, direction[1] * other.tolerance
    factor = -a / b
    size = abs(factor)
    text = "" if abs(size - 1.0) < 0.03 else f"{size:.2g} "
    unit = "" if one.unit == other.unit else f"{one.unit}/{other.unit} "
    return f"{one.name} {'+' if factor > 0 else '−'} {text}{unit}{other.name}"
