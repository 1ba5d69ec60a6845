"""Names by browser, and the instructor's PIN."""

from __future__ import annotations

import pytest

from app.ui.hardware.people import LONGEST_NAME, TRIES, TRIES_OF_ALL, People, random_pin
from app.ui.hardware.workshop import ONLY_INSTRUCTOR, Workshop, choose_pin


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


def test_everybody_has_a_name_of_his_own_and_keeps_it():
    people = People("")
    assert [people.person(key).name for key in "abcab"] == ["Guest 1", "Guest 2", "Guest 3", "Guest 1", "Guest 2"]


@pytest.mark.parametrize(
    ("typed", "kept"),
    [
        ("  Ada   Lovelace ", "Ada Lovelace"),
        ("", "Guest 1"),
        (" \t\n", "Guest 1"),
        ("a\u202eb\x00c", "a b c"),
        ("<b>x</b>", "<b>x</b>"),
        ("x" * 100, "x" * LONGEST_NAME),
    ],
)
def test_names_are_short_and_printable(typed: str, kept: str):
    people = People("")
    assert people.rename("a", typed).name == kept == people.person("a").name


def test_only_the_pin_makes_an_instructor_who_then_stays_one():
    people = People("0471")
    assert "not the PIN" in people.prove("a", "471") and not people.person("a").instructor
    assert people.prove("a", " 0471 ") == ""
    assert people.rename("a", "Ms Ng").instructor and not people.person("b").instructor


def test_wrong_pins_are_limited_by_browser_for_a_minute():
    clock = Clock()
    people = People("0471", clock)
    for _ in range(TRIES):
        assert "not the PIN" in people.prove("a", "1111")
    assert "Too many" in people.prove("a", "0471"), "the right one too: else the limit would be of no use"
    assert people.prove("b", "0471") == ""
    clock.now += 61.0
    assert people.prove("a", "0471") == ""


def test_new_browsers_give_no_more_than_the_tries_of_all():
    people = People("0471", Clock())
    for number in range(TRIES_OF_ALL):
        assert "not the PIN" in people.prove(f"browser {number}", "1111")
    assert "Too many" in people.prove("another", "0471")


def test_without_a_pin_nobody_is_the_instructor():
    assert "no instructor" in People("").prove("a", "")


def test_a_pin_is_made_where_one_is_needed():
    assert choose_pin("1234", serial=False, local_only=True) == "1234"
    assert choose_pin(None, serial=False, local_only=True) == ""
    for pin in (choose_pin(None, serial=True, local_only=True), choose_pin(None, serial=False, local_only=False)):
        assert len(pin) == 4 and pin.isdigit()
    assert len({random_pin() for _ in range(40)}) > 10


def test_on_the_network_only_the_instructor_chooses_the_port():
    at_home, in_class = Workshop(), Workshop("1234", local_only=False)
    assert at_home.why_no_port(at_home.people.person("a")) == ""
    assert in_class.why_no_port(in_class.people.person("a")) == ONLY_INSTRUCTOR
    in_class.people.prove("a", "1234")
    assert in_class.why_no_port(in_class.people.person("a")) == ""
