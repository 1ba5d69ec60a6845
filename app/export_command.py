"""`deltalab export`: a robot as a file that MuJoCo's viewer opens."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated

import tyro

from app.errors import UserMistake


@dataclass(frozen=True)
class Export:
    """Write a robot with its masses and its shapes as an MJCF model for MuJoCo."""

    robot: Annotated[tyro.conf.Positional[str], tyro.conf.arg(metavar="ROBOT")]
    """Its name: par4, delta3, linear or fivebar."""
    output: Annotated[Path, tyro.conf.arg(aliases=["-o"])] = Path("robot.xml")
    """File to write, ending in .xml; its meshes go into a folder beside it."""
    dimensions: Annotated[
        tuple[str, ...], tyro.conf.arg(name="set", metavar="NAME=VALUE"), tyro.conf.UseAppendAction
    ] = field(default_factory=tuple)
    """A changed dimension in metres or radians, say l=0.42. May be given several times."""


def export(command: Export) -> None:
    """Build the robot and write it."""
    from app.robots import GeometryError, build_robot
    from app.simulation.prototype import export as write

    if command.output.suffix != ".xml":
        raise UserMistake(f"Cannot write {command.output.name}: choose a file ending in .xml.")
    dimensions = read_dimensions(command.dimensions)
    try:
        written = write(build_robot(command.robot, dimensions), command.output)
    except GeometryError as error:
        raise UserMistake(str(error)) from error
    except OSError as error:
        reason = (error.strerror or "it cannot be used").lower()
        raise UserMistake(f"Cannot write {error.filename or command.output}: {reason}.") from error
    model, meshes = written
    print(f"{model}: open it with python -m mujoco.viewer --mjcf={model}; its shapes are in {meshes}.")


def read_dimensions(pairs: tuple[str, ...]) -> dict[str, float]:
    """`name=value` pairs as numbers."""
    dimensions = {}
    for pair in pairs:
        name, _, value = pair.partition("=")
        try:
            dimensions[name.strip()] = float(value)
        except ValueError:
            raise UserMistake(f"A dimension is written name=number, say l=0.42, not {pair!r}.") from None
    return dimensions
