// People's keyboard and gamepads: what is held, in the names of the server.

import type { HeldKey, Keys, Scene, Seat } from "./messages";

/** Google Research Football's keys. `a` slides without the ball. */
const KEYS: Record<string, HeldKey> = {
  s: "short_pass",
  d: "shot",
  a: "high_pass",
  w: "long_pass",
  e: "sprint",
  c: "dribble",
};
const WAYS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};
/** A gamepad's buttons, by number. */
const BUTTONS: (HeldKey | null)[] = [
  "short_pass", "shot", "high_pass", "long_pass", null, "dribble", null, "sprint",
];
const TILTED = 0.5;
const KEYBOARD = "Keyboard";

interface Held { way: [number, number]; held: Set<HeldKey> }

export class Hands {
  private readonly down = new Set<string>();
  private last: string[] = [];
  private agents: Seat[] = [];
  private devices = "";
  /** The agents that are played, in the order of the server's seats. */
  private seats: string[] = [];
  active = false;

  constructor(
    private readonly parent: HTMLElement,
    private readonly hold: (seat: number, keys: Keys) => void,
  ) {
    document.addEventListener("keydown", (event) => this.key(event, true));
    document.addEventListener("keyup", (event) => this.key(event, false));
    window.addEventListener("blur", () => this.down.clear());
  }

  /** Lists who can be played, with a choice for each device. */
  list(agents: Seat[]): void {
    this.agents = agents;
    this.devices = "";
    this.refresh();
  }

  /** Shows a choice for every device that is there. */
  refresh(): void {
    const pads = (navigator.getGamepads?.() ?? []).flatMap((pad, index) => (pad ? [index] : []));
    const devices = [KEYBOARD, ...pads.map((index) => `Gamepad ${index + 1}`)];
    if (devices.join() === this.devices) return;
    this.devices = devices.join();
    // Before the agents are known nobody has chosen anybody.
    const made = this.rows().filter(([, select]) => select.options.length > 1);
    const chosen = new Map(made.map(([device, select]) => [device, select.value]));
    const rows = devices.map((device) => {
      const [row, select] = [document.createElement("label"), document.createElement("select")];
      select.dataset["device"] = device;
      select.add(new Option("nobody", ""));
      for (const { id, team } of this.agents) select.add(new Option(`${id} (${team})`, id));
      const known = ["", ...this.agents.map((agent) => agent.id)].includes(chosen.get(device) ?? "?");
      select.value = (known ? chosen.get(device) : this.agents[0]?.id) ?? "";
      row.append(`${device} plays `, select);
      return row;
    });
    this.parent.replaceChildren(...rows);
  }

  /** Begins; the agents that are played. */
  begin(): string[] {
    this.down.clear();
    const chosen = this.rows().map(([, select]) => select.value).filter((id) => id !== "");
    this.seats = [...new Set(chosen)];
    this.last = this.seats.map(() => "");
    this.active = this.seats.length > 0;
    return this.seats;
  }

  /** Sends what is held if it has changed. */
  send(scene: Scene): void {
    if (!this.active) return;
    this.seats.forEach((id, seat) => {
      const team = this.agents.find((agent) => agent.id === id)?.team;
      const keys = this.held(id, scene.ball.owner?.team === team);
      const text = JSON.stringify(keys);
      if (text === this.last[seat]) return;
      this.last[seat] = text;
      this.hold(seat, keys);
    });
  }

  private rows(): [string, HTMLSelectElement][] {
    return [...this.parent.querySelectorAll("select")].map((select) => [select.dataset["device"] ?? "", select]);
  }

  private key(event: KeyboardEvent, isDown: boolean): void {
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    // What is let go is let go, whatever else is held.
    if (!isDown) this.down.delete(name);
    const isWriting = (event.target as HTMLElement).closest(".cm-editor, input, select");
    if (isWriting || !this.active || event.ctrlKey || event.metaKey || !(name in KEYS || name in WAYS)) return;
    event.preventDefault();
    event.stopPropagation();
    if (isDown) this.down.add(name);
  }

  /** What the devices of an agent hold together; `hasBall`: whether its team has the ball. */
  private held(id: string, hasBall: boolean): Keys {
    let [x, y] = [0, 0];
    const held = new Set<HeldKey>();
    for (const [device, select] of this.rows()) {
      if (select.value !== id) continue;
      const of = device === KEYBOARD ? this.keyboard() : gamepad(Number(device.split(" ")[1]) - 1);
      [x, y] = [x + of.way[0], y + of.way[1]];
      for (const key of of.held) held.add(key);
    }
    if (!hasBall && held.delete("high_pass")) held.add("sliding");
    return { way: [Math.sign(x), Math.sign(y)], held: [...held].sort() };
  }

  private keyboard(): Held {
    const held: Held = { way: [0, 0], held: new Set() };
    for (const name of this.down) {
      const way = WAYS[name];
      if (way) held.way = [held.way[0] + way[0], held.way[1] + way[1]];
      const key = KEYS[name];
      if (key) held.held.add(key);
    }
    return held;
  }
}

function gamepad(index: number): Held {
  const held: Held = { way: [0, 0], held: new Set() };
  const pad = navigator.getGamepads?.()[index];
  if (!pad) return held;
  const tilt = (axis: number) => {
    const value = pad.axes[axis] ?? 0;
    return Math.abs(value) > TILTED ? Math.sign(value) : 0;
  };
  held.way = [tilt(0), tilt(1)];
  BUTTONS.forEach((key, button) => {
    if (key && pad.buttons[button]?.pressed) held.held.add(key);
  });
  return held;
}
