"""Buttons that act for as long as they are held, with mouse, finger or keyboard.

The page renews every 50 ms. A released button, a second finger, a long press's menu, Escape, a lost focus, a hidden
tab, or a button that has gone is a release, told once; a page that hangs simply stops renewing, and the link's lease
ends by itself.
"""

from __future__ import annotations

import html
from collections.abc import Callable

import viser

from app.ui.viser_adapter import element_id, run_javascript

RENEW_MS = 50

_SCRIPT = """
const wire = "WIRE";
let held = null, pointer = null, timer = null, number = 0;
function say(what, key) {
  const value = `${what} ${key} ${++number}`;
  window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: wire, updates: {value}});
}
function release() {
  if (!held) return;
  const button = held;
  held = null;
  clearInterval(timer);
  button.classList.remove("held");
  if (pointer !== null && button.hasPointerCapture(pointer)) button.releasePointerCapture(pointer);
  pointer = null;
  say("release", button.dataset.hold);
}
function hold(button, by) {
  release();
  held = button;
  pointer = by;
  held.classList.add("held");
  const renew = () => document.contains(button) && !document.hidden ? say("hold", button.dataset.hold) : release();
  renew();
  timer = setInterval(renew, RENEW_MS);
}
const armed = (event) => {
  const button = event.target.closest?.("button[data-hold]");
  return button?.dataset.wire === wire ? button : null;
};
window.addEventListener("pointerdown", (event) => {
  if (held) return release();  // another finger, or a finger beside the key
  const button = armed(event);
  if (!button || event.button) return;
  event.preventDefault();
  button.focus({preventScroll: true});
  hold(button, event.pointerId);
  button.setPointerCapture(event.pointerId);
}, true);
window.addEventListener("keydown", (event) => {
  if (event.key === "Escape") return release();
  const button = armed(event);
  if (!button || (event.key !== " " && event.key !== "Enter")) return;
  event.preventDefault();
  if (!event.repeat && pointer === null) hold(button, null);
}, true);
window.addEventListener("contextmenu", (event) => {
  if (!armed(event) && !held) return;
  event.preventDefault();
  release();
}, true);
const ends = ["pointerup", "pointercancel", "lostpointercapture", "keyup", "focusout", "pagehide"];
for (const name of ends) window.addEventListener(name, release, true);
window.addEventListener("blur", release);
document.addEventListener("visibilitychange", release);
document.addEventListener("freeze", release);
"""


class HoldToRun:
    """Arms buttons that are put on the page as HTML. `on_hold` hears a button's key every 50 ms."""

    def __init__(
        self, client: viser.ClientHandle, on_hold: Callable[[str], None], on_release: Callable[[str], None]
    ) -> None:
        wire = client.gui.add_text("Held button", "", visible=False)
        self._wire = element_id(wire)
        run_javascript(client, _SCRIPT.replace("WIRE", self._wire).replace("RENEW_MS", str(RENEW_MS)))

        @wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            what, _, rest = event.target.value.partition(" ")
            key = rest.partition(" ")[0]
            if what == "hold":
                on_hold(key)
            elif what == "release":
                on_release(key)

    def button_html(self, key: str, label: str, hint: str) -> str:
        """A button that is held; keys have no spaces."""
        return (
            f'<button type="button" data-hold="{html.escape(key)}" data-wire="{self._wire}" '
            f'title="{html.escape(hint)}" style="touch-action:none">{html.escape(label)}</button>'
        )
