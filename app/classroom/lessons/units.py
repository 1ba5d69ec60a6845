"""How units are spelled; a misspelled one is a mistake in a lesson."""

from __future__ import annotations

from app.classroom.lessons.catalogue import FACTS

_FURTHER = """
deg, deg/s, deg/s^2, deg/mm, deg/V, deg/(V s^2), rad, rad/s, rad/s^2, mm, cm, m, mm^2, mm/s, m/s, mm/s^2, m/s^2,
mm/deg, mm/V, mm/(V s^2), s, ms, us, min, 1/s, 1/s^2, Hz, kHz, kg, g, kg m^2, dm^2, l, N,
mN, N m, N mm, N/mm, J, W, V, A, V/deg, V/mm, %, dB, bytes, bits, baud
"""
"""Of answers, beside those of facts."""

UNITS = frozenset(
    {unit for kind in FACTS.values() for unit in kind.units if unit} | {unit.strip() for unit in _FURTHER.split(",")}
)
