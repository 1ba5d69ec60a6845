"""Joining, coming back, leaving, being removed: who may be whom."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from app.classroom import roster
from app.classroom.classroom import Classroom
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import opened
from app.classroom.names import name_key
from app.classroom.store.store import Store
from tests.support.classroom import PIN, TEACHER, Clock, a_class, joined, with_teacher


def test_who_joined_is_known_by_his_browser():
    classroom = a_class()
    assert classroom.member("ada") is None
    ada = classroom.join("ada", " Ada ", classroom.code.lower())
    assert classroom.member("ada") == ada and ada.name == "Ada" and not ada.instructor
    assert [member.name for member in classroom.members] == ["Ada"]
    assert classroom.person("ada").key == ada.id


def test_a_taken_name_is_refused_with_another_one():
    classroom = a_class()
    joined(classroom, "Ada")
    with pytest.raises(ClassroomRefusal, match="what about Ada 2"):
        classroom.join("b", "Ada", classroom.code)
    assert classroom.join("b", "Ada 2", classroom.code).name == "Ada 2"


@pytest.mark.parametrize("name", ["", "  ", "\u202e\u200b", "Instructor", "1nstructor", "Instructor 7"])
def test_some_names_are_nobodys(name: str):
    classroom = a_class()
    with pytest.raises(ClassroomRefusal):
        classroom.join("a", name, classroom.code)
    assert classroom.member("a") is None


def test_a_member_stays_who_he_is_until_he_leaves():
    classroom = a_class()
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    assert classroom.join("Ada", "Eve", classroom.code) == ada
    with pytest.raises(ClassroomRefusal, match="You are Ada"):
        classroom.resume("Ada", bob.own_code)
    classroom.record(ada, opened("01-meet", 1))
    classroom.leave("Ada")
    assert classroom.member("Ada") is None
    assert classroom.resume("Ada", bob.own_code) == bob
    assert classroom.find(ada.id) == ada, "he can still come back"


def test_ones_own_code_brings_one_back_from_another_browser():
    classroom = a_class()
    ada = joined(classroom, "Ada")
    assert classroom.resume("tablet", ada.own_code.lower().replace("-", " ")) == ada
    assert classroom.member("tablet") == ada == classroom.member("Ada")
    assert classroom.person("tablet") == classroom.person("Ada"), "one person to the robot on the table"


def test_who_did_nothing_and_left_is_forgotten_with_his_name():
    classroom = a_class()
    joined(classroom, "Ada")
    classroom.leave("Ada")
    assert classroom.everybody == () and joined(classroom, "Ada").name == "Ada"


def test_a_closed_door_lets_only_members_in():
    classroom = with_teacher(a_class())
    ada = joined(classroom, "Ada")
    classroom.close_door(TEACHER)
    with pytest.raises(ClassroomRefusal, match="door is closed"):
        joined(classroom, "Bob")
    assert classroom.resume("tablet", ada.own_code) == ada
    classroom.open_door(TEACHER)
    assert joined(classroom, "Bob").name == "Bob"


def test_the_instructor_is_on_no_board_and_his_right_is_his_browsers():
    classroom = with_teacher(a_class())
    teacher = classroom.member(TEACHER)
    assert teacher is not None and teacher.instructor and classroom.members == ()
    elsewhere = classroom.resume("library", teacher.own_code)
    assert elsewhere == teacher and not elsewhere.instructor and not classroom.is_instructor("library")
    assert not classroom.person("library").instructor and classroom.person(TEACHER).instructor


def test_a_removed_member_joins_anew_and_his_rows_stay():
    classroom = with_teacher(a_class())
    ada = joined(classroom, "Ada")
    classroom.resume("tablet", ada.own_code)
    classroom.record(ada, opened("01-meet", 1))
    gone: list[str] = []
    classroom.removed.connect(lambda member: gone.append(member.name))
    classroom.remove(TEACHER, ada.id)
    assert gone == ["Ada"] and classroom.member("Ada") is None and classroom.member("tablet") is None
    for attempt in (lambda: classroom.resume("Ada", ada.own_code), lambda: classroom.record(ada, opened("x", 1))):
        with pytest.raises(ClassroomRefusal):
            attempt()
    again = joined(classroom, "Ada")
    assert again.id != ada.id
    assert [row.removed_at is not None for row in classroom.everybody if row.name == "Ada"] == [True, False]


def test_a_member_has_only_so_many_browsers():
    classroom = a_class()
    ada = joined(classroom, "Ada")
    for number in range(roster.BROWSERS_EACH):
        classroom.resume(f"tablet {number}", ada.own_code)
    assert classroom.member("Ada") is None, "the first one is forgotten"
    assert all(classroom.member(f"tablet {number}") == ada for number in range(roster.BROWSERS_EACH))


def test_a_class_goes_on_after_a_restart(tmp_path: Path):
    file = tmp_path / "class.sqlite3"
    classroom = with_teacher(a_class(Store(file)))
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    classroom.set_pace(TEACHER, "up_to", "02-inverse", 2)
    classroom.set_pace(TEACHER, "paused", message="Look here")
    classroom.remove(TEACHER, bob.id)
    classroom.close_door(TEACHER)
    code, pace = classroom.code, classroom.pace
    classroom.close()
    again = a_class(Store(file))
    assert (again.code, again.pace, again.door_open) == (code, pace, False)
    assert again.member("Ada") == ada and again.is_instructor(TEACHER) and again.member("Bob") is None
    assert again.member("Ada").own_code == ada.own_code  # type: ignore[union-attr]
    assert again.resume("tablet", ada.own_code) == ada
    again.close_class(TEACHER)
    again.close()
    next_week = a_class(Store(file))
    assert next_week.code != code and next_week.member("Ada") is None and not next_week.is_instructor(TEACHER)
    assert len(next_week.store.classes()) == 2
    next_week.close()


def test_the_file_tells_no_browser_and_no_code(tmp_path: Path):
    file = tmp_path / "class.sqlite3"
    classroom = a_class(Store(file))
    ada = classroom.join("3f8a-the-cookie-of-ada", "Ada", classroom.code)
    classroom.close()
    content = file.read_bytes()
    assert b"Ada" in content and b"cookie-of-ada" not in content
    assert ada.own_code.encode() not in content and ada.own_code.replace("-", "").encode() not in content
    assert file.stat().st_mode & 0o077 == 0, "nobody else reads it"


BROWSERS = st.sampled_from("abcdef")
NAMES = st.sampled_from(["Ada", "ADA", "Аda", "Bob", "b o b", "Cy", "", "Instructor", "\u202e"])


class Comings(RuleBasedStateMachine):
    """All that browsers can do, in any order; `proved` are those that gave the PIN and did not leave since."""

    @initialize()
    def open(self) -> None:
        self.clock = Clock()
        self.classroom = a_class(clock=self.clock)
        self.codes: list[str] = []
        self.proved: set[str] = set()

    @rule(browser=BROWSERS, name=NAMES, right=st.booleans())
    def join(self, browser: str, name: str, right: bool) -> None:
        self._attempt(lambda: self.classroom.join(browser, name, self.classroom.code if right else "22222"))

    @rule(browser=BROWSERS, which=st.integers(0, 20))
    def resume(self, browser: str, which: int) -> None:
        code = self.codes[which % len(self.codes)] if self.codes else "AAAA-AAAA"
        self._attempt(lambda: self.classroom.resume(browser, code))

    @rule(browser=BROWSERS)
    def leave(self, browser: str) -> None:
        self.classroom.leave(browser)
        self.proved.discard(browser)
        assert self.classroom.member(browser) is None

    @rule(browser=BROWSERS, pin=st.sampled_from([PIN, "000000", ""]))
    def prove(self, browser: str, pin: str) -> None:
        if self.classroom.prove(browser, pin) == "":
            assert pin == PIN
            self.proved.add(browser)

    @rule(by=BROWSERS, which=st.integers(0, 20))
    def remove(self, by: str, which: int) -> None:
        members = self.classroom.members
        if members:
            member = members[which % len(members)]
            allowed = self._attempt(lambda: self.classroom.remove(by, member.id))
            assert allowed == (by in self.proved)

    @rule(browser=BROWSERS)
    def work(self, browser: str) -> None:
        member = self.classroom.member(browser)
        if member is not None:
            self.classroom.record(member, opened("01-meet", 1))

    @rule()
    def wait(self) -> None:
        self.clock.now += 61.0

    @rule()
    def restart(self) -> None:
        before = [self.classroom.member(browser) for browser in "abcdef"], self.classroom.members
        self.classroom = a_class(self.classroom.store, self.clock)
        assert ([self.classroom.member(browser) for browser in "abcdef"], self.classroom.members) == before

    @invariant()
    def names_are_unique_and_only_the_pin_makes_instructors(self) -> None:
        keys = [name_key(member.name) for member in self.classroom.members]
        assert len(set(keys)) == len(keys)
        assert {browser for browser in "abcdef" if self.classroom.is_instructor(browser)} == self.proved
        for browser in "abcdef":
            member = self.classroom.member(browser)
            if member is not None:
                assert self.classroom.find(member.id) == member
                if member.own_code not in self.codes:
                    self.codes.append(member.own_code)

    def _attempt(self, deed) -> bool:
        try:
            deed()
        except ClassroomRefusal:
            return False
        return True


TestComings = Comings.TestCase
TestComings.settings = settings(max_examples=40, stateful_step_count=30)


def test_two_classrooms_share_nothing():
    one, other = Classroom.in_memory(in_class=True), Classroom.in_memory(in_class=True)
    joined(one, "Ada")
    assert one.code != other.code and other.member("Ada") is None
