// What many episodes gave, what an episode's events were, and what its start must meet.

import type { Episode, Reply, Require } from "./messages";

/** Fills the table of many episodes. */
export function showSummary(parent: HTMLElement, reply: Extract<Reply, { type: "summary" }>): void {
  const table = document.createElement("table");
  const row = (name: string, value: string, share?: number) => {
    const line = table.insertRow();
    line.insertCell().textContent = name;
    line.insertCell().textContent = value;
    const bar = line.insertCell();
    if (share !== undefined) {
      const fill = document.createElement("i");
      fill.style.width = `${100 * share}%`;
      bar.append(fill);
    }
  };
  for (const [name, count] of reply.outcomes) {
    row(name, `${((100 * count) / reply.episodes).toFixed(0)} %`, count / reply.episodes);
  }
  row("mean score", reply.score.map((goals) => goals.toFixed(2)).join(" : "));
  row("mean return", reply.mean_return.toFixed(3));
  for (const [name, value] of reply.terms) row(`  ${name}`, value.toFixed(3));
  for (const [name, value, unit] of reply.records) row(`  ${name}`, `${value.toFixed(3)} ${unit}`.trim());
  parent.replaceChildren(table);
}

/** Puts a mark for every event of an episode on the time line. */
export function showEvents(parent: HTMLElement, played: Episode, go: (at: number) => void): void {
  const last = Math.max(1, played.scenes.length - 1);
  const marks = played.events
    .filter((event) => !/^(touch|ball_won|ball_lost|end)/.test(event.name))
    .map((event) => {
      const mark = document.createElement("button");
      mark.className = `event ${event.team ?? ""}`;
      mark.style.left = `${(100 * event.at) / last}%`;
      const words = `${event.name.replaceAll("_", " ")}${event.by ? `, ${event.by}` : ""}`;
      mark.title = words;
      mark.setAttribute("aria-label", words);
      mark.onclick = () => go(event.at);
      return mark;
    });
  parent.replaceChildren(...marks);
}

/** Lists what a start must meet; what fails is marked. */
export function showRequires(parent: HTMLElement, requires: Require[], go: (line: number) => void): void {
  // What follows from the rest of the text matters only where it refuses something.
  const shown = requires.filter(({ implied, refused, fails }) => !implied || refused > 0 || fails);
  parent.replaceChildren(
    ...shown.map(({ label, line, refused, fails }) => {
      const row = document.createElement("button");
      row.className = fails ? "require fails" : "require";
      const share = refused > 0 ? `is the first to refuse ${(100 * refused).toFixed(0)} % of draws` : "refuses no other draw";
      row.textContent = `${fails ? "✗" : "✓"} ${label}`;
      const note = document.createElement("span");
      note.textContent = fails ? "this start can't be drawn" : share;
      row.append(note);
      row.disabled = line === null;
      if (line !== null) row.onclick = () => go(line);
      return row;
    }),
  );
}
