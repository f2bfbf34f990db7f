/// <reference lib="dom" />
// The script of the panel's page: shows the picture, and lets players and the ball be dragged.

import {
  type Field, type Place, type Thing, nearest, placeOf, reachOf, shareOf, spoken, within,
} from "./field";
import type { Drop } from "./move";
import type { PageMessage } from "./picture";

declare function acquireVsCodeApi(): { postMessage(message: Drop): void };

/** Widths of a player's disc and of the ball in the picture, metres. */
const [PLAYER_M, BALL_M] = [3, 2];
/** What was moved by less is not moved, metres. */
const LEAST_M = 0.3;
/** How far a key moves, metres; with Shift less. */
const [STEP_M, SMALL_STEP_M] = [1, 0.1];
const WAYS: Readonly<Record<string, Place>> = {
  ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1],
};

const host = acquireVsCodeApi();
const [title, words] = [part("title", HTMLElement), part("words", HTMLElement)];
const asked = part("asked", HTMLElement);
const picture = part("picture", HTMLImageElement);
const [plane, things, ghost] = [
  part("field", HTMLElement), part("things", HTMLElement), part("ghost", HTMLElement),
];

/** What the picture shows, if things may be moved in it. */
let field: Field | undefined;
/** What is moved, where it is now, and where the pointer took it. */
let held: { thing: Thing; at: Place; grip: Place } | undefined;

window.addEventListener("message", ({ data }: MessageEvent<PageMessage>) => {
  release();
  if ("refused" in data) {
    words.textContent = data.refused;
    return;
  }
  title.textContent = data.title;
  words.textContent = data.words;
  picture.classList.toggle("stale", !data.picture);
  if (data.picture) {
    picture.src = data.picture;
    picture.hidden = false;
  }
  asked.replaceChildren(...(data.asked ?? []).map((requirement) => {
    const line = document.createElement("li");
    line.textContent = requirement;
    return line;
  }));
  field = data.field;
  list();
});

const under = (event: PointerEvent, of: Field): Place =>
  placeOf(of, picture.getBoundingClientRect(), [event.clientX, event.clientY]);
const thingAt = (of: Field, at: Place): Thing | undefined =>
  nearest(of, at, reachOf(of, picture.getBoundingClientRect().width));

plane.addEventListener("pointerdown", (event) => {
  if (!field || event.button !== 0) return;
  const at = under(event, field);
  const thing = thingAt(field, at);
  if (!thing) return;
  event.preventDefault();
  plane.setPointerCapture(event.pointerId);
  take(thing, at);
});
plane.addEventListener("pointermove", (event) => {
  if (!field) return;
  const [x, y] = under(event, field);
  plane.classList.toggle("near", thingAt(field, [x, y]) !== undefined);
  if (!held || !plane.hasPointerCapture(event.pointerId)) return;
  const { thing, grip } = held;
  move([thing.at[0] + x - grip[0], thing.at[1] + y - grip[1]]);
});
plane.addEventListener("pointerup", (event) => {
  if (plane.hasPointerCapture(event.pointerId)) drop();
});
plane.addEventListener("pointercancel", release);
window.addEventListener("keydown", (event) => {
  if (event.key === "Escape") release();
});

/** A part of the page. */
function part<Part extends HTMLElement>(id: string, kind: new () => Part): Part {
  const found = document.getElementById(id);
  if (!(found instanceof kind)) throw new Error(`the page has no ${id}`);
  return found;
}

/** Takes a thing by a point. */
function take(thing: Thing, grip: Place): void {
  held = { thing, at: thing.at, grip };
  plane.classList.add("held");
}

/** Shows what is held elsewhere. */
function move(to: Place): void {
  if (!field || !held) return;
  held.at = within(field, to);
  put(ghost, held.at, widthOf(held.thing));
  ghost.hidden = false;
}

/** Says where something was dropped. The ghost stays until the answer. */
function drop(): void {
  if (!field || !held) return;
  const { thing, at } = held;
  const { player } = thing;
  const far = Math.hypot(at[0] - thing.at[0], at[1] - thing.at[1]);
  if (far < (things.contains(document.activeElement) ? SMALL_STEP_M / 2 : LEAST_M)) {
    release();
    return;
  }
  held = undefined;
  plane.classList.remove("held");
  host.postMessage({ drawing: field.drawing, player, to: at });
}

/** Lets go without moving anything. */
function release(): void {
  held = undefined;
  ghost.hidden = true;
  plane.classList.remove("held");
}

const widthOf = ({ player }: Thing): number => (player ? PLAYER_M : BALL_M);

/** Puts a part of the page over the picture. */
function put(element: HTMLElement, at: Place, width: number): void {
  if (!field) return;
  const [x, y] = shareOf(field, at);
  const { style } = element;
  [style.left, style.top] = [`${100 * x}%`, `${100 * y}%`];
  style.width = `${(100 * width) / field.view[2]}%`;
}

/** Lists who can be moved for the keyboard; the one that has the focus keeps it. */
function list(): void {
  const focused = [...things.children].findIndex((it) => it === document.activeElement);
  const buttons = (field?.things ?? []).map((thing) => {
    const button = document.createElement("button");
    button.setAttribute("aria-label", spoken(thing));
    put(button, thing.at, widthOf(thing));
    button.addEventListener("keydown", (event) => {
      const way = WAYS[event.key];
      if (!way) return;
      event.preventDefault();
      if (held?.thing !== thing) take(thing, thing.at);
      const step = event.shiftKey ? SMALL_STEP_M : STEP_M;
      const [x, y] = held?.at ?? thing.at;
      move([x + step * way[0], y + step * way[1]]);
    });
    button.addEventListener("click", drop);
    button.addEventListener("blur", release);
    return button;
  });
  things.replaceChildren(...buttons);
  buttons[focused]?.focus();
}
