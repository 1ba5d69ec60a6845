"""The table of formulas: right numbers, right units, and sentences where there is none."""

from __future__ import annotations

import binascii
import math
from typing import Any

import pytest

from app.classroom.lessons.formulas import FORMULAS, FormulaMistake
from app.classroom.lessons.formulas.registry import ANY_UNIT, formula
from app.classroom.lessons.units import UNITS
from app.link.protocol.frames import FrameDecoder
from app.robots import make_robot

POSE = {"x": 30.0, "y": -40.0, "z": -330.0, "theta": 10.0}
SI = (0.03, -0.04, -0.33, math.radians(10.0))


def value(name: str, pick: str = "", /, **arguments: Any) -> Any:
    return FORMULAS[name].quantity(arguments, pick).value


def unit(name: str, pick: str = "", /, **arguments: Any) -> str | None:
    return FORMULAS[name].quantity(arguments, pick).unit


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("sum", {"of": [1, 2.5, -4]}, -0.5),
        ("difference", {"a": 3, "b": 5}, -2),
        ("product", {"of": [2, 3, 4]}, 24),
        ("ratio", {"a": 3, "b": 4}, 0.75),
        ("percent", {"a": 3, "b": 4}, 75),
        ("negative", {"of": 3}, -3),
        ("absolute", {"of": -3}, 3),
        ("smallest", {"of": [3, 1, 2]}, 1),
        ("largest", {"of": [3, 1, 2]}, 3),
        ("power", {"of": 2, "to": -1}, 0.5),
        ("root", {"of": 9}, 3),
        ("length", {"of": [3, 4, 12]}, 13),
        ("sin", {"of": 30}, 0.5),
        ("cos", {"of": 60}, 0.5),
        ("tan", {"of": 45}, 1),
        ("atan2", {"y": -1, "x": -1}, -135),
        ("round", {"of": -2.345, "digits": 1}, -2.3),
        ("round_up", {"of": 41, "step": 5}, 45),
        ("mobility", {"bodies": 4, "joints": [1, 1, 1, 1], "space": 3}, 1),
        ("byte_time", {"count": 10, "baud": 10_000}, 10),
        ("fit_scale", {"width": 200, "height": 50, "inner_width": 100, "inner_height": 100}, 50),
    ],
)
def test_simple_ones(name: str, arguments: dict[str, Any], result: float) -> None:
    assert value(name, **arguments) == pytest.approx(result)


def test_kinematics_are_the_robots() -> None:
    robot = make_robot("par4")
    joints = {name: value("inverse", name, robot="par4", pose=POSE) for name in robot.joint_names}
    assert list(joints.values()) == pytest.approx([math.degrees(q) for q in robot.solve(*SI)])
    assert value("forward", "theta", robot="par4", joints=joints) == pytest.approx(10.0)
    assert value("forward", "z", robot="par4", joints=joints) == pytest.approx(-330.0)
    assert value("conditioning", robot="par4", pose=POSE) == pytest.approx(float(robot.conditioning(SI)))
    entry = value("jacobian", robot="par4", pose=POSE, joint="q2", coordinate="x")
    assert entry == pytest.approx(math.degrees(robot.jacobian(SI)[1, 0]) * 1e-3)
    speed = value("joint_speed", "q2", robot="par4", pose=POSE, velocity={"x": 100})
    assert speed == pytest.approx(100.0 * entry)


def test_units_follow_the_robot() -> None:
    assert unit("inverse", "q1", robot="par4", pose=POSE) == "deg"
    linear = {"x": 0, "y": 0, "z": -500}
    assert unit("inverse", "d1", robot="linear", pose=linear) == "mm"
    assert unit("joint_speed", "d1", robot="linear", pose=linear, velocity={"z": 10}) == "mm/s"
    assert unit("jacobian", robot="par4", pose=POSE, joint="q1", coordinate="x") == "deg/mm"
    assert unit("effort", "q1", robot="par4", pose=POSE) == "N m"
    assert unit("effort", "d1", robot="linear", pose=linear) == "N"


def test_dimensions_can_be_changed() -> None:
    longer = value("inverse", "q1", robot="par4", pose=POSE, geometry={"l": 400})
    assert longer == pytest.approx(math.degrees(make_robot("par4", l=0.4).solve(*SI)[0]))


