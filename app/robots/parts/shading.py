"""Meshes for a renderer that smooths everything: vertices doubled along the edges that shall stay sharp."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

SHARP = np.cos(np.radians(30.0))
"""Cosine of the angle between two faces from which their common edge shows."""

Arrays = tuple[NDArray[np.float32], NDArray[np.uint32]]


def split_sharp_edges(vertices: NDArray[np.float64], faces: NDArray[np.integer]) -> Arrays:
    """Vertices and faces of a closed mesh, each vertex doubled where sharp edges part its faces.

    Args:
        vertices: (v, 3) metres.
        faces: (f, 3) every edge shared by two faces.
    Returns:
        (w, 3) float32 and (f, 3) uint32 for a renderer that averages the normals of shared vertices.
    """
    corners = faces.ravel()
    here, there = _smooth_neighbours(vertices, faces)
    group = np.arange(corners.size)
    while True:
        merged = group.copy()
        np.minimum.at(merged, here, group[there])
        np.minimum.at(merged, there, group[here])
        merged = merged[merged]
        if np.array_equal(merged, group):
            break
        group = merged
    first, index = np.unique(group, return_inverse=True)
    return vertices[corners[first]].astype(np.float32), index.reshape(faces.shape).astype(np.uint32)


def _smooth_neighbours(vertices: NDArray, faces: NDArray) -> tuple[NDArray, NDArray]:
    """Pairs of face corners that share a vertex across an edge too flat to show."""
    a, b, c = vertices[faces].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    size = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.divide(normals, size, out=np.zeros_like(normals), where=size > 0.0)
    start, end = np.arange(faces.size), np.arange(faces.size).reshape(-1, 3)[:, (1, 2, 0)].ravel()
    vertex = faces.ravel().astype(np.int64)
    low, high = np.minimum(vertex[start], vertex[end]), np.maximum(vertex[start], vertex[end])
    order = np.argsort(low * len(vertices) + high, kind="stable")
    one, two = order[0::2], order[1::2]
    flat = (normals[one // 3] * normals[two // 3]).sum(1) > SHARP
    one, two = one[flat], two[flat]
    # The two faces run along their common edge in opposite directions.
    return np.concatenate([start[one], end[one]]), np.concatenate([end[two], start[two]])
