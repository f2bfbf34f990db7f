// What the server draws, and what the panel shows of it.

import type { Field, Thing } from "./field";

/** Something that a start must meet. */
export interface Asked {
  readonly label: string;
  /** The share of starts that it is the first to refuse; none if it has an error. */
  readonly share: number | null;
  /** Whether the start that is drawn doesn't meet it, or it has an error. */
  readonly fails: boolean;
}

/** The answer to `setpiece/preview`. */
export interface PreviewAnswer {
  /** The scenario at the place that was asked about. */
  readonly scenario?: string | null;
  /** The version of the text. */
  readonly version?: number | null;
  /** Its start. */
  readonly svg?: string | null;
  /** What of the world the picture shows, in metres. */
  readonly view?: Field["view"] | null;
  /** Who can be moved. */
  readonly things?: readonly Thing[] | null;
  /** What a start must meet. */
  readonly requires?: readonly Asked[] | null;
  /** Why nothing is drawn, or why no episode has this start. */
  readonly message?: string | null;
}

/** What the panel's page is sent. */
export interface Shown {
  readonly title: string;
  /** The address of the picture; the last one stays if absent. */
  readonly picture?: string;
  /** Who can be moved in it. */
  readonly field?: Field;
  /** What a start must meet, in words; absent if nothing is drawn. */
  readonly asked?: readonly string[];
  /** Words beneath it; may be empty. */
  readonly words: string;
}

/** What the page is sent: something to show, or why nothing was moved. */
export type PageMessage = Shown | { readonly refused: string };

/**
 * What is shown of an answer. As an image, a drawing can run nothing and load nothing.
 *
 * `drawing`: the number of the picture.
 */
export function shownOf(answer: PreviewAnswer | null | undefined, drawing: number): Shown {
  const title = answer?.scenario ?? "";
  const words = answer?.message ?? "";
  if (!answer?.svg) return { title, words: words || "No scenario stands here." };
  const encoded = Buffer.from(answer.svg, "utf8").toString("base64");
  const asked = (answer.requires ?? []).map(spokenOf);
  const shown = { title, picture: `data:image/svg+xml;base64,${encoded}`, asked, words };
  const { view, things } = answer;
  return view && things ? { ...shown, field: { drawing, view, things } } : shown;
}

/** What is said of something that a start must meet. */
function spokenOf({ label, share, fails }: Asked): string {
  const refuses = share ? `: is the first to refuse ${(100 * share).toFixed(0)} % of starts` : "";
  return `${fails ? "✗" : "✓"} ${label}${refuses}`;
}
