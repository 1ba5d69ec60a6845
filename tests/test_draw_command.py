"""`deltalab draw` as a person uses it: pictures in, files out, one sentence for a mistake."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from app.cli import EXIT_MISTAKE, main
from app.drawing import DrawingError, draw_image
from app.drawing.exports import read_points_file
from app.drawing.pipeline import MODES
from app.drawing.svg_import import read_svg
from app.robots import ROBOTS, make_robot


def picture(path: Path) -> Path:
    """A circle with a cross through it, lines 5 pixels wide."""
    grey = np.full((300, 300), 255, dtype=np.uint8)
    cv2.circle(grey, (150, 150), 100, 0, 5)
    cv2.line(grey, (20, 20), (280, 280), 0, 5)
    cv2.line(grey, (280, 20), (20, 280), 0, 5)
    assert cv2.imwrite(str(path), grey)
    return path


@pytest.fixture(scope="module")
def image(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return picture(tmp_path_factory.mktemp("pictures") / "cross.png")


def length_mm(strokes: list[np.ndarray]) -> float:
    return sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in strokes)


def test_what_is_written_is_what_is_drawn(image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    for name in ("a.svg", "a.gcode", "a.csv", "a.txt", "a.dxf", "a.png"):
        assert main(["draw", str(image), "-o", str(tmp_path / name)]) == 0
        assert f"{name}: centreline, 3 strokes" in capsys.readouterr().out
    drawing = draw_image(image.read_bytes())
    for strokes in (read_svg((tmp_path / "a.svg").read_bytes()), read_points_file((tmp_path / "a.txt").read_text())[0]):
        assert len(strokes) == 3 and length_mm(strokes) == pytest.approx(drawing.ink_mm, rel=1e-3)
    truth = (2 * np.pi * 100 + 2 * np.hypot(260, 260)) * 160 / 300
    assert drawing.ink_mm == pytest.approx(truth, rel=0.02)


def test_several_pictures_at_once_and_a_bad_one_among_them(
    image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
):
    other, bad = picture(tmp_path / "other.png"), tmp_path / "bad.jpg"
    bad.write_text("no picture")
    status = main(["draw", str(image), str(bad), str(other), "-o", str(tmp_path / "out" / ".svg"), "--sheet", "A6"])
    printed = capsys.readouterr()
    assert status == EXIT_MISTAKE
    assert {path.name for path in (tmp_path / "out").iterdir()} == {"cross.svg", "other.svg"}
    assert printed.out.count("strokes") == 2
    assert printed.err.strip().splitlines()[-1].startswith("bad.jpg: ")


def test_an_svg_is_drawn_as_it_is(image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    """Not by its name: what the first command wrote, larger, without a mode."""
    assert main(["draw", str(image), "-o", str(tmp_path / "a.svg"), "--sheet", "80x80"]) == 0
    (tmp_path / "a.png").write_bytes((tmp_path / "a.svg").read_bytes())
    assert main(["draw", str(tmp_path / "a.png"), "-o", str(tmp_path / "b.svg"), "--margin", "10"]) == 0
    assert "b.svg: 3 strokes" in capsys.readouterr().out
    small, large = (read_svg((tmp_path / name).read_bytes()) for name in ("a.svg", "b.svg"))
    sides = [float(np.ptp(np.concatenate(strokes), axis=0).max()) for strokes in (small, large)]
    assert sides[1] == pytest.approx(140.0, abs=0.1)
    assert length_mm(large) / length_mm(small) == pytest.approx(sides[1] / sides[0], rel=1e-3)


@pytest.mark.parametrize(
    ("options", "width", "height"),
    [
        (["--sheet", "a6"], 105.0, 148.0),
        (["--sheet", "A5", "--landscape"], 210.0, 148.0),
        (["--sheet", "A4"], 210.0, 297.0),
        (["--sheet", "120x90.5"], 120.0, 90.5),
    ],
)
def test_sheets(options: list[str], width: float, height: float, image: Path, tmp_path: Path):
    output = tmp_path / "a.txt"
    assert main(["draw", str(image), "-o", str(output), "--margin", "30", *options]) == 0
    strokes, sheet = read_points_file(output.read_text())
    assert sheet == (width, height)
    reach = np.abs(np.concatenate(strokes)).max()
    assert reach == pytest.approx((min(sheet) / 2 - 30.0) * 130 / 150, abs=1.0)


def test_progress_is_for_terminals_only(
    image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
):
    arguments = ["draw", str(image), "-o", str(tmp_path / "a.svg")]
    assert main(arguments) == 0
    quiet = capsys.readouterr()
    assert quiet.err == "" and quiet.out.count("\n") == 1
    monkeypatch.setenv("FORCE_COLOR", "1")  # rich takes this for a terminal
    assert main(arguments) == 0
    shown = capsys.readouterr()
    assert shown.out == quiet.out and "cross.png" in shown.err


def test_two_pictures_never_write_the_same_file(image: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    other = picture(tmp_path / "cross.jpg")
    assert main(["draw", str(image), str(other), "-o", str(tmp_path / "out" / ".svg")]) == EXIT_MISTAKE
    assert "cross.png and cross.jpg would both become" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        (["--mode", "photo"], "no mode called photo"),
        (["--sheet", "A9"], "no sheet 'A9'"),
        (["--robot", "arm"], "no robot called arm"),
        (["--set", "gamma"], "written name=value"),
        (["--set", "colour=red"], "no setting colour"),
        (["--set", "gamma=-1"], "amma"),
        (["--set", "gamma=red"], "gamma cannot be 'red'"),
        (["--set", "mode=canny"], "mode is no setting"),
        (["--margin", "80"], "no room"),
        (["--mode", "canny", "--set", "high=100000"], "nothing to draw"),
        (["--sheet", "900x900"], "beyond the robot"),
        (["-o", "x.pdf"], "Cannot write x.pdf"),
    ],
)
def test_a_mistake_gets_one_sentence(
    arguments: list[str], says: str, image: Path, capsys: pytest.CaptureFixture[str], tmp_path: Path
):
    output = [] if "-o" in arguments else ["-o", str(tmp_path / "x.svg")]
    assert main(["draw", str(image), *output, *arguments]) == EXIT_MISTAKE
    sentence = capsys.readouterr().err.strip().splitlines()[-1]
    assert says in sentence and sentence.endswith(".") and "Traceback" not in sentence
    assert not (tmp_path / "x.svg").exists()


def test_a_missing_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]):
    assert main(["draw", str(tmp_path / "none.png"), "-o", str(tmp_path / "x.svg")]) == EXIT_MISTAKE
    assert "none.png: no such file" in capsys.readouterr().err


@pytest.mark.parametrize("mode", MODES)
def test_every_mode_draws(image: Path, mode: str):
    drawing = draw_image(image.read_bytes(), mode, (100.0, 100.0))
    assert drawing.mode == mode or mode == "auto"
    assert drawing.lifts == len(drawing.strokes) - 1
    assert drawing.ink_mm > 100.0 or (mode == "stipple" and drawing.lifts > 100)
    assert drawing.time_s == drawing.toolpath.t[-1] > 1.0
    for stroke in drawing.strokes:
        assert np.abs(stroke).max() <= 50.0 + 1.0


@pytest.mark.parametrize("robot", ROBOTS)
def test_every_robot_draws_within_its_reach(image: Path, robot: str):
    drawing = draw_image(image.read_bytes(), sheet_mm=(80.0, 80.0), robot=robot)
    machine, path = make_robot(robot), drawing.toolpath
    assert machine.reachable(path.pose).all()
    assert np.allclose(machine.inverse(path.pose), path.q, atol=1e-9)
    assert path.max_joint_acceleration_ratio <= 1.05 and path.max_joint_speed_ratio <= 1.05


def test_the_papers_way_draws_every_line_twice(image: Path):
    """What is measured of it elsewhere holds here, too: twice the ink of the outline."""
    paper, outline = (draw_image(image.read_bytes(), mode) for mode in ("paper", "outline"))
    assert paper.ink_mm > 1.8 * outline.ink_mm


def test_without_lift_the_pen_leaves_stray_ink(image: Path):
    drawing = draw_image(image.read_bytes(), lift=False)
    down = np.flatnonzero(drawing.toolpath.pen)
    assert len(down) == down[-1] - down[0] + 1, "down from the first stroke to the last"
    assert drawing.toolpath.stray_ink_mm == pytest.approx(drawing.pen_up_mm, rel=0.02)


@pytest.mark.parametrize("grey", [255, 128, 0])
def test_a_blank_picture_says_that_there_is_nothing(grey: int):
    _, blank = cv2.imencode(".png", np.full((60, 60), grey, dtype=np.uint8))
    with pytest.raises(DrawingError, match=r"\.$"):
        draw_image(blank.tobytes())
