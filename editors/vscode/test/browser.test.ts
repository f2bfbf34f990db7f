// The panel's page in a real browser, which is what VS Code shows it in.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { type Browser, type Page, chromium } from "playwright-core";
import { type Shown, page, shownOf } from "../src/picture";

const COMMAND = process.env["SETPIECE"] ?? "setpiece";
const BROWSER = process.env["CHROMIUM"] ?? "/usr/bin/chromium";
const skip = existsSync(BROWSER) ? false : `no browser at ${BROWSER}: set CHROMIUM`;

let browser: Browser;
let view: Page;

before(async () => {
  if (skip) return;
  browser = await chromium.launch({ executablePath: BROWSER, args: ["--no-sandbox"] });
  view = await browser.newPage();
  await view.setContent(page("n0nce"));
});

after(async () => {
  if (!skip) await browser.close();
});

/** Hands the page what the extension sends it. */
const show = (shown: Shown): Promise<void> =>
  view.evaluate(`window.postMessage(${JSON.stringify(shown)}, "*")`);

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
  await show(shownOf({ scenario: "academy_corner", svg: readFileSync(file, "utf8") }));
  await view.waitForFunction("picture.complete && picture.naturalWidth > 0");
  assert.ok(await view.isVisible("#picture"));
  const drawn = await state();
  assert.deepEqual({ ...drawn, width: 0 }, {
    width: 0, title: "academy_corner", words: "", stale: false,
  });
  await show(shownOf({ scenario: "academy_corner", message: "<b>1 error</b>" }));
  await view.waitForFunction("words.textContent !== ''");
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
  await show(shownOf({ scenario: "evil", svg }));
  await view.waitForFunction("title.textContent === 'evil' && picture.naturalWidth === 9");
  assert.equal(await view.evaluate("window.ran"), undefined);
});
