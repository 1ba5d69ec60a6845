"""The file: kept through everything, brought up to date, and nobody else's is touched."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from app.classroom.classroom import Classroom
from app.classroom.errors import ClassroomRefusal
from app.classroom.events import acted, opened
from app.classroom.opening import open_classroom
from app.classroom.store import file as file_module
from app.classroom.store.file import StoreMistake, read_header
from app.classroom.store.place import CLASS_FILE, SOLO_FILE, data_file
from app.classroom.store.schema import VERSION
from app.classroom.store.store import Store
from tests.support.classroom import LESSON, a_class, joined
from tests.support.imports import ROOT

FIRST_VERSION = Path(__file__).with_name("store_of_version_1.sql")
RECORDER = """
import sys
from pathlib import Path
from app.classroom.classroom import Classroom
from app.classroom.events import checked
from app.classroom.store.store import Store
time = iter(range(10**9))
classroom = Classroom(Store(Path(sys.argv[1])), in_class=True, clock=lambda: next(time))
member = classroom.member("ada") or classroom.join("ada", "Ada", classroom.code)
number = len(list(classroom.store.events(member.id)))
while True:
    classroom.record(member, checked("01-meet", 1, number))
    print(number, flush=True)
    number += 1
"""


def test_what_was_confirmed_survives_the_sudden_end_of_the_server(tmp_path: Path):
    file = tmp_path / "class.sqlite3"
    confirmed, code = -1, ""
    for lines in (1, 40, 300):
        command = [sys.executable, "-c", RECORDER, str(file)]
        with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT) as server:
            assert server.stdout is not None
            for _ in range(lines):
                confirmed = int(server.stdout.readline())
            server.send_signal(signal.SIGKILL)
            confirmed = max([confirmed, *(int(line) for line in server.stdout if line.endswith("\n"))])
        with closing(Classroom.in_file(file, in_class=True)) as classroom:
            ada = classroom.member("ada")
            assert ada is not None and classroom.code == (code or classroom.code)
            code = classroom.code
            assert set(range(confirmed + 1)) <= classroom.progress(ada).of("01-meet", 1).checks


def test_two_servers_do_not_share_a_file(tmp_path: Path):
    with closing(open_classroom(str(tmp_path), in_class=True)):
        with pytest.raises(StoreMistake, match=r"Another Delta Lab uses .*class\.sqlite3: stop it first"):
            open_classroom(str(tmp_path), in_class=True)
        with closing(open_classroom(str(tmp_path), in_class=False)) as alone:
            assert alone.notice == "", "who works alone has a file of his own"
    open_classroom(str(tmp_path), in_class=True).close()


def test_a_file_of_the_first_version_is_brought_up_to_date(tmp_path: Path):
    file = tmp_path / "old.sqlite3"
    with closing(sqlite3.connect(file)) as old:
        old.executescript(FIRST_VERSION.read_text())
    assert read_header(file) == (1, 0x444C4142)
    with closing(Classroom.in_file(file, in_class=True)) as classroom:
        assert classroom.code == "K7QF2"
        (ada,) = classroom.members
        assert ada.name == "Ada" and ada.seed == 4711
        step = classroom.progress(ada).of(LESSON, 1)
        assert step.acted and step.answer == 41.5 and step.right
        (plots,) = classroom.store.evidence(ada.id).values()
        assert plots == [{"title": "Step", "series": [{"label": "y", "x": [0, 1], "y": [0, 2]}]}]
        assert [happened.event.detail for happened in classroom.store.events(ada.id)][1] == {}
    assert read_header(file) == (VERSION, 0x444C4142)


def test_a_file_of_a_newer_version_is_left_alone(tmp_path: Path):
    file = tmp_path / "new.sqlite3"
    Store(file).close()
    with closing(sqlite3.connect(file)) as new:
        new.execute(f"PRAGMA user_version = {VERSION + 1}")
    before = file.read_bytes()
    with pytest.raises(StoreMistake, match="newer Delta Lab"):
        Store(file)
    assert file.read_bytes() == before and [path.name for path in tmp_path.iterdir()] == ["new.sqlite3"]


def _somebody_elses(file: Path) -> None:
    with closing(sqlite3.connect(file)) as database:
        database.execute("CREATE TABLE photos (name TEXT)")
        database.commit()


@pytest.mark.parametrize(
    ("make", "reason"),
    [
        (lambda file: file.write_text("Dear diary, " * 100), "no class file"),
        (lambda file: file.write_bytes(b"SQLite format 3\0"), "no class file"),
        (_somebody_elses, "another program"),
    ],
)
def test_somebody_elses_file_is_left_alone(tmp_path: Path, make, reason: str):
    file = tmp_path / "notes.txt"
    make(file)
    before = file.read_bytes()
    with pytest.raises(StoreMistake, match=reason):
        open_classroom(str(file), in_class=True)
    with pytest.raises(StoreMistake, match=reason):
        open_classroom(str(file), in_class=False)
    assert file.read_bytes() == before and len(list(tmp_path.iterdir())) == 1


def test_a_damaged_file_and_an_impossible_place_are_told_in_one_sentence(tmp_path: Path):
    file = tmp_path / "class.sqlite3"
    Store(file).close()
    file.write_bytes(file.read_bytes()[:100] + b"\xff" * 5000)
    with pytest.raises(StoreMistake, match="cannot be used"):
        Store(file)
    (tmp_path / "a_file").touch()
    with pytest.raises(StoreMistake, match="cannot be used"):
        Store(tmp_path / "a_file" / "class.sqlite3")


def test_a_full_disk_is_told_and_what_was_saved_stays(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(file_module, "LARGEST_BYTES", 40 * file_module.PAGE_BYTES)
    store = Store(tmp_path / "class.sqlite3")
    classroom = a_class(store)
    ada = joined(classroom, "Ada")
    classroom.record(ada, opened(LESSON, 1))
    plots = [{"title": "T", "series": [{"label": "y", "x": list(range(3000)), "y": list(range(3000))}]}]
    with pytest.raises(ClassroomRefusal, match="could not be saved"):  # noqa: PT012, one of them
        for _ in range(100):
            classroom.record(ada, acted(LESSON, 1, plots))
    monkeypatch.undo()
    saved = len(list(store.events(ada.id)))
    classroom.close()
    with closing(a_class(Store(tmp_path / "class.sqlite3"))) as again:
        assert len(list(again.store.events(ada.id))) == saved >= 1
        again.record(ada, acted(LESSON, 1, plots))


def test_where_the_file_is(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "home"))
    assert data_file(str(tmp_path), in_class=True) == tmp_path / CLASS_FILE
    assert data_file(str(tmp_path / "monday"), in_class=False) == tmp_path / "monday" / SOLO_FILE
    assert data_file(str(tmp_path / "monday.sqlite3"), in_class=True) == tmp_path / "monday.sqlite3"
    assert data_file(None, in_class=True).name == CLASS_FILE
    if sys.platform == "linux":
        assert data_file(None, in_class=True) == tmp_path / "home" / "deltalab" / CLASS_FILE
