import assert from "node:assert/strict";
import { test } from "node:test";
import { type Field, nearest, placeOf, reachOf, shareOf, within } from "../src/field";
import { CHANGED, editsOf, isDrop, questionOf } from "../src/move";
import { shownOf } from "../src/picture";

const FIELD: Field = {
  drawing: 1,
  view: [-60, -40, 120, 80],
  things: [
    { player: { team: "left", slot: 0 }, name: "anna", at: [10, 0] },
    { player: { team: "right", slot: 1 }, name: "CB", at: [12, 0] },
    { player: null, name: "ball", at: [12, 0] },
  ],
};

test("pixels and metres are the same plane", () => {
  const box = { left: 20, top: 10, width: 600, height: 400 };
  assert.deepEqual(placeOf(FIELD, box, [20, 10]), [-60, -40]);
  assert.deepEqual(placeOf(FIELD, box, [320, 210]), [0, 0]);
  assert.deepEqual(placeOf(FIELD, box, [620, 110]), [60, -20]);
  assert.deepEqual(shareOf(FIELD, [30, -20]), [0.75, 0.25]);
  assert.deepEqual(within(FIELD, [99, -99]), [60, -40]);
});

test("the nearest is taken, within a reach that a small picture widens", () => {
  assert.equal(nearest(FIELD, [10.9, 0], 1.8)?.name, "anna");
  assert.equal(nearest(FIELD, [11.1, 0], 1.8)?.name, "ball", "the ball lies on top");
  assert.equal(nearest(FIELD, [10, 2], 1.8), undefined);
  assert.equal(reachOf(FIELD, 1200), 1.8);
  assert.equal(reachOf(FIELD, 300), 4);
});

test("only what is a drop is taken for one", () => {
  const drop = { drawing: 1, player: null, to: [1, 2] };
  assert.ok(isDrop(drop));
  assert.ok(isDrop({ ...drop, player: { team: "right", slot: 10 } }));
  for (const wrong of [
    undefined, null, "drop", {}, { ...drop, drawing: "1" }, { ...drop, to: [1] },
    { ...drop, to: [1, Number.NaN] }, { ...drop, to: ["1", "2"] }, { ...drop, player: undefined },
    { ...drop, player: { team: "middle", slot: 0 } }, { ...drop, player: { team: "left" } },
  ]) {
    assert.equal(isDrop(wrong), false, JSON.stringify(wrong));
  }
});

test("the server is asked about the text that was drawn, and only of the latest picture", () => {
  const drawn = { drawing: 4, uri: "file:///a.pitch", version: 7, scenario: "drill" };
  const player = { team: "left", slot: 2 } as const;
  assert.deepEqual(questionOf(drawn, { drawing: 4, player, to: [1, -2] }), {
    textDocument: { uri: "file:///a.pitch", version: 7 }, scenario: "drill", player, to: [1, -2],
  });
  assert.equal(questionOf(drawn, { drawing: 3, player, to: [1, -2] }), undefined);
  assert.equal(questionOf(undefined, { drawing: 3, player, to: [1, -2] }), undefined);
});

test("only the edits of the text as it is are made", () => {
  const place = { line: 1, character: 2 };
  const edits = [{ range: { start: place, end: place }, newText: "3m" }];
  assert.deepEqual(editsOf({ version: 7, edits }, 7), { edits });
  assert.deepEqual(editsOf({ version: 7, edits }, 8), { refused: CHANGED });
  assert.deepEqual(editsOf({ message: "this place is computed" }, 7), {
    refused: "this place is computed",
  });
  assert.ok("refused" in editsOf(null, 7));
});

test("a picture says who can be moved in it", () => {
  const { view, things } = FIELD;
  assert.deepEqual(shownOf({ scenario: "drill", svg: "<svg/>", view, things }, 1).field, FIELD);
  assert.equal(shownOf({ scenario: "drill", svg: "<svg/>" }, 1).field, undefined);
});
