"""Motions, the work cycle and maps, as lessons read and set them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any
from weakref import WeakKeyDictionary

import numpy as np

from app.classroom.lessons.lesson import Value
from app.errors import UserMistake
from app.motion import CYCLES, Motion
from app.motion.demands import KINDS
from app.ui.desks import Desks
from app.ui.lessons.facts.field import Field, Read, deg, index_of
from app.ui.motion.desk import WITH_CYCLE, MotionDesk
from app.ui.motion.map_desk import MapDesk

CHANGED = "changed"
MM, DEG, PERCENT = 1e-3, math.radians(1.0), 0.01

COURSE: Mapping[str, tuple[str, float | None]] = {
    "curve": ("curve", None),
    "profile": ("profile", None),
    "size": ("size_m", MM),
    "height": ("height_m", MM),
    "lower": ("lower_m", MM),
    "turns": ("turns", 1.0),
    "sides": ("sides", 1.0),
    "laps": ("laps", 1.0),
    "turn": ("turn_rad", DEG),
    "payload": ("payload_kg", 1.0),
    "speed_share": ("speed_share", PERCENT),
    "acceleration_share": ("acceleration_share", PERCENT),
    "effort_share": ("effort_share", PERCENT),
}
"""Field of the settings, and the factor from what is read; None for words."""

CYCLE: Mapping[str, tuple[str, float | None]] = {
    "belt_speed": ("belt_speed_m_s", MM),
    "stroke": ("stroke_m", MM),
    "period": ("period_s", 1.0),
    "pick_x": ("pick_x_m", MM),
    "place_x": ("place_x_m", MM),
    "turn": ("turn_rad", DEG),
    "payload": ("payload_kg", 1.0),
    "enforce_speed": ("enforce_motor_speed", None),
}
COUNTS = frozenset({"sides", "laps"})


class Peaks:
    """The largest values of a motion, in the units that people read; some milliseconds."""

    def __init__(self, motion: Motion) -> None:
        robot = motion.settings.build()
        factors = np.array([1e3 if unit == "m" else math.degrees(1.0) for unit in robot.joint_units])
        self.names = robot.joint_names
        self.speed: list[float] = (np.abs(motion.joint_rates).max(axis=0) * factors).tolist()
        self.acceleration: list[float] = (np.abs(motion.joint_accelerations).max(axis=0) * factors).tolist()
        self.effort: list[float] = np.abs(motion.efforts).max(axis=0).tolist()
        shares = 100.0 * motion.shares.max(axis=0)
        self.speed_usage: list[float] = shares[0].tolist()
        self.usages: list[float] = shares.max(axis=1).tolist()
        self.usage = 100.0 * float(motion.usage.max())
        binding = np.array([kind in motion.binding for kind in KINDS])
        kind, joint = np.unravel_index(int(np.argmax(np.where(binding[:, None], shares, -1.0))), shares.shape)
        self.limit_kind, self.limit_joint = KINDS[kind], self.names[joint]
        self.tool_speed = 1e3 * float(np.linalg.norm(motion.rate[:, :3], axis=1).max())
        self.tool_acceleration = float(np.linalg.norm(motion.acceleration[:, :3], axis=1).max())


class MotionFacts:
    """`motion.*` and `cycle.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks
        self._peaks: WeakKeyDictionary[Motion, Peaks] = WeakKeyDictionary()

    def field(self) -> Field:
        return Field(
            {**self._settings(), **self._results()},
            self._writers(),
            read_each={
                "motion.peak_speed.": partial(self._of_joint, lambda peaks: peaks.speed),
                "motion.peak_acceleration.": partial(self._of_joint, lambda peaks: peaks.acceleration),
                "motion.peak_effort.": partial(self._of_joint, lambda peaks: peaks.effort),
                "motion.speed_usage.": partial(self._of_joint, lambda peaks: peaks.speed_usage),
            },
        )

    def _settings(self) -> dict[str, Read]:
        read: dict[str, Read] = {
            f"motion.{name}": partial(self._read, "course", field, factor) for name, (field, factor) in COURSE.items()
        }
        read |= {
            f"cycle.{name}": partial(self._read, "cycle", field, factor) for name, (field, factor) in CYCLE.items()
        }
        return {
            **read,
            "motion.fastest": lambda: self._desk.course.duration_s is None,
            "motion.duration": self._duration,
            "cycle.on": lambda: self._desk.cycling,
            "cycle.transfer": lambda: self._desk.cycle.durations[0],
            "cycle.name": self._cycle_name,
        }

    def _results(self) -> dict[str, Read]:
        return {
            "motion.planned": lambda: self._motion() is not None,
            "motion.refused": lambda: bool(self._refusal()),
            "motion.refusal": self._refusal,
            "motion.usage": partial(self._of_motion, lambda peaks: peaks.usage),
            "motion.limit_kind": partial(self._of_motion, lambda peaks: peaks.limit_kind),
            "motion.limit_joint": partial(self._of_motion, lambda peaks: peaks.limit_joint),
            "motion.tool_speed": partial(self._of_motion, lambda peaks: peaks.tool_speed),
            "motion.tool_acceleration": partial(self._of_motion, lambda peaks: peaks.tool_acceleration),
            "motion.speed_usage": partial(self._of_motion, lambda peaks: peaks.usages[0]),
            "motion.acceleration_usage": partial(self._of_motion, lambda peaks: peaks.usages[1]),
            "motion.effort_usage": partial(self._of_motion, lambda peaks: peaks.usages[2]),
            "motion.playing": lambda: self._desk.playback.playing,
            "motion.played": self._played,
        }

    def _writers(self) -> dict[str, Callable[[Any], None]]:
        desks = self._desks
        write: dict[str, Callable[[Any], None]] = {
            f"motion.{name}": partial(self._write, name, field, factor) for name, (field, factor) in COURSE.items()
        }
        write |= {f"cycle.{name}": partial(self._write_cycle, field, factor) for name, (field, factor) in CYCLE.items()}
        return {
            **write,
            "motion.fastest": lambda on: desks.motion.change(duration_s=None if on else self._duration() or 2.0),
            "motion.duration": lambda seconds: desks.motion.change(duration_s=float(seconds)),
            "cycle.on": self._show_cycle,
            "cycle.transfer": lambda seconds: self._write_cycle("transfer_s", 1.0, seconds),
            "cycle.name": self._take_cycle,
        }

    @property
    def _desk(self) -> MotionDesk:
        return self._desks.motion

    def _read(self, of: str, field: str, factor: float | None) -> Value:
        value = getattr(getattr(self._desk, of), field)
        return value if factor is None else value / factor

    def _write(self, name: str, field: str, factor: float | None, value: Any) -> None:
        if factor is None:
            self._desk.change(**{field: value})
        else:
            self._desk.change(**{field: round(value) if name in COUNTS else value * factor})

    def _write_cycle(self, field: str, factor: float | None, value: Any) -> None:
        self._need_cycle()
        self._desk.change_cycle(**{field: value if factor is None else value * factor})

    def _show_cycle(self, on: bool) -> None:
        if on:
            self._need_cycle()
        self._desk.show_cycle(on)

    def _take_cycle(self, name: str) -> None:
        self._need_cycle()
        if name not in CYCLES:
            raise UserMistake(f"There is no work cycle {name}: choose one of {', '.join(CYCLES)}.")
        self._desk.take_cycle(CYCLES[name])

    def _need_cycle(self) -> None:
        if self._desks.session.robot_name != WITH_CYCLE:
            raise UserMistake("Only the five-bar has a work cycle: choose that robot first.")

    def _cycle_name(self) -> str:
        desk = self._desk
        plain = {name: desk.robot.name == WITH_CYCLE and cycle == desk.cycle for name, cycle in CYCLES.items()}
        return next((name for name, same in plain.items() if same), CHANGED)

    def _duration(self) -> float | None:
        motion = self._motion()
        return self._desk.course.duration_s if motion is None else motion.duration_s

    def _motion(self) -> Motion | None:
        """The plan of what is set; None while it is not there."""
        desk = self._desk
        desk.look()
        return desk.motion if desk.motion is not None and desk.motion.settings == desk.settings else None

    def _refusal(self) -> str:
        self._desk.look()
        return "" if self._desk.planning else self._desk.refusal

    def _figures(self) -> Peaks | None:
        motion = self._motion()
        if motion is None:
            return None
        found = self._peaks.get(motion)
        if found is None:
            found = self._peaks[motion] = Peaks(motion)
        return found

    def _of_motion(self, get: Callable[[Peaks], Value]) -> Value | None:
        peaks = self._figures()
        return None if peaks is None else get(peaks)

    def _of_joint(self, get: Callable[[Peaks], list[float]], name: str) -> Value | None:
        peaks = self._figures()
        k = None if peaks is None else index_of(name, peaks.names)
        return None if peaks is None or k is None else get(peaks)[k]

    def _played(self) -> float:
        playback = self._desk.playback
        mine = playback.run is not None and playback.run is self._desk.motion
        return 100.0 * playback.time_s / playback.duration_s if mine else 0.0


class MapFacts:
    """`map.*`."""

    def __init__(self, desks: Desks) -> None:
        self._desks = desks

    def field(self) -> Field:
        desk = lambda: self._desks.maps  # noqa: E731
        return Field(
            {
                "map.on": lambda: desk().on,
                "map.quantity": lambda: desk().settings.quantity,
                "map.height": lambda: 1e3 * desk().settings.height_m,
                "map.angle": lambda: deg(desk().settings.rotation_rad),
                "map.acceleration": lambda: desk().settings.acceleration,
                "map.speed": lambda: desk().settings.speed,
                "map.payload": lambda: desk().settings.payload_kg,
                "map.joint": lambda: desk().settings.joint + 1,
                "map.ready": lambda: self._values() is not None,
                "map.at_tool": lambda: None if self._values() is None else desk().value_at_tool,
                "map.lowest": lambda: self._of_values(lambda values: float(np.nanmin(values))),
                "map.highest": lambda: self._of_values(lambda values: float(np.nanmax(values))),
                "map.beyond": self._beyond,
            },
            {
                "map.on": lambda on: desk().show(on),
                "map.quantity": lambda name: desk().change(quantity=name),
                "map.height": lambda mm: desk().change(height_m=MM * mm),
                "map.angle": lambda angle: desk().change(rotation_rad=math.radians(angle)),
                "map.acceleration": lambda value: desk().change(acceleration=float(value)),
                "map.speed": lambda value: desk().change(speed=float(value)),
                "map.payload": lambda value: desk().change(payload_kg=float(value)),
                "map.joint": self._choose_joint,
            },
        )

    def _values(self) -> np.ndarray | None:
        """Of the map of what is set; None while it is not there."""
        desk: MapDesk = self._desks.maps
        picture = desk.picture
        return picture.map.values if picture is not None and picture.map.settings == desk.settings else None

    def _of_values(self, get: Callable[[np.ndarray], float]) -> Value | None:
        values = self._values()
        return None if values is None else get(values)

    def _beyond(self) -> Value | None:
        picture, values = self._desks.maps.picture, self._values()
        if picture is None or values is None:
            return None
        return 100.0 * float(picture.map.beyond.sum() / np.isfinite(values).sum())

    def _choose_joint(self, number: float) -> None:
        names = self._desks.session.robot.joint_names
        if not 1 <= number <= len(names):
            raise UserMistake(f"There is no joint {number:g}: choose one from 1 to {len(names)}.")
        self._desks.maps.change(joint=round(number) - 1)
