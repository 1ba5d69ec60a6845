"""Controllers compared, as lessons read and set them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from app.classroom.lessons.lesson import Value
from app.control.laws import LAWS
from app.errors import UserMistake
from app.ui.compare.desk import CompareDesk
from app.ui.compare.score import IN_PLANE, LATER, POSITION, TURNS, WHOLE, Score, quantities, ranking
from app.ui.compare.settings import TASKS, tasks_for
from app.ui.desks import Desks
from app.ui.lessons.facts.field import Field, Read

SETTINGS: Mapping[str, tuple[str, float | None]] = {
    "gains": ("gains", None),
    "bandwidth": ("bandwidth_hz", 1.0),
    "friction": ("friction", 1.0),
    "payload": ("payload_kg", 1.0),
    "model_error": ("model_error", 0.01),
    "encoder_step": ("encoder_step", 1e-3),
    "delay": ("delay_samples", 1.0),
    "filter": ("velocity_filter_hz", 1.0),
    "limit_effort": ("limit_effort", None),
    "limit_speed": ("limit_speed", None),
    "plant": ("plant", None),
}
"""Field of the settings, and the factor from what is read; None for words and switches."""

SCORES: Mapping[str, Callable[[Score], float]] = {
    "rms": lambda score: score.rms_of(POSITION, WHOLE),
    "peak": lambda score: score.peak_of(POSITION, WHOLE),
    "later_rms": lambda score: score.rms_of(POSITION, LATER),
    "later_peak": lambda score: score.peak_of(POSITION, LATER),
    "plane_rms": lambda score: score.rms_of(IN_PLANE, WHOLE),
    "z_rms": lambda score: score.rms_of("z", WHOLE),
    "later_plane_rms": lambda score: score.rms_of(IN_PLANE, LATER),
    "later_z_rms": lambda score: score.rms_of("z", LATER),
    "effort_peak": lambda score: 100.0 * score.strain,
    "saturation": lambda score: 100.0 * max(score.saturation),
}


class CompareFacts:
    """`compare.*` and `compare_before.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks

    def field(self) -> Field:
        return Field(
            {**self._settings(), **self._results()},
            self._writers(),
            read_each=self._by_law(),
            write_each={"compare.own_hz.": self._set_own},
        )

    def _settings(self) -> dict[str, Read]:
        desk = self._get
        read: dict[str, Read] = {
            f"compare.{name}": partial(self._read, field, factor) for name, (field, factor) in SETTINGS.items()
        }
        return {
            **read,
            "compare.task": lambda: desk().settings.task,
            "compare.laws": lambda: ", ".join(desk().settings.laws),
            "compare.quantity": lambda: desk().look.quantity,
            "compare.stretch": lambda: desk().look.stretch,
        }

    def _results(self) -> dict[str, Read]:
        return {
            "compare.count": lambda: len(self._scores()),
            "compare.best": lambda: self._best(POSITION, WHOLE),
            "compare.later_best": lambda: self._best(POSITION, LATER),
            "compare.looked_best": lambda: self._best(self._get().look.quantity, self._get().look.stretch),
        }

    def _by_law(self) -> dict[str, Callable[[str], Value | None]]:
        now: dict[str, Callable[[str], Value | None]] = {
            f"compare.{name}.": partial(self._score, self._scores, get) for name, get in SCORES.items()
        }
        before = {
            f"compare_before.{name}.": partial(self._score, self._scores_before, SCORES[name])
            for name in ("rms", "later_rms")
        }
        return {
            **now,
            **before,
            "compare.turn_rms.": self._turn,
            "compare.place.": partial(self._place, self._scores, WHOLE),
            "compare.later_place.": partial(self._place, self._scores, LATER),
            "compare_before.place.": partial(self._place, self._scores_before, WHOLE),
            "compare.own_hz.": lambda law: self._get().settings.own_hz.get(law, self._get().settings.bandwidth_hz),
        }

    def _writers(self) -> dict[str, Callable[[Any], None]]:
        desk = self._get
        write: dict[str, Callable[[Any], None]] = {
            f"compare.{name}": partial(self._write, field, factor) for name, (field, factor) in SETTINGS.items()
        }
        return {
            **write,
            "compare.task": self._choose_task,
            "compare.laws": self._choose_laws,
            "compare.quantity": self._look_in,
            "compare.stretch": lambda stretch: desk().look_at(stretch=stretch),
            "compare.count": lambda count: desk().forget() if count == 0 else None,
        }

    def _get(self) -> CompareDesk:
        return self._desks.compare

    def _read(self, field: str, factor: float | None) -> Value:
        value = getattr(self._get().settings, field)
        return value if factor is None else value / factor

    def _write(self, field: str, factor: float | None, value: Any) -> None:
        if factor is not None:
            value = round(value) if field == "delay_samples" else float(value) * factor
        self._get().change(**{field: value})

    def _scores(self) -> Mapping[str, Score]:
        """Of what is set now."""
        compared = self._get().comparison
        return compared.scores if compared is not None and compared.settings == self._get().settings else {}

    def _scores_before(self) -> Mapping[str, Score]:
        before = self._get().before
        return before.scores if before is not None else {}

    def _score(
        self, scores: Callable[[], Mapping[str, Score]], get: Callable[[Score], float], law: str
    ) -> Value | None:
        score = scores().get(law)
        return None if score is None else get(score)

    def _turn(self, law: str) -> Value | None:
        score = self._scores().get(law)
        turn = None if score is None else next((name for name in TURNS.values() if name in score.quantities), None)
        return None if score is None or turn is None else score.rms_of(turn, WHOLE)

    def _place(self, scores: Callable[[], Mapping[str, Score]], stretch: str, law: str) -> Value | None:
        order = ranking(scores(), POSITION, stretch)
        return order.index(law) + 1 if law in order else None

    def _best(self, quantity: str, stretch: str) -> str | None:
        """Once all have answered."""
        scores = self._scores()
        answered = self._get().comparison
        if answered is None or len(scores) + len(answered.refusals) < len(answered.settings.laws):
            return None
        return next(iter(ranking(scores, quantity, stretch)), None)

    def _choose_task(self, task: str) -> None:
        known = tasks_for(self._desks.session.robot_name)
        if task not in known:
            raise UserMistake(f"This robot has no task {task}: choose one of {', '.join(known)}.")
        self._get().change(task=task, friction=TASKS[task].friction)

    def _choose_laws(self, text: str) -> None:
        wanted = {law.strip() for law in text.split(",")}
        if unknown := wanted - LAWS.keys():
            raise UserMistake(f"There is no controller {min(unknown)}: choose among {', '.join(LAWS)}.")
        self._get().change(laws=tuple(law for law in LAWS if law in wanted))

    def _set_own(self, law: str, hertz: float) -> None:
        if law not in LAWS:
            raise UserMistake(f"There is no controller {law}: choose among {', '.join(LAWS)}.")
        self._get().change(own_hz={**self._get().settings.own_hz, law: float(hertz)})

    def _look_in(self, quantity: str) -> None:
        known = quantities(self._desks.session.robot.pose_names)
        if quantity not in known:
            raise UserMistake(f"Errors cannot be looked at in {quantity}: choose one of {', '.join(known)}.")
        self._get().look_at(quantity=quantity)
