"""Every preset draws, says only what differs from its mode, and does what it promises."""

from __future__ import annotations

import numpy as np
import pytest

from app.drawing.compose import Composition, Look, compose
from app.drawing.modes import DRAWING_MODES, PRESETS
from app.drawing.source import Source
from tests.drawing.vectorise.pictures import photo
from tests.support.paper import face


@pytest.mark.parametrize("name", PRESETS)
def test_every_preset_draws(name):
    preset = PRESETS[name]
    assert preset.title and preset.explanation.endswith(".")
    offered = {each.name: each for each in DRAWING_MODES[preset.mode].parameters}
    for key, value in preset.parameters.items():
        assert isinstance(value, float) and offered[key].low <= value <= offered[key].high
        assert value != DRAWING_MODES[preset.mode].defaults[key], "it says only what differs"
    made = compose(Source("face", face(100)), Look(preset.mode, (60.0, 60.0), parameters=preset.parameters))
    assert len(made.strokes) >= 1 and made.mode == preset.mode


def test_presets_do_what_they_promise():
    grey = photo()[:256, :256]
    made = {name: compose(Source("", grey), Look(p.mode, parameters=p.parameters)) for name, p in PRESETS.items()}
    assert len(made["one_line"].strokes) == 1
    assert all((stroke[0] == stroke[-1]).all() for stroke in made["dots"].strokes)
    rows = np.concatenate(made["laser"].strokes)
    assert len(np.unique(rows[:, 1].round(6))) > 20


def test_from_quick_to_fine_to_tones_there_is_more_ink():
    source = Source("leaves", photo()[:400, :400])
    presets = (PRESETS[name] for name in ("quick", "fine", "portrait"))
    quick, fine, tones = (compose(source, Look(each.mode, parameters=each.parameters)) for each in presets)
    assert ink(quick) < 0.9 * ink(fine) < ink(tones) and len(quick.strokes) < len(fine.strokes)


def ink(made: Composition) -> float:
    return sum(float(np.linalg.norm(np.diff(stroke, axis=0), axis=1).sum()) for stroke in made.strokes)
