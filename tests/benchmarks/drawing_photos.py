"""Photos: our lines against the same edges by sknw and vpype, and against the paper's way, on the same robot."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from app.drawing.compose import Look, compose, on_sheet
from app.drawing.order import order_strokes, pen_up_mm
from app.drawing.source import Source, read_source
from app.drawing.toolpath import PenSettings, Toolpath, default_placement, plan_toolpath
from app.drawing.vectorise import vectorise
from app.drawing.vectorise.paper_contours import paper_contours
from app.robots import make_robot
from tests.benchmarks.drawing_peers import ask, pack, unpack
from tests.benchmarks.targets import Row
from tests.drawing.vectorise.pictures import f_score, retraced

Array = NDArray[np.float64]
Strokes = list[Array]

PHOTOS = ("astronaut", "camera", "coffee", "chelsea", "motorcycle")
PAGE = "page"
"""Text, photographed: it has another mode, and does not count in the means."""

SIDE_MM = 160.0
ORDER_S = 0.5
BASELINE = "linemerge linesimplify filter -m 2mm linesort --two-opt"
"""vpype with its defaults, 0.05 mm to merge and to simplify; its filter drops a little more than ours."""
TUNED = "linemerge -t 2.2mm linesimplify -t 0.2mm filter -m 2mm linesort --two-opt"
"""As wide gaps as ours, and coarser lines, which hide the pixels' stairs."""
TEXT = "linemerge linesimplify filter -m 0.8mm linesort --two-opt"
"""The same for small letters."""

ROBOT = make_robot("delta3")
PEN = PenSettings()


def planned(strokes: Sequence[Array]) -> Toolpath:
    """With the robot, place and pen that all share."""
    return plan_toolpath(strokes, ROBOT, default_placement(ROBOT), PEN)


def seconds(strokes: Sequence[Array]) -> float:
    """Of the robot."""
    return planned(strokes).duration_s


def look(mode: str, **parameters: float) -> Look:
    return Look(mode=mode, sheet_mm=(SIDE_MM, SIDE_MM), margin_mm=0.0, parameters=parameters)


@dataclass(frozen=True, eq=False)
class Photo:
    """A photo and what is drawn of its edges."""

    name: str
    source: Source
    strokes: Strokes
    """Ours, sheet millimetres, in our order."""
    pixels: Strokes
    """The same before they are ordered, in pixels."""
    edges: NDArray[np.bool_]
    """(h, w) Canny's mask, from which all start."""

    @property
    def grey(self) -> NDArray[np.uint8]:
        assert self.source.grey is not None
        return self.source.grey

    @property
    def mm_per_px(self) -> float:
        return SIDE_MM / max(self.grey.shape)


def read_photo(folder: Path, name: str) -> Photo:
    source = read_source(name, (folder / f"{name}.png").read_bytes())
    assert source.grey is not None
    found = vectorise(source.grey, "canny", SIDE_MM / max(source.grey.shape))
    drawn = compose(source, look("canny"), order_s=ORDER_S)
    return Photo(name, source, drawn.strokes, found.strokes, found.edge_mask)


def with_vpype(mask: NDArray[np.bool_], mm_per_px: float, python: Path, commands: str) -> Strokes:
    """sknw's strokes of a mask (h, w), after vpype's commands."""
    sheet = on_sheet(unpack(ask(python, "sknw", {"mask": mask})), mask.shape, mm_per_px)
    return unpack(ask(python, "vpype", pack(sheet), commands))


def papers_way(photo: Photo) -> Strokes:
    """The contours of the same edges as they are found."""
    return on_sheet(paper_contours(photo.edges), photo.edges.shape, photo.mm_per_px)


def photo_rows(photos: Sequence[Photo], page: Photo, python: Path | None) -> list[Row]:
    rows = [row for photo in (*photos, page) for row in _alone(photo)]
    rows += _beside_the_paper([*photos, page])
    if python is not None:
        rows += [*_beside_vpype(photos, python), *_page(page, python), *_order_rows(photos, python)]
    return rows


