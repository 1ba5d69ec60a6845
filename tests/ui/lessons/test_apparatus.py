"""What lessons read, set and press, on desks without a page; and that the catalogue promises nothing else."""

from __future__ import annotations

import math

import pytest

from app.classroom.lessons.catalogue import FACTS, PRESSES, fact_kind
from app.classroom.lessons.known import control as known_control
from app.classroom.lessons.known import drawing as known_drawing
from app.classroom.lessons.known import motion as known_motion
from app.classroom.lessons.lesson import Act, Check, Step
from app.control.identification.excitation import EXCITATIONS
from app.control.laws import LAWS
from app.control.tuning.methods import METHODS
from app.drawing.modes import DRAWING_MODES
from app.drawing.modes import PRESETS as DRAWING_PRESETS
from app.drawing.samples import SAMPLES
from app.errors import UserMistake
from app.motion import CURVES, PATHS, PROFILES
from app.robots.maps import MAPS
from app.ui.lab.settings import BY_HAND
from app.ui.lessons.apparatus import Apparatus
from app.ui.lessons.play import Stage
from app.ui.tabs import LABELS
from tests.support.lesson_stage import on_stage, settled

EXAMPLES = {
    "geometry.*": "geometry.L",
    "joint.*": "joint.q1",
    "run.ise.*": "run.ise.q1",
    "before.ise.*": "before.ise.q1",
    "drawing.knob.*": "drawing.knob.smooth",
    "link.pose.*": "link.pose.x",
    "link.joint.*": "link.joint.q1",
    **{name: name.replace("*", "q1") for name in FACTS if name.startswith("motion.") and "*" in name},
    **{name: name.replace("*", "PD") for name in FACTS if name.startswith("compare") and "*" in name},
}
ONLY_SET = {"drawing.preset"}


def test_the_catalogue_knows_the_words_of_the_labs():
    assert (BY_HAND, *METHODS) == known_control.TUNINGS
    assert tuple(PATHS) == known_control.PATHS
    assert fact_kind("identify.signal").options == tuple(EXCITATIONS)  # type: ignore[union-attr]
    assert (tuple(CURVES), tuple(PROFILES)) == (known_motion.CURVES, known_motion.PROFILES)
    assert (tuple(LAWS), tuple(MAPS)) == (known_motion.LAWS, known_motion.QUANTITIES)
    assert tuple(SAMPLES) == known_drawing.SAMPLES
    assert (tuple(DRAWING_MODES), tuple(DRAWING_PRESETS)) == (known_drawing.MODES, known_drawing.PRESETS)
    assert FACTS["tab"].options == LABELS


def test_every_fact_is_known_and_has_the_type_that_the_catalogue_says():
    async def scene(stage: Stage) -> None:
        for name, kind in FACTS.items():
            if name in ONLY_SET:
                continue
            value = stage.apparatus.value(EXAMPLES.get(name, name))
            assert stage.apparatus.knows(EXAMPLES.get(name, name)), name
            types = {"number": (int, float), "word": (str,), "flag": (bool,)}[kind.kind]
            assert value is None or (isinstance(value, types) and isinstance(value, bool) == (kind.kind == "flag")), (
                name
            )
            if kind.options and value is not None and value != "":
                assert value in kind.options, name

    on_stage(scene)


def test_every_writable_fact_can_be_set_and_every_action_exists():
    async def scene(stage: Stage) -> None:
        for name, kind in FACTS.items():
            assert stage.apparatus.can_set(EXAMPLES.get(name, name)) == kind.writable, name
        assert set(stage.apparatus.actions) == set(PRESSES)

    on_stage(scene)


