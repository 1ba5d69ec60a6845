"""The papers' numbers: every one that is called reproduced rounds to its printed digits."""

from __future__ import annotations

import json
import math
from collections import Counter
from dataclasses import replace
from decimal import ROUND_HALF_DOWN, ROUND_HALF_UP, Decimal
from functools import cache
from typing import Any

import numpy as np
import pytest

from app.cli import main
from app.robots import make_robot
from app.robots.par4 import Par4Geometry
from app.simulation.reproduce import PAPERS, Figure, Section
from app.simulation.reproduce.par4.equations import arm_angles
from app.simulation.reproduce.par4.fit import fit
from app.simulation.reproduce.report import STYLES, SUMMED_UP, cells, summary
from tests.support.imports import ROOT


@cache
def figures_of(paper: str) -> tuple[Figure, ...]:
    return tuple(PAPERS[paper].figures())


@cache
def figures() -> tuple[Figure, ...]:
    return tuple(figure for paper in PAPERS for figure in figures_of(paper))


def of(section: str, verdict: str = "reproduced", paper: str = "par4") -> dict[str, Figure]:
    chosen = [figure for figure in figures_of(paper) if (figure.section, figure.verdict) == (section, verdict)]
    return {figure.name: figure for figure in chosen}


def rounded(value: float, decimals: int, rounding: str) -> Decimal:
    """After 12 digits, beyond which a binary fraction is no longer what was meant."""
    return Decimal(f"{value:.12f}").quantize(Decimal(1).scaleb(-decimals), rounding)


def test_what_is_called_reproduced_rounds_to_the_printed_digits() -> None:
    """A value half-way between two may have been rounded either way: only (25)'s T_1 is."""
    halfway = []
    for figure in figures():
        if figure.verdict != "reproduced" or figure.value is None:  # a claim in words
            continue
        assert isinstance(figure.computed, float) and figure.decimals is not None
        either = [rounded(figure.computed, figure.decimals, way) for way in (ROUND_HALF_UP, ROUND_HALF_DOWN)]
        assert Decimal(figure.printed) in either, figure
        if either[0] != either[1]:
            halfway.append(figure.name)
    assert halfway == ["(25): T_1"]


def test_what_fails_to_be_reproduced_is_known() -> None:
    """Two claims of the 5R paper depend on a friction that it does not print (fivebar spec, B4 and B7)."""
    missed = [figure for figure in figures() if figure.verdict == "not reproduced"]
    assert [figure.name for figure in missed] == ["RMS y: least with model", "axes 1 and 2 saturate"]
    assert all(figure.note for figure in missed)


def test_the_thesis_tables() -> None:
    """Table 4 to its last digit; Table 3 only with the wrong sign, which row 1 hides (linear spec, A2)."""
    assert len(of("Table 4", paper="linear")) == 18
    wrong = of("Table 3", "paper wrong", "linear")
    assert {name.split(",")[0] for name in wrong} == {"row 2", "row 3", "row 4", "row 5", "row 6"}
    golden = json.loads((ROOT / "tests/golden/linear_delta_fk.json").read_text())["thesis_rows"]
    with_slip = of("Table 3, with the sign that its program must have had", paper="linear")
    assert len(with_slip) == 15
    for k, row in enumerate(golden):
        for axis, right, slip in zip("xyz", row["fk_correct_cm"], row["fk_thesis_bug_reproduced_cm"], strict=True):
            name = f"row {k + 1}, {axis}"
            ours = {**of("Table 3", paper="linear"), **wrong}[name].computed
            assert ours == pytest.approx(right, abs=1e-9), name
            assert k == 0 or with_slip[name].computed == pytest.approx(slip, abs=1e-9), name
    assert of("Table 2 (measured)", "input", "linear")["row 6, z"].difference == pytest.approx(-3.6, abs=0.01)


def test_the_thesis_ranking() -> None:
    claims = of("Table 5", paper="linear")
    assert set(claims) == {"after the start, x and y", "PD leaves a steady error"}
    beyond = of("Table 5", "beyond the paper", "linear")
    assert beyond["e_y over the whole run"].computed == "CTC < PD < PID"
    assert beyond["e_z from home, PD, PID, CTC"].computed == "6.8, 6.9, 6.3"
    printed = of("Table 5", "cannot tell", "linear")
    assert len(printed) == 9
    for axis, tolerance in (("y", 0.02), ("z", 0.01)):  # of CTC, the only row whose law is known
        figure = printed[f"CTC, e_{axis}"]
        assert figure.computed == pytest.approx(float(figure.printed), rel=tolerance)


