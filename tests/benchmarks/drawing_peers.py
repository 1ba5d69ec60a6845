"""What the peers make of the same input: runs in their environment, knows nothing of the project.

    PYTHON drawing_peers.py sknw|vpype|toppra INPUT.npz OUTPUT.npz [COMMANDS]

Strokes are exchanged as files, see `pack`. Seconds are of the processor, without the start.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

PX_PER_MM = 96 / 25.4
"""Of vpype's documents."""

Strokes = list[Any]
"""(n, 2) arrays."""


def pack(strokes: Sequence[Any]) -> dict[str, Any]:
    """As two arrays of one file: all points, and how many of each stroke."""
    return {"points": np.concatenate([np.empty((0, 2)), *strokes]), "counts": [len(stroke) for stroke in strokes]}


def unpack(data: Mapping[str, Any]) -> Strokes:
    return np.split(data["points"], np.cumsum(data["counts"])[:-1]) if len(data["counts"]) else []


def ask(python: Path, what: str, given: Mapping[str, Any], *commands: str) -> dict[str, Any]:
    """Have one of `PEERS` run by another interpreter: arrays in, arrays out."""
    with tempfile.TemporaryDirectory() as folder:
        source, result = Path(folder, "in.npz"), Path(folder, "out.npz")
        np.savez(source, **given)
        subprocess.run([str(python), __file__, what, str(source), str(result), *commands], check=True)
        with np.load(result) as found:
            return dict(found)


def sknw(given: Mapping[str, Any]) -> dict[str, Any]:
    """Pixel strokes along the skeleton of a `mask` (h, w), from junction to junction."""
    from skimage.morphology import skeletonize  # pyright: ignore[reportMissingImports]
    from sknw import build_sknw  # pyright: ignore[reportMissingImports]

    skeleton = skeletonize(given["mask"]).astype(np.uint16)
    build_sknw(skeleton[:64, :64], multi=True)  # compiles
    start = time.process_time()
    graph = build_sknw(skeleton, multi=True)
    strokes = []
    for here, there, edge in graph.edges(data=True):
        ends = [graph.nodes[node]["o"] for node in (here, there)]
        way = np.asarray(edge["pts"], float)
        if np.linalg.norm(way[0] - ends[0]) > np.linalg.norm(way[-1] - ends[0]):
            ends.reverse()
        strokes.append(np.vstack([ends[0], way, ends[1]])[:, ::-1])
    return pack([stroke for stroke in strokes if len(stroke) > 1]) | {"seconds": time.process_time() - start}


def vpype(given: Mapping[str, Any], commands: str) -> dict[str, Any]:
    """Strokes in mm after a pipeline of vpype's commands."""
    import vpype as vp  # pyright: ignore[reportMissingImports]
    from vpype_cli import execute  # pyright: ignore[reportMissingImports]

    document = vp.Document()
    lines = [PX_PER_MM * (line @ np.array([1, 1j])) for line in unpack(given)]
    document.add(vp.LineCollection(lines), 1)
    start = time.process_time()
    document = execute(commands, document)
    seconds = time.process_time() - start
    ordered = [np.column_stack([line.real, line.imag]) / PX_PER_MM for line in document.layers[1]]
    return pack(ordered) | {"seconds": seconds}


def toppra(given: Mapping[str, Any]) -> dict[str, Any]:
    """Least time for each of several joint paths: `path` (k, 1 + n) rows s, q, `counts` rows each, with the limits
    `speed` and `acceleration` (n,) of the joints and `tool_speed` of s."""
    import toppra as ta  # pyright: ignore[reportMissingImports]
    from toppra import algorithm, constraint  # pyright: ignore[reportMissingImports]

    ta.setup_logging("ERROR")
    speed = np.append(given["tool_speed"], given["speed"])
    acceleration = np.append(1e4, given["acceleration"])
    limits = [
        constraint.JointVelocityConstraint(np.column_stack([-speed, speed])),
        constraint.JointAccelerationConstraint(np.column_stack([-acceleration, acceleration])),
    ]
    durations, start = [], time.process_time()
    for path in np.split(given["path"], np.cumsum(given["counts"])[:-1]):
        spline = ta.SplineInterpolator(path[:, 0], path)
        plan = algorithm.TOPPRA(limits, spline, gridpoints=path[:, 0], solver_wrapper="seidel")
        result = plan.compute_parameterization(0.0, 0.0, return_data=True)
        root = result[1] if result[1] is not None else np.full(len(path), np.nan)
        durations.append(np.sum(2 * np.diff(path[:, 0]) / np.maximum(root[1:] + root[:-1], 1e-9)))
    return {"durations": np.array(durations), "seconds": time.process_time() - start}


PEERS = {"sknw": sknw, "vpype": vpype, "toppra": toppra}


def main() -> None:
    what, source, result, *commands = sys.argv[1:]
    with np.load(source) as given:
        np.savez(result, **PEERS[what](dict(given), *commands))


if __name__ == "__main__":
    main()
