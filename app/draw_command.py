"""`deltalab draw`: pictures become files that a plotter or a robot draws, without a browser."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from app.errors import UserMistake

OPTIONS = frozenset({"image_bytes", "mode", "sheet_mm", "robot", "placement", "on_stage", "margin_mm"})
"""Arguments of `draw_image` that are no settings here."""


@dataclass(frozen=True)
class Draw:
    """Turn pictures into drawings: SVG, G-code, CSV, DXF, the paper's Ptos_Dibujo.txt, or a PNG preview."""

    images: tyro.conf.Positional[tuple[Path, ...]]
    """Picture files: JPG, PNG and other common formats; or SVG, whose strokes are drawn as they are."""
    output: Annotated[Path, tyro.conf.arg(aliases=["-o"])] = Path("drawing.svg")
    """File to write, or for several pictures a folder and a suffix, say out/.gcode."""
    mode: str = "auto"
    """How to draw: auto, sketch, canny, centreline, outline, paper, squiggle, hatch, streamlines, spiral, one_line,
    threshold_rows, stipple or portrait."""
    sheet: str = "160x160"
    """A6, A5, A4, A3, or width x height in millimetres."""
    landscape: bool = False
    """Turn the sheet."""
    margin: float = 0.0
    """Millimetres of the sheet that stay free on every side."""
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
    outputs = targets(command, suffix)
    refusals = []
    for path, output in zip(command.images, outputs, strict=True):
        try:
            print(draw_one(path, output, suffix, command, sheet, settings), flush=True)
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
    from app.drawing import draw_image
    from app.drawing.exports import EXPORTS
    from app.drawing.pipeline import MODES

    with progress_of(path.name) as on_stage:
        drawing = draw_image(
            path.read_bytes(),
            command.mode,
            sheet,
            command.robot,
            on_stage=on_stage,
            margin_mm=command.margin,
            **settings,
        )
        on_stage("file")
        output.parent.mkdir(parents=True, exist_ok=True)
        output.write_bytes(EXPORTS[suffix].write(drawing.strokes, sheet))
    notes = "".join(f" {note}" for note in drawing.notes)
    mode = f"{drawing.mode}, " if drawing.mode in MODES else ""
    return (
        f"{output}: {mode}{len(drawing.strokes)} strokes, {drawing.ink_mm / 1e3:.2f} m of ink, "
        f"{drawing.pen_up_mm / 1e3:.2f} m with the pen up, {drawing.lifts} lifts, {drawing.time_s:.0f} s on "
        f"{command.robot}.{notes}"
    )


@contextmanager
def progress_of(name: str) -> Iterator[Callable[[str], None]]:
    """A bar on the error output while a picture is drawn, if that is a terminal; gives what moves it to a stage."""
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    from app.drawing.pipeline import STAGES

    console = Console(stderr=True)
    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as progress:
        stages = (*STAGES, "file")
        task = progress.add_task(name, total=len(stages))
        yield lambda stage: progress.update(task, completed=stages.index(stage), description=f"{name}: {stage}")


def targets(command: Draw, suffix: str) -> list[Path]:
    """Where each picture's drawing goes: the output itself, or for several pictures a file named after each."""
    if len(command.images) == 1 and not command.output.name.startswith("."):
        return [command.output]
    found: dict[Path, Path] = {}
    for image in command.images:
        output = command.output.parent / (image.stem + suffix)
        if output in found:
            raise UserMistake(f"{found[output].name} and {image.name} would both become {output}: rename one of them.")
        found[output] = image
    return list(found)


def sheet_mm(text: str, landscape: bool) -> tuple[float, float]:
    """Width and height of a sheet by name or by its sides."""
    from app.drawing.toolpath.placement import SHEETS

    size = next(((sheet.width_mm, sheet.height_mm) for sheet in SHEETS if sheet.name == text.strip().upper()), None)
    if size is None:
        sides = re.fullmatch(r"(\d+(?:\.\d+)?)x(\d+(?:\.\d+)?)", text.strip().lower())
        if sides is None or not all(1.0 <= float(side) <= 2000.0 for side in sides.groups()):
            names = ", ".join(sorted(sheet.name for sheet in SHEETS))
            raise UserMistake(f"There is no sheet {text!r}: choose {names}, or sides in mm such as 160x120.")
        size = (float(sides[1]), float(sides[2]))
    return (size[1], size[0]) if landscape else size


def read_settings(pairs: tuple[str, ...]) -> dict[str, object]:
    """`name=value` pairs; values are numbers, yes or no, or words."""
    settings: dict[str, object] = {}
    for pair in pairs:
        name, equals, value = pair.partition("=")
        if not (equals and name.strip() and value.strip()):
            raise UserMistake(f"A setting is written name=value, not {pair!r}.")
        if name.strip() in OPTIONS:
            raise UserMistake(f"{name.strip()} is no setting; see the options of deltalab draw --help.")
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
