"""What a drawing pad does on the page: it draws at once, and sends each stroke when it ends."""

from __future__ import annotations

import json
from collections.abc import Iterable

import numpy as np

from app.ui.drawing.pad_strokes import UNITS_PER_MM, Stroke

THINNED = 4
"""Points closer than this to the one before are dropped, in tenths of a millimetre."""
PIECE_POINTS = 700
"""Points in one message: at up to 14 characters each they stay below what a text may have."""

# All coordinates are whole tenths of a millimetre, origin in the middle of the sheet, y up, as they are sent.
_SCRIPT = """
const {canvasId, wire, thinned, piecePoints} = CONFIG;
let canvas = null, pen = null, strokes = [], open = null, number = 0;

// The page makes the canvas anew whenever its panel was hidden.
const resized = new ResizeObserver(draw);
function adopt() {
  const found = document.getElementById(canvasId);
  if (found === canvas) return;
  resized.disconnect();
  canvas = found;
  pen = canvas?.getContext("2d");
  if (canvas) resized.observe(canvas);
}
new MutationObserver(adopt).observe(document.body, {childList: true, subtree: true});
adopt();

function draw() {
  const box = canvas?.getBoundingClientRect();
  if (!box?.width) return;
  const [wide, high] = sheet(), ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  pen.fillStyle = "#ffffff";
  pen.fillRect(0, 0, canvas.width, canvas.height);
  if (!strokes.length && !open) invite(ratio);
  pen.setTransform(canvas.width / wide, 0, 0, -canvas.height / high, canvas.width / 2, canvas.height / 2);
  pen.lineWidth = Math.max(6, 2 * wide / box.width);
  pen.lineCap = pen.lineJoin = "round";
  pen.strokeStyle = "#1b2a4a";
  for (const stroke of strokes) line(stroke.points);
  if (open) line(open.points);
}
function invite(ratio) {
  pen.fillStyle = "#8a919c";
  pen.font = `${14 * ratio}px system-ui, sans-serif`;
  pen.textAlign = "center";
  pen.fillText("Draw here", canvas.width / 2, canvas.height / 2);
}
function line(points) {
  pen.beginPath();
  pen.moveTo(...points[0]);
  for (const [x, y] of points) pen.lineTo(x + 0.1, y);  // never of no length, so that a dot is seen
  pen.stroke();
}

function sheet() {
  return canvas.dataset.sheet.split(" ").map(Number);
}
function at(event) {
  const box = canvas.getBoundingClientRect(), [wide, high] = sheet();
  return [
    onSheet(((event.clientX - box.left) / box.width - 0.5) * wide, wide),
    onSheet((0.5 - (event.clientY - box.top) / box.height) * high, high),
  ];
}
function onSheet(value, size) {
  const most = Math.floor(size / 2);
  return Math.round(Math.min(Math.max(value, -most), most));
}
function reach(event, spacing) {
  const point = at(event), last = open.points.at(-1);
  if (Math.hypot(point[0] - last[0], point[1] - last[1]) < spacing) return;
  open.points.push(point);
  line([last, point]);
}

function begin(event) {
  if (!canvas || event.target !== canvas || event.button !== 0) return;
  if (open && canvas.hasPointerCapture(open.pointer)) return;  // a second finger
  finish();
  canvas.setPointerCapture(event.pointerId);
  open = {pointer: event.pointerId, points: [at(event)]};
  draw();
}
function move(event) {
  if (!canvas || event.pointerId !== open?.pointer) return;
  const passed = event.getCoalescedEvents?.() ?? [];
  for (const step of passed.length ? passed : [event]) reach(step, thinned);
}
function end(event) {
  if (event.pointerId !== open?.pointer) return;
  if (canvas && event.type === "pointerup") reach(event, 1);
  finish();
}
function finish() {
  if (!open) return;
  const points = open.points;
  open = null;
  for (let k = 0; k < points.length; k += piecePoints) {
    const piece = points.slice(k, k + piecePoints), mark = k + piecePoints < points.length ? "more" : "last";
    const value = `${++number} ${mark} ${piece.join(" ")}`;
    window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: wire, updates: {value}});
  }
  strokes.push({number, points});
}
document.addEventListener("pointerdown", begin, true);
document.addEventListener("pointermove", move, true);
document.addEventListener("pointerup", end, true);
document.addEventListener("pointercancel", end, true);

// The server keeps the truth; a stroke that it had not heard of when it spoke stays.
(window.deltalabPads ??= {})[canvasId] = {
  show(kept, heard) {
    strokes = [...kept.map(([number, points]) => ({number, points})), ...strokes.filter((s) => s.number > heard)];
    draw();
  },
  remove(gone) {
    strokes = strokes.filter((stroke) => stroke.number !== gone);
    draw();
  },
};
"""


def start(canvas_id: str, wire_id: str) -> str:
    """Script that watches a canvas and sends its strokes through the text input `wire_id`."""
    config = {"canvasId": canvas_id, "wire": wire_id, "thinned": THINNED, "piecePoints": PIECE_POINTS}
    return _SCRIPT.replace("CONFIG", json.dumps(config))


def show(canvas_id: str, strokes: Iterable[Stroke], heard: int) -> str:
    """Script that shows these strokes and no others, except what was drawn after message `heard`."""
    return _call(canvas_id, "show", [[number, _units(points)] for number, points in strokes], heard)


def remove(canvas_id: str, number: int) -> str:
    """Script that takes one stroke away."""
    return _call(canvas_id, "remove", number)


def _units(points_mm: np.ndarray) -> list[list[int]]:
    return np.rint(UNITS_PER_MM * points_mm).astype(int).tolist()


def _call(canvas_id: str, function: str, *arguments: object) -> str:
    values = ", ".join(json.dumps(argument) for argument in arguments)
    return f"window.deltalabPads?.[{json.dumps(canvas_id)}]?.{function}({values});"
