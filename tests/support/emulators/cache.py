"""What the tests compile, made once for each state of its sources and kept between runs."""

from __future__ import annotations

import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path


def kept(name: str, sources: Iterable[Path], build: Callable[[Path], None]) -> Path:
    """A folder that `build` filled before from the same sources, or fills now. It is filled under another name and
    then renamed: workers may build at the same time, none sees half of it."""
    cache = Path(tempfile.gettempdir()) / f"deltalab-firmware-{os.getuid()}"
    folder = cache / f"{name}-{_fingerprint(sources)}"
    if not folder.exists():
        cache.mkdir(mode=0o700, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(dir=cache))
        build(fresh)
        try:
            fresh.rename(folder)
        except OSError:  # another worker was first
            if not folder.exists():
                raise
            shutil.rmtree(fresh)
    return folder


def run(command: Sequence[str]) -> None:
    """A compiler; what it says is the reason of the failure."""
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"


def _fingerprint(sources: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(sources):
        digest.update(path.name.encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
