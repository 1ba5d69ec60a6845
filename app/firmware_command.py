"""`deltalab firmware`: build the boards' programs and put them on the boards."""

from __future__ import annotations

import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from app.errors import UserMistake

VARIANTS = {
    "uno": ("delta3_servo", "delta3_dc", "linear_stepper"),
    "stm32": ("par4_dc", "fivebar_dc", "linear_stepper"),
}
"""Robot and drives by board, the usual one first."""

COMPILERS = {"uno": "avr-gcc", "stm32": "arm-none-eabi-gcc"}
UPLOADERS = {"uno": "avrdude", "stm32": "st-flash"}
PACKAGES = {
    "make": "make",
    "avr-gcc": "gcc-avr avr-libc arduino-core-avr",
    "arm-none-eabi-gcc": "gcc-arm-none-eabi libnewlib-arm-none-eabi",
    "avrdude": "avrdude",
    "st-flash": "stlink-tools",
}
"""What Debian and Ubuntu call them."""

RESULTS = {"uno": (".hex",), "stm32": (".bin", ".hex")}


@dataclass(frozen=True)
class Build:
    """Compile the firmware for a board."""

    board: Literal["uno", "stm32"] = "uno"
    """uno: Arduino Uno; stm32: STM32F407 Discovery."""
    variant: str | None = None
    """Robot and drives. uno: delta3_servo, delta3_dc or linear_stepper; stm32: par4_dc, fivebar_dc or linear_stepper.
    By default the first."""
    output: Path = Path("build")
    """Folder for the results."""


@dataclass(frozen=True)
class Upload(Build):
    """Compile the firmware for a board and put it there. The motor supply must be off."""

    port: str | None = None
    """Serial port of an Uno; the STM32 is flashed through its ST-LINK."""


def build(command: Build) -> None:
    for path in compile_firmware(command):
        print(path)


def upload(command: Upload) -> None:
    if command.board == "uno" and command.port is None:
        raise UserMistake("Name the port of the Uno with --port; deltalab link ports lists them.")
    require("make", COMPILERS[command.board], UPLOADERS[command.board])
    arguments = [f"PORT={command.port}"] if command.port is not None else []
    run_make(command, f"{command.board}-upload", *arguments)
    print("The new firmware is on the board; deltalab link info shows it.")


def compile_firmware(command: Build) -> list[Path]:
    """Compile, and give the files to flash."""
    require("make", COMPILERS[command.board])
    run_make(command, command.board)
    name = f"{command.board}_{variant_of(command)}"
    return [command.output / f"{name}{suffix}" for suffix in RESULTS[command.board]]


def variant_of(command: Build) -> str:
    known = VARIANTS[command.board]
    if command.variant is not None and command.variant not in known:
        raise UserMistake(f"There is no variant {command.variant!r} for {command.board}: choose {', '.join(known)}.")
    return command.variant or known[0]


def require(*programs: str) -> None:
    """UserMistake for the first that is missing, with the packages that have it."""
    for program in programs:
        if shutil.which(program) is None:
            raise UserMistake(f"This needs {program}: install it, on Debian with apt install {PACKAGES[program]}.")


def run_make(command: Build, target: str, *arguments: str) -> None:
    """The compiler's own words are shown where it fails."""
    from app.link.firmware.build import FIRMWARE

    makefile = FIRMWARE / "Makefile"
    given = [target, f"VARIANT={variant_of(command)}", f"BUILD={command.output}", *arguments]
    result = subprocess.run(
        ["make", "--no-print-directory", "-f", str(makefile), *given], capture_output=True, text=True
    )
    if result.returncode:
        words = [line for line in (result.stderr or result.stdout).splitlines() if line.strip()]
        reason = words[0].strip().rstrip(".") if words else "make failed"
        raise UserMistake(f"The firmware was not made, since {target} failed: {reason}.")
