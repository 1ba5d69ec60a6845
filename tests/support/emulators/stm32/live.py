"""A board to try things on by hand: `python -m tests.support.emulators.stm32.live par4_dc` prints its port."""

from __future__ import annotations

import sys
import time

from tests.support.emulators.stm32.qemu import running_stm32


def main(variant: str = "par4_dc") -> None:
    with running_stm32(variant) as board:
        print(f"{variant} at {board.port}; end it with Ctrl-C", flush=True)
        while board.outputs.ticks >= 0:
            time.sleep(1.0)


if __name__ == "__main__":
    main(*sys.argv[1:2])
