"""The control lab as a student uses it, in a real browser. Each test leaves a picture in tests/artifacts."""

from __future__ import annotations

import csv
import io
import math

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from app.simulation import circle_tracking
from tests.support.browser import PHONE, PageFactory, node_pose, open_page, screenshot, wait_ready, wait_until
from tests.support.plots import Chart, chart
from tests.support.server import RunningServer
from tests.support.widgets import button, choose, open_tab, press, set_slider, step_slider, toggle, type_into, upload

TOOL = "/robot/tool"
STEP, CONTROL = "Step response", "Control signal"
DEFAULT_OVERSHOOT = 0.0494
"""Golden: 25 degrees at 12 V without anti-windup."""
pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def shared_page(server: RunningServer, lasting_visit: PageFactory) -> Page:
    """One visitor for most tests."""
    page = lasting_visit()
    open_lab(page, server)
    return page


@pytest.fixture
def lab(shared_page: Page) -> Page:
    """The control lab as it is at first, its tab `Step` in front."""
    page, forget = shared_page, button(shared_page, "Forget all runs")
    open_tab(page, "Run")
    if forget.is_visible():
        forget.click()
    open_tab(page, "Step")
    press(page, "Reset the lab")
    wait_until(page, lambda: abs(overshoot(page) - DEFAULT_OVERSHOOT) < 1e-3, "the lab as it is at first")
    return page


def open_lab(page: Page, server: RunningServer) -> None:
    open_page(page, server.url)
    enter_lab(page)


def enter_lab(page: Page) -> None:
    wait_ready(page, [TOOL])
    page.get_by_role("tab", name="Control", exact=True).wait_for()
    open_tab(page, "Control")
    wait_until(page, lambda: is_drawn(chart(page, STEP)), "step response", timeout=60)


def unfold(page: Page, folder: str, shows: str) -> None:
    """Open a folder, unless it is open: then `shows` can be seen."""
    if not page.get_by_label(shows, exact=True).first.is_visible():
        page.get_by_text(folder, exact=True).click()
        page.get_by_label(shows, exact=True).first.wait_for()


def is_drawn(found: Chart | None) -> bool:
    return found is not None and len(found.x) > 100


def drawn(page: Page, title: str) -> Chart:
    found = chart(page, title)
    assert found is not None, f"no chart {title!r}"
    return found


def overshoot(page: Page) -> float:
    return max(drawn(page, STEP).curves["now"]) / 25.0 - 1.0


def test_the_lab_opens_with_the_papers_motor_and_its_plots(lab: Page):
    page = lab
    step = drawn(page, STEP)
    assert step.axes == ["Time (s)", "Position (deg)"]
    assert step.legend[:3] == ["set-point", "ideal", "now"] and "baseline" not in step.legend
    assert set(step.curves["set-point"]) == {25.0}
    assert overshoot(page) == pytest.approx(DEFAULT_OVERSHOOT, abs=1e-3)
    assert max(drawn(page, CONTROL).curves["now"]) == 12.0
    expect(page.get_by_text("Phase margin", exact=False).first).to_be_visible()
    open_tab(page, "Frequency")
    wait_until(page, lambda: is_drawn(chart(page, "Open loop: gain")), "Bode plot")
    screenshot(page, "control-frequency")
    open_tab(page, "Step")
    screenshot(page, "control-step")


def test_a_gain_moves_the_curve(lab: Page):
    page = lab
    before = drawn(page, STEP).curves["now"]
    type_into(page, "ki", 8)
    wait_until(page, lambda: overshoot(page) > 0.3, "overshoot of a large ki")
    expect(page.get_by_label("Tuning", exact=True)).to_have_value("By hand")
    assert drawn(page, STEP).curves["now"] != before
    typed = overshoot(page)
    step_slider(page, "ki, slider", -8)
    wait_until(page, lambda: float(page.get_by_label("ki", exact=True).input_value()) < 6.0, "ki pulled down")
    wait_until(page, lambda: overshoot(page) < typed - 0.02, "curve that followed the slider")


def test_a_baseline_is_kept_and_compared(lab: Page):
    page = lab
    kept = drawn(page, STEP).curves["now"]
    page.get_by_role("button", name="Keep this").click()
    wait_until(page, lambda: "baseline" in drawn(page, STEP).legend, "baseline in the legend")
    choose(page, "Tuning", "Paper, Table 3 (reaction curve)")
    wait_until(page, lambda: overshoot(page) > 0.9, "the paper's lively tuning")
    assert drawn(page, STEP).curves["baseline"] == pytest.approx(kept)
    expect(page.get_by_role("columnheader", name="baseline").first).to_be_visible()
    screenshot(page, "control-baseline")
    page.get_by_role("button", name="Forget", exact=True).click()
    wait_until(page, lambda: "baseline" not in drawn(page, STEP).legend, "no baseline")


def test_windup_and_its_cure(lab: Page):
    page = lab
    choose(page, "Trap", "Windup")
    expect(page.get_by_text("the integral keeps growing")).to_be_visible()
    wait_until(page, lambda: overshoot(page) > 0.9, "windup")
    screenshot(page, "control-windup")
    unfold(page, "Program on the board", "Anti-windup")
    choose(page, "Anti-windup", "clamping")
    wait_until(page, lambda: overshoot(page) < 0.6, "less overshoot with clamping")


def test_disturbances_can_be_switched_on(lab: Page):
    page = lab
    quiet = np.ptp(drawn(page, CONTROL).curves["now"][-40:])
    unfold(page, "Motor and disturbances", "Noise")
    toggle(page, "Noise")
    set_slider(page, "Noise (deg)", 0.5)
    wait_until(page, lambda: np.ptp(drawn(page, CONTROL).curves["now"][-40:]) > quiet + 5.0, "a nervous control signal")
    screenshot(page, "control-noise")


