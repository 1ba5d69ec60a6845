"""`deltalab link` and `deltalab firmware`, as somebody types them."""

from __future__ import annotations

import re
import shutil
import subprocess

import pytest

from app import firmware_command
from app.cli import EXIT_INTERRUPTED, EXIT_MISTAKE, main
from app.link.firmware.build import FIRMWARE
from app.link.link import RobotLink
from app.link.twin.recording import Recording
from app.link_command import JogOnce, read_step
from app.robots import make_robot
from tests.support.tools import needs


def says(line: str, capsys: pytest.CaptureFixture[str]) -> str:
    """The one sentence of a mistake."""
    assert main(line.split()) == EXIT_MISTAKE
    printed = capsys.readouterr()
    assert len(printed.err.strip().splitlines()) == 1
    return printed.err


def test_ports_are_listed(capsys):
    assert main(["link", "ports"]) == 0
    assert {"sim:par4", "sim:delta3", "sim:linear", "sim:fivebar"} <= set(capsys.readouterr().out.split())


def test_info_says_what_the_board_is(capsys):
    assert main(["link", "info", "sim:delta3?boot_ms=0"]) == 0
    printed = capsys.readouterr().out
    assert "Arduino Uno, number 1000002, firmware 1.0" in printed
    assert "limits -45.0 to 90.0 deg" in printed


def test_monitor_saves_what_it_saw(capsys, tmp_path):
    path = tmp_path / "telemetry.csv"
    assert main(["link", "monitor", "sim:delta3?boot_ms=0", "--seconds", "0.5", "--csv", str(path)]) == 0
    assert capsys.readouterr().out.count("joints") >= 2
    assert Recording.from_csv(path.read_text()).duration_s > 0.1


def test_a_joint_is_jogged(capsys):
    assert main(["link", "jog", "sim:delta3?boot_ms=0", "--joint", "1", "--by-deg", "4"]) == 0
    before, after = (float(row.split()[2]) for row in re.findall(r"ready .*", capsys.readouterr().out))
    assert after - before == pytest.approx(4.0, abs=0.02)


def test_control_c_stops_the_robot(capsys, monkeypatch):
    stopped = []
    stop = RobotLink.stop
    monkeypatch.setattr(RobotLink, "stop", lambda link, person: stopped.append(person) or stop(link, person))
    monkeypatch.setattr("app.link_command._perform", lambda *given, **options: (_ for _ in ()).throw(KeyboardInterrupt))
    assert main(["link", "jog", "sim:delta3?boot_ms=0", "--joint", "1", "--by-deg", "4"]) == EXIT_INTERRUPTED
    assert len(stopped) == 1
    assert "Stopped" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("line", "sentence"),
    [
        ("link", "link is to do: info, jog, monitor, ports"),
        ("link dance", "link is to do"),
        ("firmware", "firmware is to do: build, upload"),
        ("link info", "port"),
        ("link info /dev/nothing-here", "no port /dev/nothing-here"),
        ("link info sim:tripod", "choose one of sim:par4"),
        ("firmware build --board stm32 --variant delta3_dc", "choose par4_dc, fivebar_dc"),
        ("firmware upload", "deltalab link ports lists them"),
        ("firmware build --bord uno", "did you mean --board?"),
    ],
)
def test_a_mistake_is_one_sentence(line, sentence, capsys):
    assert sentence in says(line, capsys)


@pytest.mark.parametrize(
    ("command", "sentence"),
    [
        (JogOnce("x", joint=1), "Say how far"),
        (JogOnce("x", by_mm=1.0), "Say what is to move"),
        (JogOnce("x", joint=1, axis="x", by_mm=1.0), "Say what is to move"),
        (JogOnce("x", joint=4, by_deg=1.0), "from 1 to 3"),
        (JogOnce("x", joint=0, by_deg=1.0), "from 1 to 3"),
        (JogOnce("x", joint=1, by_mm=1.0), "moves in degrees"),
        (JogOnce("x", axis="x", by_deg=1.0), "moves in mm"),
        (JogOnce("x", axis="theta", by_deg=1.0), "choose one of x, y, z"),
        (JogOnce("x", axis="x", by_mm=0.0), "not by 0"),
    ],
)
def test_a_step_that_makes_no_sense(command, sentence):
    with pytest.raises(Exception, match=sentence):
        read_step(command, make_robot("delta3"))


