// The panel's page in a real browser, which is what VS Code shows it in.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { type Browser, type Page, chromium } from "playwright-core";
import type { Field } from "../src/field";
import { type Drop, isDrop } from "../src/move";
import { page } from "../src/page";
import { type PageMessage, shownOf } from "../src/picture";

const COMMAND = process.env["SETPIECE"] ?? "setpiece";
const BROWSER = process.env["CHROMIUM"] ?? "/usr/bin/chromium";
const skip = existsSync(BROWSER) ? false : `no browser at ${BROWSER}: set CHROMIUM`;

let browser: Browser;
let view: Page;

before(async () => {
  if (skip) return;
  browser = await chromium.launch({ executablePath: BROWSER, args: ["--no-sandbox"] });
  view = await browser.newPage();
  // What VS Code gives a page to speak with the extension.
  await view.evaluate(`{
    window.sent = [];
    window.acquireVsCodeApi = () => ({ postMessage: (message) => window.sent.push(message) });
  }`);
  await view.setContent(page("n0nce"));
});

after(async () => {
  if (!skip) await browser.close();
});

/** Hands the page what the extension sends it, and waits until it is shown. */
const show = (shown: PageMessage): Promise<void> =>
  view.evaluate(`new Promise((resolve, reject) => {
    const drawn = () => picture.src ? picture.decode() : undefined;
    window.addEventListener("message", () => {
      Promise.resolve(drawn()).then(resolve, reject);
    }, { once: true });
    window.postMessage(${JSON.stringify(shown)}, "*");
  })`);

const state = (): Promise<{ width: number; title: string; words: string; stale: boolean }> =>
  view.evaluate(`({
    width: picture.naturalWidth,
    title: title.textContent,
    words: words.textContent,
    stale: picture.classList.contains("stale"),
  })`);

test("a start is shown, and stays while the text is broken", { skip }, async () => {
  const file = join(mkdtempSync(join(tmpdir(), "setpiece-page-")), "start.svg");
  execFileSync(COMMAND, ["render", "academy_corner", "--step", "0", "--output", file]);
  await show(shownOf({ scenario: "academy_corner", svg: readFileSync(file, "utf8") }, 1));
  assert.ok(await view.isVisible("#picture"));
  const drawn = await state();
  assert.ok(drawn.width > 0);
  assert.deepEqual({ ...drawn, width: 0 }, {
    width: 0, title: "academy_corner", words: "", stale: false,
  });
  await show(shownOf({ scenario: "academy_corner", message: "<b>1 error</b>" }, 2));
  const failed = await state();
  assert.deepEqual(failed, { ...drawn, words: "<b>1 error</b>", stale: true });
});

test("nothing else may run in the page, or be loaded by it", { skip }, async () => {
  const refused = await view.evaluate(`new Promise((resolve) => {
    const directives = new Set();
    document.addEventListener("securitypolicyviolation", ({ effectiveDirective }) => {
      directives.add(effectiveDirective);
      if (directives.size === 3) resolve([...directives].sort());
    });
    const script = document.createElement("script");
    script.textContent = "window.ran = true";
    const image = document.createElement("img");
    image.src = "https://example.org/a.png";
    const style = document.createElement("style");
    style.textContent = "body { display: none }";
    document.body.append(script, image, style);
  })`);
  assert.deepEqual(refused, ["img-src", "script-src-elem", "style-src-elem"]);
  assert.equal(await view.evaluate("window.ran"), undefined);
  const size = 'xmlns="http://www.w3.org/2000/svg" width="9" height="9"';
  const script = "<script>parent.ran = true</script>";
  const svg = `<svg ${size} onload="parent.ran = true">${script}</svg>`;
  await show(shownOf({ scenario: "evil", svg }, 3));
  assert.equal((await state()).width, 9);
  assert.equal(await view.evaluate("window.ran"), undefined);
});

/** Half a pitch of 100 by 50 metres, with two who stand near each other, and the ball. */
const FIELD: Omit<Field, "drawing"> = {
  view: [-50, -25, 100, 50],
  things: [
    { player: { team: "left", slot: 0 }, name: "anna", at: [10, 5] },
    { player: { team: "right", slot: 3 }, name: "CB", at: [13, 5] },
    { player: null, name: "ball", at: [0, 0] },
  ],
};
const SVG = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="-50 -25 100 50" width="800" height="400"/>';

