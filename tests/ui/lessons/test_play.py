"""The player finds what is wrong with a lesson."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from app.classroom.lessons.lesson import Act, Check, Choice, Lesson, Play, Press, Question, Set, Setting, Step
from app.ui.lessons.play import play

CHOOSE = Question("Which?", (Choice("this", True, "Yes."), Choice("that", False, "No.")))
REACHES_30 = Act("Go there.", (Check("pose.x", "mm", "It stands at 30 mm.", is_=30.0, within=0.5),))
STEP = Step(
    1,
    "Go",
    5.0,
    "",
    settings=(Setting("robot", "delta3"),),
    act=REACHES_30,
    explain=CHOOSE,
    solution=Play((Set("pose.x", 30.0),), explain=1.0, line=20),
    wrong=Play((Set("pose.x", 10.0),), explain=2.0, line=30),
    line=10,
)


def lesson(**changes: object) -> Lesson:
    step = replace(STEP, **changes)  # type: ignore[arg-type]
    return Lesson("01-x", 1, "X", 5.0, "par4", (), (), (), False, "", (step,), Path("01-x.md"))


def test_a_whole_lesson_has_no_complaints():
    assert play(lesson()) == []


@pytest.mark.parametrize(
    ("changes", "line", "complaint"),
    [
        ({"solution": Play((Set("pose.x", 29.0),), explain=1.0, line=20)}, 20, "does not pass"),
        ({"solution": Play((Set("pose.x", 30.0),), explain=2.0, line=20)}, 20, "Explain (2) is judged wrong"),
        ({"solution": Play((Set("pose.x", 30.0),), line=20)}, 20, "does not answer Explain"),
        ({"wrong": Play((Set("pose.x", 30.2),), explain=2.0, line=30)}, 30, "wrong solution passes"),
        ({"wrong": Play((), explain=1.0, line=30)}, 30, "is judged right"),
        ({"settings": (*STEP.settings, Setting("pose.x", 30.0))}, 10, "before anything was done"),
        ({"settings": (Setting("robot", "delta4"),)}, 10, "choose one of par4"),
        ({"solution": Play((Press("fly"),), explain=1.0, line=20)}, 10, "no action 'fly'"),
        ({"may_change": frozenset({"joint"}), "settings": (*STEP.settings, Setting("pose.x", 0.0))}, 20, "pose.x"),
    ],
)
def test_what_is_wrong_is_told_with_its_line(changes: dict[str, object], line: int, complaint: str):
    found = play(lesson(**changes))
    assert any(one.startswith(f"01-x.md:{line}: step 1, Go: ") and complaint in one for one in found), found


def test_a_check_that_stays_met_is_seen_between_the_deeds():
    check = Check("reach.ok", "", "It was out of reach.", is_=False, ever=True)
    deeds = Set("pose.x", 900.0), Set("pose.x", 0.0)
    changes = {"act": Act("", (check,)), "explain": None, "wrong": None, "solution": Play(deeds)}
    assert play(lesson(**changes)) == []
