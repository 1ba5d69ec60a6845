"""Sums, products and functions of numbers; angles in degrees. Their author says which unit comes out."""

from __future__ import annotations

import math

from app.classroom.lessons.formulas.registry import ANY_UNIT, formula


@formula("sum", ANY_UNIT)
def total(of: list[float]) -> float:
    """Of all numbers in `of`."""
    return math.fsum(of)


@formula("difference", ANY_UNIT)
def difference(a: float, b: float) -> float:
    """a - b."""
    return a - b


@formula("product", ANY_UNIT)
def product(of: list[float]) -> float:
    """Of all numbers in `of`."""
    return math.prod(of)


@formula("ratio", ANY_UNIT)
def ratio(a: float, b: float) -> float:
    """a / b."""
    return a / b


@formula("percent", "%")
def percent(a: float, b: float) -> float:
    """100 a / b."""
    return 100.0 * a / b


@formula("negative", ANY_UNIT)
def negative(of: float) -> float:
    """The number with its sign changed."""
    return -of


@formula("absolute", ANY_UNIT)
def absolute(of: float) -> float:
    """The number without its sign."""
    return abs(of)


@formula("smallest", ANY_UNIT)
def smallest(of: list[float]) -> float:
    """The lowest of the numbers in `of`."""
    return min(of)


@formula("largest", ANY_UNIT)
def largest(of: list[float]) -> float:
    """The highest of the numbers in `of`."""
    return max(of)


@formula("power", ANY_UNIT)
def power(of: float, to: float) -> float:
    """`of` to the power `to`."""
    return math.pow(of, to)


@formula("root", ANY_UNIT)
def root(of: float) -> float:
    """The square root."""
    return math.sqrt(of)


@formula("length", ANY_UNIT)
def length(of: list[float]) -> float:
    """Of the vector with these components."""
    return math.hypot(*of)


@formula("distance", ANY_UNIT)
def distance(a: list[float], b: list[float]) -> float:
    """Straight, between two points."""
    return math.dist(a, b)


@formula("sin")
def sine(of: float) -> float:
    """Of an angle in degrees."""
    return math.sin(math.radians(of))


@formula("cos")
def cosine(of: float) -> float:
    """Of an angle in degrees."""
    return math.cos(math.radians(of))


@formula("tan")
def tangent(of: float) -> float:
    """Of an angle in degrees."""
    return math.tan(math.radians(of))


@formula("atan2", "deg")
def angle(y: float, x: float) -> float:
    """Direction of (x, y), from -180 to 180 degrees."""
    return math.degrees(math.atan2(y, x))


@formula("round", ANY_UNIT)
def rounded(of: float, digits: int = 0) -> float:
    """To so many digits after the point."""
    return round(of, digits) + 0.0


@formula("round_up", ANY_UNIT)
def rounded_up(of: float, step: float = 1.0) -> float:
    """The next multiple of `step`, upwards."""
    return math.ceil(of / step - 1e-9) * step