def test_a_payload_weighs() -> None:
    empty, loaded = (value("effort", "q1", robot="par4", pose=POSE, payload=kg) for kg in (0.0, 0.5))
    assert abs(loaded) > abs(empty) > 0.0


def test_control() -> None:
    assert value("motor", "K") == 9.4138
    assert value("motor", "speed", robot="delta3", volts=6) == pytest.approx(300.0)
    gains = {"kp": 4.3621, "ki": 0.38231, "kd": 0.99919, "n": 37.2929}
    assert value("tuning", "kp", method="Paper, Table 2 (MATLAB)") == pytest.approx(gains["kp"])
    assert 60.0 < value("margin", "phase", gains=gains) < 80.0
    limited, free = (value("step_metric", "rise", gains=gains, supply=volts) for volts in (6.0, math.inf))
    assert limited > free
    assert 0.0 <= value("step_metric", "overshoot", gains=gains) < 20.0


def test_frames_can_be_read_again() -> None:
    frame = value("frame", "hex", hex="01 00 ff")
    assert FrameDecoder().feed(bytes.fromhex(frame)) == [b"\x01\x00\xff"]
    assert value("cobs", "hex", hex="01 00 ff") == "02 01 02 ff"
    assert value("crc16", "value", text="123456789") == 0x29B1 == binascii.crc_hqx(b"123456789", 0xFFFF)


def test_printed_numbers_stand_beside_ours() -> None:
    angle = {"paper": "par4", "section": "2 Solid model", "name": "angle between the arms"}
    assert value("paper", "paper", **angle) == 90 and unit("paper", "ours", **angle) == "deg"
    assert value("paper", "ours", **angle) == pytest.approx(90.0)


@pytest.mark.parametrize(
    ("name", "pick", "arguments", "sentence"),
    [
        ("inverse", "", {"robot": "par4", "pose": POSE}, "inverse has several results, so pick one: there are q1"),
        ("inverse", "q7", {"robot": "par4", "pose": POSE}, "inverse has no result q7: there are q1, q2, q3, q4."),
        ("inverse", "q1", {"robot": "parr", "pose": POSE}, "There is no robot 'parr'"),
        ("inverse", "q1", {"robot": "par4", "pose": {"z": -3000}}, "the result is no number"),
        ("inverse", "q1", {"robot": "par4", "pose": {"z": "low"}}, "pose must be a table of numbers"),
        ("inverse", "q1", {"robot": 4, "pose": POSE}, "robot must be a text in quotes"),
        (
            "forward",
            "x",
            {"robot": "par4", "joints": {"q1": 0}},
            "the joints of par4 are q1, q2, q3, q4: give them all.",
        ),
        ("ratio", "", {"a": 1, "b": 0}, "it divides by zero"),
        ("root", "", {"of": -1}, "math domain error."),
        ("sum", "x", {"of": [1]}, "sum has one result only"),
        ("sum", "", {"of": 3}, "of must be a list of numbers"),
        ("ratio", "", {"a": True, "b": 2}, "a must be a number"),
        ("mobility", "", {"bodies": 2.5, "joints": []}, "bodies must be a whole number"),
        ("tuning", "kp", {"method": "Magic"}, "the methods are"),
        ("paper", "ours", {"paper": "par5", "section": "9", "name": "x"}, "the papers are par4, linear, fivebar."),
        ("crc16", "value", {}, "give either text or hex."),
        ("crc16", "value", {"hex": "xyz"}, "non-hexadecimal number"),
    ],
)
def test_why_there_is_no_number(name: str, pick: str, arguments: dict[str, Any], sentence: str) -> None:
    with pytest.raises(FormulaMistake) as caught:
        FORMULAS[name].quantity(arguments, pick)
    assert sentence in str(caught.value) and str(caught.value).endswith(".")


def test_every_formula_says_what_it_does_with_known_units() -> None:
    for name, entry in FORMULAS.items():
        assert entry.text.endswith("."), name
        assert entry.unit in (ANY_UNIT, "") or entry.unit in UNITS, name


def test_two_formulas_of_one_name_are_a_slip() -> None:
    with pytest.raises(AssertionError, match="two formulas sum"):
        formula("sum")(lambda of: 1.0)