def test_the_circle_runs_on_the_robot_and_can_be_scrubbed(lab: Page):
    page = lab
    open_tab(page, "Run")
    toggle(page, "As in the paper")
    press(page, "Run on the robot")
    wait_until(page, lambda: is_drawn(chart(page, "Joints")), "joints of the run", timeout=30)
    for value in ("91.45", "124", "126", "88.85"):
        expect(page.get_by_role("cell", name=value, exact=True).first).to_be_visible()
    assert drawn(page, "Joints").axes == ["Time (s)", "Joint position (deg)"]
    names = "() => Object.keys(window.__viserSceneTree.getState())"
    assert {"/robot/run/reference", "/robot/run/actual"} <= set(page.evaluate(names))
    first = node_pose(page, TOOL)
    wait_until(page, lambda: node_pose(page, TOOL) != first, "robot that plays the run")
    press(page, "Pause")
    set_slider(page, "Time (s)", 25)
    pose = circle_tracking("auto").pose[2500]
    wait_until(page, lambda: tool_distance_mm(page, pose) < 0.1, "tool where it was after 25 s")
    choose(page, "Error drawn", "20×")
    choose(page, "Drive", "q2")
    choose(page, "Shown", "After 5 s")
    wait_until(page, lambda: math.isnan(drawn(page, "Joints").last("q1")), "one drive only")
    screenshot(page, "control-run")


def tool_distance_mm(page: Page, pose: np.ndarray) -> float:
    found = node_pose(page, TOOL)
    return 1e3 * math.dist(found.position, pose[:3]) if found else math.inf


def test_a_run_is_saved_as_csv_and_reads_back(lab: Page):
    page = lab
    open_tab(page, "Run")
    press(page, "Run on the robot")
    wait_until(page, lambda: button(page, "Save this run as CSV").is_visible(), "finished run", timeout=30)
    with page.expect_download() as waiting:
        press(page, "Save this run as CSV")
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text())))
    run = circle_tracking("auto", mode="sampled", u_max=12.0)
    assert len(rows) == len(run.t)
    column = np.array([float(row["q2_actual_deg"]) for row in rows])
    assert column == pytest.approx(np.degrees(run.q[:, 1]), abs=1e-3)
    open_tab(page, "Step")
    with page.expect_download() as waiting:
        press(page, "Save step as CSV")
    rows = list(csv.DictReader(io.StringIO(waiting.value.path().read_text())))
    assert float(rows[-1]["now: Position (deg)"]) == pytest.approx(drawn(page, STEP).last("now"), rel=1e-6)


def test_the_papers_ranking_reverses(lab: Page):
    page = lab
    choose(page, "Trap", "A ranking that reverses")
    open_tab(page, "Run")
    for value in ("90.94", "195.1", "2.008", "0.3386"):
        expect(page.get_by_role("cell", name=value, exact=True).first).to_be_attached(timeout=30_000)
    button(page, "Forget all runs").scroll_into_view_if_needed()
    screenshot(page, "control-ranking")


def test_a_path_out_of_reach_is_refused_with_its_reason(lab: Page):
    page = lab
    open_tab(page, "Run")
    set_slider(page, "Radius (mm)", 150)
    press(page, "Run on the robot")
    expect(page.get_by_text("Part of the path is out of reach", exact=False)).to_be_visible(timeout=20_000)
    expect(button(page, "Run on the robot")).to_be_enabled()


def test_the_motor_is_identified_and_used(lab: Page, tmp_path):
    page = lab
    open_tab(page, "Motor")
    press(page, "Record and identify")
    expect(page.get_by_text("fit 98", exact=False)).to_be_visible(timeout=30_000)
    assert is_drawn(chart(page, "Output")) and is_drawn(chart(page, "Residual"))
    screenshot(page, "control-motor")
    with page.expect_download() as waiting:
        press(page, "Save recording as CSV")
    path = tmp_path / "mine.csv"
    path.write_bytes(waiting.value.path().read_bytes())
    upload(page, "Read a CSV file", path)
    expect(page.get_by_text("mine.csv: fit 98", exact=False)).to_be_visible(timeout=30_000)
    press(page, "Use this motor")
    unfold(page, "Motor and disturbances", "Noise")
    expect(page.get_by_text("Identified by you from mine.csv", exact=False)).to_be_visible()
    (broken := tmp_path / "broken.csv").write_text("time,voltage\n1,2\n")
    upload(page, "Read a CSV file", broken)
    expect(page.get_by_text("▲ Line 1", exact=False)).to_be_visible(timeout=30_000)


def test_other_robots_have_a_motor_too_and_a_reload_keeps_the_gains(lab: Page):
    """The last to use this visitor: another robot is left behind."""
    page = lab
    open_tab(page, "Robot")
    choose(page, "Robot", "Linear delta")
    open_tab(page, "Control")
    wait_until(page, lambda: drawn(page, STEP).axes[1] == "Position (mm)", "millimetres")
    type_into(page, "kp", 3.25)
    wait_until(page, lambda: page.get_by_label("Tuning", exact=True).input_value() == "By hand", "own gains")
    page.reload(wait_until="domcontentloaded")
    enter_lab(page)
    expect(page.get_by_label("kp", exact=True)).to_have_value("3.25")


def test_on_a_phone_the_response_stays_above_the_sliders(visit, server: RunningServer):
    page = visit(PHONE)
    open_lab(page, server)
    type_into(page, "ki", 8)
    wait_until(page, lambda: overshoot(page) > 0.3, "curve that follows")
    overflow = page.evaluate("() => document.documentElement.scrollWidth - window.innerWidth")
    assert overflow <= 0, "nothing sticks out of a phone's screen"
    screenshot(page, "control-phone")
