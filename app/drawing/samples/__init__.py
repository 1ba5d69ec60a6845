"""Pictures to try the modes with, all free to ship and to draw."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from app.drawing.errors import DrawingError

_FOLDER = Path(__file__).parent

OWN_CREDIT = "Made for Delta Lab, CC0"
FROM_SCIKIT_IMAGE = "from the data of scikit-image"


@dataclass(frozen=True)
class Sample:
    """A picture in this folder."""

    title: str
    file: str
    mode_hint: str
    """The drawing mode that shows it best."""
    credit: str
    """Who made it, and the licence."""


SAMPLES: dict[str, Sample] = {
    "robot": Sample("Delta robot", "robot.png", "centreline", OWN_CREDIT),
    "mandala": Sample("Mandala", "mandala.png", "centreline", OWN_CREDIT),
    "logo": Sample("Logo", "logo.png", "outline", OWN_CREDIT),
    "bicycle": Sample("Bicycle (SVG)", "bicycle.svg", "auto", OWN_CREDIT),
    "cat": Sample("Cat", "cat.jpg", "sketch", f"Stéfan van der Walt, CC0, {FROM_SCIKIT_IMAGE}"),
    "astronaut": Sample(
        "Astronaut", "astronaut.jpg", "portrait", f"NASA (Eileen Collins), public domain, {FROM_SCIKIT_IMAGE}"
    ),
    "coffee": Sample("Coffee", "coffee.jpg", "squiggle", f"Rachel Michetti, CC0, {FROM_SCIKIT_IMAGE}"),
    "camera": Sample("Cameraman", "camera.jpg", "hatch", f"Lav Varshney, CC0, {FROM_SCIKIT_IMAGE}"),
}
"""Name -> picture; line drawings first."""


def sample_bytes(name: str) -> bytes:
    """The file of one of `SAMPLES`, as if it had been uploaded."""
    if name not in SAMPLES:
        raise DrawingError(f"There is no sample called {name}; choose one of {', '.join(SAMPLES)}.")
    return (_FOLDER / SAMPLES[name].file).read_bytes()
