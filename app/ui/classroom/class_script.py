"""What the class puts on a page beside viser's panels: the card to join with, the veil of a pause, a banner, and a
picture of all."""

from __future__ import annotations

import json
from typing import Literal

from app.ui.stage import PHONE_WIDTH_PX

Tone = Literal["info", "warning"]

_STYLE = """
.deltalab-class { box-sizing: border-box; color: var(--mantine-color-text); background: var(--mantine-color-body);
  border: 1px solid var(--mantine-color-default-border); box-shadow: 0 4px 24px rgba(0,0,0,.3); line-height: 1.4;
  font-family: var(--mantine-font-family, system-ui, sans-serif); font-size: 15px; }
.deltalab-class[hidden] { display: none; }
#deltalab-join { position: fixed; z-index: 9000; left: 14px; top: 14px; width: 372px; padding: 20px 22px;
  border-radius: 12px; max-height: calc(100vh - 28px); overflow: auto; }
#deltalab-join h1 { font-size: 21px; margin: 0 0 2px; }
#deltalab-join p { margin: 0 0 12px; opacity: .85; }
#deltalab-join label { display: block; font-weight: 600; font-size: 14px; margin: 10px 0 3px; }
#deltalab-join input { width: 100%; box-sizing: border-box; font: inherit; font-size: 17px; min-height: 44px;
  padding: 6px 10px; color: inherit; background: var(--mantine-color-default); border-radius: 8px;
  border: 1px solid var(--mantine-color-gray-6); }
#deltalab-join input.code { text-transform: uppercase; letter-spacing: .15em; }
#deltalab-join input:focus-visible, .deltalab-class button:focus-visible { outline: 3px solid #228be6;
  outline-offset: 1px; }
#deltalab-join button { font: inherit; cursor: pointer; border-radius: 8px; }
#deltalab-join .go { width: 100%; min-height: 46px; margin-top: 14px; font-weight: 700; color: #fff;
  background: #1c6fc4; border: none; }
#deltalab-join .go:disabled { opacity: .6; cursor: wait; }
#deltalab-join nav { display: flex; flex-wrap: wrap; gap: 4px 14px; margin-top: 12px; }
#deltalab-join nav button { background: none; border: none; padding: 6px 0; color: inherit; font-size: 14px;
  text-decoration: underline; }
#deltalab-join [role=alert] { margin: 10px 0 0; color: #b3200f; font-weight: 600; }
#deltalab-join [role=alert]:empty { display: none; }
[data-mantine-color-scheme=dark] #deltalab-join [role=alert] { color: #ff9d8f; }
#deltalab-veil { position: fixed; inset: 0; z-index: 9500; display: grid; place-items: center; padding: 16px;
  background: rgba(15,18,24,.62); }
#deltalab-veil[hidden] { display: none; }
#deltalab-veil section { border-radius: 14px; padding: 26px 32px; max-width: 560px; text-align: center; }
#deltalab-veil h1 { margin: 0 0 8px; font-size: 17px; opacity: .8; }
#deltalab-veil p { margin: 0; font-size: 24px; white-space: pre-wrap; overflow-wrap: anywhere; }
#deltalab-banner { position: fixed; z-index: 8900; top: 12px; left: 50%; transform: translateX(-50%); padding: 8px 18px;
  border-radius: 20px; max-width: min(560px, calc(100vw - 24px)); font-weight: 600; text-align: center;
  overflow-wrap: anywhere; pointer-events: none; }
#deltalab-banner.info { background: #0b4f8a; color: #fff; border-color: transparent; }
#deltalab-banner.warning { background: #7a3b00; color: #fff; border-color: transparent; }
#deltalab-picture { position: fixed; z-index: 8800; bottom: 80px; left: 14px; width: min(430px, 46vw);
  padding: 8px 10px 6px; border-radius: 12px; }
#deltalab-picture button { position: absolute; top: 4px; right: 6px; min-width: 32px; min-height: 32px; border: none;
  background: none; color: inherit; font: inherit; font-size: 20px; cursor: pointer; }
@media (max-width: PHONEpx) {
  #deltalab-picture { top: 118px; bottom: auto; left: 12px; right: 12px; width: auto; }
  #deltalab-join { left: 0; right: 0; top: auto; bottom: 0; width: auto; border-radius: 14px 14px 0 0;
    padding: 16px 18px calc(16px + env(safe-area-inset-bottom, 0px)); max-height: 70vh; }
  #deltalab-banner { top: 74px; font-size: 14px; padding: 6px 14px; }
}
"""

