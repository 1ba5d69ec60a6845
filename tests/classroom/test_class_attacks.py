"""What a hostile browser can try at this layer."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom import work
from app.classroom.classroom import Classroom
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import acted, opened
from app.classroom.people import TRIES, TRIES_OF_ALL
from app.classroom.roster import CAPACITY, LARGEST, WRONG_CODES_OF_ALL
from app.classroom.store.store import Store
from tests.support.classroom import LESSON, PIN, TEACHER, Clock, a_class, joined, with_teacher


def refused(deed) -> bool:
    try:
        deed()
    except ClassroomRefusal:
        return True
    return False


def test_ten_thousand_joins_fill_neither_the_board_nor_the_disk(tmp_path: Path):
    clock = Clock()
    classroom = a_class(Store(tmp_path / "class.sqlite3"), clock)
    for number in range(10_000):
        refused(lambda number=number: classroom.join(f"browser {number}", f"Bot {number}", classroom.code))
        clock.now += 0.1
    assert len(classroom.members) == CAPACITY == len(classroom.everybody)
    classroom.close()
    assert sum(path.stat().st_size for path in tmp_path.iterdir()) < 200_000


def test_sixty_join_within_ten_seconds():
    clock = Clock()
    classroom = a_class(clock=clock)
    for number in range(60):
        joined(classroom, f"Student {number}")
        clock.now += 10.0 / 60.0
    assert len(classroom.members) == 60


def test_joining_and_leaving_for_ever_leaves_no_rows():
    clock = Clock()
    classroom = a_class(clock=clock)
    for number in range(2000):
        if not refused(lambda number=number: classroom.join("a", f"Bot {number}", classroom.code)):
            classroom.leave("a")
        clock.now += 15.0
    assert classroom.everybody == ()


def test_a_class_never_has_more_rows_than_agreed():
    clock = Clock()
    classroom = with_teacher(a_class(clock=clock))
    for number in range(LARGEST + 50):
        if not refused(lambda number=number: joined(classroom, f"Bot {number}")):
            classroom.remove(TEACHER, classroom.member(f"Bot {number}").id)  # type: ignore[union-attr]
        clock.now += 1.0
    assert len(classroom.everybody) == LARGEST


def test_a_pin_is_not_found_by_trying():
    clock = Clock()
    classroom = a_class(clock=clock)
    tried = 0
    for number in range(3000):
        tried += "not the PIN" in classroom.prove(f"browser {number}", f"{number:06d}")
        clock.now += 0.02
    assert tried == TRIES_OF_ALL, "in a minute, of a million"
    assert not any(classroom.is_instructor(f"browser {number}") for number in range(3000))


@pytest.mark.parametrize("pin", ["", PIN[:-1], PIN + "0", "\x00", "٠٤٧١١٩", "9" * 1_000_000])
def test_other_pins_are_wrong(pin: str):
    classroom = a_class()
    assert classroom.prove("a", pin) and not classroom.is_instructor("a") and classroom.member("a") is None


def test_another_students_code_is_not_found_by_trying():
    clock = Clock()
    classroom = a_class(clock=clock)
    ada = joined(classroom, "Ada")
    for _ in range(TRIES):
        with pytest.raises(ClassroomRefusal, match="Nobody here"):
            classroom.resume("eve", "AAAA-AAAA")
    with pytest.raises(ClassroomRefusal, match="Too many"):
        classroom.resume("eve", ada.own_code)
    for number in range(2 * WRONG_CODES_OF_ALL):
        assert refused(lambda number=number: classroom.resume(f"eve {number}", "AAAA-AAAA"))
    with pytest.raises(ClassroomRefusal, match="Too many"):
        classroom.resume("eve's friend", ada.own_code)
    clock.now += 61.0
    assert classroom.resume("tablet", ada.own_code) == ada


@pytest.mark.parametrize("code", ["", " ", "%", "' OR 1=1 --", "x" * 1_000_000, "\x00", "ÄÖ"])
def test_nonsense_is_no_code(code: str):
    classroom = a_class()
    joined(classroom, "Ada")
    assert refused(lambda: classroom.resume("eve", code)) and refused(lambda: classroom.join("eve", "Eve", code))


def test_a_megabyte_is_no_name_and_a_script_is_only_text():
    classroom = a_class()
    assert len(classroom.join("a", "x" * 1_000_000, classroom.code).name) == 24
    assert classroom.join("b", "<script>alert(1)", classroom.code).name == "<script>alert(1)", "pages escape it"
    assert classroom.join("c", "'); DROP TABLE member;--", classroom.code).name.startswith("');")
    assert len(classroom.members) == 3


def test_nobody_records_for_a_member_that_is_none():
    classroom, other = a_class(), a_class()
    stranger = joined(other, "Eve")
    assert refused(lambda: classroom.record(stranger, opened(LESSON, 1)))
    assert classroom.everybody == ()


def test_events_of_one_member_are_bounded(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(work, "MOST_EVENTS", 6)
    classroom = a_class()
    ada = joined(classroom, "Ada")
    for _ in range(6):
        classroom.record(ada, opened(LESSON, 1))
    with pytest.raises(ClassroomRefusal, match="full"):
        classroom.record(ada, opened(LESSON, 1))
    with pytest.raises(ValueError, match="too much"):
        classroom.record(joined(classroom, "Bob"), opened("x" * 1000, 1))


def test_evidence_is_thinned_and_then_left_out(monkeypatch: pytest.MonkeyPatch):
    classroom = Classroom.in_memory()
    ada = classroom.member("a")
    assert ada is not None
    huge = [{"title": "T" * 9999, "series": [{"label": "y", "x": list(range(99_999)), "y": [0.1] * 99_999}] * 99}] * 99
    classroom.record(ada, acted(LESSON, 1, huge))
    assert 1000 < classroom.store.evidence_bytes(ada.id) <= 64_000
    monkeypatch.setattr(work, "MOST_EVIDENCE_BYTES", 70_000)
    classroom.record(ada, acted(LESSON, 2, huge))
    assert classroom.store.evidence_bytes(ada.id) <= 64_000 and classroom.progress(ada).of(LESSON, 2).acted
