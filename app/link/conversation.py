"""Talking to a board: frames are numbered; what must arrive is repeated until it is answered."""

from __future__ import annotations

from collections.abc import Generator
from concurrent.futures import Future
from dataclasses import dataclass
from typing import Any, TypeAlias, TypeVar

from app.link.errors import LinkError
from app.link.protocol.codes import Refusal, describe_refusal
from app.link.protocol.frames import encode_frame
from app.link.protocol.messages import Ack, Alive, Get, Hello, Identity, Order, Set, Setpoint, Test, pack

REPEAT_S = 0.05
GIVE_UP_S = 1.0

Question: TypeAlias = Hello | Order | Set | Get | Test
Reply: TypeAlias = Ack | Identity
T = TypeVar("T")
Script: TypeAlias = Generator[Question, Any, T]
"""Questions one after the other: each `yield` gives the board's reply, or raises `Refused`."""


class Refused(LinkError):
    """The board said no."""

    def __init__(self, refusal: Refusal) -> None:
        super().__init__(describe_refusal(refusal))
        self.refusal = refusal


@dataclass
class _Asked:
    script: Script[Any]
    answer: Future[Any]
    frame: bytes
    first_s: float
    last_s: float


class Conversation:
    """Questions in the air, and the bytes that are to be written. Times are in s, of the caller's clock."""

    def __init__(self) -> None:
        self._number = 0
        self._asked: dict[int, _Asked] = {}
        self._output = bytearray()

    def say(self, message: Alive | Setpoint) -> int:
        """Something that is not answered; returns its number."""
        number = self._next_number()
        self._output += encode_frame(pack(message, number))
        return number

    def ask(self, script: Script[T], now: float) -> Future[T]:
        """Begin a script; the answer is what it returns, or the `LinkError` with which it ends."""
        answer: Future[T] = Future()
        self._go_on(script, answer, now, None)
        return answer

    def hear(self, reply: Reply, number: int, now: float) -> None:
        """A reply of the board; one that nobody waits for (any more) is dropped."""
        asked = self._asked.pop(number, None)
        if asked is None:
            return
        if isinstance(reply, Ack) and reply.result is not Refusal.OK:
            self._go_on(asked.script, asked.answer, now, Refused(reply.result))
        else:
            self._go_on(asked.script, asked.answer, now, reply)

    def repeat(self, now: float) -> None:
        """Ask again what was not answered, with the number that it had, and give up in the end."""
        for number, asked in list(self._asked.items()):
            if number not in self._asked:
                continue  # dropped by what followed from another one
            if now - asked.first_s >= GIVE_UP_S:
                del self._asked[number]
                silence = LinkError("The board does not answer; check the cable, or disconnect and connect again.")
                self._go_on(asked.script, asked.answer, now, silence)
            elif now - asked.last_s >= REPEAT_S:
                asked.last_s = now
                self._output += asked.frame

    def drop(self, reason: LinkError) -> None:
        """Every question that is in the air fails."""
        asked, self._asked = list(self._asked.values()), {}
        for one in asked:
            one.script.close()
            one.answer.set_exception(reason)

    def take_output(self) -> bytes:
        """The bytes to write now."""
        output = bytes(self._output)
        self._output.clear()
        return output

    def _go_on(self, script: Script[Any], answer: Future[Any], now: float, reply: Reply | LinkError | None) -> None:
        try:
            question = script.throw(reply) if isinstance(reply, LinkError) else script.send(reply)
        except StopIteration as end:
            answer.set_result(end.value)
        except LinkError as error:
            answer.set_exception(error)
        else:
            number = self._next_number()
            frame = encode_frame(pack(question, number))
            self._asked[number] = _Asked(script, answer, frame, now, now)
            self._output += frame

    def _next_number(self) -> int:
        self._number = (self._number + 1) & 0xFFFF
        return self._number
