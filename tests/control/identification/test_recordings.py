"""Reading students' files: what is tolerated, what is refused and how."""

from __future__ import annotations

import time

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from app.control.identification import recordings
from app.control.identification.recordings import MAX_BYTES, Recording, RecordingError, read_recording, write_recording

T, U, Y = [0.0, 0.01, 0.02], [12.0, -12.0, 0.5], [0.0, 1.5, -2.25]


@pytest.mark.parametrize(
    "text",
    [
        "0,12,0\n0.01,-12,1.5\n0.02,0.5,-2.25\n",
        "0\t12\t0\n0.01\t-12\t1.5\n0.02\t0.5\t-2.25",
        "0;12;0\n0,01;-12;1,5\n0,02;0,5;-2,25\n",
        "0;12;0\r\n0.01;-12;1.5\r\n\r\n0.02;0.5;-2.25\r\n",
        "0,12,0\r0.01,-12,1.5\r0.02,0.5,-2.25\r",
        "\ufefft,u,y\n0,12,0\n0.01,-12,1.5\n0.02,0.5,-2.25\n",
        "# by Ana, 12 V, no load\n\nt, u, y  # the usual\n0, 12, 0\n0.01, -12, 1.5 # a kick\n0.02, 0.5, -2.25\n",
        '"angle (deg)","time (s)","voltage (V)"\n0,0,12\n1.5,0.01,-12\n-2.25,0.02,0.5\n',
        "Y;note;Time [s];input_v\n0;start;0;12\n1,5;;0,01;-12\n-2,25;#;0,02;0,5\n".replace("#", "end"),
        "n,t_s,u_v,y_deg,spare\n1,0,12,0,\n2,0.01,-12,1.5,\n3,0.02,0.5,-2.25,x\n",
        "t,u,y,\n0,12,0,\n0.01,-12,1.5,\n0.02,0.5,-2.25,\n",
        "position (°)\tt\tu\n0\t0\t12\n1,5\t1e-2\t-12\n-2,25\t2e-2\t0,5\n",
    ],
)
def test_tolerated_files(text):
    recording = read_recording(text.encode())
    assert (recording.t.tolist(), recording.u.tolist(), recording.y.tolist()) == (T, U, Y)
    assert recording.unit == "deg"


def test_older_encodings_and_millimetres():
    assert read_recording("t;u;angle (°)\n0;1;2\n".encode("latin-1")).y.tolist() == [2.0]
    assert read_recording(b"t,u,position (mm)\n0,1,2\n").unit == "mm"


@pytest.mark.parametrize(
    ("data", "complaint"),
    [
        (b"", "Line 1: the file holds no data"),
        (b"# nothing\n\n", "the file holds no data"),
        (b"\n# x\nt,u,y\n", "Line 3: no data follow the header"),
        (b"t,u,y\n0,1,2\n0.01,x,3\n", "Line 3: 'x' is not a number"),
        (b"0,1,2\n\n0.01,,3\n", "Line 3: an empty cell is not a number"),
        (b"t,u,y\n0,1\n", "Line 2: 2 columns instead of 3"),
        (b"0,1,2,3\n", "Line 1: 4 columns instead of 3"),
        (b"t,u,y\n0,01,1,5,2,5\n", "Line 2: 6 columns instead of 3.*semicolons"),
        (b"time (ms),u,y\n0,1,2\n", "Line 1: no column for the time in seconds"),
        (b"t,u,angle (rad)\n0,1,2\n", "Line 1: no column for the angle in degrees"),
        (b"t,u,y,angle\n0,1,2,3\n", "Line 1: several columns for the angle"),
        (b"a,b,c\n0,1,2\n", "Line 1: no column for the time"),
        (b"0,1,2\n0.01,nan,3\n", "Line 2: a value is not finite"),
        (b"0,1,2\n0.01,1e999,3\n", "Line 2: a value is not finite"),
        (b"0,1,2\n0.02,1,2\n# here\n0.01,1,3\n", "Line 4: the time does not increase"),
        (b"0,1,2\n0,1,2\n", "Line 2: the time does not increase"),
        (b"0,1,2\n\x89PNG\x00\x00", "Line 2: this is not plain text"),
        ("t,u,y\n0,1,2\n".encode("utf-16"), "Line 1: this is not plain text"),
        (b"0,1," + b"2" * 5000, "Line 1 is longer than 2000 characters"),
        (b"0" * (MAX_BYTES + 1), "larger than 20 MB"),
    ],
)
def test_refusals_name_the_line(data, complaint):
    with pytest.raises(RecordingError, match=complaint) as refusal:
        read_recording(data)
    assert str(refusal.value).endswith(".") and "\n" not in str(refusal.value)


def test_too_many_rows_and_lines(monkeypatch):
    monkeypatch.setattr(recordings, "MAX_ROWS", 10)
    monkeypatch.setattr(recordings, "MAX_LINES", 20)
    rows = [f"{number},1,2\n" for number in range(11)]
    assert len(read_recording("".join(rows[:10]).encode()).t) == 10
    with pytest.raises(RecordingError, match="Line 11: there are more than 10 rows"):
        read_recording("".join(rows).encode())
    with pytest.raises(RecordingError, match="Line 21: there are more than 20 lines"):
        read_recording(b"0,1,2\n" + b"\n" * 30)


def test_a_long_recording_is_read_within_a_second():
    t = np.linspace(0.0, 1000.0, 100_000)
    data = write_recording(Recording(t, np.sin(t), np.cos(t))).encode()
    start = time.process_time()
    recording = read_recording(data)
    assert time.process_time() - start < 1.0
    assert (recording.t == t).all() and (recording.y == np.cos(t)).all()


finite = st.floats(allow_nan=False, allow_infinity=False)


@given(
    st.lists(st.tuples(finite, finite, finite), min_size=1, max_size=30, unique_by=lambda row: row[0]),
    st.sampled_from(["deg", "mm"]),
)
def test_what_is_written_is_read_back_exactly(rows, unit):
    t, u, y = np.array(sorted(rows)).T
    again = read_recording(write_recording(Recording(t, u, y, unit)).encode())
    assert (again.t == t).all() and (again.u == u).all() and (again.y == y).all()
    assert again.unit == unit


def read_or_refuse(data: bytes) -> None:
    try:
        recording = read_recording(data)
    except RecordingError:
        return
    assert len(recording.t) == len(recording.u) == len(recording.y) >= 1
    assert np.isfinite([recording.t, recording.u, recording.y]).all()
    assert (np.diff(recording.t) > 0).all()


@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused(data):
    read_or_refuse(data)


@given(st.text(alphabet='0123456789.,;\t\n\r#"tuy()-+eE_ \ufeff', max_size=200))
def test_anything_like_a_table_is_read_or_refused(text):
    read_or_refuse(text.encode())
