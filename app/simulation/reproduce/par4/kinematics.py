"""The Par4 paper's section 3: equations, dimensions, operating space."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from app.robots.par4 import ARM_AZIMUTHS, Par4, Par4Geometry
from app.robots.robot import Array
from app.robots.workspace import boundary, grid
from app.simulation.reproduce.figure import Figure, Section
from app.simulation.reproduce.par4.equations import arm_angles, coefficients
from app.simulation.reproduce.par4.fit import fit

GEOMETRY = Par4Geometry()
AS_LABELLED = replace(GEOMETRY, L=GEOMETRY.l, l=GEOMETRY.L)
"""Table 1 with its labels taken at their word."""

SLIP_POSES = ("(0, -36, -300, 0)", "(100, -36, -300, 0)", "(0, -36, -400, 0.3)")
"""Where the slip in (18) is computed, mm and rad."""

BOX_LOW, BOX_HIGH = np.array([-0.170, -0.210, -0.510]), np.array([0.170, 0.140, -0.220])
"""The search box of section 3.3, m."""
STEP = 0.005
"""Of our search, m; the paper names none."""


def equations() -> list[Figure]:
    """Section 3.2: what (18) and (23) do as printed."""
    section = Section("3.2 Inverse kinematics")
    azimuths = ", ".join(f"{math.degrees(a):.0f}" for a in ARM_AZIMUTHS)
    by_12 = "By (12) it is a plus. The authors' program must have had it right: see Table 4."
    undefined = (
        "On this branch (23) is 0/0 where G = F, which happens inside the workspace. Ours is the same root as"
        " (G + F) / (sqrt(E^2 + F^2 - G^2) - E), which is never 0/0."
    )
    return [
        section.given("arms at alpha_1 .. alpha_4", "deg", azimuths),
        section.given("platform turns by +-", "deg", "45"),
        section.wrong("(18): sign of 2 L d_3 cos alpha_3", "", "minus", "plus", by_12),
        *(section.beyond(f"with -, q_3 grows at {pose}", "deg", _slip(pose)) for pose in SLIP_POSES),
        section.beyond("(23): workspace with G < F", "%", _share_below(), undefined),
    ]


def table_1() -> list[Figure]:
    """Dimensions."""
    section = Section("Table 1")
    swapped = (
        f"The labels of L and l are swapped. As printed, {np.count_nonzero(_reached(AS_LABELLED))} of the"
        f" {len(_searched())} points searched in 3.3 are in reach, and no P_iz helps: the elbows stay so far out that"
        f" the rods would have to be {1e3 * _shortest_rod(AS_LABELLED):.0f} mm or longer."
    )
    return [
        section.given("R, base", "mm", "185"),
        section.wrong("L, driven arm", "mm", "386", 1e3 * GEOMETRY.L, swapped),
        section.wrong("l, rod", "mm", "200", 1e3 * GEOMETRY.l, "See L."),
        section.given("d, platform bar", "mm", "102"),
        section.given("d_i, joint along the bar", "mm", "9"),
        section.given("h, platform link", "mm", "72"),
        section.given("h_i, joint across the bar", "mm", "24"),
        section.open("P_iz, joint above the tool point", "mm", 1e3 * GEOMETRY.P_z, _two_proofs()),
        section.open("B_iz, motor above O", "mm", 1e3 * GEOMETRY.B_z, "Chosen: P_iz - B_iz is all that counts."),
    ]


def _two_proofs() -> str:
    """A longer P_iz puts the workspace lower by as much, and changes the circle's arm angles."""
    (bottom, top), by_table_4 = _ends()[2], fit("P_z", 1e-4)
    P_z, box_bottom, box_top = 1e3 * GEOMETRY.P_z, 1e3 * BOX_LOW[2], 1e3 * BOX_HIGH[2]
    return (
        f"Found, twice: the box of 3.3 holds the workspace only from {P_z + top - box_top:.1f} to"
        f" {P_z + bottom - box_bottom:.1f} mm, and Table 4 asks for {1e3 * by_table_4.value:.3f} +-"
        f" {1e3 * by_table_4.either_way:.3f} mm."
    )


def operating_space() -> list[Figure]:
    """Section 3.3: the box that was searched beside the workspace, at theta = 0."""
    section, count = Section("3.3 Operating space"), np.count_nonzero(_reached(GEOMETRY))
    searched = (
        f"{count} of {len(_searched())} points {1e3 * STEP:.0f} mm apart; the paper prints no volume and no step."
    )
    return [
        *_box(section),
        section.given("arms turn by +-", "deg", "45"),
        section.given("theta", "deg", "0"),
        section.beyond("volume", "litre", 1e3 * count * STEP**3, searched),
    ]


def _box(section: Section) -> list[Figure]:
    """Ours is the smallest box around the workspace with sides at whole centimetres."""
    ends = _ends()
    ours = np.stack([np.floor(ends[:, 0] / 10.0), np.ceil(ends[:, 1] / 10.0)], axis=1) * 10.0
    printed = (1e3 * np.stack([BOX_LOW, BOX_HIGH], axis=1)).round().astype(int)
    figures = []
    for name, (low, high), (first, last), (left, right) in zip("xyz", printed, ours, ends, strict=True):
        itself = f"The workspace itself: {left:.0f} .. {right:.0f} mm; ours is rounded outward to 10 mm."
        figures.append(section.compared(f"{name}, lowest", "mm", str(low), first))
        figures.append(section.compared(f"{name}, highest", "mm", str(high), last, itself))
    return figures


@cache
def _ends() -> Array:
    """(3, 2) lowest and highest x, y and z of the workspace, mm."""
    vertices = 1e3 * boundary(Par4(GEOMETRY), rings=240, segments=48).vertices
    return np.stack([vertices.min(axis=0), vertices.max(axis=0)], axis=1)


@cache
def _searched() -> Array:
    """(k, 4) poses of our search."""
    return grid(BOX_LOW, BOX_HIGH, STEP, rotation=0.0)


def _reached(geometry: Par4Geometry) -> NDArray[np.bool_]:
    """(k,) which of them every arm reaches within its limits."""
    angles = arm_angles(_searched(), geometry)
    return np.all((angles >= geometry.q_min) & (angles <= geometry.q_max), axis=-1)


def _shortest_rod(geometry: Par4Geometry) -> float:
    """Below this, m, no pose is in reach: elbows are R + L cos(q_max) or more from the axis, and of the joints of two
    opposite arms one is at most as far out as both are in the middle, whatever x, y, z and theta."""
    middle = (geometry.d / 2 + geometry.d_i + geometry.h / 2 + geometry.h_i) / math.sqrt(2.0)
    return geometry.R + geometry.L * math.cos(geometry.q_max) - middle


def _slip(text: str) -> float:
    """How much (18) as printed adds to q_3 at a pose, deg."""
    x, y, z, theta = (float(word) for word in text.strip("()").split(","))
    pose = np.array([x / 1e3, y / 1e3, z / 1e3, theta])
    printed, right = (arm_angles(pose, GEOMETRY, printed_f3=slip)[2] for slip in (True, False))
    return math.degrees(printed - right)


def _share_below() -> float:
    """Per cent of the arms at reached poses with G < F."""
    _, F, G = coefficients(_searched()[_reached(GEOMETRY)], GEOMETRY)
    return 100.0 * float(np.mean(G < F))
