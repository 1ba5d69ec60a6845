"""Trace a thin mask as a graph: every line between two ends or junctions once, in order.

Pixels that share a side are neighbours; pixels that share a corner only if no third pixel joins them by its sides.
Where three or more lines meet, each gets its own copy of the pixel: what is left are paths and rings. Rings are cut,
all paths are tied one behind the other, and one search along this single thread visits every pixel in order.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import breadth_first_order, connected_components


@dataclass(frozen=True, eq=False)
class Branches:
    """Lines between the ends and junctions of a thin mask."""

    lines: list[NDArray[np.float64]]
    """Each (n, 2): x and y in pixels. A ring repeats its first point, a lone pixel is one point."""
    nodes: NDArray[np.intp]
    """(branches, 2) where each begins and ends: the index of a pixel."""
    degrees: NDArray[np.intp]
    """(branches, 2) how many lines meet there; 1 for a free end, 0 for rings and lone pixels."""


def trace(thin: NDArray[np.bool_]) -> Branches:
    """Branches of a mask (h, w) of lines one pixel wide."""
    y, x = np.nonzero(thin)
    if not len(x):
        return Branches([], np.zeros((0, 2), np.intp), np.zeros((0, 2), np.intp))
    edges = _neighbours(thin)
    degree = np.bincount(edges.ravel(), minlength=len(x))
    edges, pixel = _with_copies(edges, degree)
    order, first, ring = _thread(edges, pixel, degree)
    pixels = np.split(pixel[order], first[1:])
    nodes = np.array([(line[0], line[-1]) for line in pixels])
    closed = [np.append(line, line[0]) if is_ring else line for line, is_ring in zip(pixels, ring, strict=True)]
    points = np.column_stack([x, y]).astype(float)
    return Branches([points[line] for line in closed], nodes, np.where(ring[:, None], 0, degree[nodes]))


def _neighbours(thin: NDArray[np.bool_]) -> NDArray[np.intp]:
    """(edges, 2) pairs of neighbouring pixels, by their number in the order of the rows."""
    padded = np.pad(thin, 1)
    stride = padded.shape[1]
    flat = np.flatnonzero(padded)
    number = np.full(padded.size, -1, np.intp)
    number[flat] = np.arange(len(flat))
    west, east, south = (number[flat + step] for step in (-1, 1, stride))
    south_west = np.where((west < 0) & (south < 0), number[flat + stride - 1], -1)
    south_east = np.where((east < 0) & (south < 0), number[flat + stride + 1], -1)
    others = np.concatenate([east, south, south_west, south_east])
    return np.column_stack([np.tile(np.arange(len(flat)), 4), others])[others >= 0]


def _with_copies(edges: NDArray[np.intp], degree: NDArray[np.intp]) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Edges between nodes instead of pixels, and the pixel of every node: junctions have a node for each line."""
    at_junction = degree[edges] > 2
    copied = edges[at_junction]
    edges = edges.copy()
    edges[at_junction] = len(degree) + np.arange(len(copied))
    return edges, np.concatenate([np.arange(len(degree)), copied])


def _thread(
    edges: NDArray[np.intp], pixel: NDArray[np.intp], degree: NDArray[np.intp]
) -> tuple[NDArray[np.intp], NDArray[np.intp], NDArray[np.bool_]]:
    """(all nodes in order, where in it each path starts, whether it is a ring)."""
    used = np.flatnonzero(np.concatenate([degree <= 2, np.ones(len(pixel) - len(degree), bool)]))
    number = np.empty(len(pixel), np.intp)
    number[used] = np.arange(len(used))
    edges = number[edges]
    count, label = connected_components(_graph(edges, len(used)), directed=False)
    edges, ring = _cut_rings(edges, label, count)
    ends = np.flatnonzero(np.bincount(edges.ravel(), minlength=len(used)) < 2)
    ends = ends[np.argsort(label[ends], kind="stable")]
    start, stop = np.empty((2, count), np.intp)
    start[label[ends[::-1]]], stop[label[ends]] = ends[::-1], ends
    thread = _graph(np.concatenate([edges, np.column_stack([stop[:-1], start[1:]])]), len(used))
    order = breadth_first_order(thread, start[0], return_predecessors=False)
    sizes = np.bincount(label, minlength=count)
    return used[order], np.cumsum(sizes) - sizes, ring


def _cut_rings(
    edges: NDArray[np.intp], label: NDArray[np.int32], count: int
) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Without one edge of every ring, and which components are rings: they have as many edges as nodes."""
    of_edge = label[edges[:, 0]]
    ring = np.bincount(of_edge, minlength=count) == np.bincount(label, minlength=count)
    _, first = np.unique(of_edge, return_index=True)
    return np.delete(edges, first[ring[of_edge[first]]], axis=0), ring


def _graph(edges: NDArray[np.intp], size: int) -> csr_array:
    """Both directions of every edge."""
    both = np.concatenate([edges, edges[:, ::-1]]).T
    return coo_array((np.ones(both.shape[1], np.int8), (both[0], both[1])), shape=(size, size)).tocsr()
