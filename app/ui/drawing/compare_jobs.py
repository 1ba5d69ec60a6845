"""What worker processes do for the tab Compare: plain functions of plain data. Nothing here may import viser."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from app.drawing.compare import ArmComparison, RobotResult, SweepPoint, arm_behind, compare_with_arm, draw_on
from app.drawing.compare import sweep_point as measure
from app.drawing.compare.paths import rose, zigzag
from app.drawing.compose import Look
from app.drawing.errors import DrawingError
from app.drawing.source import Source
from app.drawing.toolpath import default_pen
from app.robots import build_robot
from app.ui.drawing.jobs import Setup
from app.ui.refusal import Refusal

Array = NDArray[np.float64]

THIS, ZIGZAG, ROSE = "This drawing", "Zigzag rows", "A rose"
ARM_PATHS = (THIS, ZIGZAG, ROSE)


def sweep_point(source: Source, look: Look, setup: Setup, parameter: str, value: float) -> SweepPoint:
    """The drawing with one setting changed."""
    robot = build_robot(setup.robot, setup.dimensions)
    return measure(source, look, robot, setup.placement, setup.pen, parameter, value)


def on_robot(strokes: list[Array], name: str, setup: Setup) -> RobotResult:
    """The same strokes on another robot, lifted as suits it."""
    dimensions = setup.dimensions if name == setup.robot else {}
    pen = replace(setup.pen, lift_mm=default_pen(build_robot(name, dimensions)).lift_mm)
    return draw_on(strokes, name, pen, dimensions)


def against_arm(
    strokes: list[Array],
    path: str,
    sheet_mm: tuple[float, float],
    links_m: tuple[float, float],
    share: float,
    setup: Setup,
) -> ArmComparison | Refusal:
    """The robot against a serial arm on one of `ARM_PATHS`."""
    try:
        if path == ZIGZAG:
            strokes = zigzag(sheet_mm)
        elif path == ROSE:
            strokes = rose(min(sheet_mm) / 2.0 - 10.0)
        robot = build_robot(setup.robot, setup.dimensions)
        return compare_with_arm(strokes, arm_behind(*links_m, share), robot=robot, placement=setup.placement)
    except DrawingError as error:
        return Refusal(str(error))
