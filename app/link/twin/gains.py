"""Gains between the control lab (volts per deg or mm) and a board (volts per rad or m), and whether they are safe.

The board's PID is that of `app.control.sampled_pid`: backward Euler, set-point weights b = c = 1, n = 0 for a
derivative without filter.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from app.control import Motor, Pid
from app.control.frequency import OpenLoop
from app.control.margins import Margins, margins
from app.control.sampled_pid import Sampling
from app.link.errors import LinkError
from app.link.protocol.settings import setting_id
from app.simulation.run import SHOWN

LEAST_PHASE_MARGIN_DEG = 25.0
LEAST_GAIN_MARGIN = 1.5
"""The gain may be wrong by this factor, up or down, before the loop oscillates."""


class UnsafeGains(LinkError):
    """Gains that would make a real joint swing or run away."""


@dataclass(frozen=True)
class GainCheck:
    """A loop that passed, and by how much."""

    margins: Margins
    sentence: str


def gains_for_board(pid: Pid, joint_unit: str, joints: Iterable[int]) -> dict[int, float]:
    """Settings (id -> value) of these joints (from 0) of a robot whose `joint_unit` is `rad` or `m`."""
    if (pid.b, pid.c) != (1.0, 1.0):
        raise LinkError("The board's PID has no set-point weights; set b and c to 1 before the gains go to the board.")
    factor = SHOWN[joint_unit][1]
    n = pid.n if math.isfinite(pid.n) and pid.kd else 0.0
    values = {"kp": pid.kp * factor, "ki": pid.ki * factor, "kd": pid.kd * factor, "n": n}
    if not all(math.isfinite(value) for value in values.values()):
        raise LinkError("A gain is not a finite number; choose finite gains before they go to the board.")
    return {setting_id(name, joint): value for joint in joints for name, value in values.items()}


def gains_from_board(settings: Mapping[int, float], joint: int, joint_unit: str) -> Pid:
    """The controller of a joint (from 0), in volts per deg or mm. LinkError where its settings are not known."""
    factor = SHOWN[joint_unit][1]
    try:
        kp, ki, kd, n = (settings[setting_id(name, joint)] for name in ("kp", "ki", "kd", "n"))
    except KeyError:
        raise LinkError(f"The gains of joint {joint + 1} are not known yet; read the board's settings first.") from None
    return Pid(kp / factor, ki / factor, kd / factor, n or math.inf)


def check_gains(pid: Pid, motor: Motor, period_s: float) -> GainCheck:
    """The loop as the board would run it, `motor` as identified; both in the same unit.

    Raises:
        UnsafeGains: where it would be unstable or its margins are too thin, with the numbers.
    """
    if pid.kp <= 0.0 or min(pid.ki, pid.kd) < 0.0:
        raise UnsafeGains(
            f"The gains kp {pid.kp:g}, ki {pid.ki:g}, kd {pid.kd:g} would push a joint away from its set-point; "
            "choose kp above 0, and ki and kd of at least 0."
        )
    loop = OpenLoop(motor, pid, sampling=Sampling(period_s))
    found = margins(loop)
    if not found.stable:
        fastest = max(loop.poles().real)
        raise UnsafeGains(
            f"With these gains the joint would swing more and more at the board's period of {period_s * 1e3:g} ms: "
            f"a closed-loop pole lies at {fastest:+.3g} 1/s; lower kp or kd."
        )
    swing = math.exp(abs(math.log(found.gain_margin))) if found.gain_margin < math.inf else math.inf
    if found.phase_margin_deg < LEAST_PHASE_MARGIN_DEG or swing < LEAST_GAIN_MARGIN:
        raise UnsafeGains(
            f"These gains are too close to swinging: phase margin {found.phase_margin_deg:.0f} degrees (at least "
            f"{LEAST_PHASE_MARGIN_DEG:g}), gain margin {swing:.2f} (at least {LEAST_GAIN_MARGIN:g}); "
            "lower kp or raise kd."
        )
    return GainCheck(found, f"Stable: phase margin {found.phase_margin_deg:.0f} degrees, gain margin {_factor(swing)}.")


def _factor(value: float) -> str:
    return f"{value:.2g}" if value < math.inf else "without limit"
