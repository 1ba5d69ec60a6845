"""How the materials of the machines look."""

from __future__ import annotations

from typing import NamedTuple


class Material(NamedTuple):
    """Surface of a part, as glTF describes it."""

    color: tuple[int, int, int]
    """sRGB, 0 to 255."""
    metallic: float
    roughness: float


MATERIALS: dict[str, Material] = {
    "aluminium": Material((214, 217, 221), 0.85, 0.42),
    "steel": Material((128, 133, 140), 0.95, 0.28),
    "carbon": Material((38, 40, 44), 0.25, 0.5),
    "housing": Material((58, 64, 73), 0.1, 0.6),
    "motor": Material((34, 37, 42), 0.4, 0.45),
    "rubber": Material((28, 28, 30), 0.0, 0.95),
    "accent": Material((240, 240, 236), 0.0, 0.55),
    "ink": Material((98, 72, 160), 0.0, 0.5),
}
"""Every material but the legs', which have one colour a leg."""
