"""G-code for lasers, run by small controllers written here: what is lit, how brightly, and that travels are dark.

GRBL 1.1 in laser mode lights `M4` on G1 only, and not at rest; outside that mode S alone decides, on G0 as well.
Marlin's `M3 S` lights at once and until `M5`, moving or not; both wait for the moves before them.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.drawing.errors import DrawingError
from app.drawing.exports import write_gcode
from tests.support.sheet_strokes import assert_same, drawings

ROUNDING_MM = 0.00051
SQUARE = np.array([(0.0, 0.0), (30.0, 0.0), (30.0, 40.0), (0.0, 40.0), (0.0, 0.0)])
AWAY = np.array([(0.0, 100.0), (60.0, 100.0)])
DOT = np.array([(5.0, 5.0), (5.0, 5.0)])


@dataclass
class Engraver:
    """Follows a file and notes every move with the power that it is lit with."""

    laser_mode: bool = True
    place: tuple[float, float] = (0.0, 0.0)
    mode: str = "M5"
    power: float = 0.0
    moves: list[tuple[str, tuple[float, float], tuple[float, float], float]] = field(default_factory=list)
    lit_at_rest: list[float] = field(default_factory=list)

    def run(self, text: str) -> Engraver:
        for line in text.splitlines():
            code = line.partition(";")[0]
            words = re.findall(r"([A-Z])(-?\d+(?:\.\d+)?)", code)
            assert "".join(map("".join, words)) == code.replace(" ", "")
            if words:
                self.obey("".join(words[0]), {letter: float(number) for letter, number in words[1:]})
        return self

    def obey(self, command: str, values: dict[str, float]) -> None:
        assert "Z" not in values, "a laser is not lifted"
        self.power = values.get("S", self.power)
        if command in ("M3", "M4", "M5"):
            self.mode = command
        elif command in ("G0", "G1"):
            there = (values["X"], values["Y"])
            self.moves.append((command, self.place, there, self.brightness(command)))
            self.place = there
        else:
            assert command in ("G21", "G90", "M2", "M400"), command

    def brightness(self, command: str) -> float:
        raise NotImplementedError

    def strokes(self) -> list[np.ndarray]:
        """Runs of lit moves."""
        found: list[list[tuple[float, float]]] = []
        was_lit = False
        for _, start, stop, lit in self.moves:
            if lit and not was_lit:
                found.append([start])
            if lit:
                found[-1].append(stop)
            was_lit = lit > 0.0
        return [np.array(stroke) for stroke in found]


class Grbl(Engraver):
    def brightness(self, command: str) -> float:
        assert self.mode != "M3", "a power that does not follow the speed"
        lit = self.mode == "M4" and (command == "G1" or not self.laser_mode)
        return self.power / 1000.0 if lit else 0.0


class Marlin(Engraver):
    def obey(self, command: str, values: dict[str, float]) -> None:
        assert "S" not in values or command == "M3"
        super().obey(command, values)
        if command == "M3":
            self.lit_at_rest.append(self.power)

    def brightness(self, command: str) -> float:
        assert self.mode != "M4"
        return self.power / 255.0 if self.mode == "M3" else 0.0


MACHINES = {"grbl": Grbl, "marlin": Marlin}


@pytest.mark.parametrize("laser_mode", [True, False])
@pytest.mark.parametrize("flavour", MACHINES)
@given(drawing=drawings, power=st.floats(0.01, 1.0))
def test_the_strokes_are_burnt_and_every_travel_is_dark(flavour, laser_mode, drawing, power):
    """Under GRBL even where nobody has switched its laser mode on."""
    if not any((stroke != stroke[0]).any() for stroke in drawing):
        drawing = [*drawing, SQUARE]
    machine = MACHINES[flavour](laser_mode).run(write_gcode(drawing, flavour=flavour, pen="laser", power=power))
    assert all((lit == 0.0) == (command == "G0") for command, _, _, lit in machine.moves)
    assert_same(machine.strokes(), drawing, ROUNDING_MM)
    assert all(lit == pytest.approx(power, abs=0.0021) for _, _, _, lit in machine.moves if lit)
    assert machine.mode == "M5" and machine.place == (0.0, 0.0)


@pytest.mark.parametrize("flavour", MACHINES)
def test_it_is_off_before_the_first_move_and_before_the_last(flavour):
    lines = write_gcode([SQUARE, AWAY], flavour=flavour, pen="laser").splitlines()
    code = [line for line in lines if not line.startswith(";")]
    first = next(number for number, line in enumerate(code) if line.startswith("G0"))
    assert "M5" in code[:first] or "M4 S0" in code[:first]
    assert code[-1] == ("M2" if flavour == "grbl" else "M400")
    off = len(code) - 1 - code[::-1].index("M5")
    assert not any(line.split()[0] in ("G1", "M3", "M4") for line in code[off:])


def test_marlin_is_lit_once_a_stroke_and_grbl_never_at_rest():
    assert Marlin().run(write_gcode([SQUARE, AWAY, DOT], flavour="marlin", pen="laser")).lit_at_rest == [128.0] * 3
    text = write_gcode([SQUARE, AWAY], pen="laser")
    assert [line for line in text.splitlines() if line[0] == "M"] == ["M4 S0", "M5", "M2"]


@pytest.mark.parametrize(
    ("flavour", "needs"),
    [("grbl", ["$32=1", "$30=1000", "S350 of 1000"]), ("marlin", ["LASER_FEATURE", "PWM255", "S89 of 255"])],
)
def test_the_header_says_what_the_controller_must_be_set_to(flavour, needs):
    text = write_gcode([SQUARE, DOT], flavour=flavour, pen="laser", power=0.35, draw_mm_s=20.0, travel_mm_s=100.0)
    header = "\n".join(line for line in text.splitlines() if line.startswith(";"))
    assert all(need in header for need in [*needs, "power 35 %", "time: at least 7 s"])
    assert ("1 dots will not be marked" in header) == (flavour == "grbl")


@pytest.mark.parametrize("flavour", MACHINES)
@pytest.mark.parametrize("pen", ["z", "servo"])
def test_a_pen_knows_nothing_of_lasers(flavour, pen):
    text = write_gcode([SQUARE], flavour=flavour, pen=pen, power=0.9)
    assert text == write_gcode([SQUARE], flavour=flavour, pen=pen) and "laser" not in text


@pytest.mark.parametrize("power", [0.0, -0.5, 1.01, np.nan])
def test_a_power_that_is_none_is_refused(power):
    with pytest.raises(DrawingError, match="above 0 and at most 1"):
        write_gcode([SQUARE], pen="laser", power=power)


def test_nothing_but_dots_is_refused_where_a_laser_would_leave_no_mark():
    with pytest.raises(DrawingError, match="leaves no mark where it rests"):
        write_gcode([DOT, DOT + 3.0], pen="laser")
    assert "M3 S128" in write_gcode([DOT], flavour="marlin", pen="laser")
