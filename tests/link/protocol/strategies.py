"""Every message that the protocol can carry, for hypothesis."""

from __future__ import annotations

import struct

from hypothesis import strategies as st

from app.link.protocol import codes
from app.link.protocol.messages import (
    Ack,
    Alive,
    Get,
    Hello,
    Identity,
    Order,
    Sample,
    Set,
    Setpoint,
    Telemetry,
    Test,
)

u8 = st.integers(0, 255)
u16 = st.integers(0, 0xFFFF)
u32 = st.integers(0, 0xFFFFFFFF)
f32 = st.floats(width=32, allow_nan=False)
four = st.tuples(f32, f32, f32, f32)
steps = st.integers(-127, 127).map(lambda step: step / 127)
kinds = st.sampled_from

telemetry = st.builds(
    Telemetry,
    kinds(codes.State),
    st.integers(0, 63).map(codes.Flag),
    kinds(codes.Fault),
    st.integers(0, 4),
    kinds(codes.Refusal),
    u8,
    u32,
    four,
    four,
    st.tuples(steps, steps, steps, steps),
    u16,
    u16,
    u8,
)

from_host = st.one_of(
    st.just(Hello()),
    st.just(Alive()),
    st.builds(Setpoint, kinds(codes.TargetKind), four, st.booleans(), st.booleans(), u8),
    st.builds(Order, kinds(codes.Command), u8),
    st.builds(Set, u8, f32),
    st.builds(Get, u8),
    st.builds(Test, kinds(codes.TestKind), u8, f32, u16),
)
from_board = st.one_of(
    telemetry,
    st.builds(
        Identity,
        u8,
        kinds(codes.BoardKind),
        kinds(codes.RobotKind),
        kinds(codes.DriveKind),
        u8,
        u16,
        u16,
        u32,
        u32,
        kinds(codes.Reset),
        kinds(codes.SettingsSource),
    ),
    st.builds(Ack, kinds(codes.Refusal), f32),
    st.builds(Sample, u32, u8, f32, f32),
)
messages = from_host | from_board
payloads = st.binary(min_size=3, max_size=56)


def as_float32(value: float) -> float:
    """What is left of a number in four bytes."""
    return struct.unpack("<f", struct.pack("<f", value))[0]
