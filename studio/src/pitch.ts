// The pitch from above, in metres, with the left team attacking to the right.

import type { Player, Scene } from "./messages";
import type { Arrow, Frame, View } from "./view";
import { HALF_X, HALF_Y, MARGIN, mixed, same, shirt, towards } from "./view";

const TRAIL = 12;

interface Colours { grass: string; stripe: string; line: string }

export class Pitch implements View {
  private readonly context: CanvasRenderingContext2D;
  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas");
    this.context = context;
  }

  /** The place in metres of a point of the page. */
  place(x: number, y: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const scale = (2 * (HALF_X + MARGIN)) / box.width;
    return [(x - box.left - box.width / 2) * scale, (y - box.top - box.height / 2) * scale];
  }

  /** Draws a moment. */
  draw(frame: Frame): void {
    const { scenes, at, share } = frame;
    const scene = scenes[at];
    const width = this.canvas.clientWidth;
    const height = (width * (HALF_Y + MARGIN)) / (HALF_X + MARGIN);
    const ratio = window.devicePixelRatio || 1;
    if (this.canvas.width !== Math.round(width * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
      this.canvas.style.height = `${height}px`;
    }
    const c = this.context;
    const scale = (width * ratio) / (2 * (HALF_X + MARGIN));
    c.setTransform(scale, 0, 0, scale, this.canvas.width / 2, this.canvas.height / 2);
    field(c, this.colours());
    if (frame.regions) {
      const [x, y] = [HALF_X + MARGIN, HALF_Y + MARGIN];
      c.drawImage(frame.regions, -x, -y, 2 * x, 2 * y);
    }
    for (const start of frame.cloud) {
      start.forEach(([x, y], index) => {
        c.fillStyle = index === 0 ? "#ffffff40" : "#00000022";
        c.beginPath();
        c.arc(x, y, 0.5, 0, 7);
        c.fill();
      });
    }
    if (!scene) return;
    const to = towards(frame) ?? scene;
    if (frame.offside !== null) this.offside(frame.offside);
    if (frame.trails) this.trails(scenes, at);
    for (const arrow of frame.arrows) this.arrow(arrow);
    for (const player of scene.players) {
      if (!player.present) continue;
      const then = to.players.find((it) => same(it.id, player.id)) ?? player;
      this.player(player, mixed(player.pos, then.pos, share), scene);
    }
    const from = scene.ball.pos;
    const end = to.ball.pos;
    const [x, y] = mixed([from[0], from[1]], [end[0], end[1]], share);
    this.ball(x, y, from[2] + (end[2] - from[2]) * share);
  }

  private trails(scenes: Scene[], at: number): void {
    const c = this.context;
    c.lineCap = "round";
    const first = Math.max(0, at - TRAIL);
    for (let k = at; k > first && !scenes[k]?.placed; k--) {
      const [now, before] = [scenes[k], scenes[k - 1]];
      if (!now || !before) break;
      const fade = 1 - (at - k) / TRAIL;
      c.globalAlpha = 0.5 * fade;
      for (const player of now.players) {
        const was = before.players.find((it) => same(it.id, player.id));
        if (!was) continue;
        c.strokeStyle = shirt(player)[0];
        c.lineWidth = 0.9 * fade;
        stroke(c, was.pos, player.pos);
      }
      c.strokeStyle = "#ffffff";
      c.lineWidth = 0.5 * fade;
      stroke(c, before.ball.pos, now.ball.pos);
    }
    c.globalAlpha = 1;
  }

  private player(player: Player, [x, y]: [number, number], scene: Scene): void {
    const c = this.context;
    const [cloth, ink] = shirt(player);
    if (same(scene.ball.owner, player.id)) {
      c.fillStyle = "#ffffff4d";
      disc(c, x, y, 1.9);
    }
    const turn = Math.atan2(player.facing[1], player.facing[0]);
    c.save();
    c.translate(x, y);
    c.rotate(turn);
    c.fillStyle = "#10141880";
    c.beginPath();
    c.moveTo(2, 0);
    c.lineTo(0.3, 1.1);
    c.lineTo(0.3, -1.1);
    c.fill();
    if (player.posture === "fallen" || player.posture === "sliding" || player.posture === "diving") {
      c.fillStyle = cloth;
      c.fillRect(-1.8, -0.4, 3.6, 0.8);
    }
    c.restore();
    c.fillStyle = cloth;
    disc(c, x, y, 1.05);
    c.lineWidth = 0.22;
    c.strokeStyle = player.agent ? "#ffffff" : "#101418";
    c.beginPath();
    c.arc(x, y, player.agent ? 1.25 : 1.05, 0, 7);
    c.stroke();
    c.fillStyle = ink;
    c.font = "600 1.3px system-ui, sans-serif";
    c.textAlign = "center";
    c.textBaseline = "middle";
    c.fillText(String(player.number), x, y + 0.08);
    if (player.yellow_cards > 0) {
      c.fillStyle = "#ffde28";
      c.fillRect(x + 0.8, y - 1.9, 0.7, 1);
    }
  }

  private offside(x: number): void {
    const c = this.context;
    c.strokeStyle = "#ff8278";
    c.lineWidth = 0.25;
    c.setLineDash([1.2, 1]);
    stroke(c, [x, -HALF_Y], [x, HALF_Y]);
    c.setLineDash([]);
  }

  private arrow({ from, to, fade, shot }: Arrow): void {
    const c = this.context;
    const [x, y] = [to[0] - from[0], to[1] - from[1]];
    const length = Math.hypot(x, y);
    if (length < 2) return;
    c.save();
    c.globalAlpha = 0.85 * fade;
    c.strokeStyle = c.fillStyle = shot ? "#ff8278" : "#ffffff";
    c.lineWidth = 0.35;
    c.translate(from[0], from[1]);
    c.rotate(Math.atan2(y, x));
    stroke(c, [0, 0], [length - 1.6, 0]);
    c.beginPath();
    c.moveTo(length - 0.4, 0);
    c.lineTo(length - 2, 0.8);
    c.lineTo(length - 2, -0.8);
    c.fill();
    c.restore();
  }

  private ball(x: number, y: number, z: number): void {
    const c = this.context;
    const high = Math.max(0, z - 0.11);
    c.fillStyle = "#08160c88";
    disc(c, x + 0.15 + high * 0.3, y + 0.2 + high * 0.4, 0.5);
    const size = 0.5 * (1 + Math.min(high, 20) * 0.05);
    c.fillStyle = "#101418";
    disc(c, x, y, size + 0.15);
    c.fillStyle = "#ffffff";
    disc(c, x, y, size);
  }

  private colours(): Colours {
    const style = getComputedStyle(document.documentElement);
    const read = (name: string) => style.getPropertyValue(name).trim();
    return { grass: read("--grass"), stripe: read("--stripe"), line: read("--line") };
  }
}

