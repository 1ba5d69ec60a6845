"""The comparison of one browser: what is set, what came of it, what is looked at. No widgets here.

The laws run one after the other in a worker; results appear as they come, and a newer comparison wins.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from app.robots import Robot
from app.signal import Signal
from app.ui.compare.jobs import Result, run_law
from app.ui.compare.score import LATER, POSITION, WHOLE, Score, ranking
from app.ui.compare.settings import FEWEST_LAWS, MOST_LAWS, PLANNED, CompareSettings, default_compare, difference
from app.ui.motion.desk import MotionDesk
from app.ui.refusal import Refusal
from app.ui.series import Series
from app.ui.session import Session

HELICES = frozenset({"T1", "T2"})
"""Their first second shows how a run begins rather than how well a law tracks."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """What has come of some settings so far."""

    settings: CompareSettings
    results: Mapping[str, Result] = field(default_factory=dict)
    """By law, in the order of the settings."""
    refusals: Mapping[str, str] = field(default_factory=dict)
    """Why a law could not run."""

    @property
    def scores(self) -> dict[str, Score]:
        return {law: result.score for law, result in self.results.items()}

    def received(self, law: str, result: Result | Refusal) -> Comparison:
        """With one more answer."""
        if isinstance(result, Refusal):
            return replace(self, refusals={**self.refusals, law: result.reason})
        return replace(self, results={**self.results, law: result})


@dataclass(frozen=True)
class Before:
    """The comparison before this one, as far as it is worth remembering."""

    settings: CompareSettings
    scores: Mapping[str, Score]


@dataclass(frozen=True)
class Look:
    """What of the results is looked at."""

    quantity: str = POSITION
    stretch: str = WHOLE
    joint: int = 0
    law: str = ""
    """Whose torque is taken apart; one that is not there: the best one's."""


class CompareDesk:
    """The state behind every panel that compares controllers."""

    def __init__(self, session: Session, motion: MotionDesk, series: Series, tell: Callable[[str], None]) -> None:
        self.settings_changed: Signal[CompareSettings] = Signal()
        self.answered: Signal[Comparison | None] = Signal()
        """Another result is there, or all are gone."""
        self.finished: Signal[Comparison] = Signal()
        """All laws have answered."""
        self.looked: Signal[Look] = Signal()
        self.series = series
        self.motion = motion
        self._session = session
        self._tell = tell
        kept = session.comparison
        self.settings = kept if kept and kept.robot == session.robot_name else default_compare(session.robot_name)
        self.comparison: Comparison | None = None
        self.before: Before | None = None
        """The last comparison of the same robot and task."""
        self.look = Look()
        session.robot_changed.connect(self._follow_robot)

    @property
    def robot(self) -> Robot:
        return self._session.robot

    @property
    def busy(self) -> bool:
        return self.series.busy

    def change(self, **values: object) -> None:
        """Set some values."""
        self.settings = self._session.comparison = replace(self.settings, **values)  # type: ignore[arg-type]
        self.settings_changed.emit(self.settings)

    def look_at(self, **values: object) -> None:
        """Look at something else of the same results."""
        self.look = replace(self.look, **values)  # type: ignore[arg-type]
        self.looked.emit(self.look)

    def run(self) -> None:
        """Compare. What cannot be is said in a sentence, and the last comparison stays."""
        settings, planned = self.settings, self.motion.motion
        if reason := self._why_not():
            self._tell(reason)
            return
        motion = planned if settings.task == PLANNED else None
        self._remember()
        if self.comparison is None or _subject(self.comparison.settings) != _subject(settings):
            self.look = replace(self.look, stretch=LATER if settings.task in HELICES else WHOLE)
        self.comparison = Comparison(settings)
        dimensions = dict(self._session.dimensions)
        jobs = [(run_law, (settings, law, dimensions, motion)) for law in settings.laws]
        waiting = iter(settings.laws)
        self.series.start(jobs, lambda result: self._receive(next(waiting), result))

    def cancel(self) -> None:
        """Keep what is there, and drop the rest."""
        self.series.cancel()

    def forget(self) -> None:
        """Nothing was compared yet."""
        self.series.cancel()
        self.comparison = self.before = None
        self.answered.emit(None)

    def tell_again(self) -> None:
        """For listeners that came later."""
        if self.comparison is not None:
            self.answered.emit(self.comparison)

    def best(self) -> str | None:
        """The law that is first for what is looked at."""
        scores = self.comparison.scores if self.comparison is not None else {}
        return next(iter(ranking(scores, self.look.quantity, self.look.stretch)), None)

    def places_before(self) -> Mapping[str, int]:
        """Place of each law, from 1, in the comparison before, if that compared the same laws."""
        now = self.comparison
        if now is None or self.before is None or self.before.scores.keys() != now.results.keys():
            return MappingProxyType({})
        order = ranking(self.before.scores, self.look.quantity, self.look.stretch)
        return MappingProxyType({law: place for place, law in enumerate(order, 1)})

    def what_changed(self) -> str:
        """What the comparison before had otherwise, in words."""
        if self.comparison is None or self.before is None:
            return ""
        return difference(self.before.settings, self.comparison.settings)

    def _why_not(self) -> str:
        settings = self.settings
        if not FEWEST_LAWS <= len(settings.laws) <= MOST_LAWS:
            return f"Choose {FEWEST_LAWS} to {MOST_LAWS} controllers to compare; {len(settings.laws)} are chosen now."
        if settings.task == PLANNED and self.motion.motion is None:
            return "There is no planned motion yet: plan one under Motion, or choose another task."
        return ""

    def _remember(self) -> None:
        old = self.comparison
        if old is not None and old.results:
            self.before = Before(old.settings, old.scores)
        if self.before is not None and _subject(self.before.settings) != _subject(self.settings):
            self.before = None

    def _receive(self, law: str, result: Result | Refusal) -> None:
        if self.comparison is None:
            return
        self.comparison = self.comparison.received(law, result)
        self.answered.emit(self.comparison)
        if len(self.comparison.results) + len(self.comparison.refusals) == len(self.comparison.settings.laws):
            self.finished.emit(self.comparison)

    def _follow_robot(self, robot: Robot) -> None:
        """Runs belong to a robot of certain dimensions."""
        self.series.cancel()
        self.comparison = self.before = None
        if robot.name != self.settings.robot:
            self.look = Look()
            self.settings = default_compare(robot.name)
            self.settings_changed.emit(self.settings)
        self.answered.emit(None)


def _subject(settings: CompareSettings) -> tuple[str, str]:
    return settings.robot, settings.task
