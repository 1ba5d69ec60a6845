"""Who is who: members, who sits at which browser, and who has shown to be the instructor."""

from __future__ import annotations

import secrets
import time
from dataclasses import dataclass, field

from app.classroom.codes import browser_hash, same_secret
from app.classroom.limits import Clock, Limit
from app.link.lease import Person

TRIES = 5
"""Wrong PINs or codes that one browser may give in a minute."""

TRIES_OF_ALL = 30
"""The same for all browsers together: somebody who drops his cookies is a new one each time."""

NO_INSTRUCTOR = "This server has no instructor: start it with --pin and four digits."
WRONG_PIN = "This is not the PIN: the server has printed it when it was started."
TOO_MANY_PINS = "Too many wrong PINs: wait a minute, then try again."
SEEDS = 2**31
BETWEEN_ATTEMPTS = 7919


@dataclass(frozen=True)
class Member:
    """Somebody who works here, as one browser is told of him. Two of one `id` are the same."""

    id: str
    name: str
    seed: int
    """His numbers in the lessons."""
    instructor: bool = field(default=False, compare=False)
    own_code: str = field(default="", compare=False, repr=False)
    """Brings him back from any browser; told only to himself, and empty where nobody logs in."""


class Pin:
    """The instructor's PIN and how often it may be guessed. An empty one is never right."""

    def __init__(self, pin: str, clock: Clock = time.monotonic) -> None:
        self._pin = pin
        self._mistakes = Limit(TRIES, TRIES_OF_ALL, clock)

    def __bool__(self) -> bool:
        return bool(self._pin)

    def refusal(self, browser: str, typed: str) -> str:
        """Why this browser's user is not the instructor; empty if the PIN is right."""
        if not self._pin:
            return NO_INSTRUCTOR
        key = browser_hash(browser)
        if self._mistakes.reached(key):
            return TOO_MANY_PINS
        if not same_secret(typed.strip(), self._pin):
            self._mistakes.note(key)
            return WRONG_PIN
        return ""


def new_member_id() -> str:
    """Tells nothing about whom it belongs to, and cannot be guessed."""
    return secrets.token_hex(8)


def new_seed() -> int:
    return secrets.randbelow(SEEDS)


def seed_of_attempt(seed: int, attempt: int) -> int:
    """Of the numbers in an attempt at a step, counted from 1: the first has the member's own."""
    return (seed + BETWEEN_ATTEMPTS * (attempt - 1)) % SEEDS


def as_person(member: Member) -> Person:
    """A member as the robot on the table knows him: two browsers of his are one person."""
    return Person(member.id, member.name, member.instructor)
