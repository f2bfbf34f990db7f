// What the server says and what it is asked for: see setpiece/src/studio/message.rs.

export type Side = "left" | "right";
export interface Id { team: Side; slot: number }

/** The measures of a pitch, metres: see `Pitch` in render/src/scene.rs. */
export interface Measures {
  length_m: number;
  width_m: number;
  goal_width_m: number;
  goal_height_m: number;
  goal_depth_m: number;
  box_depth_m: number;
  box_width_m: number;
  six_yard_depth_m: number;
  six_yard_width_m: number;
  spot_m: number;
  circle_m: number;
}

/** What stays the same of a player. */
export interface Rostered { id: Id; number: number; role: string }

export interface Player extends Rostered {
  pos: [number, number];
  vel: [number, number];
  facing: [number, number];
  posture: string;
  yellow_cards: number;
  present: boolean;
  agent: boolean;
}

/** x, y, velocity, facing, posture, yellow cards, whether present, whether an agent's. */
export type RawPlayer =
  [number, number, number, number, number, number, string, number, boolean, boolean];

interface Moment {
  step: number;
  score: [number, number];
  mode: string;
  possession: Side | null;
  rewards: { name: string; value: number }[];
  placed: boolean;
}

/** A moment as it is sent. */
export interface RawScene extends Moment {
  ball: [number, number, number]; owner: Id | null; players: RawPlayer[];
}

/** Moments as they are sent, with what is the same in all of them. */
export interface RawScenes { pitch: Measures; roster: Rostered[]; scenes: RawScene[] }

export interface Scene extends Moment {
  pitch: Measures;
  ball: { pos: [number, number, number]; owner: Id | null };
  players: Player[];
}

/** Moments as the page keeps them. */
export function scenes({ pitch, roster, scenes: raw }: RawScenes): Scene[] {
  return raw.map(({ ball, owner, players, ...moment }) => ({
    ...moment,
    pitch,
    ball: { pos: ball, owner },
    players: players.map(([x, y, vx, vy, fx, fy, posture, cards, present, agent], index) => ({
      ...(roster[index] ?? { id: { team: "left", slot: index }, number: index + 1, role: "" }),
      pos: [x, y], vel: [vx, vy], facing: [fx, fy], posture, yellow_cards: cards, present, agent,
    })),
  }));
}

export interface Label {
  line: number; column: number; end_line: number; end_column: number; text: string;
}
export interface Problem {
  code: string; severity: string; message: string; help: string | null; labels: Label[];
}
export interface Param {
  name: string; doc: string; value: number; shown: string; range: [number, number] | null;
  choices: string[]; values: number[]; kind: "bool" | "integer" | "number";
}
export interface Happened {
  at: number; name: string; by: string | null; team: Side | null; place: [number, number];
}

type Point = [number, number];
export type Shape =
  | { rect: [Point, Point] }
  | { circle: [Point, number] }
  | { sector: { centre: Point; radius: number; from: number; width: number } }
  | { polygon: Point[] }
  | { union: [Shape, Shape] }
  | { intersection: [Shape, Shape] }
  | { difference: [Shape, Shape] };
export interface Region { name: string; shape: Shape }
export interface Require {
  label: string; implied: boolean; line: number | null; refused: number; fails: boolean;
}
export interface Seat { id: string; team: Side }

export type HeldKey =
  | "long_pass" | "high_pass" | "short_pass" | "shot" | "sliding" | "sprint" | "dribble";
export interface Keys { way: [number, number]; held: HeldKey[] }

export type Reply =
  | { type: "opened"; source: string; uri: string; is_file: boolean; is_saved: boolean; text: string;
      from: string | null }
  | { type: "checked"; problems: Problem[]; fault: string | null; name: string; title: string;
      params: Param[]; agents: Seat[]; players: string[] }
  | { type: "episode"; seed: number; episode: number; agent: string; beside: boolean;
      watched: boolean; name: string; names: string[]; events: Happened[]; outcome: string | null;
      success: boolean | null } & RawScenes
  | { type: "step" } & RawScenes
  | { type: "cloud"; starts: [number, number][][] }
  | { type: "summary"; episodes: number; outcomes: [string, number][]; mean_return: number;
      score: [number, number]; terms: [string, number][]; records: [string, number, string][] }
  | { type: "sketch"; pitch: Measures; regions: Region[]; requires: Require[] }
  | { type: "recording"; name: string; hex: string }
  | { type: "saved" }
  | { type: "refused"; message: string };

export type Request =
  | { type: "text"; text: string; from: string }
  | { type: "save" }
  | { type: "play"; seed: number; episode: number; agent: string; beside: string | null }
  | { type: "bind"; params: Record<string, number> }
  | { type: "begin"; seats: string[] }
  | { type: "hold"; seat: number; keys: Keys }
  | { type: "stop" }
  | { type: "move"; player: Id | null; to: [number, number] }
  | { type: "cloud"; count: number }
  | { type: "summary"; episodes: number }
  | { type: "record" };

/** A played episode as the page keeps it. */
export type Episode = Omit<Extract<Reply, { type: "episode" }>, "scenes"> & { scenes: Scene[] };
