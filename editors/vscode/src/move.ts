// A drop in the picture: what the page says of it, what the server is asked, what is done then.

import type { Place, Player } from "./field";

/** What the page sends when something is dropped. */
export interface Drop {
  /** The picture in which it was. */
  readonly drawing: number;
  readonly player: Player | null;
  /** Metres. */
  readonly to: Place;
}

/** What is drawn: a scenario of a text. */
export interface Drawn {
  readonly drawing: number;
  readonly uri: string;
  readonly version: number;
  readonly scenario: string;
}

/** An edit as the protocol has it. */
export interface NewText {
  readonly range: {
    readonly start: { readonly line: number; readonly character: number };
    readonly end: { readonly line: number; readonly character: number };
  };
  readonly newText: string;
}

/** The answer to `setpiece/move`. */
export interface MoveAnswer {
  /** The text that the edits are of. */
  readonly version?: number | null;
  readonly edits?: readonly NewText[] | null;
  /** Why nothing is moved. */
  readonly message?: string | null;
}

/** Said where the text is another one than the picture's. */
export const CHANGED = "the text has changed since this picture of it: drag again";

/** Whether a message of the page is a drop. */
export function isDrop(message: unknown): message is Drop {
  if (typeof message !== "object" || message === null) return false;
  const { drawing, player, to } = message as Partial<Record<keyof Drop, unknown>>;
  const isPlace = Array.isArray(to) && to.length === 2 && to.every((it) => Number.isFinite(it));
  return Number.isInteger(drawing) && isPlace && (player === null || isPlayer(player));
}

function isPlayer(value: unknown): value is Player {
  if (typeof value !== "object" || value === null) return false;
  const { team, slot } = value as Partial<Record<keyof Player, unknown>>;
  return (team === "left" || team === "right") && Number.isInteger(slot);
}

/** What the server is asked of a drop; nothing if the picture isn't the latest. */
export function questionOf(drawn: Drawn | undefined, drop: Drop): object | undefined {
  if (drawn?.drawing !== drop.drawing) return undefined;
  const { uri, version, scenario } = drawn;
  return { textDocument: { uri, version }, scenario, player: drop.player, to: drop.to };
}

/** What the text's edits are, or why there are none; `version`: that of the text now. */
export function editsOf(
  answer: MoveAnswer | null | undefined,
  version: number,
): { readonly edits: readonly NewText[] } | { readonly refused: string } {
  if (answer?.message) return { refused: answer.message };
  if (!answer?.edits) return { refused: "the server has no answer: restart it" };
  return answer.version === version ? { edits: answer.edits } : { refused: CHANGED };
}
