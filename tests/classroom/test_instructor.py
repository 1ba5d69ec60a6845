"""What the instructor does, and that nobody else does it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from app.classroom.board import Bar, board, by_need, histogram
from app.classroom.classroom import Classroom
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import acted, checked, hint, opened
from app.classroom.export import as_csv, events_csv, progress_csv
from app.classroom.pace import LONGEST_MESSAGE, Message, Pace
from tests.support.classroom import LESSON, OUTLINE, TEACHER, Clock, a_class, joined, with_teacher

Deed = Callable[[Classroom, str, str], None]
DEEDS: dict[str, Deed] = {
    "pace": lambda c, by, member: c.set_pace(by, "paused"),
    "go on": lambda c, by, member: c.go_on(by),
    "show": lambda c, by, member: c.show(by, member),
    "show mine": lambda c, by, member: c.show_mine(by),
    "end spotlight": lambda c, by, member: c.end_spotlight(by),
    "overlay": lambda c, by, member: c.show_overlay(by, "tool_path"),
    "end overlay": lambda c, by, member: c.end_overlay(by),
    "message": lambda c, by, member: c.send(by, "Hello"),
    "lower": lambda c, by, member: c.lower(by, member),
    "rename": lambda c, by, member: c.rename_member(by, member, "Zoe"),
    "close door": lambda c, by, member: c.close_door(by),
    "open door": lambda c, by, member: c.open_door(by),
    "remove": lambda c, by, member: c.remove(by, member),
    "close class": lambda c, by, member: c.close_class(by),
}


@pytest.mark.parametrize("deed", DEEDS)
def test_only_the_instructor_does_it(deed: str):
    classroom = with_teacher(a_class())
    ada, _ = joined(classroom, "Ada"), joined(classroom, "Bob")
    news: list[object] = []
    for signal in (classroom.pace_changed, classroom.spotlight_changed, classroom.overlay_changed, classroom.removed,
                   classroom.message_sent, classroom.closed, classroom.door_changed, classroom.members_changed,
                   classroom.progress_changed):  # fmt: skip
        signal.connect(news.append)
    before = classroom.members, classroom.pace, classroom.is_open, classroom.door_open, list(_events(classroom))
    for browser in ("Bob", "Ada", "nobody", "", TEACHER + " "):
        with pytest.raises(ClassroomRefusal, match="Only the instructor"):
            DEEDS[deed](classroom, browser, ada.id)
    assert not news
    assert before == (classroom.members, classroom.pace, classroom.is_open, classroom.door_open, [])
    DEEDS[deed](classroom, TEACHER, ada.id)


def _events(classroom: Classroom):
    return [event for row in classroom.everybody for event in classroom.store.events(row.id)]


def test_the_pace_says_what_is_open():
    classroom = with_teacher(a_class())
    seen: list[Pace] = []
    classroom.pace_changed.connect(seen.append)
    assert classroom.pace.allows("17-capstone", 8)
    classroom.set_pace(TEACHER, "up_to", LESSON, 2)
    allowed = [classroom.pace.allows(*place) for place in [("01-meet", 9), (LESSON, 2), (LESSON, 3), ("03-x", 1)]]
    assert allowed == [True, True, False, False]
    classroom.set_pace(TEACHER, "paused", message="Look here")
    classroom.set_pace(TEACHER, "paused", message="And now\nhere")
    assert classroom.pace.paused and classroom.pace.message == "And now\nhere"
    assert not classroom.pace.allows(LESSON, 3), "a pause opens nothing"
    classroom.go_on(TEACHER)
    assert classroom.pace == seen[0] == Pace("up_to", LESSON, 2)
    classroom.set_pace(TEACHER, "all_at", LESSON, 1)
    assert classroom.pace.limit == (LESSON, 1)
    with pytest.raises(ClassroomRefusal):
        classroom.set_pace(TEACHER, "up_to")
    with pytest.raises(ClassroomRefusal):
        classroom.set_pace(TEACHER, "sideways", LESSON, 1)
    classroom.set_pace(TEACHER, "free")
    assert classroom.pace.limit is None


def test_the_spotlight_tells_no_name_if_the_instructor_wishes_so():
    classroom = with_teacher(a_class())
    ada = joined(classroom, "Ada")
    classroom.show(TEACHER, ada.id)
    assert classroom.spotlight and classroom.spotlight.title == "Ada's robot"
    classroom.show(TEACHER, ada.id, anonymous=True)
    assert "Ada" not in classroom.spotlight.title and classroom.spotlight.member_id == ada.id
    classroom.show_mine(TEACHER)
    assert classroom.spotlight.mine
    classroom.show(TEACHER, ada.id)
    classroom.remove(TEACHER, ada.id)
    assert classroom.spotlight is None
    with pytest.raises(ClassroomRefusal, match="has left"):
        classroom.show(TEACHER, ada.id)


def test_a_message_is_for_one_or_for_all():
    classroom = with_teacher(a_class())
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    heard: list[Message] = []
    classroom.message_sent.connect(heard.append)
    classroom.send(TEACHER, " Well\u202e done\x00 ", ada.id)
    classroom.send(TEACHER, "x" * 1_000_000)
    assert heard[0].text == "Well  done" and heard[0].is_for(ada.id) and not heard[0].is_for(bob.id)
    assert len(heard[1].text) == LONGEST_MESSAGE and heard[1].is_for(bob.id)
    with pytest.raises(ClassroomRefusal):
        classroom.send(TEACHER, " \n ")


def test_a_closed_class_takes_nothing_more():
    classroom = with_teacher(a_class())
    ada = joined(classroom, "Ada")
    closed: list[None] = []
    classroom.closed.connect(closed.append)
    classroom.close_class(TEACHER)
    assert closed == [None] and not classroom.is_open
    for deed in (lambda: classroom.record(ada, opened(LESSON, 1)), lambda: joined(classroom, "Bob")):
        with pytest.raises(ClassroomRefusal, match="closed"):
            deed()
    assert classroom.progress(ada).lesson == "", "it can still be read"


def test_a_new_name_must_be_free_too():
    classroom = with_teacher(a_class())
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    with pytest.raises(ClassroomRefusal, match="already"):
        classroom.rename_member(TEACHER, bob.id, "ada")
    classroom.rename_member(TEACHER, bob.id, "BOB")
    classroom.rename_member(TEACHER, ada.id, "Eve")
    assert [member.name for member in classroom.members] == ["BOB", "Eve"]
    assert classroom.join("tablet", "Ada", classroom.code).name == "Ada"


def test_the_board_shows_first_who_needs_help():
    clock = Clock()
    classroom = with_teacher(a_class(clock=clock))
    names = ["Ann", "Ben", "Cy", "Dee", "Eve"]
    members = {name: joined(classroom, name) for name in names}
    for name in names[:4]:
        classroom.came(name)
    classroom.record(members["Ann"], opened(LESSON, 1))
    classroom.record(members["Ann"], checked(LESSON, 1, 1))
    classroom.record(members["Cy"], opened(LESSON, 2))
    classroom.record(members["Cy"], hint(LESSON, 2, 3))
    classroom.record(members["Eve"], opened(LESSON, 2))
    clock.now += 20.0
    classroom.raise_hand("Dee")
    rows = board(classroom, members["Ben"].id, clock.now + 10.0)
    assert [row.name for row in rows] == ["Dee", "Cy", "Ann", "Ben", "Eve"]
    by_name = {row.name: row for row in rows}
    assert by_name["Dee"].hand_s == 10.0 and by_name["Cy"].stuck_s == 30.0
    ann = by_name["Ann"]
    assert (ann.lesson, ann.step, ann.checks, ann.checks_of, ann.seconds) == (LESSON, 1, 1, 2, 30.0)
    assert by_name["Ben"].holds_robot and not ann.holds_robot
    assert ann.online and not by_name["Eve"].online and by_name["Eve"].stuck_s is None
    assert histogram(rows, OUTLINE) == (
        Bar(LESSON, 1, "One leg", ("Ann",)),
        Bar(LESSON, 2, "All legs", ("Cy", "Eve")),
    )
    assert by_need(reversed(rows)) == rows


def test_a_page_that_closes_while_another_is_open_leaves_him_online():
    classroom = a_class()
    ada = joined(classroom, "Ada")
    classroom.came("Ada")
    classroom.came("Ada")
    classroom.went("Ada")
    assert classroom.online(ada.id)
    classroom.went("Ada")
    assert not classroom.online(ada.id)


def test_tables_have_every_row_and_no_formula():
    classroom = with_teacher(a_class())
    eve = joined(classroom, "=HYPERLINK(1)")
    classroom.record(eve, opened(LESSON, 1))
    classroom.record(eve, acted(LESSON, 1))
    classroom.remove(TEACHER, eve.id)
    assert f"{eve.id},'=HYPERLINK(1),yes,{LESSON},1,One leg,1,no,no,0,2,yes,0,no,,,0,,0" in progress_csv(classroom)
    events = events_csv(classroom).splitlines()
    assert len(events) == 3 and all(f"{eve.id},'=HYPERLINK(1),yes," in line for line in events[1:])
    cells = as_csv(("a",), [["+1"], ["@x"], ["-2+3"], ["\tx"], ['="x"'], [-1.5], ["a,b"]]).splitlines()
    assert cells[1:] == ["'+1", "'@x", "'-2+3", "'\tx", '"\'=""x"""', "-1.5", '"a,b"']
