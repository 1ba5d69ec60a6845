"""Emulated microcontrollers: test tools, never part of the package."""
