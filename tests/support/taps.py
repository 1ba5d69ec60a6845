"""A student who taps about on the page: any input that is there gets any value that it may have."""

from __future__ import annotations

import random
from collections.abc import Mapping
from typing import Any

from app.drawing.samples import sample_bytes
from tests.support.draw_visitor import Visitor

LEFT_ALONE = {"Control opened", "Draw opened", "Workspace", "Workspace angle (deg)", "Shadows", "Dark"}
"""Other labs, and what only costs frames."""

KINDS = ("Slider", "Number", "Dropdown", "Checkbox", "Button", "ButtonGroup")
HANDLE = "/robot/sheet_handle"
POINTS = "{} last 100,200 -150,{} 60,-90"
MARK = "<u>"
TEXTS = ("Hola", "", f"{MARK}&amp;", "漢字")
FILES = (sample_bytes("logo"), b"", b"<svg/>", b"?")
FARTHEST = 400.0
"""Of a number without limits."""


async def tap(one: Visitor, rng: random.Random) -> None:
    """Do one thing."""
    client, kind = one.client, rng.choice((*KINDS, *KINDS, "Pad", "Text", "Drag", "Upload"))
    if kind == "Pad":
        await client.set_value("Strokes drawn", POINTS.format(rng.randrange(10**6), rng.randrange(-999, 999)))
    elif kind == "Text":
        await one.set("Text", rng.choice(TEXTS))
    elif kind == "Upload":
        await one.upload(f"{MARK}{rng.randrange(10**9)}", rng.choice(FILES))
    elif kind == "Drag":
        await client.start_drag(HANDLE)
        await client.drag(HANDLE, (rng.uniform(-0.1, 0.1), rng.uniform(-0.1, 0.1), 0.0))
        await client.end_drag(HANDLE)
    else:
        await _change(one, kind, rng)


async def _change(one: Visitor, kind: str, rng: random.Random) -> None:
    """Press a button, or give some other input of this kind a value."""
    found = [made for made in one.client.inputs.values() if made["type"] == f"Gui{kind}Message"]
    made = rng.choice([made for made in found if made["props"]["label"] not in LEFT_ALONE])
    value = True
    if kind != "Button":
        value = made["value"] = _value(made["props"], made["value"], rng)
    await one.client.send("GuiUpdateMessage", uuid=made["uuid"], updates={"value": value})


def _value(props: Mapping[str, Any], old: Any, rng: random.Random) -> Any:
    if isinstance(old, bool):
        return not old
    if "options" in props:
        return rng.choice(props["options"])
    low = -FARTHEST if props["min"] is None else props["min"]
    high = FARTHEST if props["max"] is None else props["max"]
    return min(low + props["step"] * rng.randrange(1 + int((high - low) / props["step"])), high)