def test_the_5r_paper_s_claims() -> None:
    assert set(of("2.3 Work cycle", paper="fivebar")) == {"duration", "peak speed", "peak acceleration"}
    assert len(of("3 Errors (Figure 13), as the text tells them", paper="fivebar")) == 4
    assert len(of("3 Torques (Figures 14 to 20), as the text tells them", paper="fivebar")) == 4


@pytest.mark.parametrize(
    ("section", "printed"),
    [
        ("Table 3", ["52.5561", "0.2445", "20.9963", "2.2880", "0.3178", "0.1222"]),
        ("Table 4", ["91.45", "124", "126", "88.85", "234.8", "305.4", "307.9", "231.7"]),
        ("3.3 Operating space", ["-170", "170", "-210", "140", "-510", "-220"]),
        ("4.3 Identification", ["9.414", "3.586", "0.179"]),
        ("Table 2", ["0.99919"]),
    ],
)
def test_the_tables_are_there(section: str, printed: list[str]) -> None:
    assert [figure.printed for figure in of(section).values()] == printed


def test_slips_in_print() -> None:
    wrong = of("Table 1", "paper wrong")
    assert [(figure.printed, figure.computed) for figure in wrong.values()] == [("386", 200.0), ("200", 386.0)]
    assert "0 of the 289041 points" in wrong["L, driven arm"].note
    by_18 = of("Table 4", "beyond the paper").values()
    assert [figure.computed for figure in by_18] == pytest.approx([152.6, 361.8], abs=0.05)
    turns = [figure.computed for figure in of("3.2 Inverse kinematics", "beyond the paper").values()]
    assert turns[:3] == pytest.approx([3.1, 2.2, 1.9], abs=0.05)


def test_what_was_left_open_is_found() -> None:
    for figure, value, tolerance in (
        (of("Table 1", "left open")["P_iz, joint above the tool point"], 64.5, 1e-9),
        (of("Table 2", "left open")["phase margin"], 73.0, 1e-3),
        (of("Table 2", "left open")["crossover"], 10.226, 1e-3),
        (of("Table 3", "left open")["end of the recorded step"], 144.80, 0.01),
    ):
        assert figure.computed == pytest.approx(value, abs=tolerance), figure.name


def test_table_4_asks_for_what_was_found() -> None:
    for found, ours in ((fit("P_z", 1e-4), 0.0645), (fit("u_max", 1.0), 100.0), (fit("lap_s", 1.0), 100.0)):
        assert abs(found.value - ours) <= found.either_way
        assert found.either_way < 0.002 * ours


def test_without_the_first_step_the_ranking_reverses() -> None:
    sums = of("Table 4 without its initial step, sum of the drives", "beyond the paper")
    auto, approx = (
        [f.computed for name, f in sums.items() if name.startswith(pid)] for pid in ("PID_auto", "PID_approx")
    )
    assert auto == pytest.approx([3.904, 9.210], abs=1e-3)
    assert approx == pytest.approx([0.2119, 1.3649], abs=1e-4)


def test_the_equations_agree_with_the_robot() -> None:
    poses = np.random.default_rng(3).uniform([-0.1, -0.14, -0.4, -0.7], [0.1, 0.06, -0.3, 0.7], (200, 4))
    ours = make_robot("par4").inverse(poses)
    np.testing.assert_allclose(arm_angles(poses, Par4Geometry()), ours, atol=1e-12)
    printed = arm_angles(poses, Par4Geometry(), printed_f3=True)
    np.testing.assert_allclose(np.delete(printed, 2, axis=1), np.delete(ours, 2, axis=1), atol=1e-12)
    assert (printed[:, 2] > ours[:, 2]).all()


