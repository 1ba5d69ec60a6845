"""The workers of one browser: hired when somebody needs one, sent home when the browser leaves."""

from __future__ import annotations

from collections.abc import Callable

from app.ui.compute import Pools, Worker


class Staff:
    """Lines of work in the two pools; `tell` shows one sentence about a failure."""

    def __init__(self, pools: Pools, tell: Callable[[str], None]) -> None:
        self._pools = pools
        self.tell = tell
        self._workers: list[Worker] = []

    @property
    def busy(self) -> bool:
        """Whether any of them still works."""
        return any(worker.busy for worker in self._workers)

    def quick(self) -> Worker:
        """A line of quick work."""
        return self._hire(Worker(self._pools.quick, self.tell))

    def slow(self, failed: Callable[[], None] | None = None) -> Worker:
        """A line of slow work; `failed` is called after a job of it could not be done and the user was told."""

        def tell(sentence: str) -> None:
            self.tell(sentence)
            if failed is not None:
                failed()

        return self._hire(Worker(self._pools.slow, tell))

    def cancel(self) -> None:
        """Forget all that was asked for."""
        for worker in self._workers:
            worker.cancel()

    def _hire(self, worker: Worker) -> Worker:
        self._workers.append(worker)
        return worker
