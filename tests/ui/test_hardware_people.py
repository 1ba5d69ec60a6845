"""What the tab Hardware makes of who is who: the port, the PIN, and who may ask for the robot."""

from __future__ import annotations

from app.classroom.classroom import NAME_STAYS, Classroom
from app.ui.hardware.desk import HardwareDesk
from app.ui.hardware.workshop import ONLY_INSTRUCTOR, Workshop, choose_pin
from app.ui.session import Session
from app.ui.state import Memory


def desk_in(classroom: Classroom) -> tuple[HardwareDesk, list[str]]:
    told: list[str] = []
    return HardwareDesk(Session(Memory("par4")), Workshop(classroom), "a", lambda said, _: told.append(said)), told


def test_a_pin_is_made_where_one_is_needed():
    assert choose_pin("1234", serial=False, local_only=True) == "1234"
    assert choose_pin(None, serial=False, local_only=True) == ""
    for pin in (choose_pin(None, serial=True, local_only=True), choose_pin(None, serial=False, local_only=False)):
        assert len(pin) == 4 and pin.isdigit()
    in_class = choose_pin(None, serial=False, local_only=True, in_class=True)
    assert len(in_class) == 6 and in_class.isdigit()


def test_on_the_network_only_the_instructor_chooses_the_port():
    at_home, in_class = Workshop(), Workshop(Classroom.in_memory(pin="1234"), local_only=False)
    assert at_home.why_no_port(at_home.people.person("a")) == ""
    assert in_class.why_no_port(in_class.people.person("a")) == ONLY_INSTRUCTOR
    in_class.people.prove("a", "1234")
    assert in_class.why_no_port(in_class.people.person("a")) == ""


def test_who_works_alone_calls_himself_as_he_likes():
    desk, told = desk_in(Classroom.in_memory())
    desk.rename("Ada")
    assert (desk.me.name, told) == ("Ada", [])


def test_in_a_class_the_name_is_the_one_he_joined_with():
    classroom = Classroom.in_memory(in_class=True)
    classroom.join("a", "Ada", classroom.code)
    desk, told = desk_in(classroom)
    desk.rename("Bob")
    assert (desk.me.name, told) == ("Ada", [NAME_STAYS])


def test_a_visitor_who_has_not_joined_does_not_get_the_robot():
    desk, told = desk_in(Classroom.in_memory(in_class=True))
    desk.do("request")
    assert len(told) == 1 and told[0].startswith("Join the class first")
