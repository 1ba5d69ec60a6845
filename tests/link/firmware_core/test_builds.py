"""The core as every compiler sees it, and the library as processes share it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from app.link.errors import LinkError
from app.link.firmware import build
from tests.support.imports import ROOT
from tests.support.tools import needs

pytestmark = pytest.mark.long

STRICT = ("-Wall", "-Wextra", "-Werror", "-Wdouble-promotion")
STM32 = ("-mcpu=cortex-m4", "-mthumb", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard")


def make(target: str, folder: Path) -> None:
    command = ["make", "-C", str(build.FIRMWARE), target, f"BUILD={folder}"]
    result = subprocess.run(command, capture_output=True, text=True)
    assert result.returncode == 0, result.stderr


@needs("gcc", "make")
def test_noise_and_damaged_frames_under_the_sanitizers(tmp_path):
    """10^6 bytes of noise and 10^5 frames, all states, on five builds; the program checks what must always hold."""
    make("fuzz", tmp_path)
    result = subprocess.run([tmp_path / "fuzz"], capture_output=True, text=True)
    assert result.returncode == 0, result.stderr
    assert result.stdout.startswith("1000000 noise bytes, 100000 frames")


@needs("gcc", "make")
def test_make_host_makes_a_library_without_a_warning(tmp_path):
    make("host", tmp_path)
    assert (tmp_path / "deltalab_core.so").stat().st_size > 10_000


@pytest.mark.parametrize(
    ("compiler", "options"),
    [
        pytest.param("avr-gcc", ("-std=gnu11", "-mmcu=atmega328p"), marks=needs("avr-gcc")),
        pytest.param("arm-none-eabi-gcc", ("-std=c99", *STM32), marks=needs("arm-none-eabi-gcc")),
    ],
)
def test_the_boards_compilers_take_the_core_without_a_warning(compiler, options, tmp_path):
    sources = [str(source) for source in sorted(build.CORE.glob("*.c"))]
    options = [*options, *(flag for flag in STRICT if compiler != "avr-gcc" or flag != "-Wdouble-promotion")]
    result = subprocess.run([compiler, *options, "-Os", "-c", *sources], capture_output=True, text=True, cwd=tmp_path)
    assert result.returncode == 0, result.stderr


@needs("gcc")
def test_processes_that_build_at_the_same_time_share_one_library(tmp_path):
    code = (
        "from app.link.firmware.build import build_host_library as b; import ctypes; ctypes.CDLL(str(b())); print(b())"
    )
    environment = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    running = [
        subprocess.Popen([sys.executable, "-c", code], cwd=ROOT, env=environment, stdout=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    names = {process.communicate()[0].strip() for process in running}
    assert len(names) == 1 and [str(path) for path in (tmp_path / "deltalab/firmware").iterdir()] == list(names)


def test_without_a_compiler_the_sentence_names_the_twin(monkeypatch):
    monkeypatch.setattr(build, "find_compiler", lambda: None)
    with pytest.raises(LinkError, match="Python twin"):
        build.build_host_library.__wrapped__()
