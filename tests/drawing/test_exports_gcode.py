"""G-code, run by a small controller written here: where it draws, how fast, and that it never does so lifted."""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.drawing.exports import write_gcode
from tests.support.sheet_strokes import Stroke, assert_same, drawings

ROUNDING_MM = 0.00051
KINDS = [(flavour, pen) for flavour in ("grbl", "marlin") for pen in ("z", "servo")]
SQUARE = np.array([(0.0, 0.0), (30.0, 0.0), (30.0, 40.0), (0.0, 40.0), (0.0, 0.0)])
AWAY = np.array([(0.0, 100.0), (60.0, 100.0)])
PEN_DOWN = {("M3", 1000.0): True, ("M5", None): False, ("M280", 90.0): True, ("M280", 0.0): False}
WAITS = {"grbl": 0.15, "marlin": 150.0}
"""What P of G4 counts: seconds, or milliseconds."""


@dataclass
class Plotter:
    """Keeps the modes and the position as a controller does; fails on what no plotter should be told."""

    flavour: str
    pen: str
    place: tuple[float, float] = (0.0, 0.0)
    z: float | None = None
    down: bool | None = None
    modes: set[str] = field(default_factory=set)
    feed: float = 0.0
    ended: bool = False
    strokes: list[list[tuple[float, float]]] = field(default_factory=list)
    feeds: set[tuple[str, bool, float]] = field(default_factory=set)

    def run(self, text: str) -> list[Stroke]:
        for line in text.splitlines():
            words = re.findall(r"([A-Z])(-?\d+(?:\.\d+)?)", code := line.partition(";")[0].strip())
            assert "".join(letter + number for letter, number in words) == code.replace(" ", "")
            if words:
                assert not self.ended
                self.obey("".join(words[0]), {letter: float(number) for letter, number in words[1:]})
        return [np.array(stroke) for stroke in self.strokes]

    def obey(self, command: str, values: dict[str, float]) -> None:
        if command in ("G0", "G1"):
            assert self.modes == {"G21", "G90"}, "millimetres and absolute places come first"
            self.feed = values.pop("F", self.feed)
            self.move(command, values)
        elif command in ("G21", "G90"):
            self.modes.add(command)
        elif command == "G4":
            assert values == {"P": WAITS[self.flavour]} and self.pen == "servo"
        elif command in ("M2", "M400"):
            assert command == "M400" or self.flavour == "grbl"
            self.ended = command == "M2"
        else:
            assert self.pen == "servo" and (command == "M280") == (self.flavour == "marlin")
            self.tip(PEN_DOWN[command, values.get("S")])

    def move(self, command: str, values: dict[str, float]) -> None:
        if "Z" in values:
            assert self.pen == "z" and set(values) == {"Z"}, "the pen goes up and down on the spot"
            self.z = values["Z"]
            self.tip(self.z <= 0.0)
            return
        assert set(values) == {"X", "Y"} and self.down is not None, "lift before the first move"
        assert self.down == (command == "G1"), "drawn moves by G1 with the pen down, all others by G0 with it up"
        self.place = values["X"], values["Y"]
        self.feeds.add((command, self.down, self.feed))
        if self.down:
            self.strokes[-1].append(self.place)

    def tip(self, down: bool) -> None:
        if down and not self.down:
            self.strokes.append([self.place])
        self.down = down


@pytest.mark.parametrize(("flavour", "pen"), KINDS)
@given(drawing=drawings)
def test_a_plotter_draws_the_strokes_and_nothing_else(flavour, pen, drawing):
    plotter = Plotter(flavour, pen)
    drawn = plotter.run(write_gcode(drawing, flavour=flavour, pen=pen))
    assert_same(drawn, drawing, ROUNDING_MM)
    assert plotter.down is False and plotter.place == (0.0, 0.0)
    assert plotter.ended == (flavour == "grbl")


@pytest.mark.parametrize(("flavour", "pen"), KINDS)
@given(draw=st.integers(1, 200), travel=st.integers(1, 500), lift=st.integers(1, 20))
def test_speeds_and_lift(flavour, pen, draw, travel, lift):
    plotter = Plotter(flavour, pen)
    options = {"draw_mm_s": draw, "travel_mm_s": travel, "lift_mm": lift}
    plotter.run(write_gcode([SQUARE, AWAY], flavour=flavour, pen=pen, **options))
    assert plotter.feeds == {("G0", False, 60.0 * travel), ("G1", True, 60.0 * draw)}
    assert plotter.z == (lift if pen == "z" else None)


@pytest.mark.parametrize(("pen", "seconds"), [("z", 200 / 20 + 320 / 100 + 2 * (5 / 20 + 5 / 100)), ("servo", 13.8)])
def test_the_header_says_what_is_coming(pen, seconds):
    """From 0, 0 around the square of 140 mm and back there, 100 mm up, 60 mm drawn, home over the hypotenuse."""
    hypotenuse = np.hypot(60.0, 100.0)
    text = write_gcode([SQUARE, AWAY], pen=pen, draw_mm_s=20.0, travel_mm_s=100.0, lift_mm=5.0)
    header = [line for line in text.splitlines() if line.startswith(";")]
    assert "; bounds: X 0.0 to 60.0, Y 0.0 to 100.0" in header
    assert f"; strokes: 2, pen down 200 mm, pen up {100 + hypotenuse:.0f} mm" in header
    seconds += (100 + hypotenuse - 320) / 100
    assert any(line.startswith(f"; time: at least {seconds:.0f} s") for line in header)


@pytest.mark.parametrize(
    ("drawing", "options", "complaint"),
    [
        ([], {}, "nothing to draw"),
        ([SQUARE], {"flavour": "fanuc"}, "for grbl or marlin"),
        ([SQUARE], {"pen": "feather"}, "pen on z or servo or a laser"),
        ([SQUARE], {"draw_mm_s": 0.0}, "above zero"),
        ([SQUARE], {"travel_mm_s": -1.0}, "above zero"),
        ([SQUARE], {"lift_mm": np.nan}, "above zero"),
        ([np.array([(np.nan, 0.0), (0.0, 0.0)])], {}, "Stroke 1 has a point"),
    ],
)
def test_refusals(drawing, options, complaint):
    with pytest.raises(DrawingError, match=complaint):
        write_gcode(drawing, **options)
