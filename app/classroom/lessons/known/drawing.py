"""The tab Draw: what is drawn, how it becomes strokes, how the robot draws them.

What is computed is there once it belongs to the present settings; until then its facts have no value.
"""

from __future__ import annotations

from app.classroom.lessons.known.kind import Facts, choice, flag, number, setting, switch, word

SAMPLES = ("robot", "mandala", "logo", "bicycle", "cat", "astronaut", "coffee", "camera")
MODES = (
    "auto",
    "sketch",
    "canny",
    "centreline",
    "outline",
    "paper",
    "squiggle",
    "hatch",
    "streamlines",
    "spiral",
    "one_line",
    "threshold_rows",
    "stipple",
    "portrait",
)
PRESETS = (
    "quick",
    "fine",
    "portrait",
    "line_art",
    "logo",
    "hatched",
    "waves",
    "one_line",
    "dots",
    "laser",
    "paper",
)

DRAWING: Facts = {
    "drawing.sample": choice("Picture that ships with Delta Lab; empty for another", *SAMPLES),
    "drawing.text": choice("Letters to be drawn; setting it draws them"),
    "drawing.source": word("What is drawn: a sample's name, `text`, `hand`, or the name of a file"),
    "drawing.own": flag("Whether it is one's own: a file, letters, or drawn by hand"),
    "drawing.mode": choice("How the picture becomes strokes", *MODES),
    "drawing.used_mode": word("What `auto` has chosen", *MODES),
    "drawing.preset": choice("Mode with good values for it; can only be set", *PRESETS),
    "drawing.knob.*": setting("A value of the mode, in its unit: drawing.knob.smooth, drawing.knob.pitch"),
    "drawing.sheet": choice("Paper", "A6", "A5", "A4"),
    "drawing.landscape": switch("Whether the paper lies across"),
    "drawing.margin": setting("Around the drawing", "mm"),
    "drawing.scale": setting("Of what fits inside the margins", "%"),
    "drawing.pen": setting("Width of the pen's line", "mm"),
    "drawing.sheet_x": setting("Middle of the sheet", "mm"),
    "drawing.sheet_y": setting("Middle of the sheet", "mm"),
    "drawing.sheet_z": setting("Height of the sheet", "mm"),
    "drawing.sheet_turn": setting("Turn of the sheet", "deg"),
    "drawing.lift": switch("Whether the pen is lifted between strokes"),
    "drawing.lift_height": setting("How far", "mm"),
    "drawing.speed": setting("Of the pen on the paper", "mm/s"),
    "drawing.up_speed": setting("Above the paper", "mm/s"),
    "drawing.laser": switch("A laser in place of the pen"),
    "drawing.ready": flag("Whether there are strokes for what is set"),
    "drawing.planned": flag("Whether the robot has a way to draw them"),
    "drawing.refused": flag("Whether what is set cannot be drawn"),
    "drawing.refusal": word("Why not, in a sentence"),
    "drawing.strokes": number("Number of strokes"),
    "drawing.lifts": number("How often the pen is lifted"),
    "drawing.ink": number("Length of all strokes", "mm"),
    "drawing.pen_up": number("Way between the strokes", "mm"),
    "drawing.retraced": number("Share of the ink that runs along other ink", "%"),
    "drawing.similarity": number("How like the picture it looks", "%"),
    "drawing.out_of_reach": number("Share of the points that the robot cannot reach", "%"),
    "drawing.time": number("How long the robot draws", "s"),
    "drawing.stray_ink": number("Ink between the strokes, of a pen that is not lifted", "mm"),
    "drawing.joint_speed": number("Largest joint speed, of its limit", "%"),
    "drawing.improved": flag("Whether a quicker order than the first was found"),
    "drawing.drawn": number("Share that was drawn on the page, by time", "%"),
    "drawing.exported": flag("Whether what is shown was saved as a file"),
}

DRAWING_PRESSES = {
    "draw": "Let the robot on the page draw to the end.",
    "improve": "Look for a quicker order of the strokes now.",
    "coarser": "Take the settings that a refusal offers.",
    "save": "Save the drawing as a file.",
}
