// The pitch from above, in metres, with the left team attacking to the right.

import type { Measures, Player, Scene } from "./messages";
import type { Arrow, Frame, View } from "./view";
import { USUAL, extent, mixed, same, shirt, towards } from "./view";

const TRAIL = 12;

interface Colours { grass: string; stripe: string; line: string }

export class Pitch implements View {
  private readonly context: CanvasRenderingContext2D;
  /** Half of the length that is seen, metres. */
  private half = USUAL.x;

  constructor(private readonly canvas: HTMLCanvasElement) {
    const context = canvas.getContext("2d");
    if (!context) throw new Error("no canvas");
    this.context = context;
  }

  /** The place in metres of a point of the page. */
  place(x: number, y: number): [number, number] {
    const box = this.canvas.getBoundingClientRect();
    const scale = (2 * this.half) / box.width;
    return [(x - box.left - box.width / 2) * scale, (y - box.top - box.height / 2) * scale];
  }

  /** Draws a moment. */
  draw(frame: Frame): void {
    const { scenes, at, share } = frame;
    const scene = scenes[at];
    if (!scene) return;
    [this.half] = extent(scene.pitch);
    const width = this.canvas.clientWidth;
    const height = (width * USUAL.y) / USUAL.x;
    const ratio = window.devicePixelRatio || 1;
    if (this.canvas.width !== Math.round(width * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
      this.canvas.style.height = `${height}px`;
    }
    const c = this.context;
    const scale = (width * ratio) / (2 * this.half);
    c.setTransform(scale, 0, 0, scale, this.canvas.width / 2, this.canvas.height / 2);
    field(c, scene.pitch, this.colours());
    if (frame.regions) {
      const { picture, half: [x, y] } = frame.regions;
      c.drawImage(picture, -x, -y, 2 * x, 2 * y);
    }
    for (const start of frame.cloud) {
      start.forEach(([x, y], index) => {
        c.fillStyle = index === 0 ? "#ffffff40" : "#00000022";
        c.beginPath();
        c.arc(x, y, 0.5, 0, 7);
        c.fill();
      });
    }
    const to = towards(frame) ?? scene;
    if (frame.offside !== null) this.offside(frame.offside, scene.pitch);
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

  private offside(x: number, { width_m }: Measures): void {
    const c = this.context;
    c.strokeStyle = "#ff8278";
    c.lineWidth = 0.25;
    c.setLineDash([1.2, 1]);
    stroke(c, [x, -width_m / 2], [x, width_m / 2]);
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
export function field(c: CanvasRenderingContext2D, pitch: Measures, { grass, stripe, line }: Colours): void {
  const [x, y] = [pitch.length_m / 2, pitch.width_m / 2];
  const [far, wide] = extent(pitch);
  c.fillStyle = grass;
  c.fillRect(-far, -wide, 2 * far, 2 * wide);
  c.fillStyle = stripe;
  const mown = pitch.length_m / 10;
  for (let k = 0; k < 10; k += 2) c.fillRect(-x + k * mown, -y, mown, 2 * y);
  c.strokeStyle = line;
  c.lineWidth = 0.2;
  c.beginPath();
  c.rect(-x, -y, 2 * x, 2 * y);
  c.moveTo(0, -y);
  c.lineTo(0, y);
  const circle = pitch.circle_m;
  c.moveTo(circle, 0);
  c.arc(0, 0, circle, 0, 2 * Math.PI);
  for (const side of [-1, 1]) {
    const area = (deep: number, width: number) => c.rect(side * x, -width / 2, side * deep, width);
    area(-pitch.box_depth_m, pitch.box_width_m);
    area(-pitch.six_yard_depth_m, pitch.six_yard_width_m);
    area(pitch.goal_depth_m, pitch.goal_width_m);
    const spot = side * (x - pitch.spot_m);
    const beyond = pitch.box_depth_m - pitch.spot_m;
    // A deep box has all of the D within it.
    if (beyond >= circle) continue;
    const angle = Math.acos(beyond / circle);
    const middle = side > 0 ? Math.PI : 0;
    c.moveTo(spot + circle * Math.cos(middle - angle), circle * Math.sin(middle - angle));
    c.arc(spot, 0, circle, middle - angle, middle + angle);
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
