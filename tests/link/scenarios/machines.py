"""The boards that scenarios are played on, with the truth about the joints behind them.

Those in this process know no time but the one that they are given: what is played on them does not depend on how busy
the computer is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import closing, contextmanager
from dataclasses import replace
from typing import Protocol

from app.link.emulated import EmulatedBoard
from app.link.emulated.options import board_of
from app.link.protocol.codes import BoardKind
from app.link.transport import Transport, open_transport
from tests.support.emulators.stm32.qemu import WATCHDOG_RESET, Stm32, running_stm32
from tests.support.emulators.uno.live import UnoPty
from tests.support.emulators.uno.plants import ESTOP, LASER, POWER, SWITCHES, DcPlant, StepperPlant
from tests.support.emulators.uno.rig import Rig

BOOT_MS = 300


class BoardOnStage(Protocol):
    """A running board with its machine. Joints count from 0; rad or m."""

    live: bool
    """It runs by itself, in real time."""

    def open(self) -> Transport: ...
    def advance(self, ms: int) -> None:
        """Let time pass, if it does not do so by itself."""

    def joints(self) -> tuple[float, ...]: ...
    def powered(self) -> bool: ...
    def laser(self) -> float: ...
    def reset(self) -> None: ...
    def hang(self) -> None: ...
    def estop(self, pressed: bool) -> None: ...
    def jam(self, joint: int) -> None: ...
    def break_sensor(self, joint: int) -> None: ...
    def close_switch(self, joint: int) -> None: ...


class Wire:
    """The end of a cable at a board in this process."""

    name = "board"

    def __init__(self, take: Callable[[], bytes], send: Callable[[bytes], None]) -> None:
        self._take, self._send = take, send

    def read(self) -> bytes:
        return self._take()

    def write(self, data: bytes) -> None:
        self._send(data)

    def close(self) -> None: ...


class Uno:
    """In simavr. Opening its port resets it."""

    live = False

    def __init__(self, rig: Rig, stepper: bool) -> None:
        self._rig, self._stepper = rig, stepper
        rig.uno.clear_reset_cause()

    def open(self) -> Transport:
        self._rig.uno.reset(BOOT_MS)
        return Wire(self._rig.uno.take, self._rig.uno.send)

    def advance(self, ms: int) -> None:
        for _ in range(ms):
            self._rig.uno.run(self._rig.plant.step_us)
            self._rig.plant.step(self._rig.uno)

    def joints(self) -> tuple[float, ...]:
        return tuple(self._rig.plant.joints)

    def powered(self) -> bool:
        return self._rig.uno.level(POWER) != self._stepper

    def laser(self) -> float:
        return self._rig.uno.pwm(LASER)

    def reset(self) -> None:
        self._rig.uno.reset(BOOT_MS)

    def hang(self) -> None:
        self._rig.uno.hang()

    def estop(self, pressed: bool) -> None:
        self._rig.uno.drive_pin(ESTOP, pressed)

    def jam(self, joint: int) -> None:
        self._dc.stuck = joint

    def break_sensor(self, joint: int) -> None:
        self._dc.broken_wire = joint

    def close_switch(self, joint: int) -> None:
        assert isinstance(self._rig.plant, StepperPlant)
        self._rig.uno.drive_pin(SWITCHES[joint], False)

    @property
    def _dc(self) -> DcPlant:
        assert isinstance(self._rig.plant, DcPlant), "only DC drives have this"
        return self._rig.plant


class LiveUno(Uno):
    """In simavr, in real time, behind a pseudo terminal of its own."""

    live = True

    def __init__(self, board: UnoPty, stepper: bool) -> None:
        super().__init__(board.rig, stepper)
        self._board = board

    def open(self) -> Transport:
        return open_transport(self._board.port)

    def advance(self, ms: int) -> None:
        raise NotImplementedError("It does so by itself.")


class Stm:
    """In QEMU."""

    live = True

    def __init__(self, board: Stm32, joints: int) -> None:
        self._board, self._joints = board, joints

    def open(self) -> Transport:
        return open_transport(self._board.port)

    def advance(self, ms: int) -> None:
        raise NotImplementedError("It does so by itself.")

    def joints(self) -> tuple[float, ...]:
        return tuple(self._board.plant.joints[: self._joints])

    def powered(self) -> bool:
        return self._board.outputs.powered

    def laser(self) -> float:
        return self._board.outputs.laser

    def reset(self) -> None:
        self._board.reset()

    def hang(self) -> None:
        self._board.reset(WATCHDOG_RESET)

    def estop(self, pressed: bool) -> None:
        self._board.plant.faults.estop_open = pressed

    def jam(self, joint: int) -> None:
        self._board.plant.faults.stuck_joint = joint

    def break_sensor(self, joint: int) -> None:
        self._board.plant.faults.broken_sensor = joint

    def close_switch(self, joint: int) -> None:
        self._board.plant.faults.limit_switch = joint


class InProcess:
    """The firmware's core as a library, or its twin."""

    live = False

    def __init__(self, port: str) -> None:
        self._board: EmulatedBoard = board_of(port)

    def open(self) -> Transport:
        if self._board.board is BoardKind.UNO:
            self._board.reset()
        return Wire(self._board.transmit, self._board.receive)

    def advance(self, ms: int) -> None:
        self._board.advance(1e-3 * ms)

    def joints(self) -> tuple[float, ...]:
        return self._board.true_joints

    def powered(self) -> bool:
        return self._board.powered

    def laser(self) -> float:
        return self._board.laser

    def reset(self) -> None:
        self._board.reset()

    def hang(self) -> None:
        raise NotImplementedError("A core in this process cannot hang.")

    def estop(self, pressed: bool) -> None:
        self._fault(estop=pressed)

    def jam(self, joint: int) -> None:
        self._fault(stuck_joint=joint)

    def break_sensor(self, joint: int) -> None:
        self._fault(sensor_broken=joint)

    def close_switch(self, joint: int) -> None:
        self._fault(limit_switch=joint)

    def _fault(self, **fault: bool | int) -> None:
        self._board.faults = replace(self._board.faults, **fault)  # type: ignore[arg-type]


@contextmanager
def board_on_stage(name: str) -> Iterator[BoardOnStage]:
    """`uno delta3_dc`, `live-uno delta3_dc`, `stm32 par4_dc` or `sim:par4`."""
    kind, _, variant = name.partition(" ")
    stepper = variant.endswith("stepper")
    if kind == "uno":
        with closing(Rig(variant)) as rig:
            yield Uno(rig, stepper)
    elif kind == "live-uno":
        with closing(UnoPty(variant, BOOT_MS)) as board:
            yield LiveUno(board, stepper)
    elif kind == "stm32":
        with running_stm32(variant) as stm32:
            yield Stm(stm32, 3 if variant.startswith("linear") else 4)
    else:
        yield InProcess(name)


_UNO = ("gcc", "make", "avr-gcc", "simavr/sim_avr.h")
NEEDS = {"uno": _UNO, "live-uno": _UNO, "stm32": ("make", "arm-none-eabi-gcc", "qemu-system-arm")}
"""Programs that the computer must have, by kind of board."""