def test_a_pose_that_is_set_one_number_after_the_other_counts_as_one():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        for name, value in (("pose.x", 150.0), ("pose.y", 0.0), ("pose.z", -280.0), ("pose.x", 20.0)):
            lab.set(name, value)
        found = [lab.value(f"pose.{name}") for name in "xyz"]
        assert found == pytest.approx([20.0, 0.0, -280.0]) and lab.value("reach.ok") is True
        joints = [lab.value(f"joint.q{k}") for k in (1, 2, 3, 4)]
        lab.press("home")
        for k, value in enumerate(joints, 1):
            lab.set(f"joint.q{k}", value)  # type: ignore[arg-type]
        assert [lab.value(f"pose.{name}") for name in "xyz"] == pytest.approx(found, abs=1e-6)

    on_stage(scene)


def test_out_of_reach_the_kind_of_limit_is_told():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.set("pose.x", 900.0)
        assert lab.value("reach.ok") is False and lab.value("reach.kind") == "too short"
        lab.press("home")
        lab.set("wish.x", 180.0)
        assert lab.value("reach.kind") == "arm stop" and lab.value("reach.leg") in (1, 2, 3, 4)
        assert lab.value("wish.x") == pytest.approx(180.0) and lab.value("pose.x") < 180.0  # type: ignore[operator]
        lab.press("release")
        assert lab.value("wish.x") == lab.value("pose.x")

    on_stage(scene)


def test_dimensions_and_presets_are_set_and_refused():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        assert lab.value("preset") == "desk_A4"
        lab.set("geometry.rf", 170.0)
        assert lab.value("geometry.rf") == pytest.approx(170.0) and lab.value("preset") == "changed"
        lab.set("preset", "classic")
        assert lab.value("preset") == "classic"
        for fact, value, word in (("geometry.rf", 9000.0, "between"), ("geometry.q", 1.0, "no dimension")):
            with pytest.raises(UserMistake, match=word):
                lab.set(fact, value)

    on_stage(scene, "delta3")