def _alone(photo: Photo) -> list[Row]:
    """What needs no peer."""
    again, like = retraced(photo.pixels), f_score(photo.pixels, photo.edges)
    return [
        Row("photos", f"{photo.name}: ink retraced", again, 0.015),
        Row("photos", f"{photo.name}: F against the same Canny", like, 0.98, at_least=True),
    ]


def _beside_the_paper(photos: Sequence[Photo]) -> list[Row]:
    rows, ratios = [], []
    for photo in photos:
        ours, theirs = seconds(photo.strokes), seconds(papers_way(photo))
        ratios.append(ours / theirs)
        note = f"{ours:.1f} / {theirs:.1f} s"
        rows.append(Row("photos", f"{photo.name}: robot time / paper's way", ratios[-1], note=note))
    mean = float(np.mean([ratio for ratio, photo in zip(ratios, photos, strict=True) if photo.name in PHOTOS]))
    return [*rows, Row("photos", "mean: robot time / paper's way", mean, 0.33, note="of the five photos")]


def _beside_vpype(photos: Sequence[Photo], python: Path) -> list[Row]:
    rows, ratios, tuned_ratios = [], [], []
    for photo in photos:
        peer, tuned = (with_vpype(photo.edges, photo.mm_per_px, python, commands) for commands in (BASELINE, TUNED))
        ours, theirs = seconds(photo.strokes), seconds(peer)
        ratios.append(ours / theirs)
        tuned_ratios.append(ours / seconds(tuned))
        note = f"{ours:.1f} / {theirs:.1f} s, {len(photo.strokes)} / {len(peer)} strokes"
        rows.append(Row("photos", f"{photo.name}: robot time / vpype", ratios[-1], 0.78, note=note))
        rows.append(Row("photos", f"{photo.name}: strokes / vpype", len(photo.strokes) / len(peer), 0.80))
    rows.append(Row("photos", "mean: robot time / vpype", float(np.mean(ratios)), 0.74))
    tuned_mean = float(np.mean(tuned_ratios))
    rows.append(Row("photos", "mean: robot time / vpype tuned", tuned_mean, note="merges 2.2 mm, simplifies 0.2 mm"))
    return rows


def _page(page: Photo, python: Path) -> list[Row]:
    """Text: Canny's edges as of a photo, and the middle of its ink, each beside the same of vpype."""
    rows = []
    for mode, commands, target in (("canny", BASELINE, 0.78), ("centreline", TEXT, None)):
        mask = vectorise(page.grey, mode, page.mm_per_px).edge_mask
        ours = seconds(compose(page.source, look(mode), order_s=ORDER_S).strokes)
        theirs = seconds(with_vpype(mask, page.mm_per_px, python, commands))
        note = f"{ours:.1f} / {theirs:.1f} s"
        rows.append(Row("photos", f"{page.name}: robot time / vpype, {mode}", ours / theirs, target, note=note))
    return rows


def _order_rows(photos: Sequence[Photo], python: Path) -> list[Row]:
    """The same shuffled strokes in our order and in vpype's; the open way, since vpype knows no home."""
    rows, ratios = [], []
    for photo in photos:
        strokes = shuffled(on_sheet(photo.pixels, photo.edges.shape, photo.mm_per_px))
        ours = open_way(order_strokes(strokes, budget_s=ORDER_S))
        plain, better = (
            open_way(unpack(ask(python, "vpype", pack(strokes), command))) for command in ("linesort", "linesort -t")
        )
        ratios.append(ours / better)
        rows.append(Row("order", f"{photo.name}: pen up / linesort", ours / plain, 0.80, note=f"{ORDER_S:g} s"))
        rows.append(Row("order", f"{photo.name}: pen up / two-opt", ours / better))
    return [*rows, Row("order", "mean: pen up / two-opt", float(np.mean(ratios)), 0.95)]


def shuffled(strokes: Strokes, seed: int = 0) -> Strokes:
    rng = np.random.default_rng(seed)
    return [strokes[k][:: rng.choice([1, -1])] for k in rng.permutation(len(strokes))]


def open_way(strokes: Strokes) -> float:
    """mm with the pen up between the strokes."""
    return pen_up_mm(strokes, tuple(strokes[0][0])) if strokes else math.nan
