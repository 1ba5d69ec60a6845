"""Who may talk to the server, and how fast: the policy by itself."""

from __future__ import annotations

from http import HTTPStatus

import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.ui.guard import (
    SECURITY_HEADERS,
    Guard,
    browser_id_in,
    identity_cookie,
    is_loopback,
    new_browser_id,
)
from app.ui.rate_limit import TokenBucket

GUARD = Guard()
PROXIED = Guard(allowed_hosts=("lab.example.org",))


def status(guard: Guard, hosts: list[str], origins: list[str], local_only: bool = True) -> HTTPStatus | None:
    refusal = guard.refusal(hosts, origins, local_only=local_only)
    return refusal and refusal[0]


@pytest.mark.parametrize(
    "host", ["localhost:8080", "127.0.0.1:8080", "127.9.9.9", "[::1]:8080", "LOCALHOST", "a.localhost"]
)
def test_this_machine_answers_to_its_own_names(host: str) -> None:
    assert status(GUARD, [host], []) is None


@pytest.mark.parametrize("host", ["evil.example:8080", "localhost.evil.example", "192.168.1.7:8080", "0.0.0.0:8080"])
def test_a_foreign_name_for_this_machine_is_rebinding(host: str) -> None:
    assert status(GUARD, [host], []) == HTTPStatus.FORBIDDEN
    assert status(GUARD, [host], [f"http://{host}"]) == HTTPStatus.FORBIDDEN


def test_an_open_server_answers_to_every_name() -> None:
    assert status(GUARD, ["lab-7.school.example:8080"], [], local_only=False) is None


def test_a_proxy_may_use_an_allowed_name() -> None:
    assert status(PROXIED, ["lab.example.org"], ["https://lab.example.org"]) is None
    assert status(PROXIED, ["127.0.0.1:8080"], ["https://lab.example.org"]) is None
    assert status(GUARD, ["lab.example.org"], []) == HTTPStatus.FORBIDDEN


@pytest.mark.parametrize(
    "hosts",
    [[], ["a", "b"], [""], ["localhost:port"], ["localhost:99999"], ["[::1"], ["user@localhost"], ["localhost/x"]],
)
def test_a_request_needs_one_valid_host(hosts: list[str]) -> None:
    assert status(GUARD, hosts, []) == HTTPStatus.BAD_REQUEST


@pytest.mark.parametrize(
    ("host", "origin"),
    [
        ("localhost:8080", "http://localhost:8080"),
        ("LocalHost:8080", "http://localhost:8080"),
        ("localhost", "http://localhost"),
        ("localhost:80", "http://localhost"),
        ("localhost", "https://localhost:443"),
        ("[::1]:8080", "http://[::1]:8080"),
    ],
)
def test_the_own_page_may_connect(host: str, origin: str) -> None:
    assert status(GUARD, [host], [origin]) is None


@pytest.mark.parametrize(
    "origin",
    [
        "http://evil.example",
        "http://localhost",
        "http://localhost:8081",
        "http://127.0.0.1:8080",
        "https://localhost",
        "null",
        "",
        "file://",
        "ws://localhost:8080",
        "http://localhost:8080@evil.example",
        "http://localhost:8080/x",
        "http://[",
    ],
)
def test_a_foreign_page_may_not(origin: str) -> None:
    assert status(GUARD, ["localhost:8080"], [origin]) == HTTPStatus.FORBIDDEN
    assert status(GUARD, ["localhost:8080"], [origin], local_only=False) == HTTPStatus.FORBIDDEN


def test_two_origins_are_one_too_many() -> None:
    assert status(GUARD, ["localhost"], ["http://localhost", "http://localhost"]) == HTTPStatus.FORBIDDEN


@given(st.text(), st.text())
def test_any_nonsense_in_the_headers_gets_an_answer(host: str, origin: str) -> None:
    GUARD.refusal([host], [origin], local_only=True)


@pytest.mark.parametrize(
    ("host", "local"),
    [("localhost", True), ("127.0.0.1", True), ("::1", True), ("0.0.0.0", False), ("::", False), ("lab", False)],
)
def test_loopback(host: str, local: bool) -> None:
    assert is_loopback(host) is local


def test_the_page_may_only_connect_to_its_own_server() -> None:
    policy = SECURITY_HEADERS["Content-Security-Policy"]
    directives = dict(part.strip().split(" ", 1) for part in policy.split(";"))
    assert directives["connect-src"] == "'self' data: blob:"
    assert directives["frame-ancestors"] == "'self'"
    assert "*" not in policy


def test_a_cookie_survives_the_round_trip() -> None:
    identity = new_browser_id()
    cookie = identity_cookie(identity)
    assert browser_id_in(cookie.split(";")[0]) == identity
    assert browser_id_in(f"theme=dark; deltalab_id={identity}; other=1") == identity
    assert {"HttpOnly", "SameSite=Lax", "Path=/"} <= set(cookie.split("; "))


@pytest.mark.parametrize(
    "cookies",
    ["", "deltalab_id=", "deltalab_id=short", f"deltalab_id={'a' * 25}", f"xdeltalab_id={'a' * 24}",
     f"deltalab_id={'ä' * 24}", f"deltalab_id={'a' * 20}<b>!", f'deltalab_id="{"a" * 24}"', "deltalab_id; a=b"],
)  # fmt: skip
def test_a_malformed_cookie_is_no_identity(cookies: str) -> None:
    assert browser_id_in(cookies) is None


@given(st.text())
def test_any_nonsense_is_a_cookie_without_identity(cookies: str) -> None:
    assert browser_id_in(cookies) is None


def test_identities_differ() -> None:
    assert len({new_browser_id() for _ in range(1000)}) == 1000


class Clock:
    now = 0.0

    def __call__(self) -> float:
        return self.now


def test_a_burst_is_free_and_then_the_rate_holds() -> None:
    clock = Clock()
    bucket = TokenBucket(rate=10.0, burst=5.0, clock=clock)
    assert [bucket.take() for _ in range(5)] == [0.0] * 5
    assert bucket.take() == pytest.approx(0.1)
    assert bucket.take() == pytest.approx(0.2)
    clock.now += 0.2
    assert bucket.take() == pytest.approx(0.1)


def test_a_rest_fills_the_bucket_only_to_the_brim() -> None:
    clock = Clock()
    bucket = TokenBucket(rate=10.0, burst=5.0, clock=clock)
    clock.now += 3600.0
    assert bucket.take(5.0) == 0.0
    assert bucket.take(0.5) == pytest.approx(0.05)


@given(st.lists(st.tuples(st.floats(0.0, 2.0), st.floats(0.1, 20.0)), max_size=60))
def test_who_waits_as_told_never_exceeds_the_rate(steps: list[tuple[float, float]]) -> None:
    clock = Clock()
    bucket = TokenBucket(rate=7.0, burst=11.0, clock=clock)
    taken = 0.0
    for rest, tokens in steps:
        clock.now += rest
        clock.now += bucket.take(tokens)
        taken += tokens
        assert taken <= 11.0 + 7.0 * clock.now + 1e-6


@pytest.mark.parametrize(("rate", "burst"), [(0.0, 1.0), (1.0, 0.0), (-1.0, 1.0)])
def test_a_bucket_without_rate_or_burst_is_refused(rate: float, burst: float) -> None:
    with pytest.raises(ValueError, match="positive rate and burst"):
        TokenBucket(rate, burst)
