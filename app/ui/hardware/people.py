"""Who is who: a name for every browser, and who has shown to be the instructor."""

from __future__ import annotations

import hmac
import secrets
import time
from collections import deque
from collections.abc import Callable

from app.link.lease import Person
from app.ui.recent import Recent

REMEMBERED = 500
LONGEST_NAME = 24
TRIES = 5
"""Wrong PINs that one browser may give in a minute."""

TRIES_OF_ALL = 30
"""The same for all browsers together: somebody who drops his cookies is a new one each time."""

MINUTE_S = 60.0
NO_INSTRUCTOR = "This server has no instructor: start it with --pin and four digits."


def random_pin() -> str:
    """Four digits that nobody can guess from the last ones."""
    return f"{secrets.randbelow(10_000):04d}"


class People:
    """Names and instructors by browser. An empty PIN: nobody can become the instructor."""

    def __init__(self, pin: str, clock: Callable[[], float] = time.monotonic) -> None:
        self._pin = pin
        self._clock = clock
        self._known: Recent[str, Person] = Recent(REMEMBERED)
        self._guests = 0
        self._mistakes: Recent[str, deque[float]] = Recent(REMEMBERED)
        self._all_mistakes: deque[float] = deque()

    @property
    def has_pin(self) -> bool:
        return bool(self._pin)

    def person(self, browser: str) -> Person:
        """Who sits at this browser; somebody new becomes the next guest."""
        person = self._known.get(browser)
        if person is None:
            self._guests += 1
            person = self._keep(Person(browser, f"Guest {self._guests}"))
        return person

    def rename(self, browser: str, name: str) -> Person:
        """Call somebody by another name; without a letter the old one stays."""
        person = self.person(browser)
        printable = "".join(character if character.isprintable() else " " for character in name)
        short = " ".join(printable.split())[:LONGEST_NAME].rstrip()
        return self._keep(Person(browser, short or person.name, person.instructor))

    def prove(self, browser: str, pin: str) -> str:
        """Make somebody the instructor; returns a sentence if that failed, else nothing."""
        if not self._pin:
            return NO_INSTRUCTOR
        mine = self._mistakes.get(browser) or deque()
        if self._too_many(mine, TRIES) or self._too_many(self._all_mistakes, TRIES_OF_ALL):
            return "Too many wrong PINs: wait a minute, then try again."
        if not hmac.compare_digest(pin.strip().encode(), self._pin.encode()):
            for mistakes in (mine, self._all_mistakes):
                mistakes.append(self._clock())
            self._mistakes.put(browser, mine)
            return "This is not the PIN: the server has printed it when it was started."
        person = self.person(browser)
        self._keep(Person(browser, person.name, instructor=True))
        return ""

    def _too_many(self, mistakes: deque[float], allowed: int) -> bool:
        while mistakes and self._clock() - mistakes[0] >= MINUTE_S:
            mistakes.popleft()
        return len(mistakes) >= allowed

    def _keep(self, person: Person) -> Person:
        self._known.put(person.key, person)
        return person
