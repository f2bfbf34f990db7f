// The page: the text on the left, the football on the right.

import "./style.css";
import { Drag } from "./drag";
import { Editor } from "./editor";
import type { Episode, Reply, Scene } from "./messages";
import { scenes } from "./messages";
import { Hands } from "./hands";
import { arrows, offside } from "./overlay";
import { Params } from "./params";
import { Clock } from "./player";
import { Plot } from "./plot";
import { painted } from "./regions";
import { showEvents, showRequires, showSummary } from "./results";
import type { Seen } from "./screen";
import { Screen } from "./screen";
import { Socket } from "./socket";
import type { Frame, Painted } from "./view";

const CHECK_MS = 60;
const STEP_MS = 100;
const CLOUD = 150;
const EPISODES = 100;
const NOBODY = "nobody";
const PLAYING = "playing…";

function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no ${id}`);
  return found as T;
}

const [scrub, seed, index] = ["scrub", "seed", "episode"].map((id) => element<HTMLInputElement>(id)) as
  [HTMLInputElement, HTMLInputElement, HTMLInputElement];
const [agent, beside, speed, view] = ["agent", "beside", "speed", "view"].map((id) =>
  element<HTMLSelectElement>(id)) as
  [HTMLSelectElement, HTMLSelectElement, HTMLSelectElement, HTMLSelectElement];
const [trails, lines, zones, cloud, follow] = ["trails", "lines", "zones", "cloud", "follow"].map((id) =>
  element<HTMLInputElement>(id)) as
  [HTMLInputElement, HTMLInputElement, HTMLInputElement, HTMLInputElement, HTMLInputElement];

const clock = new Clock();
const screens = element("screens");
const say = (words: string) => (element("state").textContent = words);
const screen = new Screen(screens, "pitch", say);
let second: Screen | null = null;
let episode: Episode | null = null;
/** The same episode played by somebody else, or another recording. */
let other: Episode | null = null;
/** An episode of another program that waits until the last one has been seen. */
let waits: Episode | null = null;
let starts: [number, number][][] = [];
let regions: Painted | null = null;
/** The scenes of a match that somebody plays now, and when the last one came. */
let live: Scene[] = [];
let arrived = 0;
let dirty = false;
/** Whether somebody has typed here since the text was last shown or saved. */
let unsaved = false;
/** Whether the next text comes of a drag on this page. */
let moved = false;
let waiting = 0;

const hands = new Hands(element("seats"), (seat, keys) => socket.ask({ type: "hold", seat, keys }));
const socket = new Socket(hear, (connected) => {
  say(connected ? "" : "The studio has ended. Start it again.");
});
const editor = new Editor(element("editor"), edited, save);
// Only the start can be dragged.
const drag = new Drag(
  screen.element,
  screen,
  () => (clock.now.at === 0 && !clock.playing && live.length === 0 ? episode?.scenes[0] : undefined),
  (player, to) => {
    moved = true;
    socket.ask({ type: "move", player, to });
  },
);
const plot = new Plot(element("plot"), (at) => go(at));
const params = new Params(element("params"), (values) => {
  socket.ask({ type: "bind", params: values });
});

/** How this page calls itself, to know its own changes. */
const SELF = crypto.randomUUID();

function edited(text: string): void {
  dirty = unsaved = true;
  say("");
  clearTimeout(waiting);
  waiting = window.setTimeout(() => {
    socket.ask({ type: "text", text, from: SELF });
  }, CHECK_MS);
}

function save(): void {
  clearTimeout(waiting);
  socket.ask({ type: "text", text: editor.text(), from: SELF });
  socket.ask({ type: "save" });
}

function play(): void {
  const whole = (input: HTMLInputElement) =>
    Math.min(Number.MAX_SAFE_INTEGER, Math.max(0, Math.floor(Number(input.value) || 0)));
  const also = beside.value === NOBODY ? null : beside.value;
  // What somebody has chosen stays until they follow the program again.
  follow.checked = false;
  socket.ask({ type: "play", seed: whole(seed), episode: whole(index), agent: agent.value, beside: also });
}

function refreshCloud(): void {
  if (cloud.checked) socket.ask({ type: "cloud", count: CLOUD });
}

function go(at: number): void {
  clock.playing = false;
  clock.go(at);
}

function hear(reply: Reply): void {
  switch (reply.type) {
    case "opened":
      element<HTMLButtonElement>("save").hidden = !reply.is_file;
      element("text").toggleAttribute("hidden", reply.text === "" && !reply.is_file);
      dirty = !reply.is_saved;
      // What somebody types here has come this way already.
      if (reply.from === SELF) break;
      clearTimeout(waiting);
      void editor.serve(reply.uri);
      if (dirty && !moved && ![reply.text, ""].includes(editor.text())) {
        say("somebody else is editing this text");
      }
      // What was written here and is replaced from elsewhere comes back by undo.
      editor.show(reply.text, moved || unsaved);
      unsaved = false;
      moved = false;
      break;
    case "checked": {
      editor.report(reply.problems);
      const errors = reply.problems.filter((problem) => problem.severity !== "warning").length;
      const warnings = reply.problems.length - errors;
      const words = [
        ...(reply.fault ? [reply.fault] : []),
        ...(errors ? [`${errors} ${errors === 1 ? "error" : "errors"}`] : []),
        ...(warnings ? [`${warnings} ${warnings === 1 ? "warning" : "warnings"}`] : []),
      ];
      const shown = element("problems");
      shown.textContent = words.join(", ") || "no problems";
      shown.classList.toggle("wrong", errors > 0 || reply.fault !== null);
      element("name").textContent = reply.name;
      element("title").textContent = reply.title;
      document.title = `${reply.name} · Setpiece studio`;
      params.show(reply.params);
      hands.list(reply.agents);
      choices(agent, reply.players, "bot");
      choices(beside, [NOBODY, ...reply.players], NOBODY);
      break;
    }
    case "episode": {
      const played: Episode = { ...reply, scenes: scenes(reply) };
      if (reply.watched) element("follow").closest("label")?.removeAttribute("hidden");
      if (reply.watched && !follow.checked) break;
      if (reply.watched && episode?.watched && clock.now.at < clock.last) waits = played;
      else show(played);
      refreshCloud();
      break;
    }
    case "step":
      if (reply.scenes[0]?.step === 0) live = [];
      live.push(...scenes(reply));
      arrived = performance.now();
      break;
    case "cloud":
      starts = cloud.checked ? reply.starts : [];
      break;
    case "sketch":
      regions = painted(reply.regions, reply.pitch);
      element("zones").closest("label")?.toggleAttribute("hidden", regions === null);
      showRequires(element("requires"), reply.requires, (line) => editor.go(line));
      break;
    case "summary":
      showSummary(element("results"), reply);
      break;
    case "recording":
      download(reply.name, reply.hex);
      break;
    case "saved":
      dirty = unsaved = false;
      say("saved");
      break;
    case "refused":
      if (live.length === 0) hands.active = false;
      moved = false;
      if (element("results").textContent === PLAYING) element("results").textContent = "";
      if (episode) choose(agent, episode.agent);
      say(reply.message);
      break;
  }
}

/** Fills a choice; what was chosen stays if it is still there. */
function choices(select: HTMLSelectElement, names: string[], first: string): void {
  const now = [...select.options].map((option) => option.value);
  if (now.join("\n") === names.join("\n")) return;
  const chosen = names.includes(select.value) ? select.value : first;
  select.replaceChildren(...names.map((name) => new Option(name, name)));
  select.value = chosen;
}

/** Chooses a name, if it is one of the choices. */
function choose(select: HTMLSelectElement, name: string): void {
  if ([...select.options].some((option) => option.value === name)) select.value = name;
}

/** Shows an episode, in the second picture if it is there to be compared. */
function show(reply: Episode): void {
  if (reply.beside) {
    other = reply;
    // It is kept: a browser has few pictures in space.
    second ??= new Screen(screens, "pitch-beside", say);
    second.element.hidden = false;
    second.see(view.value as Seen);
    caption();
    return;
  }
  const first = episode === null;
  const played = live.length > 0;
  if (reply.watched) say("as another program has played it");
  else if (element("state").textContent !== "saved") say("");
  [episode, other] = [reply, null];
  if (second) second.element.hidden = true;
  clock.load(reply, first || reply.watched || (clock.playing && !played));
  if (element("results").textContent === PLAYING) element("results").textContent = "";
  if (played) clock.go(clock.last);
  [live, hands.active, waits] = [[], false, null];
  scrub.max = String(clock.last);
  [seed.value, index.value] = [String(reply.seed), String(reply.episode)];
  choose(agent, reply.agent);
  plot.show(reply);
  showEvents(element("events"), reply, go);
  caption();
}

/** Says which picture is whose, where there are two. */
function caption(): void {
  const words = (of: Episode) => [of.agent || `recording of ${of.name}`, `seed ${of.seed}`, `episode ${of.episode}`].join(" · ");
  screen.say(other && episode ? words(episode) : "");
  if (other) second?.say(words(other));
}

function download(name: string, hex: string): void {
  const bytes = new Uint8Array((hex.match(/../g) ?? []).map((digits) => parseInt(digits, 16)));
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([bytes]));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

function frameOf(of: Scene[], at: number, share: number, episode: Episode | null): Frame {
  const scene = of[at];
  return {
    scenes: of,
    at,
    share,
    trails: trails.checked,
    arrows: lines.checked && episode ? arrows(of, episode.events, at) : [],
    offside: lines.checked && scene ? offside(scene) : null,
    regions: zones.checked && at === 0 ? regions : null,
    cloud: starts,
  };
}

/** Shows the match that somebody plays, one step late, so that it moves smoothly. */
function hand(now: number): void {
  const last = live[live.length - 1];
  if (!last) return;
  hands.send(last);
  const at = Math.max(0, live.length - 2);
  screen.draw(frameOf(live, at, Math.min(1, (now - arrived) / STEP_MS), null));
  element("score").textContent = `${last.score[0]} : ${last.score[1]} · by hand`;
  element("moment").textContent = `${(last.step / 10).toFixed(1)} s`;
}

function byHand(): void {
  const seats = hands.begin();
  if (seats.length === 0) {
    say("choose who the keyboard or a gamepad plays");
    return;
  }
  clock.playing = false;
  screen.focus();
  socket.ask({ type: "begin", seats });
}

/** The score, what play waits for, and how it ended. */
function standing(of: Episode, scene: Scene, ended: boolean): string {
  const verdict = of.success === null ? "" : of.success ? " (success)" : " (failure)";
  const end = ended && of.outcome ? ` · ${of.outcome}${verdict}` : "";
  const mode = scene.mode === "normal" ? "" : ` · ${scene.mode.replaceAll("_", " ")}`;
  return `${scene.score[0]} : ${scene.score[1]}${mode}${end}`;
}

function frame(now: number): void {
  clock.pass(Math.min(0.25, (now - before) / 1000));
  before = now;
  hands.refresh();
  if (waits && follow.checked && clock.now.at >= clock.last) show(waits);
  const { at, share } = clock.now;
  const scene = episode?.scenes[at];
  if (live.length > 0) {
    hand(now);
  } else if (episode && scene) {
    const shown = at === 0 ? [drag.shown(scene), ...episode.scenes.slice(1, 2)] : episode.scenes;
    screen.draw(frameOf(shown, at, share, episode));
    scrub.value = String(at);
    element("moment").textContent = `${(scene.step / 10).toFixed(1)} s`;
    element("toggle").textContent = clock.playing ? "Pause" : "Play";
    element("score").textContent = standing(episode, scene, at >= clock.last) + compare(at, share);
    plot.mark(at);
  }
  element("save").classList.toggle("dirty", dirty);
  requestAnimationFrame(frame);
}
let before = performance.now();

/** Draws the second picture at the same step; what it says of the score. */
function compare(at: number, share: number): string {
  if (!other || !second || !episode) return "";
  const step = episode.scenes[at]?.step ?? 0;
  const last = other.scenes.length - 1;
  const found = other.scenes.findIndex((scene) => scene.step >= step);
  const there = found < 0 ? last : found;
  const scene = other.scenes[there];
  if (!scene) return "";
  // The longer one goes on while the shorter one stands at its end.
  second.draw(frameOf(other.scenes, there, there < last ? share : 0, other));
  return ` | ${standing(other, scene, there >= last)}`;
}

element("toggle").onclick = () => clock.toggle();
element("back").onclick = () => go(clock.now.at - 1);
element("forth").onclick = () => go(clock.now.at + 1);
element("next").onclick = next;
element("save").onclick = save;
element("hand").onclick = byHand;
element("record").onclick = () => socket.ask({ type: "record" });
element("summarise").onclick = () => {
  element("results").textContent = PLAYING;
  socket.ask({ type: "summary", episodes: EPISODES });
};
scrub.oninput = () => go(Number(scrub.value));
speed.onchange = () => (clock.speed = Number(speed.value));
view.onchange = () => {
  view.value = screen.see(view.value as Seen);
  second?.see(view.value as Seen);
};
screens.ondblclick = (event) => {
  const scene = live[live.length - 1] ?? episode?.scenes[clock.now.at];
  const followed = screen.follow(event.clientX, event.clientY, scene);
  if (view.value !== "above") say(followed ? "the camera follows this player" : "the camera follows the ball");
};
for (const choice of [seed, index, agent, beside]) choice.onchange = play;
cloud.onchange = () => {
  starts = [];
  refreshCloud();
};

function next(): void {
  index.value = String(Number(index.value) + 1);
  play();
}

function otherView(): void {
  view.selectedIndex = (view.selectedIndex + 1) % view.options.length;
  view.dispatchEvent(new Event("change"));
}

// Keys for everything, but not while somebody writes.
document.addEventListener("keydown", (event) => {
  const target = event.target as HTMLElement;
  if (hands.active && event.key !== "Escape") return;
  if (target.closest(".cm-editor, input:not(#scrub):not([type=checkbox]), select")) return;
  // A button or a box that has the focus takes these itself.
  if ([" ", "Enter"].includes(event.key) && target.closest("button, input[type=checkbox]")) return;
  const keys: Record<string, () => void> = {
    " ": () => clock.toggle(),
    ArrowLeft: () => go(clock.now.at - 1),
    ArrowRight: () => go(clock.now.at + 1),
    Home: () => go(0),
    End: () => go(clock.last),
    n: next,
    h: byHand,
    v: otherView,
    Escape: () => socket.ask({ type: "stop" }),
  };
  const act = keys[event.key];
  if (act && !event.ctrlKey && !event.metaKey) {
    event.preventDefault();
    act();
  }
});
window.addEventListener("beforeunload", (event) => {
  if (dirty && !element<HTMLButtonElement>("save").hidden) event.preventDefault();
});
requestAnimationFrame(frame);
