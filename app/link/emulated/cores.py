"""Which core an emulated board runs."""

from __future__ import annotations

import functools
from typing import Literal

from app.link.emulated.compiled import CompiledCore
from app.link.emulated.core import Core
from app.link.emulated.twin.core import TwinCore
from app.link.firmware.build import find_compiler

CoreKind = Literal["compiled", "twin"]


def make_core(kind: CoreKind | None = None) -> Core:
    """The firmware's own core where this computer has a C compiler, else its twin in Python."""
    return CompiledCore() if (kind or _usual()) == "compiled" else TwinCore()


@functools.cache
def _usual() -> CoreKind:
    return "compiled" if find_compiler() else "twin"
