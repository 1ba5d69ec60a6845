"""MuJoCo itself, imported when a model is first run: the page starts without it.

Its compiled modules declare no types, so whatever comes from it is `Any` to a type checker.
"""

from __future__ import annotations

import functools
import logging
from typing import Any

Model = Any
"""mujoco.MjModel"""
Data = Any
"""mujoco.MjData"""


@functools.cache
def mujoco() -> Any:
    """The library. Its warnings go to the log; by itself it writes them into a file where the program was started."""
    import mujoco as module

    library: Any = module
    library.set_mju_user_warning(logging.getLogger(__name__).warning)
    return library
