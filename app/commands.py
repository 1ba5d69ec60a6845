"""The commands behind `deltalab`, their options, and how a command line is read."""

from __future__ import annotations

import contextlib
import io
import re
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import tyro

from app import __version__, export_command, firmware_command, lessons_command, link_command
from app.draw_command import Draw, draw
from app.errors import UserMistake
from app.resources import data_root
from app.ui.options import ServeOptions

Command = TypeVar("Command")


@dataclass(frozen=True)
class Meshes:
    """Make the robots' parts (GLB files) again from their geometry."""

    directory: Path = data_root() / "meshes"
    """Folder to write to."""


@dataclass(frozen=True)
class Reproduce:
    """Compare every number of the papers with ours."""

    paper: str = "all"
    """Whose numbers: par4, or all."""
    json: bool = False
    """Print an array of objects for other programs instead of the table."""


def serve(options: ServeOptions) -> None:
    from app.ui.server import serve as serve_page

    serve_page(options)


def build_meshes(command: Meshes) -> None:
    from app.robots.parts.library import build_all

    try:
        for path in build_all(command.directory):
            print(path)
    except OSError as error:
        raise UserMistake(f"Cannot write meshes to {command.directory}: {error.strerror}.") from error


def reproduce(command: Reproduce) -> None:
    from app.simulation.reproduce import PAPERS
    from app.simulation.reproduce.report import as_json, print_table

    if command.paper not in (*PAPERS, "all"):
        raise UserMistake(f"There is no paper {command.paper!r}: choose {', '.join(PAPERS)} or all.")
    papers = PAPERS if command.paper == "all" else {command.paper: PAPERS[command.paper]}
    if command.json:
        print(as_json(papers))
    else:
        print_table(papers)


COMMANDS: dict[str, tuple[type, Callable[..., None]]] = {
    "draw": (Draw, draw),
    "export": (export_command.Export, export_command.export),
    "firmware build": (firmware_command.Build, firmware_command.build),
    "firmware upload": (firmware_command.Upload, firmware_command.upload),
    "lessons check": (lessons_command.Check, lessons_command.check),
    "lessons facts": (lessons_command.Facts, lessons_command.facts),
    "lessons new": (lessons_command.New, lessons_command.new),
    "link info": (link_command.Info, link_command.info),
    "link jog": (link_command.JogOnce, link_command.jog),
    "link monitor": (link_command.Monitor, link_command.monitor),
    "link ports": (link_command.Ports, link_command.ports),
    "meshes": (Meshes, build_meshes),
    "reproduce": (Reproduce, reproduce),
}
"""Name of a command, of one word or two -> its options and what carries it out. Without a name, the page is served."""


WIDTH = max(map(len, COMMANDS))


def run(arguments: list[str]) -> None:
    """Find the command, read its options and carry it out."""
    first = arguments[0] if arguments else ""
    name = next((name for name in (" ".join(arguments[:2]), first) if name in COMMANDS), None)
    if name is not None:
        options, execute = COMMANDS[name]
        execute(parse(options, f"deltalab {name}", arguments[len(name.split()) :]))
    elif first == "--version":
        print(f"deltalab {__version__}")
    elif first and not first.startswith("-"):
        choose_another(first, arguments[1:])
    else:
        serve(parse(ServeOptions, "deltalab", arguments, description=overview()))


def choose_another(first: str, others: list[str]) -> None:
    """Help for the first word of some commands; anything else is no command."""
    seconds = [name.split()[1] for name in COMMANDS if name.startswith(f"{first} ")]
    if seconds and others[:1] in (["--help"], ["-h"]):
        print("\n".join(summary(first)))
    elif seconds:
        raise UserMistake(f"Say what deltalab {first} is to do: {', '.join(seconds)}.")
    else:
        words = dict.fromkeys(name.split()[0] for name in COMMANDS)
        raise UserMistake(f"There is no command {first!r}: choose {', '.join(words)}, or none to serve the page.")


def overview() -> str:
    """What `deltalab --help` says above its options."""
    lines = [*summary(), f"  deltalab {'--version':<{WIDTH}} Print the version."]
    return "\n".join([ServeOptions.__doc__ or "", "", "Other commands (each has its own --help):", *lines])


def summary(first: str = "") -> list[str]:
    """A line for each command that begins with a word."""
    chosen = [(name, options) for name, (options, _) in COMMANDS.items() if name.startswith(first)]
    return [f"  deltalab {name:<{WIDTH}} {options.__doc__}" for name, options in chosen]


def parse(options: type[Command], prog: str, arguments: list[str], description: str | None = None) -> Command:
    """Read options with tyro; its boxed, many-line error becomes a `UserMistake` of one sentence."""
    errors = io.StringIO()
    try:
        with contextlib.redirect_stderr(errors):
            return tyro.cli(options, prog=prog, args=arguments, description=description)
    except SystemExit as leaving:
        if not leaving.code:
            raise
        raise UserMistake(condense(errors.getvalue(), prog)) from None


def condense(box: str, prog: str) -> str:
    """One sentence from the first paragraph of tyro's error box, and its guess at what was meant."""
    plain = re.sub(r"\x1b\[[0-9;]*m", "", box)
    rows = "\n".join(row.strip(" │") for row in plain.splitlines())
    _title, *paragraphs = re.split(r"^(?:[╭╰].*|[─-]{3,})$", rows, flags=re.MULTILINE)
    reason, *others = [" ".join(paragraph.split()) for paragraph in paragraphs] or [""]
    reason = re.sub(r"\. (\w)", lambda match: ", " + match[1].lower(), reason.rstrip("."))
    guess = re.search(r"Perhaps you meant: (--[\w-]+)", " ".join(others))
    advice = f"did you mean {guess[1]}?" if guess else f"see {prog} --help"
    return f"{reason[:1].upper()}{reason[1:] or 'This command line cannot be read'} ({advice})."
