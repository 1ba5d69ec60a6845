"""The document, the C headers and the Python codes say the same."""

from __future__ import annotations

import re
import string

import pytest

from app.link.protocol import codes
from app.link.protocol.codes import describe_fault, describe_refusal
from app.link.protocol.frames import MAX_PAYLOAD, MIN_PAYLOAD
from app.link.protocol.messages import PAYLOAD_LENGTHS
from app.link.protocol.settings import (
    GEOMETRY_ID,
    GEOMETRY_SIZE,
    JOINT_SETTINGS,
    SETTING_COUNT,
    SETTINGS,
    is_live,
    setting_id,
    setting_of,
)
from tests.link.protocol.documents import TEXT, c_constants, table

C = c_constants()

IN_C = {
    codes.State: "DL_{}",
    codes.Fault: "DL_FAULT_{}",
    codes.Refusal: "DL_REFUSED_{}",
    codes.BoardKind: "DL_BOARD_{}",
    codes.RobotKind: "DL_ROBOT_{}",
    codes.DriveKind: "DL_DRIVE_{}",
    codes.Reset: "DL_RESET_{}",
    codes.SettingsSource: "DL_SETTINGS_{}",
    codes.Flag: "DL_FLAG_{}",
    codes.TargetKind: "DL_KIND_{}",
    codes.TestKind: "DL_TEST_{}",
    codes.MessageType: "DL_{}",
    codes.Command: "DL_{}",
}
C_OFF_COMMAND = "DL_POWER_OFF"
"""DL_OFF is the state."""


@pytest.mark.parametrize("kind", IN_C, ids=lambda kind: kind.__name__)
def test_the_c_headers_number_alike(kind):
    pattern = IN_C[kind]
    for code in kind:
        name = C_OFF_COMMAND if code is codes.Command.OFF else pattern.format(code.name)
        assert C[name] == code, name


def test_the_c_headers_know_nothing_else():
    known = {IN_C[kind].format(code.name) for kind in IN_C for code in kind}
    grouped = [name for name in C if re.match(r"DL_(FAULT|REFUSED|BOARD|ROBOT|DRIVE|RESET|FLAG|KIND)_", name)]
    assert len(grouped) > 30
    assert set(grouped) <= known
    assert C["DL_PROTOCOL"] == codes.PROTOCOL_VERSION


@pytest.mark.parametrize("column", [0, 2, 4])
def test_states_faults_and_refusals_are_those_of_the_document(column):
    kind = (codes.State, codes.Fault, codes.Refusal)[column // 2]
    cells = [row[column].split() for row in table("state", "", "fault", "", "refusal") if row[column]]
    assert {name: int(number) for number, name in cells} == {code.name: code.value for code in kind}


def test_message_types_and_lengths_are_those_of_the_document():
    rows = table("type", "name")
    assert {row[1]: int(row[0], 16) for row in rows} == {code.name: code.value for code in codes.MessageType}
    assert {row[1]: int(row[3]) for row in rows} == {code.name: size for code, size in PAYLOAD_LENGTHS.items()}
    assert f"A payload is {MIN_PAYLOAD} to {MAX_PAYLOAD} bytes" in TEXT


def test_the_fields_of_the_document_add_up_to_its_lengths():
    sizes = {"u8": 1, "i8": 1, "u16": 2, "u32": 4, "f32": 4}
    for _, name, fields, length in table("type", "name"):
        found = re.findall(r"`\w+` (?:(\d) x )?([uif]\d+)", fields)
        assert 3 + sum(int(count or 1) * sizes[size] for count, size in found) == int(length), name


def test_commands_are_those_of_the_document():
    rows = table("code", "name", "allowed in")
    assert {row[1]: int(row[0]) for row in rows} == {code.name: code.value for code in codes.Command}


def test_kinds_are_those_of_the_sentences():
    for field, kind in (("board", codes.BoardKind), ("robot", codes.RobotKind), ("drive", codes.DriveKind)):
        sentence = re.search(rf"`{field}`: (.*?)\.", TEXT, flags=re.S)
        assert sentence
        assert [int(n) for n in re.findall(r"(?:^|, )(\d) ", sentence[1])] == [code.value for code in kind]


def test_settings_are_those_of_the_document_and_of_c():
    joint = {row[1]: int(row[0]) for row in table("k", "name")}
    board = {row[1]: int(row[0]) for row in table("id", "name") if "geometry" not in row[1]}
    assert joint == {name: setting.id for name, setting in SETTINGS.items() if setting.per_joint}
    assert board == {name: setting.id for name, setting in SETTINGS.items() if not setting.per_joint}
    for name, number in (joint | board).items():
        assert C["DL_HOME_JOINT" if name == "home" else f"DL_{name.upper()}"] == number
    assert (C["DL_GEOMETRY"], C["DL_GEOMETRY_SIZE"], C["DL_SETTINGS"]) == (GEOMETRY_ID, GEOMETRY_SIZE, SETTING_COUNT)
    assert C["DL_JOINT_SETTINGS"] == JOINT_SETTINGS
    assert f"ids {GEOMETRY_ID} up" in TEXT and f"({GEOMETRY_SIZE} values)" in TEXT


def test_every_id_has_one_meaning():
    ids = {setting_id(name, joint) for name, s in SETTINGS.items() for joint in (range(4) if s.per_joint else [None])}
    assert ids == set(range(GEOMETRY_ID))
    for number in ids:
        setting, joint = setting_of(number)
        assert setting_id(setting.name, joint) == number
    assert {number for number in range(SETTING_COUNT) if is_live(number)} == {
        *(10 * joint + k for joint in range(4) for k in range(4)), 40, 49, 50
    }  # fmt: skip


@pytest.mark.parametrize("sentence", [
    *(describe_fault(fault, joint) for fault in codes.Fault for joint in (0, 3)),
    *(describe_refusal(refusal) for refusal in codes.Refusal),
])  # fmt: skip
def test_every_reason_is_one_sentence(sentence):
    assert sentence[0] in string.ascii_uppercase
    assert sentence.endswith(".") and sentence.count(".") == 1
    assert "{" not in sentence
