"""Tones with a pen: from a grey picture to strokes whose ink looks like it."""

from app.drawing.rasterise.ink import ink_cover, render_ink
from app.drawing.rasterise.mode import Parameter, RasterMode
from app.drawing.rasterise.modes import RASTER_MODES, rasterise
from app.drawing.rasterise.portrait import portrait
from app.drawing.rasterise.similar import affine_error, similarity

__all__ = [
    "RASTER_MODES",
    "Parameter",
    "RasterMode",
    "affine_error",
    "ink_cover",
    "portrait",
    "rasterise",
    "render_ink",
    "similarity",
]
