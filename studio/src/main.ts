// The page: the text on the left, the football on the right.

import "./style.css";
import { Drag } from "./drag";
import { Editor } from "./editor";
import type { Episode, Reply, Scene, Side } from "./messages";
import { Hands } from "./hands";
import { Params } from "./params";
import { Pitch } from "./pitch";
import { Clock } from "./player";
import { Plot } from "./plot";
import { Socket } from "./socket";

const CHECK_MS = 60;
const STEP_MS = 100;
const CLOUD = 150;
const EPISODES = 100;

function element<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`no ${id}`);
  return found as T;
}

const canvas = element<HTMLCanvasElement>("pitch");
const [scrub, seed, index] = ["scrub", "seed", "episode"].map((id) => element<HTMLInputElement>(id)) as
  [HTMLInputElement, HTMLInputElement, HTMLInputElement];
const [agent, speed] = [element<HTMLSelectElement>("agent"), element<HTMLSelectElement>("speed")];
const [trails, cloud] = [element<HTMLInputElement>("trails"), element<HTMLInputElement>("cloud")];

const clock = new Clock();
const pitch = new Pitch(canvas);
let episode: Episode | null = null;
/** The scenes of a match that somebody plays now, and when the last one came. */
let live: Scene[] = [];
let arrived = 0;
let dirty = false;
/** Whether the next text comes of a drag on this page. */
let moved = false;
let waiting = 0;

const hands = new Hands((keys) => socket.ask({ type: "hold", keys }));
const socket = new Socket(hear, (connected) => {
  element("state").textContent = connected ? "" : "The studio has ended. Start it again.";
});
const editor = new Editor(element("editor"), edited, save);
// Only the start can be dragged.
const drag = new Drag(
  canvas,
  pitch,
  () => (clock.now.at === 0 && !clock.playing ? episode?.scenes[0] : undefined),
  (player, to) => {
    moved = true;
    socket.ask({ type: "move", player, to });
  },
);
const plot = new Plot(element("plot"), (at) => go(at));
const params = new Params(element("params"), (values) => {
  socket.ask({ type: "bind", params: values });
  refreshCloud();
});

function edited(text: string): void {
  dirty = true;
  clearTimeout(waiting);
  waiting = window.setTimeout(() => {
    socket.ask({ type: "text", text });
    refreshCloud();
  }, CHECK_MS);
}

function save(): void {
  socket.ask({ type: "text", text: editor.text() });
  socket.ask({ type: "save" });
}

function play(): void {
  const whole = (input: HTMLInputElement) => Math.max(0, Math.floor(Number(input.value) || 0));
  socket.ask({ type: "play", seed: whole(seed), episode: whole(index), agent: agent.value });
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
      editor.show(reply.text, moved);
      moved = false;
      dirty = false;
      element<HTMLButtonElement>("save").hidden = !reply.is_file;
      if (agent.options.length === 0) {
        for (const name of reply.agents) agent.add(new Option(name, name, false, name === "bot"));
      }
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
      break;
    }
    case "episode": {
      const first = episode === null;
      const played = live.length > 0;
      episode = reply;
      clock.load(reply, first || (clock.playing && !played));
      if (played) clock.go(clock.last);
      [live, hands.active] = [[], false];
      scrub.max = String(clock.last);
      [seed.value, index.value] = [String(reply.seed), String(reply.episode)];
      if (reply.agent) agent.value = reply.agent;
      plot.show(reply);
      events(reply);
      break;
    }
    case "step":
      if (reply.scenes[0]?.step === 0) live = [];
      live.push(...reply.scenes);
      arrived = performance.now();
      break;
    case "cloud":
      pitch.lay(cloud.checked ? reply.starts : []);
      break;
    case "summary":
      results(reply);
      break;
    case "saved":
      dirty = false;
      element("state").textContent = "saved";
      break;
    case "refused":
      if (live.length === 0) hands.active = false;
      moved = false;
      element("state").textContent = reply.message;
      break;
  }
}

function events(played: Episode): void {
  const list = element("events");
  list.replaceChildren(
    ...played.events
      .filter((event) => !/^(touch|ball_won|ball_lost|end)/.test(event.name))
      .map((event) => {
        const mark = document.createElement("button");
        mark.className = `event ${event.team ?? ""}`;
        mark.style.left = `${(100 * event.at) / Math.max(1, clock.last)}%`;
        const words = `${event.name.replaceAll("_", " ")}${event.by ? `, ${event.by}` : ""}`;
        mark.title = words;
        mark.setAttribute("aria-label", words);
        mark.onclick = () => go(event.at);
        return mark;
      }),
  );
}

