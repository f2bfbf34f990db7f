// What a picture of the match needs, from above or in space.

import type { Id, Player, Scene } from "./messages";

/** A pass or a shot, from where it was struck to where the ball is or came. */
export interface Arrow { from: [number, number]; to: [number, number]; fade: number; shot: boolean }

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
  regions: HTMLCanvasElement | null;
  /** Many starts: the ball and everyone. */
  cloud: [number, number][][];
}

export interface View {
  draw(frame: Frame): void;
  /** The place in metres of a point of the page. */
  place(x: number, y: number): [number, number];
}

export const HALF_X = 55;
export const HALF_Y = 36;
/** Grass around the pitch, metres. */
export const MARGIN = 4;

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
