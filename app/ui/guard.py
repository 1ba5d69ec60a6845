"""Who may talk to the server, and how much: the policy that viser itself does not have.

Nothing here knows viser or websockets; `viser_adapter` applies it.
"""

from __future__ import annotations

import ipaddress
import re
import secrets
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from http import HTTPStatus
from urllib.parse import urlsplit

MIB = 1024 * 1024

SECURITY_HEADERS = {
    # The page is one HTML file with inline scripts, WebAssembly and a worker made from a blob. Everything is
    # allowed from the page itself; `connect-src` keeps `?websocket=` from attaching it to a foreign server.
    "Content-Security-Policy": (
        "default-src 'self' 'unsafe-inline' 'unsafe-eval' data: blob:; "
        "connect-src 'self' data: blob:; object-src 'none'; base-uri 'none'; frame-ancestors 'self'"
    ),
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
}

COOKIE = "deltalab_id"
_COOKIE_YEARS = 1
_ID_BYTES = 18
_COOKIE_PATTERN = re.compile(rf"(?:^|;)\s*{COOKIE}=([A-Za-z0-9_-]{{{_ID_BYTES * 4 // 3}}})\s*(?:;|$)")

_DEFAULT_PORTS = {"http": 80, "https": 443}


@dataclass(frozen=True, kw_only=True)
class Guard:
    """The limits that one server enforces."""

    allowed_hosts: Collection[str] = ()
    """Host names, besides this machine's own, under which people reach the server through a proxy."""
    max_connections: int = 256
    max_message_bytes: int = 2 * MIB
    """A browser's biggest message is half a mebibyte: a part of an upload."""
    frames_per_second: float = 240.0
    """A browser sends at most about 90: 20 of a gizmo, 50 of the camera, 20 of panels."""
    frame_burst: float = 480.0
    max_uploads: int = 4
    """Unfinished uploads of one page."""
    max_upload_bytes: int = 64 * MIB
    """For one file, and for all unfinished uploads of one page together."""
    max_upload_bytes_in_all: int = 256 * MIB
    """For the unfinished uploads of all pages together: they are held in memory."""

    def refusal(
        self, hosts: Sequence[str], origins: Sequence[str], *, local_only: bool
    ) -> tuple[HTTPStatus, str] | None:
        """Why a request with these Host and Origin headers is turned away, or None.

        `local_only` says that the server listens on the loopback interface. There, a foreign Host is DNS
        rebinding: a web site gave its own name this machine's address. A foreign Origin is another web site's
        script; programs send none.
        """
        host = _host_and_port(f"//{hosts[0]}") if len(hosts) == 1 else None
        if host is None:
            return HTTPStatus.BAD_REQUEST, "The request needs one valid Host header.\n"
        if local_only and not (is_loopback(host[0]) or host[0] in self.allowed_hosts):
            return HTTPStatus.FORBIDDEN, f"This server does not answer to the name {host[0]}.\n"
        if origins and not (len(origins) == 1 and self._is_own_origin(origins[0], hosts[0])):
            return HTTPStatus.FORBIDDEN, "Pages of other web sites may not connect here.\n"
        return None

    def _is_own_origin(self, origin: str, host: str) -> bool:
        """A proxy may rewrite the Host header, so an origin among `allowed_hosts` is ours as well."""
        scheme = origin.partition(":")[0]
        if scheme not in _DEFAULT_PORTS:
            return False
        claimed = _host_and_port(origin)
        return claimed is not None and (
            claimed == _host_and_port(f"{scheme}://{host}") or claimed[0] in self.allowed_hosts
        )


def is_loopback(host: str) -> bool:
    """Whether a host name or address can only mean this machine."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host == "localhost" or host.endswith(".localhost")


def _host_and_port(url: str) -> tuple[str, int | None] | None:
    """Lower-case host and port of a URL (the scheme's own port where it names none); None if malformed."""
    try:
        parts = urlsplit(url)
        port = parts.port or _DEFAULT_PORTS.get(parts.scheme)
    except ValueError:
        return None
    if not parts.hostname or parts.username is not None or parts.path or parts.query or parts.fragment:
        return None
    return parts.hostname, port


def new_browser_id() -> str:
    """An identity that cannot be guessed."""
    return secrets.token_urlsafe(_ID_BYTES)


def browser_id_in(cookies: str) -> str | None:
    """The identity in a Cookie header; None if there is none or it is malformed."""
    found = _COOKIE_PATTERN.search(cookies)
    return found and found[1]


def identity_cookie(browser_id: str) -> str:
    """Value of the Set-Cookie header that makes a browser known again after a reload."""
    lifetime = _COOKIE_YEARS * 365 * 24 * 3600
    return f"{COOKIE}={browser_id}; Max-Age={lifetime}; Path=/; HttpOnly; SameSite=Lax"
