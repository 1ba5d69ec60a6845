"""What this browser has that the robot on the table could run: its drawing, and the run of its control lab."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

from app.ui.hardware import jobs

if TYPE_CHECKING:
    from app.link.programs import Program
    from app.simulation import Run
    from app.ui.drawing.jobs import Sketch
    from app.ui.refusal import Refusal


class Offer(NamedTuple):
    """Something to run; `job` makes the program of it, in a worker."""

    title: str
    job: Callable[[], Program | Refusal]


class Shelf(NamedTuple):
    """Where the other labs of this browser keep what they have."""

    drawing: Callable[[], Sketch | None]
    """What the tab Draw has planned, None before that."""
    run: Callable[[], Run | None]
    """What the tab Control shows, None before the first run."""

    def offers(self) -> list[Offer]:
        found = []
        drawing, run = self.drawing(), self.run()
        if drawing is not None:
            found.append(Offer("The drawing of the tab Draw", partial(jobs.drawing_program, drawing)))
        if run is not None:
            found.append(Offer(f"The run “{run.title}”", partial(jobs.run_program, run)))
        return found
