"""The firmware's core as a shared library of this computer, compiled when first asked for."""

from __future__ import annotations

import functools
import hashlib
import os
import platform
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from app.link.errors import LinkError

FIRMWARE = Path(__file__).parent
CORE = FIRMWARE / "deltalab/src/core"

_FLAGS = ("-std=c99", "-O2", "-fPIC", "-shared")
_COMPILERS = ("cc", "gcc", "clang")


def find_compiler() -> str | None:
    """A C compiler that takes gcc's options; what the environment calls CC comes first."""
    return next(filter(None, map(shutil.which, filter(None, (os.environ.get("CC"), *_COMPILERS)))), None)


def host_sources() -> list[Path]:
    """What the library is compiled from."""
    return [FIRMWARE / "host/host.c", *sorted(CORE.glob("*.c"))]


@functools.cache
def build_host_library() -> Path:
    """The library for these sources, made once for a user. Safe for processes that ask at the same time.

    Raises:
        LinkError: if there is no compiler, or it cannot compile this.
    """
    compiler = find_compiler()
    if compiler is None:
        raise LinkError("The firmware's core needs a C compiler; install gcc or clang, or use the Python twin.")
    folder = _cache_folder()
    library = folder / f"core-{_fingerprint(compiler)}.{_suffix()}"
    if not library.exists():
        folder.mkdir(parents=True, exist_ok=True)
        _compile(compiler, library)
    return library


def _compile(compiler: str, library: Path) -> None:
    """Into another file first, so that nobody loads half of it."""
    with tempfile.TemporaryDirectory(dir=library.parent) as folder:
        half = Path(folder) / library.name
        command = [compiler, *_FLAGS, *map(str, host_sources()), "-lm", "-o", str(half)]
        result = subprocess.run(command, capture_output=True, text=True)
        if result.returncode:
            reason = next(iter(result.stderr.strip().splitlines()), f"{compiler} ended with {result.returncode}")
            raise LinkError(f"The firmware's core does not compile: {reason}; use the Python twin.")
        os.replace(half, library)


def _fingerprint(compiler: str) -> str:
    """Changes with every source, header, option, compiler and kind of computer."""
    digest = hashlib.sha256(repr((compiler, _FLAGS, sys.platform, platform.machine())).encode())
    for source in [*host_sources(), *sorted(CORE.glob("*.h"))]:
        digest.update(source.name.encode() + b"\0" + source.read_bytes())
    return digest.hexdigest()[:20]


def _suffix() -> str:
    return {"win32": "dll", "darwin": "dylib"}.get(sys.platform, "so")


def _cache_folder() -> Path:
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData/Local")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "deltalab" / "firmware"
