"""What the robots weigh. The 5R's numbers are its paper's; the others' are declared, as no paper prints them.

A mass belongs to a part, whatever the dimensions: a longer rod stays as heavy as it was. Every inertia is about
the part's own centre of mass, so that a changed dimension cannot make a part impossible. Masses in kg, inertias
in kg m^2, places of centres of mass as a share of the part's length.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any, Self

GRAVITY = 9.81
"""m/s^2, along -z."""


class InertiaError(ValueError):
    """Masses that cannot be; the message is one sentence for the user."""


@dataclass(frozen=True)
class Quantity:
    """What kind of number a field holds."""

    label: str
    unit: str
    """`kg`, `kg m^2`, or empty for a share of a length from 0 to 1."""
    optional: bool = False


def mass(default: float, label: str) -> Any:
    """Kilograms."""
    return dataclasses.field(default=default, metadata={"quantity": Quantity(label, "kg")})


def inertia(default: float, label: str) -> Any:
    """Kilogram square metres."""
    return dataclasses.field(default=default, metadata={"quantity": Quantity(label, "kg m^2")})


def share(default: float | None, label: str) -> Any:
    """From 0 to 1; None only where that is the default."""
    return dataclasses.field(default=default, metadata={"quantity": Quantity(label, "", default is None)})


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """Base of every robot's masses."""

    payload: float = mass(0.0, "Payload")
    """A point mass at the tool point."""

    def __post_init__(self) -> None:
        for name, quantity in self.quantities().items():
            value = getattr(self, name)
            if value is None and quantity.optional:
                continue
            if not isinstance(value, int | float) or not math.isfinite(value) or value < 0.0:
                raise InertiaError(f"{quantity.label} ({name}) must be a number of at least 0, not {value!r}.")
            if not quantity.unit and value > 1.0:
                raise InertiaError(f"{quantity.label} ({name}) is a share and must lie between 0 and 1, not {value:g}.")

    @classmethod
    def quantities(cls) -> dict[str, Quantity]:
        """Field name -> what it holds, in the order of the class."""
        return {field.name: field.metadata["quantity"] for field in dataclasses.fields(cls)}

    def changed(self, **values: float | None) -> Self:
        """A copy with some fields replaced.

        Raises:
            InertiaError: for an unknown field or an impossible value.
        """
        known = self.quantities()
        for name in values:
            if name not in known:
                raise InertiaError(f"{name!r} is not a mass of this robot; it has {', '.join(known)}.")
        return dataclasses.replace(self, **values)

    def scaled(self, factor: float) -> Self:
        """A wrong model: every mass and inertia times `factor`, the payload and the places of centres kept."""
        kept = {name for name, quantity in self.quantities().items() if name == "payload" or not quantity.unit}
        return self.changed(**{name: factor * getattr(self, name) for name in self.quantities() if name not in kept})


@dataclass(frozen=True, kw_only=True)
class LinearInertia(Inertia):
    """linear: six carbon rods of 0.1 kg, uniform and thin (m_l l^2 / 12); carriages with their bearings and belts."""

    platform_mass: float = mass(0.60, "Platform")
    """m_p"""
    carriage_mass: float = mass(0.45, "One carriage")
    """m_s, what its belt and motor add included."""
    rod_mass: float = mass(0.10, "One rod")
    """m_l; there are six."""
    rod_com: float = share(0.5, "Rod's centre from the carriage")
    rod_inertia: float = inertia(0.10 * 0.365**2 / 12, "One rod across its length")
    lumped: float | None = share(None, "Share of the rods at the platform")
    """w of the thesis: this share of every rod's mass is put on the platform, the rest on the carriages. None
    takes rods as the rigid bodies they are."""


