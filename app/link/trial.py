"""A TEST on the board: started, recorded, ended."""

from __future__ import annotations

from concurrent.futures import Future

from app.link.conversation import Refused, Script
from app.link.errors import LinkError
from app.link.protocol.codes import Refusal, State
from app.link.protocol.messages import Sample, Telemetry, Test
from app.link.twin.recorder import Recorder
from app.link.twin.recording import Recording

SLACK_S = 0.5
"""A test is over so long after its time at the latest."""


class Trial:
    """From the question to the last sample."""

    def __init__(self, test: Test, recorder: Recorder) -> None:
        self.test, self._recorder = test, recorder
        self.answer: Future[Recording] = Future()
        self._state = State.READY
        self._began_s: float | None = None

    @property
    def done(self) -> bool:
        return self.answer.done()

    def script(self) -> Script[None]:
        """Ask for the test. Where the board's answer got lost, the repeated question finds it busy with it."""
        try:
            yield self.test
        except Refused as refused:
            if not (refused.refusal is Refusal.BUSY and self._state is State.TESTING):
                raise

    def heard(self, telemetry: Telemetry, now: float) -> None:
        before, self._state = self._state, telemetry.state
        self._recorder.append(telemetry, now)
        if telemetry.state is State.TESTING:
            self._began_s = now if self._began_s is None else self._began_s
        elif before is State.TESTING and telemetry.state is State.READY:
            self.answer.set_result(self._recorder.recording())
        elif telemetry.state is not State.READY:
            self.fail(LinkError("The test was broken off; look at the state of the board, and try again."))

    def sampled(self, sample: Sample, now: float) -> None:
        self._recorder.append_sample(sample, now)

    def begun(self, answer: Future[None]) -> None:
        """The board's answer to the question."""
        error = answer.exception()
        if isinstance(error, LinkError):
            self.fail(error)

    def tick(self, now: float) -> None:
        if self._began_s is not None and now - self._began_s > 1e-3 * self.test.duration_ms + SLACK_S:
            self.fail(LinkError("The test did not end in time; stop the robot and try again."))

    def fail(self, error: LinkError) -> None:
        if not self.done:
            self.answer.set_exception(error)
