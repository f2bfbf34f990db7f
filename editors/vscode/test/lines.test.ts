// The command accepts what the extension runs, and prints what the problem matcher reads.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import manifest from "../package.json";
import { checkLine, choreLine, drawLine, isChore, isPathAndName, runLine } from "../src/lines";

const COMMAND = process.env["SETPIECE"] ?? "setpiece";
const DRILL = `scenario other extends academy {
    ball at (0.7, 0)
    team left { CF at (0.68, 0) }
}

scenario drill extends academy {
    ball at (0.02, 0)
    team left { CF at (0, 0) }
    end limit 2s
}

check "the bot stays within its limit" {
    play drill for 2 episodes
    expect max(length) <= 2s
}

check "nobody scores" {
    play drill with idle for 2 episodes
    expect success_rate == 0%
}
`;

function written(text: string): string {
  const path = join(mkdtempSync(join(tmpdir(), "setpiece-vscode-")), "drill.pitch");
  writeFileSync(path, text);
  return path;
}

const printed = (line: string[]): string => execFileSync(COMMAND, line, { encoding: "utf8" });

test("a lens runs the scenario that it stands at", () => {
  const path = written(DRILL);
  const lines = ["other", "drill"].map((name) => printed(runLine(path, name)));
  for (const [text, name] of [[lines[0], "other"], [lines[1], "drill"]] as const) {
    assert.match(text ?? "", new RegExp(`^${name}\\b`, "m"));
    assert.match(text ?? "", /20 episodes/);
  }
});

test("a lens draws a start", () => {
  const path = written(DRILL);
  const picture = path.replace(".pitch", ".png");
  printed(drawLine(path, "drill", picture));
  assert.ok(statSync(picture).size > 1000);
});

test("a lens plays one check", () => {
  const text = printed(checkLine(written(DRILL), "nobody scores"));
  assert.match(text, /nobody scores/);
  assert.doesNotMatch(text, /stays within/);
});

test("tasks check, test and run a file", () => {
  const path = written(DRILL);
  for (const chore of ["check", "test", "run"] as const) {
    assert.equal(spawnSync(COMMAND, choreLine(chore, path, [])).status, 0, chore);
  }
  assert.deepEqual(choreLine("run", "a.pitch", ["--seed", "1"]), ["run", "a.pitch", "--seed", "1"]);
  assert.ok(isChore("check") && !isChore("build"));
});

test("the problem matcher reads the reports of a task", () => {
  const path = written(DRILL.replace("CF at (0, 0)", "CFF at (0, 0)"));
  const { stdout, status } = spawnSync(COMMAND, choreLine("check", path, []), { encoding: "utf8" });
  assert.equal(status, 1);
  const [pattern] = manifest.contributes.problemPatterns;
  assert.ok(pattern);
  const [line, ...others] = stdout.trim().split("\n");
  assert.deepEqual(others, []);
  const found = new RegExp(pattern.regexp).exec(line ?? "");
  assert.ok(found, line);
  assert.equal(found[pattern.file], path);
  assert.equal(found[pattern.line], "8");
  assert.equal(found[pattern.column], "17");
  assert.equal(found[pattern.severity], "error");
  assert.equal(found[pattern.code], "SP0203");
  assert.match(found[pattern.message] ?? "", /CFF/);
});

test("a lens hands over a path and a name", () => {
  assert.ok(isPathAndName(["/a.pitch", "drill"]));
  for (const values of [[], ["a"], ["a", 1], ["a", "b", "c"]]) assert.ok(!isPathAndName(values));
});

test("every command of the manifest has the extension's code", () => {
  const source = readFileSync("src/extension.ts", "utf8");
  for (const { command } of manifest.contributes.commands) {
    assert.ok(source.includes(`registerCommand("${command}"`), command);
  }
});
