"""Lessons played without a page: every step's solution must pass, and its wrong solution must not.

The state behind the page is the real one; its slow work is done by threads of this process, the robot on the table is
an emulated board. Where there is something to wait for, it is awaited; nothing is timed.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Iterator
from concurrent.futures import ThreadPoolExecutor

from app.classroom.lessons.lesson import Lesson, Play, Press, Question, Set, Step
from app.errors import UserMistake
from app.ui.compute import Pools
from app.ui.desks import Desks
from app.ui.hardware.workshop import Workshop
from app.ui.lessons.apparatus import Apparatus
from app.ui.lessons.examiner import LOOKS_TO_PASS, Examiner
from app.ui.lessons.setting_up import set_up
from app.ui.session import Session
from app.ui.staff import Staff
from app.ui.state import Memory

POLL_S = 0.01
ALIVE_EVERY = 50
"""Polls between two signs of life for the robot on the table."""

PATIENCE_S = 90.0
"""For one action: then it is given up."""

REPORT_S = 5.0
"""How long the robot on the table may take to report what the checks want to know."""

THREADS = 2


class Stage:
    """A student's page without the page."""

    def __init__(self, robot: str, pool: ThreadPoolExecutor) -> None:
        self.told: list[str] = []
        """What the page would have said."""
        session = Session(Memory(robot))
        self._workshop = Workshop()
        staff = Staff(Pools(pool, pool), self.told.append)
        self.desks = Desks(session, staff, self._workshop, "player", lambda sentence, _: self.told.append(sentence))
        self.apparatus = Apparatus(session, self.desks)
        self._was_held = False

    @property
    def has_robot(self) -> bool:
        """Whether there is a robot on the table."""
        return self.desks.has_hardware and self._workshop.status.phase != "none"

    async def settle(self, examiner: Examiner | None = None) -> None:
        """Wait until nothing computes and what was pressed has ended; an examiner looks on.

        Raises:
            UserMistake: it does not end.
        """
        for poll in range(round(PATIENCE_S / POLL_S)):
            if examiner is not None:
                examiner.look()
            if not self.apparatus.busy and not self.apparatus.waits:
                self.desks.stand_still()
                return
            if poll % ALIVE_EVERY == 0 and self.desks.has_hardware:
                self._look_after_robot()
            await asyncio.sleep(POLL_S)
        self.apparatus.give_up()
        raise UserMistake(f"What was begun does not end. {' '.join(self.told)}".strip())

    def _look_after_robot(self) -> None:
        """Signs of life; and on a busy computer an emulated board may hold, as it should: it goes on then."""
        self.desks.hardware.alive()
        state = self.apparatus.value("link.state")
        if state == "held" and self.apparatus.waits:
            self._was_held = True
            self.desks.hardware.do("resume")
        elif self._was_held and state == "ready" and self.apparatus.value("link.activity") == "idle":
            self._was_held = False
            self.apparatus.press_again()

    def close(self) -> None:
        self.desks.close()
        self._workshop.close()


def play(lesson: Lesson) -> list[str]:
    """Complaints, a sentence each with the place in the file; none for a lesson that is fine."""
    return asyncio.run(_play(lesson))


async def _play(lesson: Lesson) -> list[str]:
    complaints: list[str] = []
    async with _stage(lesson.robot) as stage:
        for step in lesson.steps:
            complaints += [_placed(lesson, step, *found) for found in await _play_step(stage, lesson, step)]
    return complaints


@contextlib.asynccontextmanager
async def _stage(robot: str) -> AsyncIterator[Stage]:
    with ThreadPoolExecutor(THREADS) as pool:
        stage = Stage(robot, pool)
        try:
            yield stage
        finally:
            stage.close()


def _placed(lesson: Lesson, step: Step, line: int, sentence: str) -> str:
    return f"{lesson.path}:{line or step.line}: step {step.number}, {step.title}: {sentence}"


