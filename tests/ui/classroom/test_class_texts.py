"""How the class says things: invitation, board, and the picture of all, on data made by hand."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.classroom.board import Bar, BoardRow
from app.classroom.pace import Pace
from app.ui.classroom import class_script
from app.ui.classroom.crowd_picture import KINDS, crowd_picture
from app.ui.classroom.invitation import ONLY_HERE, Invitation
from app.ui.classroom.lines import POINTS, Line, thinned
from app.ui.panels.classroom.board_table import bars, board_table, minutes, summary
from app.ui.panels.classroom.pace_panel import in_words, titled

EVIL = "<script>alert('x')</script>\"&"


def row(name: str = "Ada", **changes: object) -> BoardRow:
    usual = {"member_id": "a1", "name": name, "lesson": "02-inverse-kinematics", "step": 3, "checks": 1, "checks_of": 2}
    usual |= {"seconds": 200.0, "stuck_s": None, "hand_s": None, "holds_robot": False, "online": True, "share": 0.1}
    return BoardRow(**(usual | changes))  # type: ignore[arg-type]


def test_who_listens_here_only_is_told_that_students_cannot_come():
    here = Invitation("127.0.0.1", 8080, "K7QF2")
    assert here.link == "http://localhost:8080/?class=K7QF2"
    text = here.text("123456", "utf-8")
    assert ONLY_HERE in text and "123456" in text and "█" not in text


@pytest.mark.parametrize("host", ["0.0.0.0", "::"])
def test_the_network_is_told_an_address_that_it_can_reach(host: str):
    invitation = Invitation(host, 8080, "K7QF2")
    assert not re.search(r"0\.0\.0\.0|\[::\]|localhost", invitation.link)
    text = invitation.text("123456", "utf-8")
    assert invitation.link in text and "█" in text and ONLY_HERE not in text
    assert "█" not in invitation.text("123456", "ascii"), "a terminal without blocks gets none"


def test_other_addresses_are_told_as_they_are():
    assert Invitation("192.168.1.20", 80, "K7QF2").link == "http://192.168.1.20:80/?class=K7QF2"
    assert Invitation("fe80::1", 80, "K7QF2").link == "http://[fe80::1]:80/?class=K7QF2"


def test_the_qr_code_is_a_picture_with_a_light_ground():
    drawn = ET.fromstring(Invitation("192.168.1.20", 8080, "K7QF2").svg())
    assert drawn.tag.endswith("svg") and "viewBox" in drawn.attrib


def test_the_board_escapes_what_students_typed():
    page = board_table([row(EVIL, lesson=EVIL, member_id=EVIL)], "", EVIL) + bars([Bar(EVIL, 1, EVIL, (EVIL,))])
    assert "<script" not in page and "&lt;script&gt;" in page
    assert in_words(Pace("paused", message=EVIL)).count("<") == 2


def test_the_board_says_who_needs_what():
    page = board_table([row(hand_s=130.0, stuck_s=601.0), row("Ben", online=False, holds_robot=True)], "a1", "w")
    for words in ("hand 2 min", "stuck 10 min", "away", "has the robot", "02 · 3", ">1/2<", ">3<"):
        assert words in page
    assert "<b>1</b> of 2 here" in summary([row(), row(online=False)])
    assert "exploring" in board_table([row(lesson="")], "", "w")
    assert "Nobody has joined" in board_table([], "", "w")


@pytest.mark.parametrize(("seconds", "words"), [(0, "< 1"), (59, "< 1"), (60, "1"), (7200, "120")])
def test_times_are_in_whole_minutes(seconds: float, words: str):
    assert minutes(seconds) == words


@pytest.mark.parametrize(
    ("pace", "words"),
    [
        (Pace(), "Free"),
        (Pace("up_to", "02-x", 3), "Open up to</b> lesson 02, step 3"),
        (Pace("all_at", "02-x", 3), "All at</b> lesson 02, step 3"),
        (Pace("all_at", "02-x", 3).pause("Listen"), "Paused.</b> Listen"),
    ],
)
def test_the_pace_is_told_in_words(pace: Pace, words: str):
    assert words in in_words(pace)


def test_a_lesson_is_chosen_by_its_number_and_topic():
    assert titled("02-inverse-kinematics") == "02 · Inverse kinematics"


def test_what_is_said_to_a_page_is_data_whatever_it_is():
    for script in (class_script.ask(EVIL), class_script.pause(EVIL), class_script.banner(EVIL)):
        inside = script[script.index("(") + 1 : script.rindex(")")]
        assert json.loads(f"[{inside}]")[0] == EVIL


finite = st.floats(-1e6, 1e6)


@given(st.lists(st.tuples(st.floats(), st.floats()), max_size=400))
def test_a_line_keeps_its_ends_and_few_points(points: list[tuple[float, float]]):
    x, y = [p[0] for p in points], [p[1] for p in points]
    line = thinned(x, y)
    good = [p for p in points if np.isfinite(p).all()]
    if line is None:
        assert len(good) < 2
    else:
        assert len(line.x) == min(len(good), POINTS)
        assert (line.x[0], line.y[0]) == good[0] and (line.x[-1], line.y[-1]) == good[-1]


@given(st.lists(st.lists(st.tuples(finite, finite), min_size=2, max_size=9), max_size=4), st.sampled_from(list(KINDS)))
def test_the_picture_of_all_stays_within_its_frame(lines: list[list[tuple[float, float]]], kind):
    picture = crowd_picture(kind, [Line(*np.array(points).T) for points in lines])
    drawn = ET.fromstring(picture)
    polylines = [element.attrib["points"] for element in drawn.iter() if element.tag == "polyline"]
    assert len(polylines) == len(lines)
    for pair in " ".join(polylines).split():
        across, down = map(float, pair.split(","))
        assert 0 <= across <= 400 and 0 <= down <= 260


def test_a_path_is_drawn_with_one_scale():
    square = Line(np.array([0.0, 100.0, 100.0, 0.0]), np.array([0.0, 0.0, 100.0, 100.0]))
    (points,) = re.findall(r'points="([^"]*)"', crowd_picture("tool_path", [square]))
    corners = np.array([pair.split(",") for pair in points.split()], dtype=float)
    width, height = np.ptp(corners, axis=0)
    assert width == pytest.approx(height, abs=0.2) and width > 50
