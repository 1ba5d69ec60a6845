"""Everything that was promised of the drawing pipeline, against its peers, in one run.

    python tests/benchmarks/drawing.py --photos FOLDER [--peers PYTHON] [--json]

FOLDER holds astronaut.png, camera.png, coffee.png, chelsea.png, motorcycle.png (the left one) and page.png from the
data of scikit-image. PYTHON is an interpreter that has vpype, sknw, scikit-image and toppra; without it only our own
figures are printed. All strokes are timed with the same planner on the same delta3, sheet and pen. The baseline is
what vpype gives with its defaults: sknw's strokes of the same Canny edges, merged, simplified, filtered and sorted
by two-opt. The paper's way is the contours of Canny's edges as found, with a lift.
"""

from __future__ import annotations

import json
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import tyro

from app.drawing.compose import compose
from app.drawing.order import order_strokes
from app.drawing.toolpath import Toolpath, track
from app.drawing.vectorise import vectorise
from app.robots.limits import rate_limits
from tests.benchmarks.drawing_order import random_lines
from tests.benchmarks.drawing_peers import ask, pack, unpack
from tests.benchmarks.drawing_photos import (
    PAGE,
    PEN,
    PHOTOS,
    ROBOT,
    Photo,
    look,
    open_way,
    photo_rows,
    planned,
    read_photo,
    seconds,
    shuffled,
)
from tests.benchmarks.drawing_speed import played_s, speed_rows
from tests.benchmarks.drawing_toolpath import grid, optimal_times
from tests.benchmarks.targets import Row, table
from tests.drawing.vectorise import pictures

LIKENESS = {"astronaut": 0.86, "camera": 0.90, "chelsea": 0.90}
RANDOM = {2000: (0.97, 0.3), 20_000: (1.0, 2.0)}
"""Strokes -> most of two-opt's way, most seconds."""


@dataclass(frozen=True)
class Options:
    """What to measure."""

    photos: Path
    """Folder of the photos."""
    peers: Path | None = None
    """Interpreter that has vpype, sknw, scikit-image and toppra."""
    json: bool = False
    """Print JSON instead of a table."""


def line_art_rows() -> list[Row]:
    rows = []
    for draw in (pictures.circles_and_cross, pictures.cartoon, pictures.spiral):
        truth = draw()
        strokes = vectorise(pictures.inked(truth), "centreline", pictures.MM_PER_PX).strokes
        rms, covered = pictures.rms_and_covered(strokes, truth)
        length, name = pictures.length(strokes) / pictures.length(truth), draw.__name__
        note = f"{len(strokes)} for {len(truth)}, {length:.3f} of the length"
        rows += [
            Row("centre line", f"{name}: strokes too many or too few", abs(len(strokes) - len(truth)), 1, note=note),
            Row("centre line", f"{name}: length off", abs(length - 1.0), 0.02),
            Row("centre line", f"{name}: rms, px", rms, 0.35),
            Row("centre line", f"{name}: covered", covered, 0.99, at_least=True),
        ]
    truth = pictures.logo()
    strokes = vectorise(pictures.filled(truth), "outline", pictures.MM_PER_PX).strokes
    rms = pictures.rms_and_covered(strokes, truth)[0]
    return [*rows, Row("outline", "logo: rms, px", rms, 0.37, note="potrace's, by the specification")]


def tone_rows(photos: list[Photo]) -> list[Row]:
    rows = []
    for photo in photos:
        if photo.name in LIKENESS:
            found = compose(photo.source, look("squiggle"))
            assert found.similarity is not None
            least = LIKENESS[photo.name]
            rows.append(Row("tones", f"{photo.name}: squiggle, likeness", found.similarity, least, at_least=True))
            if photo.name == "astronaut":
                ratio = seconds(found.strokes) / seconds(compose(photo.source, look("threshold_rows")).strokes)
                rows.append(Row("tones", f"{photo.name}: squiggle's robot time / threshold rows", ratio, 0.75))
    return rows