async def _play_step(stage: Stage, lesson: Lesson, step: Step) -> list[tuple[int, str]]:
    """Line and sentence of each complaint. The wrong solution comes first: a student who errs can still do it."""
    complaints: list[tuple[int, str]] = []
    try:
        if step.wrong is not None:
            complaints += await _play_wrong(stage, lesson, step, step.wrong)
        if step.solution is not None:
            complaints += await _play_solution(stage, lesson, step, step.solution)
        if step.solution is None and step.wrong is None:
            await _begin(stage, lesson, step)
    except UserMistake as mistake:
        complaints.append((step.line, str(mistake)))
    return complaints


async def _begin(stage: Stage, lesson: Lesson, step: Step) -> Examiner:
    stage.told.clear()
    if refusal := set_up(stage.apparatus, lesson, step):
        raise UserMistake(refusal)
    if step.tab:
        stage.apparatus.set("tab", step.tab)
    await stage.settle()
    examiner = Examiner(stage.apparatus, step)
    examiner.look()  # which begins to compute what the checks are about
    await stage.settle()
    return Examiner(stage.apparatus, step)


async def _play_wrong(stage: Stage, lesson: Lesson, step: Step, wrong: Play) -> list[tuple[int, str]]:
    examiner = await _begin(stage, lesson, step)
    complaints: list[tuple[int, str]] = []
    if step.act is not None:
        if await _judge(stage, examiner):
            complaints.append((step.line, "The act is done before anything was done: change its checks or the set-up."))
        elif await _act(stage, examiner, wrong):
            complaints.append((wrong.line, "The wrong solution passes the act: make a check stricter."))
    for name, question, answer in _answers(step, wrong):
        if question is not None and answer is not None and question.grade(answer).right:
            complaints.append((wrong.line, f"The wrong answer to {name} is judged right."))
    return complaints


async def _play_solution(stage: Stage, lesson: Lesson, step: Step, solution: Play) -> list[tuple[int, str]]:
    examiner = await _begin(stage, lesson, step)
    complaints: list[tuple[int, str]] = []
    if step.act is not None and not (await _act(stage, examiner, solution) or await _wait(stage, examiner)):
        complaints.append((solution.line, _missing(stage, examiner)))
    for name, question, answer in _answers(step, solution):
        if question is not None and answer is None:
            complaints.append((solution.line, f"The solution does not answer {name}."))
        elif question is not None and answer is not None and not question.grade(answer).right:
            complaints.append((solution.line, f"The solution's answer to {name} ({answer:g}) is judged wrong."))
    return complaints


def _answers(step: Step, play: Play) -> Iterator[tuple[str, Question | None, float | None]]:
    yield "Predict", step.predict, play.predict
    yield "Explain", step.explain, play.explain
    yield "One more", step.more, play.more


async def _act(stage: Stage, examiner: Examiner, play: Play) -> bool:
    """Do what the play does; whether the act was passed at any time."""
    passed = False
    for deed in play.deeds:
        match deed:
            case Set(fact, to):
                stage.apparatus.set(fact, to)
            case Press(name):
                await stage.settle(examiner)
                stage.apparatus.press(name)
        passed = await _judge(stage, examiner) or passed
    return await _judge(stage, examiner) or passed


async def _wait(stage: Stage, examiner: Examiner) -> bool:
    """What a robot on the table reports comes a little later, as it does for a student."""
    for _ in range(round(REPORT_S / POLL_S) if stage.has_robot else 0):
        await asyncio.sleep(POLL_S)
        if await _judge(stage, examiner):
            return True
    return False


async def _judge(stage: Stage, examiner: Examiner) -> bool:
    """As the page does it: all checks must hold for two looks."""
    examiner.look()
    await stage.settle(examiner)
    for _ in range(LOOKS_TO_PASS):
        examiner.look()
    return examiner.passed


def _missing(stage: Stage, examiner: Examiner) -> str:
    open_ = [f"“{verdict.says}” (it is {_shown(verdict.value)})" for verdict in examiner.verdicts if not verdict.met]
    astray = f" Set up, and changed: {', '.join(examiner.astray)}." if examiner.astray else ""
    told = f" The page said: {' '.join(dict.fromkeys(stage.told))}" if stage.told else ""
    return f"The solution does not pass: {', '.join(open_) or 'not all checks hold at once'}.{astray}{told}"


def _shown(value: object) -> str:
    if value is None:
        return "not there"
    return f"{value:.5g}" if isinstance(value, float) else str(value)
