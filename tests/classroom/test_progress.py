"""Progress is a function of what happened: steps, time, who is stuck, what should be done again."""

from __future__ import annotations

import pytest

from app.classroom.errors import ClassroomRefusal
from app.classroom.events import Event, Happened, acted, checked, explained, hint, more, opened, predicted, redo
from app.classroom.progress import GAP_S, Progress, progress_of
from app.classroom.work import EVENTS_A_MINUTE
from tests.support.classroom import LESSON, OUTLINE, Clock, a_class, joined

STEP = (LESSON, 1)
START = 1000.0


def after(*events: Event | float) -> Progress:
    """Progress after events a second apart; a number lets so many seconds pass instead."""
    now, happened = START, []
    for event in events:
        if isinstance(event, Event):
            happened.append(Happened(len(happened), now, event))
            now += 1.0
        else:
            now += event - 1.0
    return progress_of(happened)


DONE = (predicted(*STEP, 2), checked(*STEP, 0), checked(*STEP, 1), acted(*STEP), explained(*STEP, 40.0, True))


def test_a_step_is_done_when_all_that_it_asks_for_is():
    for count in range(len(DONE)):
        assert not after(opened(*STEP), *DONE[:count]).done(*STEP, OUTLINE)
    progress = after(opened(*STEP), *DONE)
    step = progress.of(*STEP)
    assert progress.done(*STEP, OUTLINE) and not progress.done(LESSON, 2, OUTLINE)
    assert (step.prediction, step.checks, step.tries, step.first_try_right) == (2, {0, 1}, 1, True)
    assert progress.lesson_share(LESSON, OUTLINE) == 0.5 and progress.share(OUTLINE) == pytest.approx(1 / 3)


def test_the_first_try_is_the_first_and_right_stays_right():
    step = after(*(explained(*STEP, value, right) for value, right in [(1, False), (2, True), (3, False)])).of(*STEP)
    assert (step.tries, step.right, step.first_try_right, step.answer) == (3, True, False, 3)
    assert after(predicted(*STEP, 1), predicted(*STEP, 2)).of(*STEP).prediction == 1
    assert after(more(*STEP, 1, False)).of(*STEP).more_right is False
    assert after(more(*STEP, 1, True), more(*STEP, 1, False)).of(*STEP).more_right is True


def test_time_goes_to_the_step_that_was_open_but_not_while_he_is_away():
    progress = after(opened(*STEP), 60.0, opened(LESSON, 2), 3600.0, opened(*STEP), 10.0, predicted(*STEP, 1))
    assert progress.of(*STEP).seconds == 60.0 + 10.0
    assert progress.of(LESSON, 2).seconds == GAP_S
    now = START + 60.0 + 3600.0 + 10.0
    assert progress.seconds_here(now + 5.0) == 75.0


def test_hands_are_raised_and_lowered():
    progress = after(opened(*STEP), Event("raised"), Event("raised"))
    assert progress.hand_since == START + 1.0 and (progress.lesson, progress.step) == STEP
    assert after(Event("raised"), Event("lowered")).hand_since is None


def test_without_progress_for_long_he_is_stuck_and_progress_frees_him():
    began = after(opened(*STEP), predicted(*STEP, 1))
    moved = START + 1.0
    assert began.stuck_since(OUTLINE, moved + 359.0) is None, "1.5 times four minutes"
    assert began.stuck_since(OUTLINE, moved + 361.0) == moved
    assert (
        after(opened(*STEP), predicted(*STEP, 1), 300.0, checked(*STEP, 0)).stuck_since(OUTLINE, moved + 361.0) is None
    )
    again = after(opened(*STEP), checked(*STEP, 0), 300.0, checked(*STEP, 0))
    assert again.stuck_since(OUTLINE, moved + 361.0) == moved, "a check that was met before is no progress"
    long_step = after(opened(LESSON, 2))
    assert long_step.stuck_since(OUTLINE, START + 890.0) is None
    assert long_step.stuck_since(OUTLINE, START + 910.0) == START
    assert Progress().stuck_since(OUTLINE, 1e12) is None


def test_the_worked_hint_or_three_wrong_answers_are_a_call_for_help():
    wrong = explained(*STEP, 1, False)
    assert after(opened(*STEP), hint(*STEP, 2)).stuck_since(OUTLINE, START + 2.0) is None
    assert after(opened(*STEP), hint(*STEP, 3)).stuck_since(OUTLINE, START + 2.0) == START + 1.0
    assert after(wrong, wrong).stuck_since(OUTLINE, START + 2.0) is None
    assert after(wrong, wrong, wrong).stuck_since(OUTLINE, START + 3.0) == START + 2.0
    assert after(*DONE[:4], wrong, wrong, wrong, DONE[4]).stuck_since(OUTLINE, START + 1e4) is None


def test_weak_steps_are_to_be_done_again_until_they_are_done_well():
    wrong = explained(*STEP, 1, False)
    assert after(wrong).redo_list(OUTLINE) == (), "it is not even done once"
    weak = (*DONE[:4], wrong, DONE[4])
    assert after(*DONE).redo_list(OUTLINE) == ()
    assert after(*weak).redo_list(OUTLINE) == (STEP,) == after(*weak).redo_list(OUTLINE, LESSON)
    assert after(*weak).redo_list(OUTLINE, "01-meet") == ()
    assert after(*DONE[:4], hint(*STEP, 3), DONE[4]).redo_list(OUTLINE) == (STEP,)
    assert after(*DONE, hint(*STEP, 3)).redo_list(OUTLINE) == (), "read after it was right"
    begun = after(*weak, redo(*STEP), DONE[0])
    assert begun.redo_list(OUTLINE) == (STEP,) and begun.done(*STEP, OUTLINE) and begun.of(*STEP).attempt == 2
    assert after(*weak, redo(*STEP), *weak).redo_list(OUTLINE) == (STEP,)
    assert after(*weak, redo(*STEP), *DONE).redo_list(OUTLINE) == ()


def test_another_attempt_has_other_numbers():
    classroom = a_class()
    ada = joined(classroom, "Ada")
    first = classroom.seed(ada, *STEP)
    classroom.record(ada, redo(*STEP))
    assert first == ada.seed != classroom.seed(ada, *STEP) and classroom.seed(ada, LESSON, 2) == ada.seed


def test_what_is_recorded_is_the_progress_and_is_told():
    classroom = a_class()
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    told: list[str] = []
    classroom.progress_changed.connect(lambda member: told.append(member.id))
    for event in DONE:
        classroom.record(ada, event)
    classroom.raise_hand("Bob")
    assert told == [ada.id] * len(DONE) + [bob.id]
    progress = classroom.progress(ada)
    assert progress == progress_of(classroom.store.events(ada.id)) and progress.done(*STEP, OUTLINE)
    assert classroom.progress(bob).hand_since is not None
    classroom.lower_hand("Bob")
    assert classroom.progress(bob).hand_since is None


def test_nobody_records_faster_than_people_work():
    clock = Clock()
    classroom = a_class(clock=clock)
    ada, bob = joined(classroom, "Ada"), joined(classroom, "Bob")
    for _ in range(EVENTS_A_MINUTE):
        classroom.record(ada, opened(*STEP))
    with pytest.raises(ClassroomRefusal, match="too quick"):
        classroom.record(ada, opened(*STEP))
    classroom.record(bob, opened(*STEP))
    clock.now += 61.0
    classroom.record(ada, opened(*STEP))
