"""`deltalab lessons`: what is printed, and how it fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.classroom.lessons.read import mistakes_in
from app.cli import main
from tests.support.small_lesson import WHOLE, damaged, write_lesson


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Exit status, and what stands on stdout and stderr."""
    status = main(["lessons", *arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def test_a_fine_lesson_gets_one_line(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    path = write_lesson(tmp_path)
    status, out, err = run(capsys, "check", str(path), "--structure-only")
    assert (status, err) == (0, "")
    assert out.splitlines()[0] == f"{path}: fine, 2 steps, 3 checks, 10 minutes."


def test_mistakes_get_a_line_each(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    source, line = damaged('press = "jog"', 'press = "walk"')
    path = write_lesson(tmp_path, source.replace("is = true", "is = 3"), name="02-broken")
    status, out, err = run(capsys, "check", str(write_lesson(tmp_path)), str(path), "--structure-only")
    assert status == 2
    complaints = [row for row in out.splitlines() if row.startswith(f"{path}:") and "note" not in row]
    assert len(complaints) == 2 and complaints[1].startswith(f"{path}:{line}: There is no action walk")
    assert err == "1 lesson needs mending: each line above says where and what is wrong.\n"


def test_solutions_are_played(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """A check that the solution does not meet is found by playing it, and by nothing else."""
    status, _, _ = run(capsys, "new", "Move it", "--folder", str(tmp_path))
    path = tmp_path / "01-move-it.md"
    assert run(capsys, "check", str(path))[0] == status == 0
    path.write_text(path.read_text().replace('to = "<<x>>"', "to = 75"))
    assert run(capsys, "check", str(path), "--structure-only")[0] == 0
    line = path.read_text().partition("### Solution")[0].count("\n") + 1
    status, out, _ = run(capsys, "check", str(path))
    assert status == 2 and f"{path}:{line}: step 1, Move the tool: The solution does not pass: “The tool stands" in out


@pytest.mark.parametrize(
    ("title", "name"),
    [
        ("The five-bar robot", "01-the-five-bar-robot"),
        ("Grübler's count", "01-grubler-s-count"),
        ('Say "hi" \\ <b>', "01-say-hi-b"),
        ("x" * 200, "01-" + "x" * 48),
    ],
)
def test_a_template_works_as_it_is(capsys: pytest.CaptureFixture[str], tmp_path: Path, title: str, name: str) -> None:
    assert run(capsys, "new", title, "--folder", str(tmp_path / "new"))[0] == 0
    assert mistakes_in(tmp_path / "new" / f"{name}.md") == []


def test_templates_are_numbered(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    write_lesson(tmp_path, WHOLE, name="07-old")
    run(capsys, "new", "Next", "--folder", str(tmp_path))
    assert (tmp_path / "08-next.md").is_file()


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["new", "!!!"], "A lesson needs a title with letters"),
        (["new", "A", "--folder", "FILE"], "Cannot write"),
        (["check", "--structure-only", "FILE/none.md"], "1 lesson needs mending"),
        (["facts", "no such thing"], "Nothing is said about 'no such thing'"),
        (["walk"], "Say what deltalab lessons is to do: check, facts, new."),
    ],
)
def test_a_users_mistake_is_one_sentence(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, arguments: list[str], sentence: str
) -> None:
    file = tmp_path / "file"
    file.write_text("")
    status, _, err = run(capsys, *(argument.replace("FILE", str(file)) for argument in arguments))
    assert status == 2 and err.startswith(sentence) and err.count("\n") == 1


def test_what_can_be_used_is_listed(capsys: pytest.CaptureFixture[str]) -> None:
    out = run(capsys, "facts")[1]
    assert "pose.x" in out and "mm, may be set" in out and "press" in out and "inverse(robot, pose, [preset]" in out
    assert all("pose" in row.lower() for row in run(capsys, "facts", "pose")[1].splitlines())
