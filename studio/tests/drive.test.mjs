// The page in a real browser, against the real command: `cargo xtask studio --drive`.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";

const COMMAND = process.env.SETPIECE ?? "setpiece";
const BROWSER = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PATIENCE = { timeout: 20_000 };
const DRILL = `/// A striker and a winger against one defender.
scenario drill extends academy {
    param gap: length = 10m in 5m..20m
    ball at (20m, 0m)
    team left {
        GK at (-1, 0)
        striker: CF at (19m, 0m)
        RM at (0.4, 0.2)
    }
    team right {
        GK at own (-1, 0)
        CB at (20m + gap, 0m)
    }
}
`;

let browser;
const children = [];

before(async () => {
  const args = ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync"];
  browser = await chromium.launch({ executablePath: BROWSER, args });
});
after(async () => {
  await browser?.close();
  for (const child of children) child.kill("SIGINT");
});

/** Opens a studio and a page of it; every error of the page fails the test. */
async function open(scenario, folder, options = {}) {
  const child = spawn(COMMAND, ["studio", scenario], { cwd: folder });
  children.push(child);
  const address = await new Promise((resolve) => {
    child.stdout.on("data", (text) => {
      const found = /open (http\S+)/.exec(String(text));
      if (found) resolve(found[1]);
    });
  });
  const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, colorScheme: "dark", ...options });
  page.on("pageerror", (error) => assert.fail(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") assert.fail(message.text());
  });
  await page.addInitScript(() => {
    window.pad = null;
    Navigator.prototype.getGamepads = () => [window.pad];
  });
  await page.goto(address);
  await page.waitForSelector(".cm-line", PATIENCE);
  return page;
}

function drill() {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  writeFileSync(join(folder, "drill.pitch"), DRILL);
  return { folder, file: join(folder, "drill.pitch") };
}

const text = (page, selector) => page.textContent(selector);
const waits = (page, selector, words) =>
  page.waitForFunction(([s, w]) => new RegExp(w).test(document.querySelector(s).textContent),
    [selector, words], PATIENCE);

async function rewind(page) {
  if ((await text(page, "#toggle")) === "Pause") await page.click("#toggle");
  await page.click("#pitch", { position: { x: 4, y: 4 } });
  await page.keyboard.press("Home");
  await waits(page, "#moment", "^0.0 s");
}

test("it opens, plays and scrubs", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, "#name", "drill");
  await waits(page, "#moment", "^(0\\.[5-9]|[1-9])");
  await rewind(page);
  await page.keyboard.press("ArrowRight");
  await waits(page, "#moment", "^0.1 s");
  await page.keyboard.press("End");
  await waits(page, "#score", "·");
  await page.screenshot({ path: process.env.SHOTS ? join(process.env.SHOTS, "studio.png") : undefined });
});

test("a mistake is shown at its line and goes", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, "#problems", "no problems");
  await page.click(".cm-content");
  await page.keyboard.press("Control+End");
  await page.keyboard.type("\nscenario x extends acadmy { }");
  await waits(page, "#problems", "1 error");
  await page.waitForSelector(".cm-lint-marker-error", PATIENCE);
  await page.keyboard.press("Control+z");
  await waits(page, "#problems", "no problems");
  assert.equal(await page.locator(".cm-lint-marker-error").count(), 0);
});

test("a save on disk is shown, and one here is written", async () => {
  const { folder, file } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, "#problems", "no problems");
  writeFileSync(file, DRILL.replace("(19m, 0m)", "(18m, 3m)"));
  await waits(page, ".cm-content", "18m, 3m");
  await page.click(".cm-content");
  await page.keyboard.press("Control+Home");
  await page.keyboard.type("// mine\n");
  await page.keyboard.press("Control+s");
  await waits(page, "#state", "saved");
  assert.match(readFileSync(file, "utf8"), /^\/\/ mine\n/);
});

test("a drag rewrites the numbers of one place and nothing else", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await rewind(page);
  const box = await page.locator("#pitch").boundingBox();
  const scale = box.width / 118;
  const at = ([x, y]) => [box.x + box.width / 2 + x * scale, box.y + box.height / 2 + y * scale];
  await page.mouse.move(...at([0.4 * 54.4, 0.2 * 83.6]));
  await page.mouse.down();
  await page.mouse.move(...at([28, 0]));
  await page.mouse.move(...at([30, -20]));
  await page.mouse.up();
  await waits(page, ".cm-content", "RM at \\(0.55");
  const now = (await page.locator(".cm-content").innerText()).replace(/RM at \(.*\)/, "RM at (0.4, 0.2)");
  assert.equal(now.trim(), DRILL.trim());
  await page.click(".cm-content");
  await page.keyboard.press("Control+z");
  await waits(page, ".cm-content", "RM at \\(0.4, 0.2\\)");
});

test("a slider binds, and the plots and results fill", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, '[data-shown="gap"]', "10m");
  await page.locator(".param", { hasText: "gap" }).locator("input").focus();
  for (let n = 0; n < 10; n++) await page.keyboard.press("ArrowRight");
  await waits(page, '[data-shown="gap"]', "10\\.[5-9]|11");
  await page.click("#summarise");
  await page.waitForSelector("#results td", PATIENCE);
  assert.ok((await page.locator("#plot canvas").count()) > 0);
});

test("a goal is played by keyboard and by gamepad", async () => {
  const page = await open("academy_empty_goal_close", tmpdir());
  for (const device of ["keyboard", "gamepad"]) {
    await page.click("#hand");
    await waits(page, "#score", "by hand");
    if (device === "keyboard") {
      await page.keyboard.down("ArrowRight");
      await page.keyboard.down("e");
    } else {
      await page.evaluate(() => {
        window.pad = { axes: [1, 0], buttons: Array.from({ length: 8 }, (_, n) => ({ pressed: n === 7 })) };
      });
    }
    await waits(page, "#score", "^1 : 0 · scored");
    for (const key of ["ArrowRight", "e"]) await page.keyboard.up(key);
  }
});

test("the page needs no more memory the longer it is open", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  const session = await page.context().newCDPSession(page);
  const heap = async () => {
    await session.send("HeapProfiler.collectGarbage");
    return (await session.send("Runtime.getHeapUsage")).usedSize;
  };
  await page.waitForTimeout(500);
  await page.click("#pitch", { position: { x: 4, y: 4 } });
  const first = await heap();
  for (let n = 0; n < 30; n++) {
    await page.keyboard.press("n");
    await page.waitForTimeout(80);
  }
  assert.ok((await heap()) < 1.3 * first + 1e6);
});

test("it fits small and light screens", async () => {
  const { folder } = drill();
  for (const [width, height] of [[1024, 700], [400, 800]]) {
    const page = await open("drill.pitch", folder, { viewport: { width, height }, colorScheme: "light" });
    await waits(page, "#problems", "no problems");
    const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(over <= 0, `${over} pixels too wide at ${width}`);
  }
});
