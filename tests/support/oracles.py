"""Other people's software to test against, without its types: python-control's are too narrow to be of use."""

from __future__ import annotations

from importlib import import_module
from typing import Any

control: Any = import_module("control")
signal: Any = import_module("scipy.signal")
