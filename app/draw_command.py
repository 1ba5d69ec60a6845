"""`deltalab draw`: pictures become files that a plotter or a robot draws, without a browser."""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from app.errors import UserMistake

SHEETS_MM = {"A6": (105.0, 148.0), "A5": (148.0, 210.0), "A4": (210.0, 297.0)}
"""Upright."""


@dataclass(frozen=True)
class Draw:
    """Turn pictures into drawings: SVG, G-code, CSV, DXF, the paper's Ptos_Dibujo.txt, or a PNG preview."""

    images: tyro.conf.Positional[tuple[Path, ...]]
    """Picture files: JPG, PNG and other common formats."""
    output: Annotated[Path, tyro.conf.arg(aliases=["-o"])] = Path("drawing.svg")
    """File to write, or for several pictures a folder and a suffix, say out/.gcode."""
    mode: str = "auto"
    """How to draw: auto, sketch, canny, centreline, outline, paper, squiggle, hatch, streamlines, spiral, one_line,
    threshold_rows, stipple or portrait."""
    sheet: str = "160x160"
    """A6, A5, A4, or width x height in millimetres."""
    landscape: bool = False
    """Turn the sheet."""
    robot: str = "delta3"
    """Robot that is to draw it; its reach and its joints decide the time."""
    settings: Annotated[tuple[str, ...], tyro.conf.arg(name="set", metavar="NAME=VALUE"), tyro.conf.UseAppendAction] = (
        field(default_factory=tuple)
    )
    """A setting of the mode or of the pen, say gamma=0.8 or speed_mm_s=60. May be given several times."""


def draw(command: Draw) -> None:
    """Draw every picture; a bad one does not keep the others from being drawn."""
    from app.drawing import DrawingError
    from app.drawing.exports import EXPORTS

    suffix = command.output.suffix or (command.output.name if command.output.name.startswith(".") else "")
    if suffix not in EXPORTS:
        raise UserMistake(f"Cannot write {command.output.name}: choose a file ending in {', '.join(EXPORTS)}.")
    if not command.images:
        raise UserMistake("Name at least one picture to draw, say deltalab draw photo.jpg -o photo.svg.")
    sheet, settings = sheet_mm(command.sheet, command.landscape), read_settings(command.settings)
    refusals = []
    for path in command.images:
        try:
            print(draw_one(path, target(command, path, suffix), suffix, command, sheet, settings), flush=True)
        except DrawingError as error:
            refusals.append(f"{path.name}: {error}")
        except OSError as error:
            refusals.append(f"{error.filename or path}: {(error.strerror or 'cannot be used').lower()}.")
    if refusals:
        raise UserMistake("\n".join(refusals))


def draw_one(
    path: Path, output: Path, suffix: str, command: Draw, sheet: tuple[float, float], settings: dict[str, object]
) -> str:
    """Draw one picture and write it; returns the summary line."""
    from rich.console import Console

    from app.drawing import draw_image
    from app.drawing.exports import EXPORTS

    with Console(file=sys.stderr).status(f"Drawing {path.name} …"):
        drawing = draw_image(path.read_bytes(), command.mode, sheet, command.robot, **settings)
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_bytes(EXPORTS[suffix].write(drawing.strokes, sheet))
    notes = "".join(f" {note}" for note in drawing.notes)
    return (
        f"{output}: {drawing.mode}, {len(drawing.strokes)} strokes, {drawing.ink_mm / 1e3:.2f} m of ink, "
        f"{drawing.pen_up_mm / 1e3:.2f} m with the pen up, {drawing.lifts} lifts, {drawing.time_s:.0f} s on "
        f"{command.robot}.{notes}"
    )


def target(command: Draw, path: Path, suffix: str) -> Path:
    """Where a picture's drawing goes: the output itself, or for several pictures a file named after each."""
    if len(command.images) == 1 and not command.output.name.startswith("."):
        return command.output
    return command.output.parent / (path.stem + suffix)


def sheet_mm(text: str, landscape: bool) -> tuple[float, float]:
    """Width and height of a sheet by name or by its sides."""
    size = SHEETS_MM.get(text.upper())
    if size is None:
        sides = re.fullmatch(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)", text.strip().lower())
        if sides is None or not all(1.0 <= float(side) <= 2000.0 for side in sides.groups()):
            raise UserMistake(f"There is no sheet {text!r}: choose A6, A5, A4, or sides in mm such as 160x120.")
        size = (float(sides[1]), float(sides[2]))
    return (size[1], size[0]) if landscape else size


def read_settings(pairs: tuple[str, ...]) -> dict[str, object]:
    """`name=value` pairs; values are numbers, yes or no, or words."""
    settings: dict[str, object] = {}
    for pair in pairs:
        name, equals, value = pair.partition("=")
        if not (equals and name.strip() and value.strip()):
            raise UserMistake(f"A setting is written name=value, not {pair!r}.")
        settings[name.strip()] = _value(value.strip())
    return settings


def _value(text: str) -> object:
    if text.lower() in ("yes", "true", "no", "false"):
        return text.lower() in ("yes", "true")
    try:
        return int(text)
    except ValueError:
        pass
    try:
        return float(text)
    except ValueError:
        return text