def random_order_rows(python: Path | None) -> list[Row]:
    rows = []
    for count, (most, most_s) in RANDOM.items():
        strokes = shuffled(random_lines(count, np.random.default_rng(0)))
        start = time.process_time()
        ours = order_strokes(strokes)
        took = time.process_time() - start
        rows.append(Row("order", f"{count} random: s of the processor", took, most_s))
        if python is not None:
            found = ask(python, "vpype", pack(strokes), "linesort -t")
            ratio = open_way(ours) / open_way(unpack(found))
            rows.append(
                Row("order", f"{count} random: pen up / two-opt", ratio, most, note=f"its {found['seconds']:.1f} s")
            )
    return rows


def time_law_rows(photos: list[Photo], python: Path | None) -> list[Row]:
    rows, limits = [], rate_limits(ROBOT)
    for photo in photos:
        path = planned(photo.strokes)
        acceleration = np.abs(np.diff(path.q, n=2, axis=0)) / 1e-6 / limits.acceleration
        speed = np.abs(np.diff(path.q, axis=0)) / 1e-3 / limits.speed
        down_s = 1e-3 * np.count_nonzero(path.stroke >= 0)
        hop_ms = 1e3 * (path.duration_s - down_s) / (len(photo.strokes) + 1)
        rows += [
            Row("time law", f"{photo.name}: joint acceleration / limit", float(acceleration.max()), 1.05),
            Row("time law", f"{photo.name}: joint speed / limit", float(speed.max()), 1.0 + 1e-9),
            Row("time law", f"{photo.name}: samples above 1.05", float((acceleration > 1.05).sum()), 0),
            Row("hops", f"{photo.name}: ms each", hop_ms, 165, note=f"{len(photo.strokes)} strokes"),
        ]
    rows += _against_optimal(planned(photos[0].strokes), photos[0].name, python)
    path = track(planned(photos[0].strokes))
    off = abs(played_s(path) / planned(photos[0].strokes).duration_s - 1.0)
    return [*rows, Row("estimate", f"{photos[0].name}: off the time played", off, 0.01, note="by the page's clock")]


def _against_optimal(path: Toolpath, name: str, python: Path | None) -> list[Row]:
    """The strokes on the very same geometry, in the least time that the joints allow."""
    limits, tool_speed = rate_limits(ROBOT), 1e-3 * PEN.speed_mm_s
    down = np.array([1e-3 * np.count_nonzero(path.stroke == k) for k in range(int(path.stroke.max()) + 1)])
    best = float(optimal_times(path, limits, tool_speed).sum())
    rows = [Row("time law", f"{name}: pen down / time-optimal", down.sum() / best, 1.12, note="our own TOPP")]
    if python is not None:
        grids = [np.column_stack(grid(path, k)) for k in range(len(down))]
        given = {"path": np.concatenate(grids), "counts": [len(each) for each in grids], "tool_speed": tool_speed}
        found = ask(python, "toppra", given | limits._asdict())
        solved = np.isfinite(found["durations"])
        ratio = down[solved].sum() / found["durations"][solved].sum()
        note = f"{solved.sum()} of {len(solved)} strokes solved, in {found['seconds']:.1f} s"
        rows.append(Row("time law", f"{name}: pen down / toppra", ratio, 1.12, note=note))
    return rows


def main() -> None:
    options = tyro.cli(Options, description=__doc__)
    photos = [read_photo(options.photos, name) for name in PHOTOS]
    rows = [
        *photo_rows(photos, read_photo(options.photos, PAGE), options.peers),
        *line_art_rows(),
        *tone_rows(photos),
        *random_order_rows(options.peers),
        *time_law_rows(photos, options.peers),
        *speed_rows(photos[0].grey),
    ]
    print(json.dumps([row.as_json() for row in rows], indent=2) if options.json else table(rows))


if __name__ == "__main__":
    main()
