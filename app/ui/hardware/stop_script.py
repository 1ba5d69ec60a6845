"""What the bar with Stop does on the page. It is no part of viser's panels: they could be folded, or hide it."""

from __future__ import annotations

import json

from app.ui.stage import PHONE_WIDTH_PX

NO_ANSWER_S = 2.0
"""So long after Stop the page says that nobody has answered."""

NO_ANSWER = "No answer: use the emergency stop at the robot!"

_STYLE = """
#deltalab-stop { position: fixed; bottom: 14px; z-index: 10000; transform: translateX(-50%); box-sizing: border-box;
  width: 372px; max-width: calc(100vw - 12px); display: grid; grid-template-columns: 116px 1fr 66px; gap: 10px;
  align-items: center; padding: 6px; border-radius: 10px; color: var(--mantine-color-text); line-height: 1.25;
  background: var(--mantine-color-body); border: 1px solid var(--mantine-color-default-border);
  box-shadow: 0 2px 12px rgba(0,0,0,.25); font-family: var(--mantine-font-family, system-ui, sans-serif); }
#deltalab-stop[hidden] { display: none; }
#deltalab-stop button { min-height: 48px; min-width: 44px; border-radius: 8px; font: inherit; cursor: pointer;
  touch-action: none; user-select: none; -webkit-user-select: none; -webkit-tap-highlight-color: transparent; }
#deltalab-stop .stop { background: #c4161c; color: #fff; border: 2px solid #fff; outline: 2px solid #c4161c;
  font-size: 20px; font-weight: 700; margin: 2px; }
#deltalab-stop .stop:hover { background: #a81016; }
#deltalab-stop .stop:active, #deltalab-stop .stop.sent { background: #7d0a0f; }
#deltalab-stop .clear { background: var(--mantine-color-default); color: inherit; font-size: 14px;
  border: 1px solid var(--mantine-color-default-border); }
#deltalab-stop .clear:disabled { visibility: hidden; }
#deltalab-stop button:focus-visible { outline: 3px solid #228be6; outline-offset: 2px; }
#deltalab-stop kbd { font: inherit; font-size: 11px; font-weight: 400; border: 1px solid #ffffffa0; border-radius: 4px;
  padding: 0 4px; margin-left: 4px; vertical-align: 3px; }
#deltalab-stop [role=status] { min-width: 0; font-size: 14px; overflow: hidden; }
#deltalab-stop b, #deltalab-stop small { display: block; overflow: hidden; text-overflow: ellipsis;
  white-space: nowrap; }
#deltalab-stop small { font-size: 12px; opacity: .85; }
#deltalab-stop .alarm small { white-space: normal; color: #c4161c; font-weight: 700; opacity: 1; }
[data-mantine-color-scheme=dark] #deltalab-stop .alarm small { color: #ff8f8f; }
@media (pointer: coarse) { #deltalab-stop kbd { display: none; } }
@media (max-width: PHONEpx) {
  #deltalab-stop { top: calc(6px + env(safe-area-inset-top, 0px)); bottom: auto; }
  body:has(#deltalab-stop:not([hidden])) .mantine-Notifications-root { margin-top: 68px; }
}
"""

# Stop acts when the button goes down, and Escape always, also in an input: neither asks anything.
_SCRIPT = """
const {wire, noAnswerMs, noAnswer, style} = CONFIG;
window.deltalabStop?.end();  // of an earlier connection
const bar = document.createElement("section");
bar.id = "deltalab-stop";
bar.hidden = true;
bar.setAttribute("aria-label", "Robot on the table");
bar.innerHTML = `<style>${style}</style>
  <button type="button" class="stop" aria-keyshortcuts="Escape" aria-label="Stop the robot"
    title="Stops the robot at once; the motors hold. Key: Escape. Anybody may press it.">Stop<kbd>Esc</kbd></button>
  <div role="status"><b></b><small></small></div>
  <button type="button" class="clear" disabled
    title="After Stop: allow motion again. Nothing moves by itself.">Clear</button>`;
document.body.append(bar);
const [stop, clear] = bar.querySelectorAll("button"), state = bar.querySelector("[role=status]");
const word = bar.querySelector("b"), line = bar.querySelector("small"), done = new AbortController();
const listen = {capture: true, signal: done.signal};
let number = 0, timer = null, shown = {};

function say(what) {
  window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: wire, updates: {value: `${what} ${++number}`}});
}
function alarm(sentence) {
  line.textContent = sentence || shown.line || "";
  line.title = line.textContent;
  state.classList.toggle("alarm", Boolean(sentence));
}
function press() {
  stop.classList.add("sent");
  clearTimeout(timer);
  timer = setTimeout(() => { stop.classList.remove("sent"); alarm(noAnswer); }, noAnswerMs);
  say("stop");
}
stop.addEventListener("pointerdown", (event) => { if (!event.button) { event.preventDefault(); press(); } });
stop.addEventListener("click", (event) => { if (!event.detail) press(); });  // by the keyboard
clear.addEventListener("click", () => say("clear"));
window.addEventListener("keydown", (event) => {
  if (event.key === "Escape" && !bar.hidden && !event.repeat) press();
}, listen);

// In the middle of the robot's picture, beside the panels.
function place() {
  const box = window.__viserMutable?.canvas?.getBoundingClientRect();
  const half = Math.min(bar.offsetWidth, window.innerWidth) / 2 + 6;
  const middle = box?.width ? box.left + box.width / 2 : window.innerWidth / 2;
  bar.style.left = `${Math.min(Math.max(middle, half), Math.max(window.innerWidth - half, half))}px`;
}
const resized = new ResizeObserver(place);
resized.observe(document.documentElement);

window.deltalabStop = {
  show(news) {
    shown = news;
    word.textContent = "";
    const mark = document.createElement("span");
    mark.style.color = news.color;
    mark.textContent = `${news.mark} `;
    mark.setAttribute("aria-hidden", "true");
    word.append(mark, news.word);
    word.title = news.word;
    alarm("");
    clear.disabled = !news.clear;
    bar.hidden = false;
    if (window.__viserMutable?.canvas) resized.observe(window.__viserMutable.canvas);
    place();
  },
  hide() { bar.hidden = true; this.answered(""); },
  answered(problem) {
    clearTimeout(timer);
    stop.classList.remove("sent");
    alarm(problem);
  },
  end() { clearTimeout(timer); done.abort(); resized.disconnect(); bar.remove(); },
};
"""


def start(wire_id: str) -> str:
    """Script that makes the bar, hidden, and sends what is pressed through the text input `wire_id`."""
    config = {
        "wire": wire_id,
        "noAnswerMs": 1e3 * NO_ANSWER_S,
        "noAnswer": NO_ANSWER,
        "style": _STYLE.replace("PHONE", f"{PHONE_WIDTH_PX - 1}"),
    }
    return _SCRIPT.replace("CONFIG", json.dumps(config))


def show(*, mark: str, color: str, word: str, line: str, clear: bool) -> str:
    """Script that shows the bar with the robot's state, and Clear where it makes sense."""
    news = {"mark": mark, "color": color, "word": word, "line": line, "clear": clear}
    return f"window.deltalabStop?.show({json.dumps(news)});"


def hide() -> str:
    """Script for when there is no robot."""
    return "window.deltalabStop?.hide();"


def answered(problem: str = "") -> str:
    """Script that says that Stop has arrived, or what went wrong."""
    return f"window.deltalabStop?.answered({json.dumps(problem)});"
