"""Tests of Delta Lab; a package so that `tests.support` is always this one."""
