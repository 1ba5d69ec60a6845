"""News and who hears them."""

from __future__ import annotations

from app.signal import Signal


def test_listeners_hear_in_order_until_they_stop_listening():
    signal: Signal[int] = Signal()
    heard: list[tuple[str, int]] = []
    stop_first = signal.connect(lambda news: heard.append(("first", news)))
    signal.connect(lambda news: heard.append(("second", news)))
    signal.emit(1)
    stop_first()
    stop_first()
    signal.emit(2)
    assert heard == [("first", 1), ("second", 1), ("second", 2)]


def test_a_listener_may_stop_listening_while_it_hears():
    signal: Signal[int] = Signal()
    heard: list[int] = []

    def hear_once(news: int) -> None:
        heard.append(news)
        stop()

    stop = signal.connect(hear_once)
    signal.connect(heard.append)
    signal.emit(1)
    signal.emit(2)
    assert heard == [1, 1, 2]
