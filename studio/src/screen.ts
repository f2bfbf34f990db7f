// One picture of a match: from above, from the stand, or from anywhere.

import type { Id, Scene } from "./messages";
import { Pitch } from "./pitch";
import { Stadium } from "./stadium";
import type { Frame, View } from "./view";

export type Seen = "above" | "stand" | "free";

/** A figure is followed by a click this near, metres. */
const REACH_M = 1.5;

export class Screen implements View {
  private readonly above: Pitch;
  private stadium: Stadium | null = null;
  private readonly deep: HTMLCanvasElement;
  private seen: Seen = "above";
  readonly element = document.createElement("div");
  private readonly caption = document.createElement("p");

  /** `id`: the name of its canvas; `failed`: called if the browser draws nothing in space. */
  constructor(parent: HTMLElement, id: string, private readonly failed: (why: string) => void) {
    this.element.className = "screen";
    const flat = document.createElement("canvas");
    [flat.id, flat.tabIndex] = [id, 0];
    flat.setAttribute("aria-label", "The pitch from above");
    this.deep = document.createElement("canvas");
    [this.deep.id, this.deep.tabIndex, this.deep.hidden] = [`${id}-deep`, 0, true];
    this.deep.setAttribute("aria-label", "The pitch in space");
    this.element.append(this.caption, flat, this.deep);
    parent.append(this.element);
    this.above = new Pitch(flat);
  }

  /** Where it is seen from now. */
  see(seen: Seen): Seen {
    if (seen !== "above" && !this.stadium) {
      try {
        this.stadium = new Stadium(this.deep);
      } catch {
        this.failed("this browser has no WebGL: only the view from above is drawn");
        seen = "above";
      }
    }
    this.seen = seen;
    if (seen !== "above") this.stadium?.see(seen);
    this.element.querySelector("canvas")?.toggleAttribute("hidden", seen !== "above");
    this.deep.hidden = seen === "above";
    return seen;
  }

  say(words: string): void {
    this.caption.textContent = words;
  }

  draw(frame: Frame): void {
    this.view.draw(frame);
  }

  place(x: number, y: number): [number, number] {
    return this.view.place(x, y);
  }

  /** Follows the player at a point of the page, else the ball. */
  follow(x: number, y: number, scene: Scene | undefined): Id | null {
    if (!this.stadium || this.seen === "above") return null;
    const [px, py] = this.place(x, y);
    const near = scene?.players.find((player) =>
      player.present && Math.hypot(player.pos[0] - px, player.pos[1] - py) < REACH_M);
    this.stadium.followed = near?.id ?? null;
    return this.stadium.followed;
  }

  focus(): void {
    (this.seen === "above" ? this.element.querySelector("canvas") : this.deep)?.focus();
  }

  private get view(): View {
    return this.seen === "above" || !this.stadium ? this.above : this.stadium;
  }
}
