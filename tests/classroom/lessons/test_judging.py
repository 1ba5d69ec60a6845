"""Checks on live facts, and answers to questions."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.classroom.lessons.check import judge
from app.classroom.lessons.lesson import Check, Choice, Near, NumberAnswer, Question, Relation

numbers = st.floats(-1e6, 1e6)
values = st.none() | st.booleans() | st.text(max_size=3) | st.floats() | st.integers(-5, 5)


def check(**how: Any) -> Check:
    return Check("f", "mm", "It is so.", **how)


def met(value: object, other: object = None, **how: Any) -> bool:
    return judge(check(**how), lambda name: {"f": value, "g": other}[name]).met  # type: ignore[return-value]


@given(numbers, numbers, st.floats(0.0, 10.0))
def test_a_number_is_met_within_its_tolerance(value: float, wanted: float, within: float) -> None:
    slack = 2e-9 * max(1.0, abs(wanted))
    if abs(value - wanted) <= within - slack:
        assert met(value, is_=wanted, within=within)
    if abs(value - wanted) > within + slack:
        assert not met(value, is_=wanted, within=within)


@given(numbers, numbers, numbers)
def test_bounds_hold_together(value: float, low: float, high: float) -> None:
    if low <= value <= high:
        assert met(value, at_least=low, at_most=high) and met(value, at_least=low) and met(value, at_most=high)
    if value < low - 0.01 or value > high + 0.01:
        assert not met(value, at_least=low, at_most=high)


@given(numbers, numbers, st.floats(-3.0, 3.0), st.floats(-5.0, 5.0))
def test_a_bound_may_be_another_fact(value: float, other: float, times: float, plus: float) -> None:
    bound = Relation("g", times, plus)
    if abs(value - (times * other + plus)) > 0.01:
        assert met(value, other, at_most=bound) == (value < times * other + plus)
        assert met(value, other, at_least=bound) == (value > times * other + plus)


@pytest.mark.parametrize("missing", [None, math.nan])
def test_nothing_is_met_before_there_is_something(missing: float | None) -> None:
    assert not met(missing, is_=0.0, within=1e9)
    assert not met(missing, at_least=-1e9)
    assert not met(missing, one_of=("", "a"))
    assert not met(3.0, missing, at_most=Relation("g"))


@given(values, values, st.sampled_from(["is_", "one_of", "at_least", "relation"]))
def test_judging_never_fails(value: Any, other: Any, how: str) -> None:
    wanted = {
        "is_": {"is_": other if other is not None else 1.0},
        "one_of": {"one_of": (1.0 if other is None else other,)},
    }
    rest = {"at_least": {"at_least": 0.0}, "relation": {"at_most": Relation("g")}}
    verdict = judge(check(**{**wanted, **rest}[how]), lambda name: {"f": value, "g": other}[name])
    assert verdict.says == "It is so." and bool(verdict.advice) != verdict.met


def test_kinds_are_not_mixed_up() -> None:
    assert not met(1.0, is_=True) and not met(True, is_=1.0, within=0.0) and not met("1", is_=1.0, within=1.0)
    assert not met(True, at_least=0.0) and not met("9", at_least=0.0)
    assert (
        met(True, is_=True) and met("PD", is_="PD") and met("b", one_of=("a", "b")) and not met("c", one_of=("a", "b"))
    )


def test_an_infinite_value_is_more_than_any_bound() -> None:
    assert met(math.inf, at_least=100.0) and not met(math.inf, at_most=100.0)
    assert not met(math.inf, is_=100.0, within=5.0)


def test_advice_is_the_authors_or_says_what_is_wanted() -> None:
    advice = judge(check(is_=40, within=2), lambda _: 0.0).advice
    assert advice == "Not yet: wanted is 40 ± 2 mm."
    assert judge(check(at_most=Relation("g", 0.5)), lambda name: 12.0).advice == "Not yet: wanted is at most 6 mm."
    assert judge(check(is_=40, within=2, if_not="Turn it."), lambda _: 0.0).advice == "Turn it."
    assert judge(check(is_=40, within=2, if_not="Turn it."), lambda _: 41.0).advice == ""


CHOICES = Question("Why?", (Choice("a", False, "Not a."), Choice("b", True, "Right.")))
NUMBER = Question("How much?", number=NumberAnswer(10.0, "deg", 0.5, "Yes.", "No.", (Near(-10.0, 1.0, "The sign."),)))


@pytest.mark.parametrize(
    ("question", "answer", "right", "feedback"),
    [
        (CHOICES, 1, False, "Not a."),
        (CHOICES, 2, True, "Right."),
        (CHOICES, 3, False, "Choose one of the options."),
        (CHOICES, 0, False, "Choose one of the options."),
        (CHOICES, 1.5, False, "Choose one of the options."),
        (CHOICES, math.nan, False, "Choose one of the options."),
        (NUMBER, 10.5, True, "Yes."),
        (NUMBER, 10.6, False, "No."),
        (NUMBER, -9.2, False, "The sign."),
        (NUMBER, math.nan, False, "Give a number."),
        (NUMBER, math.inf, False, "Give a number."),
    ],
)
def test_answers_are_graded(question: Question, answer: float, right: bool, feedback: str) -> None:
    assert question.grade(answer) == (right, feedback)