@pytest.mark.parametrize(
    ("fact", "value", "sentence"),
    [
        ("pose.q", 1.0, "no fact"),
        ("conditioning", 1.0, "cannot be set"),
        ("pose.x", "left", "give a number"),
        ("pose.x", True, "give a number"),
        ("pose.x", math.nan, "give a number"),
        ("view.frames", 1.0, "true or false"),
        ("control.tuning", "Magic", "choose one of"),
        ("control.period", 0.0, "larger number"),
        ("compare.laws", "PD, XYZ", "no controller XYZ"),
        ("cycle.on", True, "five-bar"),
        ("link.line_noise", 1.0, "No emulated board"),
        ("drawing.speed", 0.0, "speed"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(fact: str, value: float | str | bool, sentence: str):
    async def scene(stage: Stage) -> None:
        with pytest.raises(UserMistake, match=sentence):
            stage.apparatus.set(fact, value)

    on_stage(scene)


def test_a_step_response_belongs_to_what_is_set():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        overshoot, phase = await settled(stage, "step.overshoot", "margin.phase")
        assert isinstance(overshoot, float) and isinstance(phase, float)
        lab.press("keep")
        lab.set("control.kp", 20.0)
        assert lab.value("step.overshoot") is None, "that of other gains is none"
        assert lab.value("control.tuning") == BY_HAND
        later, kept = await settled(stage, "step.overshoot", "kept.overshoot")
        assert kept == overshoot and later != overshoot
        lab.set("kept.on", False)
        assert lab.value("kept.overshoot") is None

    on_stage(scene)


def test_runs_know_how_they_were_set():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.set("run.lap", 5.0)
        for tuning in known_control.TUNINGS[1:3]:
            lab.set("control.tuning", tuning)
            await stage.settle()
            lab.press("run")
            await stage.settle()
        used = [lab.value("before.used_tuning"), lab.value("run.used_tuning")]
        assert used == list(known_control.TUNINGS[1:3]) and lab.value("run.count") == 2
        assert lab.value("run.ise") == pytest.approx(sum(lab.value(f"run.ise.q{k}") for k in (1, 2, 3, 4)))  # type: ignore[misc]
        assert 0.0 < lab.value("run.jump_share") <= 100.0  # type: ignore[operator]
        step = Step(1, "", 1.0, "", act=Act("", (Check("run.ise", "deg^2 s", "", at_most=1.0),)))
        plots = lab.evidence(step)
        assert plots and all(len(one["x"]) <= 300 for plot in plots for one in plot["series"])
        lab.set("run.count", 0)
        assert lab.value("run.ise") is None

    on_stage(scene)


def test_an_identified_motor_belongs_to_its_test():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.set("identify.duration", 8.0)
        lab.press("identify")
        await stage.settle()
        assert lab.value("found.fit") > 50.0 and lab.value("found.count") == 1  # type: ignore[operator]
        lab.set("identify.noise", 0.1)
        assert lab.value("found.fit") is None
        lab.press("use_motor")
        assert lab.value("motor.identified") is True

    on_stage(scene)


def test_a_motion_and_a_comparison_belong_to_what_is_set():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.set("motion.size", 30.0)
        lab.set("motion.curve", "circle")
        planned, usage = await settled(stage, "motion.planned", "motion.usage")
        assert planned is True and 0.0 < usage <= 101.0  # type: ignore[operator]
        lab.press("play")
        await stage.settle()
        assert lab.value("motion.played") == pytest.approx(100.0)
        lab.set("compare.task", "planned")
        lab.set("compare.laws", "CTC, PD")
        assert lab.value("compare.laws") == "PD, CTC"
        lab.press("compare")
        await stage.settle()
        assert lab.value("compare.count") == 2 and lab.value("compare.place.CTC") in (1, 2)
        lab.set("compare.payload", 0.5)
        assert lab.value("compare.count") == 0 and lab.value("compare.rms.PD") is None

    on_stage(scene, "linear")


def test_a_drawing_is_set_drawn_and_saved():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.set("drawing.text", "L")
        strokes, time_s, own = await settled(stage, "drawing.strokes", "drawing.time", "drawing.own")
        assert strokes == 1 and time_s > 0.0 and own is True  # type: ignore[operator]
        lab.press("draw")
        await stage.settle()
        assert lab.value("drawing.drawn") == pytest.approx(100.0)
        lab.press("save")
        await stage.settle()
        assert lab.value("drawing.exported") is True
        lab.set("drawing.text", "LI")
        assert (await settled(stage, "drawing.exported", "drawing.strokes"))[0] is False

    on_stage(scene, "delta3")


def test_the_emulated_robot_is_driven():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        assert lab.value("link.phase") == "none"
        for action in ("connect", "request", "enable", "home_robot", "jog", "stop"):
            lab.press(action)
            await stage.settle()
        assert lab.value("link.stopped") is True and lab.value("link.holder") == "me"
        assert lab.value("link.same_robot") is True and lab.value("link.frames_ok") > 0  # type: ignore[operator]
        lab.press("enable")
        await stage.settle()
        assert stage.told, "refused, and told"
        lab.press("clear")
        await stage.settle()
        assert lab.value("link.state") == "ready"
        lab.set("link.estop", True)
        assert lab.value("link.estop") is True
        lab.press("heal")
        assert lab.value("link.estop") is False

    on_stage(scene, "delta3")


def test_an_apparatus_says_when_something_may_have_changed():
    async def scene(stage: Stage) -> None:
        lab: Apparatus = stage.apparatus
        heard: list[None] = []
        lab.changed.connect(heard.append)
        lab.set("pose.x", 10.0)
        assert heard
        heard.clear()
        lab.set("control.kp", 3.0)
        assert heard
        heard.clear()
        lab.press("export")
        assert heard and lab.value("report.exported") is True

    on_stage(scene)


def test_what_the_link_refuses_has_ended_and_what_does_not_end_is_given_up():
    async def scene(stage: Stage) -> None:
        lab = stage.apparatus
        lab.press("enable")  # there is no board
        await stage.settle()
        assert not lab.waits and stage.told
        lab.press("disconnect")
        assert lab.waits, "the link has not answered yet"
        lab.give_up()
        assert not lab.waits

    on_stage(scene)
