"""The table of all ways to draw, from which a page builds its choices and sliders, and good starting points."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from app.drawing.rasterise import RASTER_MODES
from app.drawing.rasterise.mode import Parameter
from app.drawing.vectorise.modes import OWN

AUTO = "auto"
PAPER = "paper"
PORTRAIT = "portrait"
PORTRAIT_LINES = "sketch"
MAX_STROKES = 10_000
"""More are no drawing but noise, and would take a robot most of an hour."""

Value = float | Literal["auto"]


@dataclass(frozen=True)
class DrawingMode:
    """One way to draw."""

    title: str
    explanation: str
    """For students, a sentence or two."""
    parameters: tuple[Parameter, ...]
    """Of the picture first (the paper's width, gamma and smooth), then of the mode."""

    @property
    def defaults(self) -> dict[str, Value]:
        """What the mode does if nothing is set."""
        return {each.name: AUTO if each.auto else each.default for each in self.parameters}


@dataclass(frozen=True)
class Preset:
    """A good starting point."""

    title: str
    mode: str
    parameters: Mapping[str, Value] = field(default_factory=dict)
    """Those that differ from the mode's own."""
    explanation: str = ""


WIDTH = Parameter(
    "width", "Width", 1000.0, 100.0, 1400.0, 20.0, "px", True,
    explanation="Pixels across the picture before anything is sought in it: fewer leave out detail.",
)  # fmt: skip
GAMMA = Parameter(
    "gamma", "Gamma", 1.0, 0.2, 5.0, 0.05, explanation="Below 1 the picture gets brighter, above 1 darker."
)
SMOOTH = Parameter(
    "smooth", "Smooth", 1.0, 1.0, 31.0, 2.0, "px",
    explanation="Size of the Gaussian that blurs the picture, odd: takes away noise and fine detail. 1 is none.",
)  # fmt: skip
PICTURE = (WIDTH, GAMMA, SMOOTH)

APERTURE = Parameter(
    "aperture", "Aperture", 3.0, 3.0, 7.0, 2.0, "px", choices=(3.0, 5.0, 7.0),
    explanation="Size of the Sobel kernel that measures the slope of the tones: a larger one sees softer edges.",
)  # fmt: skip
LOW = Parameter(
    "low", "Low threshold", 40.0, 0.0, 300.0, 5.0, auto=True,
    explanation="Slope at which an edge ends: lower makes edges longer.",
)  # fmt: skip
HIGH = Parameter(
    "high", "High threshold", 100.0, 0.0, 600.0, 5.0, auto=True,
    explanation="Slope at which an edge may start: higher keeps only the clear ones.",
)  # fmt: skip
EDGES = (APERTURE, LOW, HIGH)
SKETCH = (
    Parameter("strong", "Dark lines", 0.06, 0.01, 0.12, 0.005, explanation="Share of the picture that starts a line."),
    Parameter("weak", "Faint lines", 0.12, 0.06, 0.4, 0.01, explanation="Share of the picture that may continue one."),
)
SHORTEST = Parameter(
    "shortest_mm", "Shortest stroke", 2.0, 0.0, 20.0, 0.2, "mm", explanation="What is shorter is left out."
)
JOIN = Parameter("join_mm", "Join gaps", 1.5, 0.0, 5.0, 0.1, "mm", explanation="Gaps as wide as this are drawn over.")
TRACING = (
    Parameter(
        "smooth_px", "Smooth strokes", 1.0, 0.0, 5.0, 0.1, "px",
        explanation="Rounds a stroke, so that the robot need not brake at each pixel.",
    ),
    Parameter(
        "tolerance_mm", "Tolerance", 0.05, 0.0, 1.0, 0.01, "mm",
        explanation="A stroke may move by this to be drawn with fewer points.",
    ),
)  # fmt: skip
WEIGHT = Parameter("weight", "Weight of the tones", 0.5, 0.0, 1.0, 0.05, explanation="0 is lines only, 1 full tones.")


def _strokes(mode: str) -> tuple[Parameter, ...]:
    """How traced lines become strokes, with the mode's own values."""
    own = OWN[mode]
    return replace(SHORTEST, default=own.shortest_mm), replace(JOIN, default=own.join_mm), *TRACING


def _raster_mode(name: str) -> DrawingMode:
    """The picture's parameters, but for those of which the mode has its own, then the mode's."""
    mode = RASTER_MODES[name]
    own = {each.name for each in mode.parameters}
    picture = (each for each in PICTURE if each.name not in own)
    return DrawingMode(mode.title, mode.explanation, (*picture, *map(_as_offered, mode.parameters)))


def _as_offered(parameter: Parameter) -> Parameter:
    """Every dot is a stroke."""
    return replace(parameter, high=float(MAX_STROKES)) if parameter.name == "dots" else parameter


DRAWING_MODES: dict[str, DrawingMode] = {
    AUTO: DrawingMode(
        "Automatic",
        "Looks whether the picture is line art, filled shapes or a photo, and takes the mode that suits it.",
        (*PICTURE, replace(SHORTEST, auto=True), replace(JOIN, auto=True), *TRACING),
    ),
    "sketch": DrawingMode(
        "Sketch",
        "Dark lines as an artist sees them, smoothed along their flow. Best for photos of faces, animals and things.",
        (*PICTURE, *SKETCH, *_strokes("sketch")),
    ),
    "canny": DrawingMode(
        "Edges (Canny)",
        "Canny's edges, where the tone changes most, each traced once. A thin dark line has two of them.",
        (*PICTURE, *EDGES, *_strokes("canny")),
    ),
    "centreline": DrawingMode(
        "Centre lines",
        "The middle of every line, straight through crossings. For line art and handwriting.",
        (*PICTURE, *_strokes("centreline")),
    ),
    "outline": DrawingMode(
        "Outlines",
        "The borders of flat shapes, below a pixel exact. For logos, clip art and silhouettes.",
        (*PICTURE, *EDGES, *_strokes("outline")),
    ),
    PAPER: DrawingMode(
        "As in the paper",
        "Contours around Canny's edges, as the paper's robot draws them: nearly every line twice, in no good order.",
        (*PICTURE, *EDGES),
    ),
    **{name: _raster_mode(name) for name in RASTER_MODES},
    PORTRAIT: DrawingMode(
        "Portrait",
        "A sketch with light hatching: lines tell who it is, tones give the face its shape.",
        (*PICTURE, *SKETCH, *_strokes(PORTRAIT_LINES), WEIGHT),
    ),
}
"""Name -> mode; `auto` first."""

PRESETS: dict[str, Preset] = {
    "quick": Preset(
        "Quick sketch",
        "sketch",
        {"strong": 0.03, "weak": 0.08, "shortest_mm": 6.0, "join_mm": 2.5},
        "The few lines that matter, in a fraction of the time.",
    ),
    "fine": Preset(
        "Fine sketch",
        "sketch",
        {"strong": 0.08, "weak": 0.16, "shortest_mm": 1.6},
        "More lines and fainter ones: hair, fur and leaves.",
    ),
    "portrait": Preset(
        "Portrait with tones", PORTRAIT, {"gamma": 0.8}, "A face: its lines, and light hatching in the shade."
    ),
    "line_art": Preset("Line art", "centreline", {}, "A drawing, a plan or handwriting: the middle of each line."),
    "logo": Preset("Logo outlines", "outline", {}, "The borders of filled shapes."),
    "hatched": Preset("Hatched", "hatch", {"pitch": 1.6}, "Tones from straight lines in two directions."),
    "waves": Preset(
        "Waves", "squiggle", {}, "Rows of waves, higher where it is darker: few lifts, and good from afar."
    ),
    "one_line": Preset(
        "One line", "one_line", {"points": 4000.0}, "A single line, for a robot that cannot lift its pen."
    ),
    "dots": Preset(
        "Dots",
        "stipple",
        {"dots": 2000.0},
        "Dots, closer together where it is darker; each one is a lift, so it is slow.",
    ),
    "laser": Preset(
        "Laser rows",
        "threshold_rows",
        {"smooth": 5.0, "pitch": 2.0},
        "The dark parts row by row, to and fro, as the paper's laser burns them.",
    ),
    "paper": Preset(
        "The paper's way", PAPER, {"smooth": 7.0}, "Contours around Canny's edges: compare its time with the others."
    ),
}
"""Name -> preset."""
