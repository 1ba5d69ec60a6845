"""Who may move the robot: one holder at a time, for as long as there are signs of life; others wait in order."""

from __future__ import annotations

from dataclasses import dataclass

from app.link.errors import LinkError

KEEP_S = 15.0
"""Without a sign of life for so long, a holder loses the robot, and whoever waits his place in the queue."""


@dataclass(frozen=True)
class Person:
    """Somebody in the room. Two pages of one person share the key."""

    key: str
    name: str
    instructor: bool = False


class Lease:
    """The right to move the robot. Times are in s, of any clock that does not go back; a time is never remembered
    but as a sign of life."""

    def __init__(self, keep_s: float = KEEP_S) -> None:
        self._keep_s = keep_s
        self._line: list[Person] = []
        self._seen: dict[str, float] = {}

    @property
    def holder(self) -> Person | None:
        return self._line[0] if self._line else None

    @property
    def queue(self) -> tuple[Person, ...]:
        """Who waits, the next one first."""
        return tuple(self._line[1:])

    def left_s(self, now: float) -> float:
        """Until the holder loses the robot, unless there is a sign of life."""
        holder = self.holder
        return 0.0 if holder is None else max(0.0, self._seen[holder.key] + self._keep_s - now)

    def holds(self, person: Person) -> bool:
        return self.holder is not None and self.holder.key == person.key

    def request(self, person: Person, now: float) -> None:
        """Take the robot if it is free, or a place at the end of the queue. Asking again keeps the place."""
        self.expire(now)
        if person.key not in self._seen:
            self._line.append(person)
        self._seen[person.key] = now

    def release(self, person: Person, now: float) -> None:
        """Give the robot to whoever is next, or the place in the queue up."""
        self.expire(now)
        self._drop(person.key)

    def alive(self, person: Person, now: float) -> None:
        """A sign of life of the holder or of somebody who waits; from anybody else it means nothing."""
        self.expire(now)
        if person.key in self._seen:
            self._seen[person.key] = now

    def take_over(self, person: Person, now: float) -> None:
        """An instructor holds the robot at once; who held it is next."""
        if not person.instructor:
            raise LinkError("Only an instructor can take the robot over; ask for it and wait for your turn.")
        self.expire(now)
        self._put_first(person, now)

    def hand_to(self, giver: Person, person: Person, now: float) -> None:
        """An instructor gives the robot to somebody, whether he waits or not; who held it is next, but for the giver.
        His page has as long as any to give a sign of life."""
        if not giver.instructor:
            raise LinkError("Only an instructor can hand the robot to somebody; press Hand over for the next in line.")
        self.expire(now)
        if giver.key != person.key:
            self._drop(giver.key)
        self._put_first(person, now)

    def expire(self, now: float) -> None:
        """Forget everybody who gave no sign of life for too long."""
        for key in [key for key, seen in self._seen.items() if now - seen >= self._keep_s]:
            self._drop(key)

    def _put_first(self, person: Person, now: float) -> None:
        self._drop(person.key)
        self._line.insert(0, person)
        self._seen[person.key] = now

    def _drop(self, key: str) -> None:
        self._line = [waiting for waiting in self._line if waiting.key != key]
        self._seen.pop(key, None)
