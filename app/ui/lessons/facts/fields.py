"""Which file knows the facts of a namespace. It is loaded when somebody first wants one of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from app.ui.desks import Desks
from app.ui.lessons.facts.field import Field


def _robot(desks: Desks) -> Field:
    from app.ui.lessons.facts.robot import RobotFacts

    return RobotFacts(desks.session).field()


def _view(desks: Desks) -> Field:
    from app.ui.lessons.facts.robot import view_field

    return view_field(desks.session)


def _control(desks: Desks) -> Field:
    from app.ui.lessons.facts.control import ControlFacts

    return ControlFacts(desks).field()


def _runs(desks: Desks) -> Field:
    from app.ui.lessons.facts.runs import RunFacts

    return RunFacts(desks).field()


def _motor(desks: Desks) -> Field:
    from app.ui.lessons.facts.runs import MotorFacts

    return MotorFacts(desks).field()


def _motion(desks: Desks) -> Field:
    from app.ui.lessons.facts.motion import MotionFacts

    return MotionFacts(desks).field()


def _map(desks: Desks) -> Field:
    from app.ui.lessons.facts.motion import MapFacts

    return MapFacts(desks).field()


def _compare(desks: Desks) -> Field:
    from app.ui.lessons.facts.compare import CompareFacts

    return CompareFacts(desks).field()


def _drawing(desks: Desks) -> Field:
    from app.ui.lessons.facts.drawing import DrawingFacts

    return DrawingFacts(desks).field()


SPACES: Mapping[Callable[[Desks], Field], tuple[str, ...]] = {
    _robot: ("robot", "preset", "geometry", "pose", "wish", "joint", "reach", "conditioning", "solutions"),
    _view: ("view",),
    _control: ("control", "step", "ideal", "margin", "kept"),
    _runs: ("run", "before"),
    _motor: ("motor", "identify", "found"),
    _motion: ("motion", "cycle"),
    _map: ("map",),
    _compare: ("compare", "compare_before"),
    _drawing: ("drawing",),
}


class Fields:
    """By namespace. `others` are known already."""

    def __init__(self, desks: Desks, others: Mapping[str, Callable[[], Field]]) -> None:
        self._desks = desks
        self._others = others
        self._loaded: dict[str, Field] = {}

    def of(self, fact: str) -> Field:
        """The field of a fact; an empty one for a namespace that does not exist."""
        space = fact.partition(".")[0]
        if space not in self._loaded:
            self._load(space)
        return self._loaded[space]

    def _load(self, space: str) -> None:
        if space in self._others:
            self._loaded[space] = self._others[space]()
            return
        for make, spaces in SPACES.items():
            if space in spaces:
                self._loaded |= dict.fromkeys(spaces, make(self._desks))
                return
        self._loaded[space] = Field()
