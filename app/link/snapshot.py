"""What a pilot knows, as a snapshot for others."""

from __future__ import annotations

from app.link.pilot import Pilot
from app.link.protocol.messages import Telemetry
from app.link.situation import LATCHED, describe_state
from app.link.status import Activity, LinkStatus

NOTICED = 1e-4
"""A joint that moved less (rad or m) looks as before."""


class Camera:
    """Takes snapshots."""

    def __init__(self, pilot: Pilot) -> None:
        self._pilot = pilot
        self._telemetry: Telemetry | None = None
        self._seen: tuple[object, ...] = ()
        self._revision = 0

    def take(self, now: float) -> LinkStatus:
        pilot, connection = self._pilot, self._pilot.connection
        self._telemetry = pilot.telemetry
        activity: Activity = "test" if pilot.trial is not None else pilot.mover.activity
        course = pilot.mover.course
        holder, left_s = pilot.lease.holder, pilot.lease.left_s(now)
        progress = course.progress if course else 0.0
        sentence = self._sentence(activity, now)
        recording_s = pilot.recorder.duration_s if pilot.recorder else 0.0
        self._count((
            connection.phase, connection.port, sentence, activity, holder, pilot.lease.queue, round(left_s),
            round(progress, 2), pilot.mover.override, len(connection.settings), round(recording_s),
            pilot.diary.lines[-1:], _visible(self._telemetry),
        ))  # fmt: skip
        return LinkStatus(
            phase=connection.phase,
            sentence=sentence,
            port=connection.port,
            identity=connection.identity,
            robot=connection.robot,
            telemetry=self._telemetry,
            holder=holder,
            holder_left_s=left_s,
            queue=pilot.lease.queue,
            activity=activity,
            progress=progress,
            program_title=course.program.title if course else "",
            override=pilot.mover.override,
            round_trip_ms=pilot.round_trips.median_ms,
            round_trip_p95_ms=pilot.round_trips.p95_ms,
            settings=dict(connection.settings),
            log=pilot.diary.lines,
            recording_s=recording_s,
            revision=self._revision,
        )

    def _sentence(self, activity: Activity, now: float) -> str:
        telemetry = self._telemetry
        if not self._pilot.connection.ready or telemetry is None:
            return self._pilot.connection.sentence
        if telemetry.state in LATCHED:
            return describe_state(telemetry, activity)
        return self._pilot.diary.fresh(now) or describe_state(telemetry, activity)

    def _count(self, seen: tuple[object, ...]) -> None:
        if seen != self._seen:
            self._seen, self._revision = seen, self._revision + 1


def _visible(telemetry: Telemetry | None) -> tuple[object, ...]:
    if telemetry is None:
        return ()
    moved = [round(value / NOTICED) for value in (*telemetry.position, *telemetry.setpoint)]
    return (telemetry.state, telemetry.flags, telemetry.fault, telemetry.limit_switches, *moved)
