"""Compiles the Uno's firmware and its simulator once for each state of their sources."""

from __future__ import annotations

import functools
from pathlib import Path

from tests.support.emulators.cache import kept, run
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
    sources = [*HERE.glob("unosim.*"), HERE / "Makefile"]
    return kept("simavr", sources, lambda folder: run(["make", "-C", str(HERE), f"BUILD={folder}"])) / "libunosim.so"


@functools.cache
def firmware(variant: str) -> Path:
    """The firmware of a variant, with its symbols."""
    sketch, product = FIRMWARE / "deltalab", f"uno_{variant}"
    sources = [*sketch.rglob("*.[ch]"), sketch / "deltalab.ino", FIRMWARE / "uno.mk"]
    make = ["make", "-C", str(FIRMWARE), "-f", "uno.mk", "uno", f"VARIANT={variant}"]
    return kept(product, sources, lambda folder: run([*make, f"BUILD={folder}"])) / f"{product}.elf"