def test_the_printed_f3_is_the_paper_s() -> None:
    """(18) letter by letter against the general form that the comparison uses."""
    g, (X, Y, Z) = Par4Geometry(), (0.03, -0.05, -0.33)
    c = s = math.cos(math.radians(225.0))
    E = 2 * g.L * Z - 2 * g.L * g.B_z + 2 * g.L * g.P_z
    F = 2 * g.L * g.R - 2 * g.L * X * c + g.L * g.d * c - 2 * g.L * g.d_i * c - 2 * g.L * Y * s + 2 * g.L * g.h_i * s
    q = arm_angles(np.array([X, Y, Z, 0.0]), g, printed_f3=True)[2]
    u = np.array([X - g.d / 2 - g.d_i - g.R * c, Y - g.h_i - g.R * s, Z + g.P_z - g.B_z])
    assert E * math.sin(q) + F * math.cos(q) + u @ u + g.L**2 - g.l**2 == pytest.approx(0.0, abs=1e-15)


def test_what_is_wrong_or_open_is_explained() -> None:
    for figure in figures():
        assert figure.verdict in STYLES
        if figure.verdict in ("paper wrong", "left open"):
            assert figure.note, figure.name
        assert f"{figure.name}{figure.unit}{figure.printed}{figure.computed}{figure.note}".isascii(), figure.name


def test_a_miss_is_called_one() -> None:
    section = Section("Table 9")
    assert section.compared("k", "", "2.50", 2.5049).verdict == "reproduced"
    assert section.compared("k", "", "2.50", 2.5051).verdict == "not reproduced"


def test_the_closing_line_counts() -> None:
    line = summary(list(figures_of("par4")))
    counts = Counter(figure.verdict for figure in figures_of("par4"))
    beyond = counts.pop("beyond the paper")
    assert line.startswith(f"{counts.total()} entries: {counts['reproduced']} reproduced, 3 wrong in print, ")
    assert line.endswith(f"{beyond} more of ours go beyond the paper.")
    assert set(SUMMED_UP) | {"beyond the paper"} == set(STYLES)
    assert summary([replace(figures()[0], verdict="left open")]) == "1 entries: 1 left open."


def test_json_is_for_programs(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["reproduce", "--paper", "par4", "--json"]) == 0
    rows: list[dict[str, Any]] = json.loads(capsys.readouterr().out)
    assert len(rows) == len(figures_of("par4"))
    for row, figure in zip(rows, figures_of("par4"), strict=True):
        assert (row["paper"], row["section"], row["name"]) == ("par4", figure.section, figure.name)
        assert row["as_printed"] == figure.printed
        assert row["verdict"] == figure.verdict
        assert row["note"] == figure.note
        assert row["computed"] == figure.computed
        assert row["difference"] == figure.difference
    table_3 = {row["name"]: row for row in rows if row["section"] == "Table 3"}
    assert (table_3["k_p"]["printed"], table_3["k_p"]["as_printed"], table_3["k_p"]["decimals"]) == (2.288, "2.2880", 4)
    assert (table_3["rule: T_i / T_0"]["printed"], table_3["rule: T_i / T_0"]["difference"]) == (None, None)


def test_a_table_without_a_terminal_is_plain(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("FORCE_COLOR", "TTY_COMPATIBLE"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("COLUMNS", "40")
    assert main(["reproduce", "--paper", "par4"]) == 0
    of_par4 = figures_of("par4")
    printed = capsys.readouterr().out
    lines = [line.rstrip() for line in printed.splitlines()]
    assert printed.isascii() and "\x1b" not in printed
    assert max(map(len, lines)) <= 100
    assert " ".join(lines[-2:]).strip().endswith(summary(list(of_par4)))
    for figure in of_par4:
        row = next(line for line in lines[lines.index(figure.section) :] if line.startswith(f"  {figure.name} "))
        assert figure.verdict.split()[0] in row


def test_every_number_fits_its_column() -> None:
    for figure in figures():
        shown = [cell.plain for cell in cells(figure)]
        assert all(len(text) <= width for text, width in zip(shown[2:4], (10, 10), strict=True)) or isinstance(
            figure.computed, str
        ), figure


def test_a_terminal_gets_colours(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("NO_COLOR", raising=False)
    monkeypatch.setenv("FORCE_COLOR", "1")
    monkeypatch.setenv("TERM", "xterm-256color")
    assert main(["reproduce", "--paper", "par4"]) == 0
    assert "\x1b[32m" in capsys.readouterr().out
