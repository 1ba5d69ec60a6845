"""A calibration for people, and for the board."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import NamedTuple

from app.link.board_geometry import geometry_values
from app.link.calibration.identifiability import unseparated
from app.link.calibration.problem import FRAME, KINEMATIC
from app.link.calibration.solve import CONFIDENCE, Solution
from app.link.errors import LinkError
from app.link.protocol.settings import GEOMETRY_ID, setting_id
from app.link.twin.tables import write_comments
from app.robots import ROBOTS
from app.simulation.run import SHOWN

UNUSUAL = 3.5
"""Tolerances away from what was assumed."""
TOO_GOOD = 0.9999


class Row(NamedTuple):
    """One unknown, in mm or degrees."""

    name: str
    assumed: float
    found: float
    half_width: float
    """Of the 95 % interval."""
    shrinkage: float
    """Uncertainty after by before: 1 for what the measurements do not show."""
    unit: str


def rows(solution: Solution) -> list[Row]:
    """The table of a calibration."""
    problem, table = solution.problem, []
    half_widths = CONFIDENCE * solution.deviations
    numbers = zip(problem.unknowns, solution.values, half_widths, solution.shrinkage, strict=True)
    for unknown, value, half, shrinkage in numbers:
        unit, factor = SHOWN[unknown.unit]
        assumed, found = factor * unknown.assumed, factor * float(value)
        table.append(Row(unknown.name, assumed, found, factor * float(half), float(shrinkage), unit))
    return table


def sentences(solution: Solution) -> list[str]:
    """What to know before using a calibration, the most important first."""
    said = []
    if solution.outliers:
        many = len(solution.outliers) > 1
        subject = (
            f"{'Rows' if many else 'Row'} {', '.join(map(str, solution.outliers))} {'do' if many else 'does'} not fit"
        )
        advice = " and had no weight" if solution.robust else ": measure again, or leave out"
        said.append(f"{subject} to the others{advice}.")
    if math.isnan(solution.chance):
        said.append("There are too few rows to check the fit: measure more poses than are needed.")
    elif not solution.trusted:
        said.append(
            f"The measurements do not fit to one machine: {1e3 * solution.tool_rms_m:.2g} mm are left where "
            f"{1e3 * solution.problem.noise_m:.2g} mm were expected; check rows, units and what is looked for."
        )
    elif solution.chance > TOO_GOOD:
        said.append("The fit is better than the given accuracy: state a smaller one, and the intervals get narrower.")
    said += [group.sentence for group in unseparated(solution.problem, solution.information)]
    for unknown, value in zip(solution.problem.unknowns, solution.values, strict=True):
        away = abs(float(value) - unknown.assumed) / unknown.tolerance
        if away > UNUSUAL:
            said.append(f"{unknown.name} is {away:.0f} tolerances away from what was assumed: check it with a ruler.")
    return said


def csv(solution: Solution) -> str:
    """The table, what it rests on, and what was left over."""
    notes = {"robot": solution.problem.robot, "rows": str(len(solution.data.lines))}
    notes |= {"left over (mm)": f"{1e3 * solution.tool_rms_m:.4g}", "trusted": "yes" if solution.trusted else "no"}
    notes |= {f"note {number}": sentence for number, sentence in enumerate(sentences(solution), 1)}
    lines = [",".join([*Row._fields])]
    for row in rows(solution):
        numbers = (f"{value:.8g}" for value in (row.assumed, row.found, row.half_width, row.shrinkage))
        lines.append(",".join([row.name, *numbers, row.unit]))
    return write_comments(notes) + "\n".join([*lines, ""])


def board_settings(solution: Solution, present: Mapping[int, float]) -> dict[int, float]:
    """What to send to the board (id -> value): new offsets of the joints, and the geometry where it was looked for.

    `present` are the board's settings as they are. The measuring frame stays with the ruler.

    Raises:
        LinkError: for a solution that is not to be trusted, or where the present offsets are not known.
    """
    if not solution.trusted:
        raise LinkError("This calibration is not to be trusted yet; see what it says, and measure again.")
    problem, values = solution.problem, solution.values
    changed = {}
    if problem.places("offset"):
        for joint, offset in enumerate(problem.offsets(values).tolist()):
            number = setting_id("offset", joint)
            if number not in present:
                raise LinkError("The board's offsets are not known yet; read its settings first.")
            changed[number] = present[number] + offset
    if problem.places("dimension"):
        changed |= {GEOMETRY_ID + k: value for k, value in enumerate(geometry_values(problem.build(values)))}
    return changed


def choices(robot: str) -> dict[str, str]:
    """Name -> label of everything that can be looked for beside the offsets."""
    known = ROBOTS[robot].geometry.dimensions()
    labels = {name: f"{known[name].label} ({name})" for name in KINEMATIC[robot]}
    return labels | {name: f"Measuring {name}" for name, _ in FRAME}
