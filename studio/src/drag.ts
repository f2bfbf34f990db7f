// Dragging a player or the ball at the start: the text changes, and with it everything else.

import type { Id, Scene } from "./messages";
import type { View } from "./view";

const REACH_M = 1.8;

export class Drag {
  private held: { player: Id | null; place: [number, number] } | null = null;

  constructor(
    element: HTMLElement,
    private readonly view: View,
    private readonly start: () => Scene | undefined,
    private readonly move: (player: Id | null, to: [number, number]) => void,
  ) {
    element.addEventListener("pointerdown", (event) => {
      this.held = this.find(this.view.place(event.clientX, event.clientY));
      if (!this.held) return;
      element.setPointerCapture(event.pointerId);
      // The camera stays.
      event.stopPropagation();
    }, true);
    element.addEventListener("pointermove", (event) => {
      const place = this.view.place(event.clientX, event.clientY);
      // Above the horizon there is no place.
      if (!place.every(Number.isFinite)) return;
      if (this.held) this.held.place = place;
      element.style.cursor = this.held || this.find(place) ? "grab" : "default";
    });
    element.addEventListener("pointerup", () => {
      const held = this.held;
      this.held = null;
      if (held) this.move(held.player, held.place);
    });
    element.addEventListener("pointercancel", () => (this.held = null));
  }

  /** The start with what is held at the pointer. */
  shown(scene: Scene): Scene {
    const held = this.held;
    if (!held) return scene;
    const [x, y] = held.place;
    if (!held.player) return { ...scene, ball: { ...scene.ball, pos: [x, y, scene.ball.pos[2]] } };
    const { team, slot } = held.player;
    const players = scene.players.map((player) =>
      player.id.team === team && player.id.slot === slot
        ? { ...player, pos: [x, y] as [number, number] }
        : player,
    );
    return { ...scene, players };
  }

  private find([x, y]: [number, number]): { player: Id | null; place: [number, number] } | null {
    const scene = this.start();
    if (!scene) return null;
    const far = ([a, b]: readonly number[]) => Math.hypot((a ?? 0) - x, (b ?? 0) - y);
    const near = scene.players.filter((player) => player.present && far(player.pos) < REACH_M);
    near.sort((a, b) => far(a.pos) - far(b.pos));
    const player = near[0];
    if (far(scene.ball.pos) < Math.min(REACH_M / 2, player ? far(player.pos) : REACH_M)) {
      return { player: null, place: [x, y] };
    }
    return player ? { player: player.id, place: [x, y] } : null;
  }
}
