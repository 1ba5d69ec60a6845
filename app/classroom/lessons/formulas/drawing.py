"""How long a drawing takes, by hand."""

from __future__ import annotations

from app.classroom.lessons.formulas.registry import formula


@formula("drawing_time", "s")
def drawing_time(ink: float, pen_up: float, lifts: float, speed: float, up_speed: float, lift_s: float) -> float:
    """ink / speed + pen_up / up_speed + lifts x lift_s: lengths in mm, speeds in mm/s; accelerations are left out."""
    return ink / speed + pen_up / up_speed + lifts * lift_s


@formula("fit_scale", "%")
def fit_scale(width: float, height: float, inner_width: float, inner_height: float) -> float:
    """Scale at which a picture just fits inside the margins, all in mm."""
    return 100.0 * min(inner_width / width, inner_height / height)
