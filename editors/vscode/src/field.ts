// The picture of a start as a plane: pixels and metres, and what lies under the pointer.

/** A point of the pitch, in metres. */
export type Place = readonly [number, number];

/** A player, as the server calls them. */
export interface Player {
  readonly team: "left" | "right";
  readonly slot: number;
}

/** Whoever can be dragged. */
export interface Thing {
  /** The player; nothing for the ball. */
  readonly player: Player | null;
  readonly name: string;
  readonly at: Place;
}

/** What a picture shows of the world. */
export interface Field {
  /** The number of the picture: what is dragged in an older one is not moved. */
  readonly drawing: number;
  /** The left and top edge, the width and the height, in metres. */
  readonly view: readonly [number, number, number, number];
  readonly things: readonly Thing[];
}

/** Where the picture is on the page, in pixels. */
export interface Box {
  readonly left: number;
  readonly top: number;
  readonly width: number;
  readonly height: number;
}

/** How near to a thing it is taken: metres, and in a small picture pixels. */
const REACH_M = 1.8;
const REACH_PX = 10;

/** The point of the pitch at a pixel of the page. */
export function placeOf({ view }: Field, box: Box, [x, y]: Place): Place {
  const [left, top, width, height] = view;
  return [left + ((x - box.left) / box.width) * width, top + ((y - box.top) / box.height) * height];
}

/** Where a point of the pitch is in the picture: shares of its width and height. */
export function shareOf({ view }: Field, [x, y]: Place): Place {
  const [left, top, width, height] = view;
  return [(x - left) / width, (y - top) / height];
}

/** How near to a thing it is taken in a picture of a width in pixels, in metres. */
export function reachOf({ view }: Field, width: number): number {
  return Math.max(REACH_M, (REACH_PX / width) * view[2]);
}

/** The nearest thing within a reach; of those that are equally near, the one that is drawn last. */
export function nearest({ things }: Field, at: Place, reach: number): Thing | undefined {
  let [found, least]: [Thing | undefined, number] = [undefined, reach];
  for (const thing of things) {
    const far = Math.hypot(thing.at[0] - at[0], thing.at[1] - at[1]);
    if (far <= least) [found, least] = [thing, far];
  }
  return found;
}

/** A point within the picture. */
export function within({ view }: Field, [x, y]: Place): Place {
  const [left, top, width, height] = view;
  return [clamp(x, left, width), clamp(y, top, height)];
}

function clamp(value: number, from: number, size: number): number {
  return Math.min(Math.max(value, from), from + size);
}

/** What a thing is called aloud. */
export function spoken({ player, name, at }: Thing): string {
  const [x, y] = at.map((metres) => `${metres.toFixed(1)} m`);
  return player ? `${name}, ${player.team} team, at ${x}, ${y}` : `${name}, at ${x}, ${y}`;
}
