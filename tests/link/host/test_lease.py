"""Who holds the robot, against a model of people with watches."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.link.errors import LinkError
from app.link.lease import KEEP_S, Lease, Person

PEOPLE = [Person("a", "Anna"), Person("b", "Ben"), Person("c", "Carla", instructor=True), Person("d", "Dora")]
ACTS = ["request", "release", "alive", "take_over"]

steps = st.lists(
    st.tuples(st.sampled_from(ACTS), st.sampled_from(PEOPLE), st.sampled_from([0.0, 0.5, 1.0, 4.0, 7.5, 14.9, 16.0])),
    max_size=40,
)


class Room:
    """Independent of the lease: everybody in one line, each with the time of the last sign of life."""

    def __init__(self) -> None:
        self.line: list[tuple[Person, float]] = []

    def act(self, what: str, person: Person, now: float) -> None:
        self.line = [(who, seen) for who, seen in self.line if now - seen < KEEP_S]
        present = any(who is person for who, _ in self.line)
        if what == "release":
            self.line = [(who, seen) for who, seen in self.line if who is not person]
        elif what == "take_over" and person.instructor:
            self.line = [(person, now)] + [(who, seen) for who, seen in self.line if who is not person]
        elif present and what in ("request", "alive"):
            self.line = [(who, now if who is person else seen) for who, seen in self.line]
        elif what == "request":
            self.line.append((person, now))


@given(steps)
def test_the_line_is_that_of_the_model(taken):
    lease, room, now = Lease(), Room(), 0.0
    for what, person, wait in taken:
        now += wait
        room.act(what, person, now)
        if what == "take_over" and not person.instructor:
            with pytest.raises(LinkError, match="Only an instructor"):
                lease.take_over(person, now)
            lease.expire(now)
        else:
            getattr(lease, what)(person, now)
        line = [who for who, _ in room.line]
        assert ([lease.holder] if lease.holder else []) + list(lease.queue) == line
        left = room.line[0][1] + KEEP_S - now if room.line else 0.0
        assert lease.left_s(now) == pytest.approx(left)


@given(steps)
def test_nobody_who_only_waits_overtakes(taken):
    """Two people in the line keep their order, unless one of them left it or took over."""
    lease, now = Lease(), 0.0
    for what, person, wait in taken:
        now += wait
        lease.expire(now)
        before = [lease.holder, *lease.queue]
        if what != "take_over" or person.instructor:
            getattr(lease, what)(person, now)
        after = [lease.holder, *lease.queue]
        stayed = [who for who in before if who is not None and who in after and who is not person]
        assert stayed == [who for who in after if who in stayed]
        assert len(set(after)) == len(after)


def test_a_countdown_runs_and_a_sign_of_life_starts_it_again():
    lease, (anna, ben, *_) = Lease(), PEOPLE
    lease.request(anna, 0.0)
    lease.request(ben, 1.0)
    assert lease.left_s(10.0) == pytest.approx(5.0)
    lease.alive(anna, 10.0)
    assert lease.left_s(12.0) == pytest.approx(13.0)
    lease.alive(ben, 20.0)  # too late for Ben, who was silent for 19 s
    assert lease.queue == ()
    lease.expire(25.0)
    assert lease.holder is None


def test_two_pages_of_one_person_are_one():
    lease = Lease()
    lease.request(Person("a", "Anna"), 0.0)
    lease.request(Person("a", "Anna on her phone"), 1.0)
    assert lease.queue == ()
    assert lease.holds(Person("a", ""))


def test_an_instructor_hands_the_robot_to_anybody():
    lease, (anna, ben, carla, dora) = Lease(), PEOPLE
    lease.request(anna, 0.0)
    lease.request(ben, 0.0)
    lease.hand_to(carla, ben, 1.0)
    assert (lease.holder, lease.queue) == (ben, (anna,)), "who held it is next"
    lease.take_over(carla, 2.0)
    lease.hand_to(carla, dora, 3.0)
    assert (lease.holder, lease.queue) == (dora, (ben, anna)), "the giver need not wait"
    lease.hand_to(carla, carla, 4.0)
    assert lease.holder == carla
    lease.hand_to(carla, anna, 5.0)
    lease.expire(5.0 + KEEP_S)
    assert lease.holder is None, "a page that never gives a sign of life keeps nothing"


def test_a_student_hands_the_robot_to_nobody():
    lease, (anna, ben, *_) = Lease(), PEOPLE
    lease.request(anna, 0.0)
    with pytest.raises(LinkError, match="Only an instructor"):
        lease.hand_to(anna, ben, 1.0)
    assert (lease.holder, lease.queue) == (anna, ())
