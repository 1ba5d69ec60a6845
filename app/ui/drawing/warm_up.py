"""What has to be loaded before a first drawing, while nobody waits for it."""

from __future__ import annotations


def warm_up_worker() -> None:
    """In a worker: OpenCV and the first sketch, which take about a second."""
    from app.drawing.compose import Look
    from app.drawing.samples import sample_bytes
    from app.drawing.source import read_source
    from app.drawing.toolpath import PenSettings, default_placement
    from app.robots import build_robot
    from app.ui.drawing.jobs import Setup, Sketch, plan, sketch

    setup = Setup("delta3", {}, default_placement(build_robot("delta3", {})), PenSettings())
    drawn = sketch(read_source("robot", sample_bytes("robot")), Look(), setup)
    assert isinstance(drawn, Sketch)
    plan(drawn.strokes, setup)


def warm_up_server() -> None:
    """In the server: the room, which is not imported before."""
    from app.ui.drawing import room

    assert room.DrawingRoom is not None
