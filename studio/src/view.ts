// What a picture of the match needs, from above or in space.

import type { Id, Measures, Player, Scene } from "./messages";

/** A pass or a shot, from where it was struck to where the ball is or came. */
export interface Arrow { from: [number, number]; to: [number, number]; fade: number; shot: boolean }

/** Regions as a picture, and half of what it covers, metres. */
export interface Painted { picture: HTMLCanvasElement; half: [number, number] }

/** A moment, and what is drawn beside the match. */
export interface Frame {
  scenes: Scene[];
  at: number;
  /** The share of the way to the next scene, 0..1. */
  share: number;
  trails: boolean;
  arrows: Arrow[];
  /** Where the attackers are offside, metres. */
  offside: number | null;
  /** The painted regions of the start. */
  regions: Painted | null;
  /** Many starts: the ball and everyone. */
  cloud: [number, number][][];
}

export interface View {
  draw(frame: Frame): void;
  /** The place in metres of a point of the page. */
  place(x: number, y: number): [number, number];
}

/** Grass around the pitch, metres. */
const MARGIN = 4;
/** Half of the picture of the usual pitch, metres. Every picture has this shape. */
export const USUAL = { x: 59, y: 40 };

/** Half of the pitch and the grass around it, metres. */
export function grounds({ length_m, width_m }: Measures): [number, number] {
  return [length_m / 2 + MARGIN, width_m / 2 + MARGIN];
}

/** Half of the picture from above, metres: the pitch and the grass around it fit into it. */
export function extent(pitch: Measures): [number, number] {
  const [x, y] = grounds(pitch);
  const scale = Math.max(x / USUAL.x, y / USUAL.y);
  return [USUAL.x * scale, USUAL.y * scale];
}

/** Shirts and numbers, by team and whether it is the keeper's: the same as in pictures. */
export const SHIRTS = {
  left: [["#ffaa14", "#281808"], ["#ce3428", "#ffffff"]],
  right: [["#2660e4", "#ffffff"], ["#60dee8", "#002832"]],
} as const;

export function shirt(player: Player): readonly [string, string] {
  return SHIRTS[player.id.team][player.role === "GK" ? 1 : 0];
}

export function same(a: Id | null, b: Id | null): boolean {
  return a !== null && b !== null && a.team === b.team && a.slot === b.slot;
}

export function mixed(
  a: readonly [number, number], b: readonly [number, number], share: number,
): [number, number] {
  return [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
}

/** The scene that a moment moves towards: none connects what was placed since. */
export function towards(frame: Frame): Scene | undefined {
  const next = frame.scenes[frame.at + 1];
  return next && !next.placed ? next : frame.scenes[frame.at];
}