_SCRIPT = """
const {wire, style} = CONFIG;
window.deltalabClass?.end();  // of an earlier connection
const root = document.getElementById("root"), place = document.createElement("div"), address = new URL(location.href);
place.innerHTML = `<style>${style}</style>
  <section id="deltalab-join" class="deltalab-class" role="dialog" aria-labelledby="deltalab-join-title" hidden>
    <h1 id="deltalab-join-title"></h1><p></p>
    <form novalidate><div class="fields"></div><div role="alert"></div>
    <button class="go" type="submit"></button></form><nav></nav>
  </section>
  <div id="deltalab-veil" hidden><section class="deltalab-class" role="alertdialog" aria-modal="true" tabindex="-1"
    aria-labelledby="deltalab-veil-title" aria-describedby="deltalab-veil-text">
    <h1 id="deltalab-veil-title">Your instructor has paused the class</h1><p id="deltalab-veil-text"></p>
  </section></div>
  <div id="deltalab-banner" class="deltalab-class" role="status" hidden></div>
  <aside id="deltalab-picture" class="deltalab-class" aria-label="Picture of the whole class" hidden><div></div>
    <button type="button" aria-label="Hide the picture">×</button></aside>`;
document.body.append(place);
const [card, veil, banner, picture] = ["join", "veil", "banner", "picture"].map(
  (name) => place.querySelector(`#deltalab-${name}`));
const form = card.querySelector("form"), alarm = card.querySelector("[role=alert]"), go = card.querySelector(".go");
const ways = {
  join: {title: "Join the class", text: "You can try the robot already: drag its arrows.", go: "Join",
    link: "Join as a new student", fields: [["name", "Your name", {autocomplete: "nickname", maxlength: 60}],
      ["code", "Class code", {class: "code", autocomplete: "off", maxlength: 12}]]},
  resume: {title: "Welcome back", text: "Your own code stands in your lesson panel, under “My place”.", go: "Go on",
    link: "I was here before",
    fields: [["code", "Your own code", {class: "code", autocomplete: "off", maxlength: 20}]]},
  prove: {title: "The instructor", text: "The server has printed the PIN where it was started.", go: "Open my page",
    link: "I am the instructor",
    fields: [["pin", "PIN", {type: "password", inputmode: "numeric", autocomplete: "off", maxlength: 12}]]},
};
let way = "", number = 0, waiting = 0, unwanted = "";

function say(what) {
  what.number = ++number;
  window.__viserMutable.sendMessage({type: "GuiUpdateMessage", uuid: wire, updates: {value: JSON.stringify(what)}});
}
function input([name, label, attributes]) {
  const box = document.createElement("label"), field = document.createElement("input");
  box.textContent = label;
  field.name = name;
  for (const [key, value] of Object.entries(attributes)) field.setAttribute(key, value);
  if (way === "join" && name === "code") field.value = (address.searchParams.get("class") || "").slice(0, 12);
  box.append(field);
  return box;
}
function turn(to) {
  way = to;
  const {title, text, go: word, fields} = ways[way];
  card.querySelector("h1").textContent = title;
  card.querySelector("p").textContent = text;
  go.textContent = word;
  alarm.textContent = "";
  form.querySelector(".fields").replaceChildren(...fields.map(input));
  card.querySelector("nav").replaceChildren(...Object.keys(ways).filter((other) => other !== way).map((other) => {
    const link = document.createElement("button");
    link.type = "button";
    link.textContent = ways[other].link;
    link.addEventListener("click", () => turn(other));
    return link;
  }));
  if (!matchMedia("(pointer: coarse)").matches) form.querySelector("input").focus();
}
function canvas() { return window.__viserMutable?.canvas?.getBoundingClientRect(); }
picture.querySelector("button").addEventListener("click", () => {
  unwanted = picture.dataset.kind;
  picture.hidden = true;
});
function free() { clearTimeout(waiting); go.disabled = false; }
form.addEventListener("submit", (event) => {
  event.preventDefault();
  if (go.disabled) return;
  go.disabled = true;
  alarm.textContent = "";
  waiting = setTimeout(() => { free(); alarm.textContent = "No answer yet: try again."; }, 5000);
  say({do: way, ...Object.fromEntries(new FormData(form))});
});
for (const kind of ["keydown", "keyup", "keypress"]) {  // what is typed here is no command to the picture
  card.addEventListener(kind, (event) => { if (event.key !== "Escape") event.stopPropagation(); });
}

window.deltalabClass = {
  ask(sentence) { if (card.hidden) { card.hidden = false; turn("join"); } free(); alarm.textContent = sentence; },
  done() { free(); card.hidden = true; card.querySelectorAll("input").forEach((field) => { field.value = ""; }); },
  pause(message) {
    const on = message !== null;
    if (on) veil.querySelector("p").textContent = message;
    if (on === veil.hidden) {
      veil.hidden = !on;
      root.inert = card.inert = on;  // the bar with Stop stays outside of this
      if (on) veil.querySelector("section").focus({preventScroll: true});
    }
  },
  banner(text, tone) {
    banner.hidden = !text;
    banner.textContent = text;
    banner.className = `deltalab-class ${tone}`;
    const box = canvas();
    if (box?.width) banner.style.left = `${box.left + box.width / 2}px`;
  },
  picture(html, kind) {
    if (!html) unwanted = "";
    picture.hidden = !html || unwanted === kind;
    picture.dataset.kind = kind;
    picture.firstElementChild.innerHTML = html;  // numbers of the server only
    const box = canvas();
    if (box?.width && innerWidth > PHONE) picture.style.left = `${box.left + 14}px`;
  },
  end() { root.inert = false; clearTimeout(waiting); place.remove(); },
};
const key = address.searchParams.get("instructor");
if (key) {
  address.searchParams.delete("instructor");
  history.replaceState(null, "", address);
  say({do: "open", key: key.slice(0, 64)});
}
"""


def start(wire_id: str) -> str:
    """Script that makes all of them, hidden, and says what is typed through the text input `wire_id`."""
    phone = f"{PHONE_WIDTH_PX - 1}"
    config = {"wire": wire_id, "style": _STYLE.replace("PHONE", phone)}
    return _SCRIPT.replace("PHONE", phone).replace("CONFIG", json.dumps(config))


def ask(sentence: str = "") -> str:
    """Script that shows the card to join with, and why it is shown again."""
    return f"window.deltalabClass?.ask({json.dumps(sentence)});"


def done() -> str:
    """Script that takes the card away."""
    return "window.deltalabClass?.done();"


def pause(message: str | None) -> str:
    """Script that lays the veil with a message over everything but Stop, or lifts it."""
    return f"window.deltalabClass?.pause({json.dumps(message)});"


def banner(text: str, tone: Tone = "info") -> str:
    """Script that shows a line above the robot; without a text, none."""
    return f"window.deltalabClass?.banner({json.dumps(text)}, {json.dumps(tone)});"


def picture(svg: str, kind: str = "") -> str:
    """Script that shows a picture of all beside the robot; without one, it takes the last away."""
    return f"window.deltalabClass?.picture({json.dumps(svg)}, {json.dumps(kind)});"