def test_steps_are_in_si():
    jog, size = read_step(JogOnce("x", joint=2, by_deg=-180.0), make_robot("delta3"))
    assert (jog.space, jog.axis, jog.direction, size) == ("joint", 1, -1, pytest.approx(3.14159265))
    jog, size = read_step(JogOnce("x", axis="z", by_mm=2.0), make_robot("delta3"))
    assert (jog.space, jog.axis, jog.direction, size) == ("pose", 2, 1, pytest.approx(0.002))


def test_help_of_a_group(capsys):
    assert main(["link", "--help"]) == 0
    assert "deltalab link jog" in capsys.readouterr().out


def test_variants_are_those_of_the_makefile():
    text = (FIRMWARE / "Makefile").read_text()
    for board, variants in firmware_command.VARIANTS.items():
        (listed,) = re.findall(rf"make {board} VARIANT=.*?: (.*)\"", text)
        assert listed.replace(" (default)", "").split(", ") == list(variants)


@needs("make")
@pytest.mark.parametrize(("board", "suffixes"), [("uno", [".hex"]), ("stm32", [".bin", ".hex"])])
def test_make_is_asked_for_what_the_makefile_knows(board, suffixes, tmp_path, monkeypatch, capsys):
    """Without carrying it out: the boards' own tests compile."""
    really, recipes = subprocess.run, []

    def rehearse(line, **options):
        recipes.append(really([line[0], "-n", *line[1:]], **options))
        return recipes[-1]

    monkeypatch.setattr(firmware_command, "require", lambda *programs: None)
    monkeypatch.setattr(subprocess, "run", rehearse)
    assert main(["firmware", "build", "--board", board, "--output", str(tmp_path)]) == 0
    name = f"{board}_{firmware_command.VARIANTS[board][0]}"
    paths = [str(tmp_path / f"{name}{suffix}") for suffix in suffixes]
    assert capsys.readouterr().out.split() == paths
    assert all(path in recipes[0].stdout for path in paths)


def test_a_missing_compiler_is_named_with_its_package(monkeypatch, capsys):
    monkeypatch.setattr(shutil, "which", lambda program: None if "gcc" in program else f"/bin/{program}")
    assert "apt install gcc-avr avr-libc arduino-core-avr" in says("firmware build", capsys)
    assert "apt install gcc-arm-none-eabi" in says("firmware build --board stm32", capsys)


def test_upload_compiles_and_calls_the_programmer(monkeypatch, capsys):
    lines = []

    def run(line, **options):
        lines.append(line)
        return subprocess.CompletedProcess(line, 0, "", "")

    monkeypatch.setattr(shutil, "which", lambda program: f"/bin/{program}")
    monkeypatch.setattr(subprocess, "run", run)
    assert main(["firmware", "upload", "--port", "/dev/ttyACM0", "--variant", "delta3_dc"]) == 0
    assert {"uno-upload", "VARIANT=delta3_dc", "PORT=/dev/ttyACM0"} <= set(lines[0])


def test_a_compilers_complaint_is_passed_on(monkeypatch, capsys):
    failed = subprocess.CompletedProcess([], 2, "", "deltalab.ino:3: error: no such thing\nmake: *** [x] Error 1\n")
    monkeypatch.setattr(shutil, "which", lambda program: f"/bin/{program}")
    monkeypatch.setattr(subprocess, "run", lambda *given, **options: failed)
    assert "no such thing" in says("firmware build", capsys)