@dataclass(frozen=True, kw_only=True)
class FiveBarInertia(Inertia):
    """fivebar: Tables 1 and 2 of Righettini et al. (2024). Centres in the middle of the links are assumed."""

    proximal_mass: float = mass(2.9, "Arm")
    proximal_com: float = share(0.5, "Arm's centre from the motor")
    proximal_inertia: float = inertia(5.22e-2, "Arm")
    distal_mass: float = mass(2.9, "Rod")
    distal_com: float = share(0.5, "Rod's centre from the elbow")
    distal_inertia: float = inertia(5.22e-2, "Rod")
    tool_mass: float = mass(0.36, "Screw with gripper")
    """m_ee: moves with the tool in x, y and z."""
    tool_inertia: float = inertia(6.4e-6, "Screw with gripper about its axis")
    """J_ee: turns by phi."""
    nut_inertia: float = inertia(1.2e-6, "One nut")
    """J_3 = J_4: turn by q_3 and q_4."""
    arm_drive: float = inertia(64.0**2 * (17.0 + 24.85) * 1e-6, "Motor and gear of an arm, at the arm")
    """i_t^2 (J_m + J_t) of axes 1 and 2."""
    nut_drive: float = inertia(40.0**2 * (2.4 + 20.5) * 1e-6, "Motor and gear of a nut, at the nut")
    """i_t^2 (J_m + J_t) of axes 3 and 4."""


@dataclass(frozen=True, kw_only=True)
class RotaryInertia(Inertia):
    """Arms and rods of a rotary delta. Two rods a leg."""

    arm_mass: float
    arm_com: float
    """Centre of the arm from the motor axis."""
    arm_inertia: float
    """About the centre of the arm, along the motor axis."""
    rotor_inertia: float
    """Motor and gear, as felt at the arm."""
    rod_mass: float
    rod_com: float
    """Centre of a rod from the elbow."""
    rod_inertia: float
    """Of one rod about its centre, across its length."""


@dataclass(frozen=True, kw_only=True)
class Delta3Inertia(RotaryInertia):
    """delta3, a desk-top machine: milled aluminium arms of 160 mm, carbon tubes of 8 mm with a ball end of 6 g at
    either end, an aluminium star with the pen, small geared motors."""

    arm_mass: float = mass(0.12, "Arm")
    arm_com: float = share(0.40, "Arm's centre from the motor")
    arm_inertia: float = inertia(3.2e-4, "Arm")
    rotor_inertia: float = inertia(1.5e-3, "Motor and gear, at the arm")
    rod_mass: float = mass(0.026, "One rod")
    rod_com: float = share(0.5, "Rod's centre from the elbow")
    rod_inertia: float = inertia(5.8e-4, "One rod across its length")
    platform_mass: float = mass(0.15, "Platform with pen")


@dataclass(frozen=True, kw_only=True)
class Par4Inertia(RotaryInertia):
    """par4, a laboratory machine: aluminium arms of 200 mm, carbon tubes of 12 mm with a ball end of 10 g at
    either end, aluminium bars, steel links with the belts' wheels, a small gripper, geared servomotors."""

    arm_mass: float = mass(0.28, "Arm")
    arm_com: float = share(0.40, "Arm's centre from the motor")
    arm_inertia: float = inertia(1.2e-3, "Arm")
    rotor_inertia: float = inertia(4.0e-3, "Motor and gear, at the arm")
    rod_mass: float = mass(0.042, "One rod")
    rod_com: float = share(0.5, "Rod's centre from the elbow")
    rod_inertia: float = inertia(9.8e-4, "One rod across its length")
    bar_mass: float = mass(0.080, "One bar of the platform")
    """Bars never turn: a bar is a point mass in the middle between its two pivots."""
    link_mass: float = mass(0.040, "One link of the platform")
    link_com: float = share(0.40, "Link's centre from the bar of the tool")
    """Below a half: the wheel of the belt sits on the pivot in the bar of legs 3 and 4."""
    link_inertia: float = inertia(2.6e-5, "One link about the vertical")
    """Turns by theta."""
    tool_mass: float = mass(0.15, "Spindle with gripper")
    """At the tool point."""
    tool_inertia: float = inertia(4.0e-5, "Spindle with gripper about its axis")
    """Turns by 2 theta."""


INERTIA: dict[str, Inertia] = {
    "par4": Par4Inertia(),
    "delta3": Delta3Inertia(),
    "linear": LinearInertia(),
    "fivebar": FiveBarInertia(),
}
"""By name of the robot."""
