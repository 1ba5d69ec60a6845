"""What a student has set to compare controllers. Immutable: a change makes a new one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Literal

FEWEST_LAWS, MOST_LAWS = 2, 6

Gains = Literal["standard", "equal", "own"]
PlantName = Literal["exact", "mujoco"]

GAINS: dict[Gains, str] = {
    "standard": "As in the paper",
    "equal": "Fair: equal bandwidth",
    "own": "A bandwidth for each",
}
"""Where gains come from -> what students read."""
PLANTS: dict[PlantName, str] = {"exact": "Analytic model", "mujoco": "MuJoCo"}

PLANNED = "planned"
"""The task that the student has planned."""


@dataclass(frozen=True)
class Task:
    """What the robot is to do while it is watched."""

    title: str
    robot: str = ""
    """Empty: any."""
    friction: float = 0.0
    """Share of the declared friction with which it is first tried."""


TASKS: dict[str, Task] = {
    "T1": Task("Helix T1 (thesis)", "linear"),
    "T2": Task("Helix T2, faster and wider", "linear"),
    "W1": Task("Work cycle W1 (paper)", "fivebar", 1.0),
    "W2": Task("Work cycle W2, long stroke", "fivebar", 1.0),
    PLANNED: Task("The motion planned above"),
}

FIRST_LAWS = {"fivebar": ("PD", "PID", "TSIDC", "TSIIDC")}
BANDWIDTH_HZ = {"linear": 9.5, "fivebar": 30.0}
"""About that of the published gains; of the other robots, `USUAL_BANDWIDTH_HZ`."""
USUAL_BANDWIDTH_HZ = 9.0


@dataclass(frozen=True)
class CompareSettings:
    """One comparison: the same robot and task under several laws. SI units."""

    robot: str
    task: str
    """Key of `TASKS`."""
    laws: tuple[str, ...]
    """Keys of `LAWS`, in their order there."""
    gains: Gains = "standard"
    bandwidth_hz: float = USUAL_BANDWIDTH_HZ
    """Of every law, where it is equal."""
    own_hz: Mapping[str, float] = field(default_factory=dict)
    """Bandwidth by law, where each has its own."""
    friction: float = 0.0
    """Share of the declared friction; 0: none."""
    payload_kg: float = 0.0
    """At the tool, and unknown to the controller."""
    model_error: float = 0.0
    """Masses in the controller's model: times 1 + this."""
    encoder_step: float = 0.0
    """rad or m; 0: ideal."""
    delay_samples: int = 0
    velocity_filter_hz: float = 0.0
    """0: ideal."""
    limit_effort: bool = True
    limit_speed: bool = False
    plant: PlantName = "exact"

    def bandwidth_of(self, law: str) -> float | None:
        """Hz; None for the published gains."""
        if self.gains == "standard":
            return None
        return self.bandwidth_hz if self.gains == "equal" else self.own_hz.get(law, self.bandwidth_hz)


def default_compare(robot: str) -> CompareSettings:
    """The paper's own comparison, or the planned motion where there is none."""
    task = next(iter(tasks_for(robot)))
    return CompareSettings(
        robot=robot,
        task=task,
        laws=FIRST_LAWS.get(robot, ("PD", "PID", "CTC")),
        gains="standard" if robot in BANDWIDTH_HZ else "equal",
        bandwidth_hz=BANDWIDTH_HZ.get(robot, USUAL_BANDWIDTH_HZ),
        friction=TASKS[task].friction,
    )


def tasks_for(robot: str) -> Mapping[str, Task]:
    """What this robot can be compared on; its paper's tasks come first."""
    return MappingProxyType({key: task for key, task in TASKS.items() if task.robot in ("", robot)})


def difference(old: CompareSettings, new: CompareSettings) -> str:
    """What has changed in words, say `friction 0× → 1×`; empty where only the laws have."""
    pairs = zip(_spoken(old), _spoken(new), strict=True)
    return ", ".join(f"{name} {before} → {after}" for (name, before), (_, after) in pairs if before != after)


def _spoken(settings: CompareSettings) -> list[tuple[str, str]]:
    s = settings
    equal = f"equal, {s.bandwidth_hz:g} Hz" if s.gains == "equal" else GAINS[s.gains].lower()
    own = ", ".join(f"{law} {hz:g}" for law, hz in s.own_hz.items()) if s.gains == "own" else ""
    return [
        ("gains", equal),
        ("bandwidths", own or "none"),
        ("friction", f"{s.friction:g}×"),
        ("payload", f"{s.payload_kg:g} kg"),
        ("model error", f"{100 * s.model_error:g} %"),
        ("encoder step", f"{1e3 * s.encoder_step:g}e-3"),
        ("delay", f"{s.delay_samples} samples"),
        ("speed filter", f"{s.velocity_filter_hz:g} Hz" if s.velocity_filter_hz else "none"),
        ("torque limits", "on" if s.limit_effort else "off"),
        ("speed limits", "on" if s.limit_speed else "off"),
        ("plant", PLANTS[s.plant]),
    ]
