// Every snippet, taken as it is offered, is something that the compiler accepts.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import snippets from "../snippets/pitch.json";

const COMMAND = process.env["SETPIECE"] ?? "setpiece";

/** The text of a snippet whose places keep what they propose. */
function taken(body: string | readonly string[]): string {
  const text = typeof body === "string" ? body : body.join("\n");
  return text
    .replaceAll(/\$\{\d+\|([^,|]*)[^|]*\|\}/g, "$1")
    .replaceAll(/\$\{\d+:([^}]*)\}/g, "$1")
    .replaceAll(/\$\d+/g, "");
}

const scenario = taken(snippets.Scenario.body);
/** The scenario with more statements at its end. */
const within = (statement: string): string => scenario.replace(/\}\s*$/, `${statement}\n}\n`);

const TEXTS: Readonly<Record<string, (body: string) => string>> = {
  Scenario: (body) => body,
  Team: (body) => `scenario alone extends academy {\nball at (1m, 0m)\n${body}\n}\n`,
  Parameter: (body) => within(body).replace("(30m, 0m)", "(20m + gap, 0m)"),
  Reward: (body) => `${body}\n${within("reward shaping")}`,
  Give: (body) => within(`reward paid { ${body} }`),
  Ending: (body) => within(body),
  Behaviour: (body) => `${body}\n${within("team left { DM at (0m, 5m) { ai: close_down } }")}`,
  Check: (body) => `${scenario}\n${body}\n`,
};

for (const [name, { body }] of Object.entries(snippets)) {
  test(`the snippet ${name} is sound`, () => {
    const text = TEXTS[name]?.(taken(body));
    assert.ok(text, "no text shows this snippet");
    const path = join(mkdtempSync(join(tmpdir(), "setpiece-snippet-")), "drill.pitch");
    writeFileSync(path, text);
    const { stdout } = spawnSync(COMMAND, ["check", "--message-format", "short", path], {
      encoding: "utf8",
    });
    assert.equal(stdout, "", `${text}\n${stdout}`);
  });
}