/** Draws grass and lines; metres. */
export function field(c: CanvasRenderingContext2D, { grass, stripe, line }: Colours): void {
  c.fillStyle = grass;
  c.fillRect(-HALF_X - MARGIN, -HALF_Y - MARGIN, 2 * (HALF_X + MARGIN), 2 * (HALF_Y + MARGIN));
  c.fillStyle = stripe;
  for (let k = 0; k < 10; k += 2) c.fillRect(-HALF_X + k * 11, -HALF_Y, 11, 2 * HALF_Y);
  c.strokeStyle = line;
  c.lineWidth = 0.2;
  c.beginPath();
  c.rect(-HALF_X, -HALF_Y, 2 * HALF_X, 2 * HALF_Y);
  c.moveTo(0, -HALF_Y);
  c.lineTo(0, HALF_Y);
  c.moveTo(9.15, 0);
  c.arc(0, 0, 9.15, 0, 2 * Math.PI);
  for (const side of [-1, 1]) {
    c.rect(side * HALF_X, -20.15, -side * 16.5, 40.3);
    c.rect(side * HALF_X, -9.16, -side * 5.5, 18.32);
    c.rect(side * HALF_X, -3.7, side * 2.55, 7.4);
    const spot = side * (HALF_X - 11);
    const angle = Math.acos(5.5 / 9.15);
    const middle = side > 0 ? Math.PI : 0;
    c.moveTo(spot + 9.15 * Math.cos(middle - angle), 9.15 * Math.sin(middle - angle));
    c.arc(spot, 0, 9.15, middle - angle, middle + angle);
  }
  c.stroke();
}

function disc(c: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  c.beginPath();
  c.arc(x, y, radius, 0, 7);
  c.fill();
}

function stroke(c: CanvasRenderingContext2D, from: number[], to: number[]): void {
  c.beginPath();
  c.moveTo(from[0] ?? 0, from[1] ?? 0);
  c.lineTo(to[0] ?? 0, to[1] ?? 0);
  c.stroke();
}
