"""The list of ports."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from app.link import ports
from app.link.ports import Port, list_ports


def test_real_ports_come_first_with_their_numbers(monkeypatch: pytest.MonkeyPatch):
    uno = SimpleNamespace(device="/dev/ttyACM0", description="Uno", vid=0x2341, pid=0x43, serial_number="85")
    bare = SimpleNamespace(device="/dev/ttyS0", description=None, vid=None, pid=None, serial_number=None)
    monkeypatch.setattr(ports.system, "comports", lambda: [bare, uno])
    found = list_ports()
    assert found[:2] == [Port("/dev/ttyACM0", "Uno", 0x2341, 0x43, "85"), Port("/dev/ttyS0", "/dev/ttyS0")]
    assert [port.device for port in found if port.simulated] == ["sim:par4", "sim:delta3", "sim:linear", "sim:fivebar"]


def test_this_computers_ports_can_be_listed():
    assert len([port for port in list_ports() if port.simulated]) == 4
