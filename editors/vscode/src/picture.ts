// What the server draws, and what the panel shows of it.

import type { Field, Thing } from "./field";

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
  /** Why nothing is drawn. */
  readonly message?: string | null;
}

/** What the panel's page is sent. */
export interface Shown {
  readonly title: string;
  /** The address of the picture; the last one stays if absent. */
  readonly picture?: string;
  /** Who can be moved in it. */
  readonly field?: Field;
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
  const shown = { title, picture: `data:image/svg+xml;base64,${encoded}`, words };
  const { view, things } = answer;
  return view && things ? { ...shown, field: { drawing, view, things } } : shown;
}
