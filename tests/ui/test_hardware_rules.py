"""What the tab Hardware lets whom do when, and how it says so: on statuses made by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from app.link.lease import Person
from app.link.protocol.codes import Fault, Flag, Refusal, State, describe_fault
from app.link.protocol.messages import Telemetry
from app.link.protocol.settings import SETTINGS, setting_id
from app.link.status import Activity, LinkStatus, LogLine
from app.robots import make_robot
from app.ui.hardware.board_settings import ALL, GROUPS, Edits, ids_of, shown_as
from app.ui.hardware.jogging import Space, axes_of, jog_of, key_of
from app.ui.hardware.verbs import VERBS, not_free, place_in_queue
from app.ui.hardware.words import condition
from app.ui.panels.hardware.connection_panel import port_title, state_line
from app.ui.panels.hardware.control_panel import lease_line
from app.ui.panels.hardware.health_panel import log_lines

ME, OTHER, CHIEF = Person("me", "Ada"), Person("o", "<b>Bob</b>"), Person("c", "Chief", instructor=True)
HOMED = Flag.HOMED | Flag.POWERED


def telemetry(state: State, flags: Flag = HOMED, fault: Fault = Fault.NONE) -> Telemetry:
    return Telemetry(state, flags, fault, 2, Refusal.OK, 0, 0, (0.0,) * 4, (0.0,) * 4, (0.0,) * 4, 0, 0, 0)


def status(
    state: State = State.READY, flags: Flag = HOMED, activity: Activity = "idle", holder: Person | None = ME
) -> LinkStatus:
    robot = make_robot("delta3")
    return LinkStatus("ready", robot=robot, telemetry=telemetry(state, flags), activity=activity, holder=holder)


def allowed(now: LinkStatus, person: Person) -> set[str]:
    return {key for key, verb in VERBS.items() if not verb.why_not(now, person)}


@pytest.mark.parametrize(
    ("state", "flags", "activity", "verbs"),
    [
        (State.OFF, Flag.HOMED, "idle", {"enable"}),
        (State.READY, Flag.POWERED, "idle", {"home", "power_off"}),
        (State.READY, HOMED, "paused", {"resume", "cancel", "power_off"}),
        (State.MOVING, HOMED, "run", {"pause", "cancel", "power_off"}),
        (State.MOVING, HOMED, "jog", {"power_off"}),
        (State.HOMING, Flag.POWERED, "idle", {"power_off"}),
        (State.HELD, HOMED, "idle", {"resume", "power_off"}),
        (State.STOPPED, HOMED, "idle", {"clear", "power_off"}),
        (State.FAULT, Flag(0), "idle", {"clear", "power_off"}),
    ],
)
def test_only_what_makes_sense_can_be_pressed(state: State, flags: Flag, activity: Activity, verbs: set[str]):
    now = status(state, flags, activity)
    assert allowed(now, ME) == verbs | {"release"}
    assert allowed(now, OTHER) == {"request"}, "somebody else has the robot"
    refusals = {verb.why_not(now, OTHER) for verb in VERBS.values()} - {""}
    assert all(reason.endswith(".") for reason in refusals)


def test_an_instructor_may_end_things_without_holding_the_robot():
    assert allowed(status(State.STOPPED), CHIEF) == {"clear", "power_off", "request", "take_over"}
    assert {"pause", "cancel"} <= allowed(status(State.MOVING, activity="run"), CHIEF)
    assert "take_over" not in allowed(status(), OTHER)


def test_without_a_board_everything_is_grey():
    assert allowed(LinkStatus(), ME) == allowed(LinkStatus("lost"), CHIEF) == set()


def test_what_waits_says_its_place():
    now = replace(status(), queue=(OTHER, CHIEF))
    assert [place_in_queue(now, person) for person in (ME, OTHER, CHIEF)] == [0, 1, 2]
    assert VERBS["request"].why_not(now, OTHER) == "You wait already, in place 1."
    assert allowed(now, OTHER) == {"release"} and "take_over" in allowed(now, CHIEF)
    line = lease_line(replace(now, holder_left_s=14.5), "o")
    assert "<b>Ada</b> has control" in line and "1. <b>you</b>, 2. Chief" in line and "Kept for 15 s" in line
    assert "free in 4 s" in lease_line(replace(now, holder_left_s=3.2), "o")


def test_names_and_log_cannot_bring_html():
    now = replace(status(holder=OTHER), log=(LogLine(0.0, "<script>x</script> came."),))
    for shown in (lease_line(now, "me"), log_lines(now), state_line(replace(now, sentence=now.log[0].sentence))):
        assert "<script>" not in shown and "<b>Bob" not in shown
    assert "&lt;b&gt;Bob&lt;/b&gt;" in lease_line(now, "me")


def test_the_state_is_a_word_a_colour_and_a_sentence():
    seen = [condition(LinkStatus(phase)) for phase in ("none", "connecting", "lost", "refused")]
    seen += [condition(status(state)) for state in State]
    seen.append(condition(status(State.READY, Flag.POWERED)))
    assert len({one.word for one in seen}) == len(seen)
    assert condition(status(State.READY, Flag.POWERED)).word == "Not homed"
    broken = replace(status(State.FAULT), telemetry=telemetry(State.FAULT, fault=Fault.FOLLOWING))
    assert condition(broken).sentence == describe_fault(Fault.FOLLOWING, 2)


def test_a_busy_robot_takes_nothing_new():
    assert not_free(status(), ME) == ""
    assert "busy" in not_free(status(activity="run"), ME)
    assert not_free(status(State.READY, Flag.POWERED), ME) == "Home the robot first."
    assert not_free(status(State.READY, Flag.POWERED), ME, homed=False) == ""


def test_every_jog_button_comes_back_as_what_it_stands_for():
    now = replace(status(), settings={setting_id("speed", 1): 0.2, setting_id("tool_speed"): 0.05})
    robot = make_robot("delta3")
    spaces: tuple[Space, ...] = ("joint", "pose")
    for space in spaces:
        axes = axes_of(robot, space)
        assert len(axes) == 3
        for axis in axes:
            for direction in (-1, 1):
                found = jog_of(key_of(axis, direction), now, 0.5)
                assert found is not None
                jog, same = found
                assert same == axis and (jog.space, jog.axis, jog.direction) == (space, axis.axis, direction)
    joint, tool = jog_of("joint:1:+", now, 0.5), jog_of("pose:2:-", now, 0.5)
    assert joint is not None and joint[0].speed == pytest.approx(0.1), "half of the board's limit"
    assert tool is not None and tool[0].speed == pytest.approx(0.025)


@pytest.mark.parametrize("key", ["", "joint", "joint:3:+", "pose:0:*", "pose:-1:+", "joint:²:+", "x:0:+", "joint:0:+:"])
def test_forged_jog_keys_move_nothing(key: str):
    assert jog_of(key, status(), 1.0) is None


def test_settings_are_shown_in_the_units_of_people():
    delta, linear = make_robot("delta3"), make_robot("linear")
    edits, now = Edits(), replace(status(), settings={0: 180.0 / math.pi, 5: math.pi / 2, 40: 0.25, 3: 80.0})
    shown = {name: edits.value(name, ALL, now, delta) for name in ("kp", "max", "tool_speed", "n", "min")}
    assert shown == {"kp": 1.0, "max": 90.0, "tool_speed": 250.0, "n": 80.0, "min": None}
    assert shown_as("kp", linear).unit == "V/mm" and shown_as("kp", linear).factor == 1e-3
    assert shown_as("n", linear).unit == "rad/s"


def test_edits_go_to_the_joints_that_were_chosen():
    delta, edits = make_robot("delta3"), Edits()
    edits.type("kp", ALL, 2.0, delta)
    edits.type("max", "q2", 45.0, delta)
    assert edits.values == pytest.approx({0: 114.59156, 10: 114.59156, 20: 114.59156, 15: math.pi / 4})
    assert ids_of("off_after", ALL, delta) == [42]
    edits.clear()
    assert not len(edits)


def test_every_setting_but_number_and_geometry_has_its_place():
    assert sorted(name for names in GROUPS.values() for name in names) == sorted(set(SETTINGS) - {"serial"})


def test_ports_that_look_alike_can_be_told_apart():
    from app.link.ports import Port

    uno = Port("/dev/ttyACM0", "Arduino Uno", 0x2341, 0x0043, "7573530")
    assert port_title(uno) == "/dev/ttyACM0 – Arduino Uno – 2341:0043 – no. 7573530"
    assert port_title(Port("sim:par4", "Emulated board: Par4 delta", simulated=True)).startswith("sim:par4")