/** Shows the field as the picture of a number. */
async function field(drawing: number): Promise<void> {
  await view.evaluate("sent.length = 0");
  await show(shownOf({ scenario: `f${drawing}`, svg: SVG, ...FIELD }, drawing));
}

/** The pixel of the page at a point of the pitch. */
async function pixel(x: number, y: number): Promise<[number, number]> {
  const box = await view.locator("#picture").boundingBox();
  assert.ok(box);
  return [box.x + ((x + 50) / 100) * box.width, box.y + ((y + 25) / 50) * box.height];
}

async function drag(from: [number, number], to: [number, number]): Promise<void> {
  await view.mouse.move(...(await pixel(...from)));
  await view.mouse.down();
  await view.mouse.move(...(await pixel(...to)), { steps: 3 });
  await view.mouse.up();
}

const sent = (): Promise<Drop[]> => view.evaluate("sent");
const ghostIsShown = (): Promise<boolean> => view.isVisible("#ghost");

test("a drop says who was dragged where, and the ghost stays until the answer", { skip }, async () => {
  await field(5);
  // Taken beside the middle, the thing keeps its distance from the pointer.
  await drag([10.5, 5.5], [30.5, -9.5]);
  const [drop, ...more] = await sent();
  assert.deepEqual(more, []);
  assert.ok(drop && isDrop(drop));
  assert.deepEqual([drop.drawing, drop.player], [5, { team: "left", slot: 0 }]);
  const [x, y] = drop.to;
  assert.ok(Math.hypot(x - 30, y + 10) < 0.3, `${x}, ${y}`);
  assert.ok(await ghostIsShown());
  const ghost = await view.locator("#ghost").boundingBox();
  assert.ok(ghost);
  const [left, top] = await pixel(x, y);
  const off = Math.hypot(ghost.x + ghost.width / 2 - left, ghost.y + ghost.height / 2 - top);
  assert.ok(off < 1.5, String(off));
  await show({ refused: "this place is computed" });
  assert.equal(await ghostIsShown(), false);
  assert.equal((await state()).stale, false);
});

test("the nearest is taken; beside everyone, nobody", { skip }, async () => {
  await field(6);
  await drag([11.8, 5], [11.8, 15]);
  await drag([0.4, 0], [-20, 0]);
  await drag([-30, -10], [0, 0]);
  assert.deepEqual((await sent()).map(({ player }) => player), [{ team: "right", slot: 3 }, null]);
});

test("a click moves nothing, nor does what is let go by Escape or redrawn", { skip }, async () => {
  await field(7);
  await drag([10, 5], [10.1, 5]);
  assert.equal(await ghostIsShown(), false);
  await view.mouse.move(...(await pixel(10, 5)));
  await view.mouse.down();
  await view.mouse.move(...(await pixel(20, 5)));
  assert.ok(await ghostIsShown());
  await view.keyboard.press("Escape");
  assert.equal(await ghostIsShown(), false);
  await view.mouse.up();
  await view.mouse.move(...(await pixel(10, 5)));
  await view.mouse.down();
  await view.mouse.move(...(await pixel(20, 5)));
  await field(8);
  await view.mouse.up();
  assert.deepEqual(await sent(), []);
  // Without a picture that is up to date, nothing can be taken.
  await show(shownOf({ scenario: "f9", message: "1 error in the text" }, 9));
  await drag([10, 5], [20, 5]);
  assert.deepEqual(await sent(), []);
});

test("keys move, too", { skip }, async () => {
  await field(10);
  await view.focus("#things button:nth-child(3)");
  assert.equal(
    await view.getAttribute("#things button:nth-child(1)", "aria-label"),
    "anna, left team, at 10.0 m, 5.0 m",
  );
  await view.keyboard.press("ArrowRight");
  await view.keyboard.press("ArrowRight");
  await view.keyboard.press("ArrowUp");
  await view.keyboard.press("Shift+ArrowLeft");
  await view.keyboard.press("Enter");
  const [drop] = await sent();
  assert.ok(drop);
  assert.equal(drop.player, null);
  const [x, y] = drop.to;
  assert.ok(Math.hypot(x - 1.9, y + 1) < 1e-6, `${x}, ${y}`);
  // The one that was moved keeps the focus.
  await field(11);
  assert.ok(await view.evaluate("things.children[2] === document.activeElement"));
  await view.keyboard.press("ArrowDown");
  await view.keyboard.press("Escape");
  await view.keyboard.press("Enter");
  assert.deepEqual(await sent(), []);
});
