"""The thesis' section 6: mobility, dimensions, and three tables of positions."""

from __future__ import annotations

from app.robots.linear import LinearDelta, LinearGeometry
from app.simulation.reproduce.figure import Figure, Section
from app.simulation.reproduce.linear.equations import platform

Row = tuple[str, str, str]

GEOMETRY = LinearGeometry()

CARRIAGES_CM: tuple[tuple[float, float, float], ...] = (
    (0.0, 0.0, 0.0),
    (6.0, 0.0, 6.0),
    (30.0, 33.5, 30.0),
    (33.0, 33.0, 35.0),
    (17.0, 32.0, 24.0),
    (35.0, 35.0, 39.0),
)
"""L1, L2, L3 of Tables 2 and 3."""

TABLE_2: tuple[Row, ...] = (
    ("0", "0", "-31.6"),
    ("5", "-3.5", "-34"),
    ("-2", "0.4", "-61"),
    ("0", "-2", "-63"),
    ("-11", "-2", "-51.5"),
    ("0", "-5", "-64"),
)
TABLE_3: tuple[Row, ...] = (
    ("0", "0.006731", "-31.64"),
    ("6", "-3.472", "-34.65"),
    ("-3.36", "1.946", "-62"),
    ("0", "-2.225", "-64.46"),
    ("-13.2", "-0.5", "-52.3"),
    ("0", "-3.981", "-64.22"),
)
TABLE_4: tuple[Row, ...] = (
    ("-0.04455", "-0.04455", "-0.03874"),
    ("4.5", "-0.4286", "5.08"),
    ("28.55", "30.55", "29.2"),
    ("30.85", "30.85", "32.6"),
    ("16", "27.7", "23.16"),
    ("31.33", "31.33", "35.82"),
)

SLIP = (
    "A sign in its program: with -t_y for t_y in the linear coefficient of the quadratic every row comes out, see the "
    "next section. So FK(IK(P)) is not P there. Row 1 hides it: t_y is almost 0."
)


def mobility() -> list[Figure]:
    """(1) to (3)."""
    section = Section("6 Mobility, (1) to (3)")
    links = 6 + 3 + 1 + 1
    by_gruebler = 6 * (links - 15 - 1) + 2 * 12 + 3
    return [
        section.wrong("(1): sign before the sum", "", "missing", "plus", "Gruebler: M = 6 (n - j - 1) + sum of f_i."),
        section.given("universal joints", "", "12"),
        section.given("prismatic joints", "", "3"),
        section.wrong("links", "", "14", float(links), "6 rods, 3 carriages, the platform and the base."),
        section.wrong(
            "(2): M", "", "15", float(by_gruebler),
            "From (1) with 11 links. The robot moves all the same: its parallelograms are over-constrained, and "
            "Gruebler cannot see that. (As printed, 6 (14 - 15 - 1) + 27 is 15.)",
        ),
        section.wrong("(3): links, each pair as one", "", "11", 8.0, "3 rods, 3 carriages, the platform, the base."),
        section.wrong("(3): joints, each pair as one", "", "12", 9.0, "6 universal and 3 prismatic ones."),
        section.compared("(3): M", "", "3", float(6 * (8 - 9 - 1) + 2 * 6 + 3)),
    ]  # fmt: skip


def table_1() -> list[Figure]:
    """Dimensions."""
    section, g = Section("Table 1"), GEOMETRY
    up = (
        "The text lets z point down to the platform; the tables have it up, with negative z and d >= 0 downward. The "
        "legs' order follows from the tables."
    )
    return [
        section.given("s_a, w_a, u_a, outer triangle", "mm", "700, 202, 404", "Not used by the kinematics."),
        section.given("H, frame height", "mm", "870"),
        section.given("S_A", "mm", "485", computed=1e3 * g.S_A),
        section.given("W_A", "mm", "140", computed=1e3 * g.W_A),
        section.given("U_A", "mm", "280", computed=1e3 * g.U_A),
        section.given("s_p", "mm", "170", computed=1e3 * g.s_p),
        section.given("w_p", "mm", "49", computed=1e3 * g.w_p),
        section.given("u_b", "mm", "98", computed=1e3 * g.u_b),
        section.given("L_min", "mm", "70", computed=1e3 * g.L_min),
        section.given("L_max", "mm", "580", computed=1e3 * g.L_max),
        section.given("l, rod", "mm", "365", computed=1e3 * g.l),
        section.wrong("6.1: z axis of the frame", "", "down", "up", up),
    ]


def table_2() -> list[Figure]:
    """What was measured on the hardware, beside the kinematics."""
    section = Section("Table 2 (measured)")
    return [
        section.given(_name(k, axis), "cm", printed, computed=ours)
        for k, (row, position) in enumerate(zip(TABLE_2, _positions(slip=False), strict=True))
        for axis, printed, ours in zip("xyz", row, position, strict=True)
    ]


def table_3() -> list[Figure]:
    """Forward kinematics as printed beside the right one."""
    section = Section("Table 3")
    figures = []
    for k, (row, position) in enumerate(zip(TABLE_3, _positions(slip=False), strict=True)):
        for axis, printed, ours in zip("xyz", row, position, strict=True):
            compared = section.compared(_name(k, axis), "cm", printed, ours)
            right = compared.verdict == "reproduced"
            note = SLIP if not any(f.verdict == "paper wrong" for f in figures) else "The same sign."
            figures.append(compared if right else section.wrong(_name(k, axis), "cm", printed, ours, note))
    return figures


def table_3_with_its_slip() -> list[Figure]:
    """The same with the wrong sign: the thesis' own numbers, digit for digit."""
    section = Section("Table 3, with the sign that its program must have had")
    return [
        section.compared(_name(k, axis), "cm", printed, ours)
        for k, (row, position) in enumerate(zip(TABLE_3, _positions(slip=True), strict=True))
        for axis, printed, ours in zip("xyz", row, position, strict=True)
        if k > 0
    ]


def table_4() -> list[Figure]:
    """Inverse kinematics at the measured positions."""
    section, robot = Section("Table 4"), LinearDelta(GEOMETRY)
    figures = []
    for k, (pose, row) in enumerate(zip(TABLE_2, TABLE_4, strict=True)):
        joints = robot.solve(*(float(value) / 100.0 for value in pose))
        for leg, (printed, d) in enumerate(zip(row, joints, strict=True), 1):
            figures.append(section.compared(f"row {k + 1}, L{leg}", "cm", printed, 100.0 * d))
    return figures


def _positions(slip: bool) -> list[tuple[float, ...]]:
    """(x, y, z) of each row of Tables 2 and 3, cm."""
    rows = []
    for d1, d2, d3 in CARRIAGES_CM:
        position = platform((d1 / 100.0, d2 / 100.0, d3 / 100.0), GEOMETRY, slip)
        rows.append(tuple(round(100.0 * value, 9) + 0.0 for value in position))
    return rows


def _name(row: int, axis: str) -> str:
    return f"row {row + 1}, {axis}"
