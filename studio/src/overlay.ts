// What is drawn beside the match: passes and shots, and the offside line.

import type { Happened, Scene } from "./messages";
import type { Arrow } from "./view";

/** How long an arrow stays after the ball has come, and at most, scenes. */
const STAYS = 10;
const FLIES = 40;

/** The passes and shots of the last moments. */
export function arrows(scenes: Scene[], events: Happened[], at: number): Arrow[] {
  const found: Arrow[] = [];
  events.forEach((event, index) => {
    const shot = event.name.startsWith("shot");
    if (!(shot || event.name === "pass attempted") || event.at > at || at - event.at > FLIES) return;
    if (scenes.slice(event.at + 1, at + 1).some((scene) => scene.placed)) return;
    const rest = events.slice(index + 1);
    const end = rest.find((next) =>
      next.at > event.at && /^(pass (completed|intercepted)|goal|save|out_of_play|touch)/.test(next.name));
    const came = end && end.at <= at ? end.at : at;
    const ball = scenes[came]?.ball.pos;
    const fade = 1 - (at - came) / STAYS;
    if (!ball || fade <= 0) return;
    found.push({ from: event.place, to: [ball[0], ball[1]], fade, shot });
  });
  return found;
}

/** Where the team that has the ball is offside, metres; null if nobody has it. */
export function offside(scene: Scene): number | null {
  const team = scene.possession;
  if (!team) return null;
  const way = team === "left" ? 1 : -1;
  const others = scene.players
    .filter((player) => player.present && player.id.team !== team)
    .map((player) => way * player.pos[0])
    .sort((a, b) => b - a);
  const second = others[1] ?? Infinity;
  if (!Number.isFinite(second)) return null;
  return way * Math.max(second, way * scene.ball.pos[0], 0);
}
