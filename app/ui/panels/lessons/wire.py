"""How the lesson's buttons and forms reach the server: all through one hidden text input."""

from __future__ import annotations

from collections.abc import Callable

import viser

from app.ui.viser_adapter import element_id, run_javascript

LONGEST = 200

# A lesson in the page's address is opened once: after a reload the student is where he was.
_SCRIPT = """
window.deltalabLesson?.abort();  // of an earlier connection
const done = window.deltalabLesson = new AbortController(), options = {signal: done.signal};
let number = 0;
const say = (what, value = "") => window.__viserMutable.sendMessage(
  {type: "GuiUpdateMessage", uuid: "UUID", updates: {value: `${++number} ${what} ${String(value).slice(0, 150)}`}});
document.addEventListener("click", (event) => {
  const button = event.target.closest?.("button[data-lesson]");
  if (button) say(button.dataset.lesson, button.dataset.value);
  const link = event.target.closest?.('.dl a[href^="?lesson="]');
  if (!link) return;
  event.preventDefault();  // no need to load the page anew
  say("open", new URLSearchParams(link.search).get("lesson"));
}, options);
document.addEventListener("submit", (event) => {
  const form = event.target.closest?.("form[data-lesson]");
  if (!form) return;
  event.preventDefault();
  say(form.dataset.lesson, new FormData(form).get("answer") ?? "");
}, options);
const address = new URL(location.href), wanted = address.searchParams.get("lesson");
if (wanted) {
  address.searchParams.delete("lesson");
  history.replaceState(null, "", address);
}
say("hello", `${window.innerWidth} ${wanted ?? ""}`);
"""
# The page draws what it was sent a moment later, and a phone unfolds the section slowly.
_TO_TOP = """
for (const later of [80, 500]) setTimeout(() =>
  document.querySelector("[data-lesson-top]")?.parentElement.scrollIntoView({block: "start"}), later);
"""


class LessonWire:
    """`heard(what, value)` is called for what is pressed or sent; both may be anything that a page can say."""

    def __init__(self, client: viser.ClientHandle, heard: Callable[[str, str], None]) -> None:
        self._client = client
        wire = client.gui.add_text("Lesson", "", visible=False)

        @wire.on_update
        async def _(event: viser.GuiEvent[viser.GuiTextHandle]) -> None:
            _, what, value = [*event.target.value[:LONGEST].split(" ", 2), "", "", ""][:3]
            heard(what, value)

        self._id = element_id(wire)

    def start(self) -> None:
        """Make the page listen; it says `hello` with its width in px and the lesson in its address."""
        run_javascript(self._client, _SCRIPT.replace("UUID", self._id))

    def scroll_to_top(self) -> None:
        run_javascript(self._client, _TO_TOP)
