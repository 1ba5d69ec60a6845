"""Judge a check on live facts."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from app.classroom.lessons.lesson import Bound, Check, Relation, Value, is_near

Facts = Callable[[str], Value | None]
"""Name of a fact -> its value; None or NaN: not there yet."""


class Verdict(NamedTuple):
    """Of one check, now."""

    met: bool
    value: Value | None
    says: str
    advice: str
    """What to do, while it is not met; else empty."""


def judge(check: Check, facts: Facts) -> Verdict:
    """Whether a check holds; a fact that is not there, or of another kind, is no error."""
    value = facts(check.fact)
    if value is None or _not_a_number(value):
        return Verdict(False, None, check.says, check.if_not or "There is nothing to check yet: do what the step asks.")
    met = _holds(check, value, facts)
    return Verdict(met, value, check.says, "" if met else check.if_not or f"Not yet: {_wanted(check, facts)}.")


def _holds(check: Check, value: Value, facts: Facts) -> bool:
    if check.one_of:
        return any(_same(value, wanted, check.within) for wanted in check.one_of)
    if check.is_ is not None:
        return _same(value, check.is_, check.within)
    if isinstance(value, (str, bool)):
        return False
    low, high = bound_now(check.at_least, facts), bound_now(check.at_most, facts)
    above = check.at_least is None or (low is not None and value >= low - 1e-9 * max(1.0, abs(low)))
    below = check.at_most is None or (high is not None and value <= high + 1e-9 * max(1.0, abs(high)))
    return above and below and (low is not None or high is not None)


def _same(value: Value, wanted: Value, within: float) -> bool:
    if isinstance(value, (str, bool)) or isinstance(wanted, (str, bool)):
        return type(value) is type(wanted) and value == wanted
    return is_near(value, wanted, within)


def bound_now(bound: Bound | None, facts: Facts) -> float | None:
    """The number behind a bound; None where there is none, or the fact it refers to is not there."""
    if not isinstance(bound, Relation):
        return bound
    other = facts(bound.fact)
    if other is None or isinstance(other, (str, bool)) or math.isnan(other):
        return None
    return bound.times * other + bound.plus


def _not_a_number(value: Value) -> bool:
    return not isinstance(value, str) and math.isnan(value)


def _wanted(check: Check, facts: Facts) -> str:
    """What is wanted, in words."""
    unit = f" {check.unit}" if check.unit else ""
    if check.one_of:
        return f"wanted is {' or '.join(map(_shown, check.one_of))}"
    if check.is_ is not None:
        return f"wanted is {_shown(check.is_)}{f' ± {check.within:g}' if check.within else ''}{unit}"
    low, high = bound_now(check.at_least, facts), bound_now(check.at_most, facts)
    named = (("at least", low), ("at most", high))
    bounds = [f"{words} {value:.4g}{unit}" for words, value in named if value is not None]
    return f"wanted is {' and '.join(bounds)}" if bounds else "there is nothing to compare it with yet"


def _shown(value: Value) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    return value if isinstance(value, str) else f"{value:.6g}"
