"""Compiles the Uno's firmware and its simulator once for each state of their sources."""

from __future__ import annotations

import functools
import hashlib
import os
import subprocess
import tempfile
from collections.abc import Iterable
from pathlib import Path

from tests.support.imports import ROOT
from tests.support.tools import needs

HERE = Path(__file__).parent
FIRMWARE = ROOT / "app" / "link" / "firmware"
VARIANTS = ("delta3_servo", "delta3_dc", "linear_stepper")
needs_uno = needs("gcc", "make", "avr-gcc", "simavr/sim_avr.h")
"""For tests that emulate an Uno."""


@functools.cache
def simulator() -> Path:
    """The shared library around simavr."""
    sources = sorted(HERE.glob("unosim.*")) + [HERE / "Makefile"]
    return _built("libunosim.so", sources, ["make", "-C", str(HERE)])


@functools.cache
def firmware(variant: str) -> Path:
    """The firmware of a variant, with its symbols."""
    sketch = FIRMWARE / "deltalab"
    sources = [*sorted(sketch.rglob("*.[ch]")), sketch / "deltalab.ino", FIRMWARE / "uno.mk"]
    make = ["make", "-C", str(FIRMWARE), "-f", "uno.mk", "uno", f"VARIANT={variant}"]
    return _built(f"uno_{variant}.elf", sources, make)


def _built(product: str, sources: Iterable[Path], make: list[str]) -> Path:
    """Made in a folder of its own that is then renamed: workers may build at the same time, none sees half a file."""
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    cache = Path(tempfile.gettempdir()) / f"deltalab-uno-{os.getuid()}"
    done = cache / f"{product}-{digest}"
    if not done.exists():
        cache.mkdir(mode=0o700, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(dir=cache))
        made = subprocess.run([*make, f"BUILD={fresh}"], capture_output=True, text=True, check=False)
        if made.returncode:
            raise RuntimeError(f"{product} does not compile:\n{made.stderr[-4000:]}")
        try:
            fresh.rename(done)
        except OSError:  # another worker was first
            if not done.exists():
                raise
    return done / product
