"""Questions that are repeated until they are answered."""

from __future__ import annotations

import pytest

from app.link.conversation import GIVE_UP_S, REPEAT_S, Conversation, Refused, Script
from app.link.errors import LinkError
from app.link.protocol.codes import Command, Refusal
from app.link.protocol.frames import FrameDecoder
from app.link.protocol.messages import Ack, Alive, Get, Order, Set, unpack
from app.link.round_trips import RoundTrips

YES = Ack(Refusal.OK, 0.0)


def written(conversation: Conversation) -> list[tuple[object, int]]:
    return [unpack(payload) for payload in FrameDecoder().feed(conversation.take_output())]


def enable() -> Script[str]:
    yield Order(Command.ENABLE)
    return "done"


def test_a_question_is_repeated_with_its_number_until_it_is_answered():
    conversation = Conversation()
    answer = conversation.ask(enable(), 0.0)
    ((_, number),) = written(conversation)
    for k in range(1, 4):
        conversation.repeat(k * REPEAT_S - 0.01)
        assert written(conversation) == []
        conversation.repeat(k * REPEAT_S)
        assert written(conversation) == [(Order(Command.ENABLE), number)]
    conversation.hear(YES, number + 1, 0.2)  # to something else
    assert not answer.done()
    conversation.hear(YES, number, 0.2)
    assert answer.result(0) == "done"
    conversation.hear(YES, number, 0.3)  # a second answer, to the repetition
    conversation.repeat(0.5)
    assert written(conversation) == []


def test_it_is_given_up_after_a_second():
    conversation = Conversation()
    answer = conversation.ask(enable(), 0.0)
    conversation.repeat(GIVE_UP_S)
    with pytest.raises(LinkError, match="does not answer"):
        answer.result(0)
    assert len(written(conversation)) == 1


def test_a_refusal_is_raised_inside_of_the_script():
    def script() -> Script[float]:
        with pytest.raises(Refused) as caught:
            yield Set(3, 1.0)
        assert caught.value.refusal is Refusal.BUSY
        ack = yield Get(3)
        return ack.value

    conversation = Conversation()
    answer = conversation.ask(script(), 0.0)
    conversation.hear(Ack(Refusal.BUSY, 0.0), written(conversation)[0][1], 0.1)
    conversation.hear(Ack(Refusal.OK, 7.0), written(conversation)[0][1], 0.2)
    assert answer.result(0) == 7.0


def test_dropping_ends_every_script_and_what_follows_from_that_is_asked():
    conversation = Conversation()
    first, second = (conversation.ask(enable(), 0.0) for _ in range(2))
    written(conversation)
    first.add_done_callback(lambda _: conversation.ask(enable(), 0.0))
    conversation.drop(LinkError("No more."))
    assert str(first.exception(0)) == str(second.exception(0)) == "No more."
    assert len(written(conversation)) == 1


def test_numbers_go_round():
    conversation = Conversation()
    conversation._number = 2**16 - 2
    assert [conversation.say(Alive()) for _ in range(3)] == [2**16 - 1, 0, 1]


def test_round_trips_are_counted_once_and_the_median_is_theirs():
    trips = RoundTrips()
    for number in range(100):
        trips.sent(number, 0.01 * number)
        if number % 2:
            trips.named(number, 0.01 * number + 0.001 * number)
            trips.named(number, 0.01 * number + 5.0)
    assert trips.median_ms == pytest.approx(50.0)
    assert trips.p95_ms == pytest.approx(94.1)
    trips.named(0, 9.0)  # older than what was named
    assert trips.last_s == pytest.approx(0.099)
