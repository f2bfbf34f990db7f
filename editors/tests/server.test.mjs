// `setpiece lsp` driven by an independent client over standard input and output:
// `cargo xtask editors --drive`.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, realpathSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterEach, beforeEach, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { COMMAND, Editor } from "./client.mjs";

const FIXTURE = fileURLToPath(new URL("fixture", import.meta.url));
const NONE = (found) => found.length === 0;

let editor, drill, shapes;

beforeEach(async () => {
  const folder = realpathSync(mkdtempSync(join(tmpdir(), "setpiece-editor-")));
  cpSync(FIXTURE, folder, { recursive: true });
  editor = await Editor.start(folder);
  const opened = (name) => pathToFileURL(join(folder, name)).href;
  [drill, shapes] = [opened("drill.pitch"), opened("shapes.pitch")];
  for (const uri of [drill, shapes]) {
    await editor.open(uri, readFileSync(fileURLToPath(uri), "utf8"));
  }
  await editor.diagnostics(drill, NONE);
  await editor.diagnostics(shapes, NONE);
});

afterEach(async () => {
  assert.equal(await editor.stop(), 0, "the server ends well");
});

test("a typo is reported, and its quick fix mends it", async () => {
  const sound = editor.text(drill);
  await editor.write(drill, sound.replace("striker: CF", "striker: CFF"));
  const [problem, ...others] = await editor.diagnostics(drill, (found) => found.length > 0);
  assert.deepEqual(others, []);
  assert.equal(problem.code, "SP0203");
  assert.equal(problem.source, "setpiece");
  assert.equal(problem.severity, 1);
  const start = editor.position(drill, "CFF");
  assert.deepEqual(problem.range, { start, end: { ...start, character: start.character + 3 } });
  const fixes = await editor.fixes(drill, problem);
  const fix = fixes.find((it) => it.title.includes("CF"));
  assert.equal(fix?.kind, "quickfix");
  await editor.apply(fix.edit);
  assert.equal(editor.text(drill), sound);
  await editor.diagnostics(drill, NONE);
});

test("columns are counted in UTF-16, as the protocol wants", async () => {
  await editor.write(drill, editor.text(drill).replace("striker: CF", "/* ⚽𝒃 */ striker: CFF"));
  const [{ range }] = await editor.diagnostics(drill, (found) => found.length > 0);
  assert.deepEqual(range.start, editor.position(drill, "CFF"));
});

test("a formation that two files use is renamed in both", async () => {
  const edit = await editor.rename(drill, "back_two", "narrow_two");
  await editor.apply(edit);
  for (const uri of [drill, shapes]) {
    assert.ok(editor.text(uri).includes("narrow_two"), editor.text(uri));
    assert.ok(!editor.text(uri).includes("back_two"), editor.text(uri));
  }
  await editor.diagnostics(drill, NONE);
});

test("a new name is refused if it isn't one, or if it is taken", async () => {
  for (const name of ["narrow two", "9", "hold_shape"]) {
    await assert.rejects(editor.rename(shapes, "back_two", name), undefined, name);
  }
  await assert.rejects(editor.rename(shapes, "hold_shape", "back_two"));
});

test("hover shows a place in metres", async () => {
  const { contents } = await editor.hover(drill, "(0.02, 0)");
  assert.match(contents.value, /1\.088\s?m/);
});

test("the regions of the opponents are offered behind `them.`", async () => {
  await editor.write(drill, editor.text(drill).replace("them.box", "them."));
  const labels = (await editor.complete(drill, "them.")).map((item) => item.label);
  for (const region of ["box", "half", "goal"]) {
    assert.ok(labels.includes(region), labels.join(" "));
  }
  assert.ok(!labels.includes("scenario"), labels.join(" "));
});

test("a text is formatted as `setpiece fmt` does", async () => {
  const rough = editor.text(drill).replace(/^ +/gm, "  ").replace("(0.02, 0)", "( 0.02,0 )");
  await editor.write(drill, rough);
  const expected = execFileSync(COMMAND, ["fmt", "-"], { input: rough, encoding: "utf8" });
  assert.notEqual(expected, rough);
  assert.equal(await editor.format(drill), expected);
});

test("lenses stand above what can be run, and name it", async () => {
  const text = `${editor.text(drill)}
check "the ball is lost" {
    play drill for 2 episodes
    expect success_rate < 50%
}
`;
  await editor.write(drill, text);
  const lenses = await editor.lenses(drill);
  const path = fileURLToPath(drill);
  for (const [command, name] of [
    ["setpiece.run", "drill"], ["setpiece.draw", "drill"], ["setpiece.check", "the ball is lost"],
  ]) {
    const lens = lenses.find((it) => it.command.command === command);
    assert.deepEqual(lens?.command.arguments, [path, name], JSON.stringify(lenses));
    assert.equal(lens.range.start.line, editor.position(drill, name).line);
  }
});

test("a start is drawn, and what is wrong is said in its place", async () => {
  const drawn = await editor.preview(drill, "striker");
  assert.equal(drawn.scenario, "drill");
  assert.match(drawn.svg, /^<svg[\s\S]*<\/svg>\s*$/);
  await editor.write(drill, editor.text(drill).replace("striker: CF", "striker: CFF"));
  const failed = await editor.preview(drill, "striker");
  assert.equal(failed.svg, undefined);
  assert.ok(failed.message, JSON.stringify(failed));
});

test("who is dragged in the picture changes the two numbers of the text", async () => {
  const before = editor.text(drill);
  const drawn = await editor.preview(drill, "striker");
  assert.equal(await editor.drag(drill, drawn, "striker", [-10.88, 8.36]), undefined);
  const after = before.replace("striker: CF at (0, 0)", "striker: CF at (-0.2, 0.1)");
  assert.equal(editor.text(drill), after);
  // The picture is of the text before.
  assert.match(await editor.drag(drill, drawn, "striker", [0, 0]), /has changed/);
  const again = await editor.preview(drill, "striker");
  const striker = again.things.find(({ name }) => name === "striker");
  assert.ok(Math.hypot(striker.at[0] + 10.88, striker.at[1] - 8.36) < 0.01, String(striker.at));
  const [, inFormation] = again.things;
  assert.match(await editor.drag(drill, again, inFormation.name, [0, 0]), /shapes\.pitch/);
  assert.equal(editor.text(drill), after);
});

test("what drawn starts show comes later, and goes with the next change", async () => {
  const sound = editor.text(drill);
  const drawn = "let x = uniform(0, 1)\n    require x < 0.2\n    ball at (0.02, 0)";
  await editor.write(drill, sound.replace("ball at (0.02, 0)", drawn));
  const [note, ...others] = await editor.diagnostics(drill, (found) => found.length > 0);
  assert.deepEqual(others, []);
  assert.equal(note.severity, 3);
  assert.match(note.message, /^refuses \d\d% of the starts that are drawn\. /);
  assert.deepEqual(note.range.start, editor.position(drill, "x < 0.2"));
  await editor.write(drill, sound);
  await editor.diagnostics(drill, NONE);
});
