"""The STM32's firmware, and its drivers for the desktop, compiled once and kept by a hash of their sources."""

from __future__ import annotations

import functools
import hashlib
import os
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

from tests.support.imports import ROOT
from tests.support.tools import needs

FIRMWARE = ROOT / "app" / "link" / "firmware"
HERE = Path(__file__).parent
CORE = FIRMWARE / "deltalab" / "src" / "core"
VARIANTS = ("par4_dc", "fivebar_dc", "linear_stepper")
DRIVERS = "stm32-drivers.so"
needs_drivers = needs("gcc")
"""For tests of the drivers on a desktop."""
needs_stm32 = needs("make", "arm-none-eabi-gcc", "qemu-system-arm")
"""For tests that emulate an STM32."""


def firmware(variant: str = "par4_dc") -> Path:
    """The ELF file, with symbols, of one of the variants."""
    return _kept("stm32", _make) / f"stm32_{variant}.elf"


def driver_library() -> Path:
    """The drivers as a shared library; the processor's registers are an array in it."""
    return _kept("drivers", _compile_drivers) / DRIVERS


def symbol(elf: Path, name: str) -> int:
    """Where the linker put something."""
    table = subprocess.run(["arm-none-eabi-nm", elf], check=True, capture_output=True, text=True).stdout
    return next(int(line.split()[0], 16) for line in table.splitlines() if line.split()[-1] == name)


def _make(folder: Path) -> None:
    for variant in VARIANTS:
        _run(["make", "-C", str(FIRMWARE), "stm32", f"BUILD={folder}", f"VARIANT={variant}"])


def _compile_drivers(folder: Path) -> None:
    apart = {"main.c", "startup.c"}
    sources = [path for path in sorted((FIRMWARE / "stm32").glob("*.c")) if path.name not in apart]
    flags = ["-std=gnu99", "-O1", "-fPIC", "-shared", "-Wall", "-Wextra", "-Werror", "-DDL_HOST_REGISTERS"]
    include = [f"-I{CORE}", f"-I{FIRMWARE / 'stm32'}"]
    files = [*sources, *sorted(CORE.glob("*.c")), HERE / "registers.c"]
    _run(["gcc", *flags, *include, *map(str, files), "-lm", "-o", str(folder / DRIVERS)])


def _run(command: list[str]) -> None:
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, f"{' '.join(command)}\n{done.stdout}{done.stderr}"


def _kept(name: str, build: Callable[[Path], None]) -> Path:
    """A folder that was filled before from the same sources, or is now; other workers may do so at the same time."""
    cache = Path(tempfile.gettempdir()) / f"deltalab-stm32-{os.getuid()}"
    kept = cache / f"{name}-{_fingerprint()}"
    if not kept.exists():
        cache.mkdir(mode=0o700, exist_ok=True)
        fresh = Path(tempfile.mkdtemp(dir=cache))
        build(fresh)
        try:
            fresh.rename(kept)
        except OSError:  # another worker was first
            shutil.rmtree(fresh)
    return kept


@functools.cache
def _fingerprint() -> str:
    folders = [FIRMWARE / "stm32", CORE]
    sources = [path for folder in folders for path in folder.iterdir() if path.suffix in (".c", ".h", ".ld")]
    sources += [FIRMWARE / "stm32.mk", HERE / "registers.c"]
    digest = hashlib.sha256()
    for path in sorted(sources):
        digest.update(str(path.name).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()[:16]
