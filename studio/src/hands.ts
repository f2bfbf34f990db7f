// A person's keyboard or gamepad: what is held, in the names of the server.

import type { HeldKey, Keys } from "./messages";

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
/** Its buttons, by number. */
const BUTTONS: (HeldKey | null)[] = [
  "short_pass", "shot", "high_pass", "long_pass", null, "dribble", null, "sprint",
];
const TILTED = 0.5;

export class Hands {
  private readonly down = new Set<string>();
  private last = "";
  active = false;

  constructor(private readonly hold: (keys: Keys) => void) {
    document.addEventListener("keydown", (event) => this.key(event, true));
    document.addEventListener("keyup", (event) => this.key(event, false));
    window.addEventListener("blur", () => this.down.clear());
  }

  begin(): void {
    this.down.clear();
    this.last = "";
    this.active = true;
  }

  /** Sends what is held if it has changed; `hasBall`: whether the person's team has the ball. */
  send(hasBall: boolean): void {
    if (!this.active) return;
    const keys = this.held(hasBall);
    const text = JSON.stringify(keys);
    if (text === this.last) return;
    this.last = text;
    this.hold(keys);
  }

  private key(event: KeyboardEvent, isDown: boolean): void {
    const name = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const isWriting = (event.target as HTMLElement).closest(".cm-editor, input, select");
    if (isWriting || !this.active || event.ctrlKey || event.metaKey || !(name in KEYS || name in WAYS)) return;
    event.preventDefault();
    event.stopPropagation();
    if (isDown) this.down.add(name);
    else this.down.delete(name);
  }

  private held(hasBall: boolean): Keys {
    let [x, y] = [0, 0];
    const held = new Set<HeldKey>();
    for (const name of this.down) {
      const way = WAYS[name];
      if (way) [x, y] = [x + way[0], y + way[1]];
      const key = KEYS[name];
      if (key) held.add(key);
    }
    for (const pad of navigator.getGamepads?.() ?? []) {
      if (!pad) continue;
      const tilt = (axis: number) => {
        const value = pad.axes[axis] ?? 0;
        return Math.abs(value) > TILTED ? Math.sign(value) : 0;
      };
      [x, y] = [x + tilt(0), y + tilt(1)];
      BUTTONS.forEach((key, button) => {
        if (key && pad.buttons[button]?.pressed) held.add(key);
      });
    }
    if (!hasBall && held.delete("high_pass")) held.add("sliding");
    return { way: [Math.sign(x), Math.sign(y)], held: [...held].sort() };
  }
}