function results(reply: Extract<Reply, { type: "summary" }>): void {
  const table = document.createElement("table");
  const row = (name: string, value: string, share?: number) => {
    const line = table.insertRow();
    line.insertCell().textContent = name;
    line.insertCell().textContent = value;
    const bar = line.insertCell();
    if (share !== undefined) {
      const fill = document.createElement("i");
      fill.style.width = `${100 * share}%`;
      bar.append(fill);
    }
  };
  for (const [name, count] of reply.outcomes) {
    row(name, `${((100 * count) / reply.episodes).toFixed(0)} %`, count / reply.episodes);
  }
  row("mean score", reply.score.map((goals) => goals.toFixed(2)).join(" : "));
  row("mean return", reply.mean_return.toFixed(3));
  for (const [name, value] of reply.terms) row(`  ${name}`, value.toFixed(3));
  for (const [name, value] of reply.records) row(`  ${name}`, value.toFixed(3));
  element("results").replaceChildren(table);
}

/** Shows the match that somebody plays, one step late, so that it moves smoothly. */
function hand(now: number): void {
  const last = live[live.length - 1];
  if (!last) return;
  const side = element<HTMLSelectElement>("side").value;
  hands.send(last.ball.owner?.team === side);
  const at = Math.max(0, live.length - 2);
  pitch.draw(live, at, Math.min(1, (now - arrived) / STEP_MS), trails.checked);
  element("score").textContent = `${last.score[0]} : ${last.score[1]} · by hand`;
  element("moment").textContent = `${(last.step / 10).toFixed(1)} s`;
}

function byHand(): void {
  clock.playing = false;
  hands.begin();
  canvas.focus();
  socket.ask({ type: "begin", side: element<HTMLSelectElement>("side").value as Side });
}

function frame(now: number): void {
  clock.pass(Math.min(0.25, (now - before) / 1000));
  before = now;
  const { at, share } = clock.now;
  const scene = episode?.scenes[at];
  if (live.length > 0) {
    hand(now);
  } else if (episode && scene) {
    const scenes = at === 0 ? [drag.shown(scene), ...episode.scenes.slice(1, 2)] : episode.scenes;
    pitch.draw(scenes, at, share, trails.checked);
    scrub.value = String(at);
    element("moment").textContent = `${(scene.step / 10).toFixed(1)} s`;
    element("toggle").textContent = clock.playing ? "Pause" : "Play";
    const end = at >= clock.last && episode.outcome ? ` · ${episode.outcome}` : "";
    const mode = scene.mode === "normal" ? "" : ` · ${scene.mode.replaceAll("_", " ")}`;
    element("score").textContent = `${scene.score[0]} : ${scene.score[1]}${mode}${end}`;
    plot.mark(at);
  }
  element("save").classList.toggle("dirty", dirty);
  requestAnimationFrame(frame);
}
let before = performance.now();

element("toggle").onclick = () => clock.toggle();
element("back").onclick = () => go(clock.now.at - 1);
element("forth").onclick = () => go(clock.now.at + 1);
element("next").onclick = next;
element("save").onclick = save;
element("hand").onclick = byHand;
element("summarise").onclick = () => {
  element("results").textContent = "playing…";
  socket.ask({ type: "summary", episodes: EPISODES });
};
scrub.oninput = () => go(Number(scrub.value));
speed.onchange = () => (clock.speed = Number(speed.value));
seed.onchange = play;
index.onchange = play;
agent.onchange = play;
cloud.onchange = () => (cloud.checked ? refreshCloud() : pitch.lay([]));

function next(): void {
  index.value = String(Number(index.value) + 1);
  play();
}

// Keys for everything, but not while somebody writes.
document.addEventListener("keydown", (event) => {
  const target = event.target as HTMLElement;
  if (hands.active && event.key !== "Escape") return;
  if (target.closest(".cm-editor, input:not(#scrub):not([type=checkbox]), select")) return;
  const keys: Record<string, () => void> = {
    " ": () => clock.toggle(),
    ArrowLeft: () => go(clock.now.at - 1),
    ArrowRight: () => go(clock.now.at + 1),
    Home: () => go(0),
    End: () => go(clock.last),
    n: next,
    h: byHand,
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
