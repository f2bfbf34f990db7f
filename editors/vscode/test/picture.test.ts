import assert from "node:assert/strict";
import { test } from "node:test";
import { debounced } from "../src/debounce";
import { INSTALL, missingText } from "../src/missing";
import { page } from "../src/page";
import { shownOf } from "../src/picture";

test("a drawing is shown as an image, which can run nothing", () => {
  const svg = '<svg xmlns="http://www.w3.org/2000/svg"><script>alert("ü")</script></svg>';
  const shown = shownOf({ scenario: "drill", svg }, 1);
  assert.equal(shown.title, "drill");
  assert.equal(shown.words, "");
  const [head, data] = shown.picture?.split(",") ?? [];
  assert.equal(head, "data:image/svg+xml;base64");
  assert.equal(Buffer.from(data ?? "", "base64").toString("utf8"), svg);
});

test("what a start must meet is listed, and a start that fails it is drawn", () => {
  const requires = [
    { label: "ball.x > 0.3", share: 0.125, fails: true },
    { label: "far", share: 0, fails: false },
    { label: "ball.z > 1", share: null, fails: true },
  ];
  const shown = shownOf({ scenario: "drill", svg: "<svg/>", requires, message: "no start" }, 1);
  assert.deepEqual(shown.asked, [
    "✗ ball.x > 0.3: is the first to refuse 13 % of starts", "✓ far", "✗ ball.z > 1",
  ]);
  assert.equal(shown.words, "no start");
  assert.ok(shown.picture);
});

test("without a drawing there are words, and the last picture stays", () => {
  const failed = shownOf({ scenario: "drill", message: "1 error" }, 2);
  assert.deepEqual(failed, { title: "drill", words: "1 error" });
  for (const nothing of [undefined, null, {}]) {
    assert.deepEqual(shownOf(nothing, 3), { title: "", words: "No scenario stands here." });
  }
});

test("the page allows its own style and script, pictures in it, and nothing else", () => {
  const text = page("n0nce");
  const policy = /Content-Security-Policy" content="([^"]*)"/.exec(text)?.[1];
  assert.equal(
    policy,
    "default-src 'none'; img-src data:; style-src 'nonce-n0nce'; script-src 'nonce-n0nce'",
  );
  const tags = text.match(/<(script|style)\b[^>]*>/g) ?? [];
  assert.equal(tags.length, 2);
  for (const tag of tags) assert.match(tag, /nonce="n0nce"/);
  assert.doesNotMatch(text, /\son\w+=|\sstyle=|https?:/);
});

test("quick calls become one, and a cancelled one none", async () => {
  let calls = 0;
  const call = debounced(() => (calls += 1), 20);
  for (let index = 0; index < 5; index += 1) call();
  assert.equal(calls, 0);
  await new Promise((resolve) => setTimeout(resolve, 60));
  assert.equal(calls, 1);
  call();
  call.cancel();
  await new Promise((resolve) => setTimeout(resolve, 60));
  assert.equal(calls, 1);
});

test("whoever lacks the command reads how to install it", () => {
  const text = missingText("/opt/setpiece", "ENOENT");
  for (const words of ["/opt/setpiece", "ENOENT", INSTALL, "setpiece.path"]) {
    assert.ok(text.includes(words), words);
  }
});
