"""Thin a mask to lines one pixel wide (Guo and Hall 1989), looking only at pixels that may go.

A pixel whose neighbours did not change in one whole round will stay until they do, so that the time grows with the
number of pixels removed and not with the rounds times the size of the picture.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def _removable() -> NDArray[np.bool_]:
    """(2, 256) whether a pixel goes in either half round, by its neighbours: bit 0 north, then clockwise."""
    n, ne, e, se, s, sw, w, nw = ((np.arange(256) >> bit & 1).astype(bool) for bit in range(8))
    lines = [~n & (ne | e), ~e & (se | s), ~s & (sw | w), ~w & (nw | n)]
    pairs = [nw | n, ne | e, se | s, sw | w], [n | ne, e | se, s | sw, w | nw]
    neighbours = np.minimum(*(np.sum(pair, axis=0) for pair in pairs))
    simple = (np.sum(lines, axis=0) == 1) & (neighbours >= 2) & (neighbours <= 3)
    return np.array([simple & ~((s | sw | ~nw) & w), simple & ~((n | ne | ~se) & e)])


REMOVABLE = _removable()


def thin(mask: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """(h, w) -> (h, w): the middle lines of what is set, connected as it was."""
    height, width = mask.shape
    padded = np.zeros((height + 2, width + 2), np.uint8)
    padded[1:-1, 1:-1] = mask
    stride = width + 2
    around = np.array([-stride, 1 - stride, 1, 1 + stride, stride, stride - 1, -1, -1 - stride])
    flat = padded.ravel()
    order = np.zeros(flat.size, np.int32)
    suspects = np.flatnonzero(flat)
    while len(suspects):
        gone = []
        for removable in REMOVABLE:
            code = np.zeros(len(suspects), np.uint8)
            for bit, step in enumerate(around):
                code |= flat[suspects + step] << bit
            going = removable[code]
            gone.append(suspects[going])
            flat[gone[-1]] = 0
            suspects = suspects[~going]
        suspects = _distinct((np.concatenate(gone)[:, None] + around).ravel(), flat, order)
    return padded[1:-1, 1:-1].astype(bool)


def _distinct(pixels: NDArray[np.intp], flat: NDArray[np.uint8], order: NDArray[np.int32]) -> NDArray[np.intp]:
    """The set ones among `pixels`, each once; `order` is scratch space."""
    pixels = pixels[flat[pixels] == 1]
    order[pixels] = np.arange(len(pixels))
    return pixels[order[pixels] == np.arange(len(pixels))]
