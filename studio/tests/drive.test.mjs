// The page in a real browser, against the real command: `cargo xtask studio --drive`.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { chromium } from "playwright-core";

const COMMAND = process.env.SETPIECE ?? "setpiece";
const BROWSER = process.env.CHROMIUM ?? "/usr/bin/chromium";
const PYTHON = process.env.SETPIECE_PYTHON;
const PATIENCE = { timeout: 60_000 };
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

/** No graphics card: what is drawn in space is drawn by software. */
const SPACE = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const FLAGS = ["--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync"];

before(async () => {
  browser = await chromium.launch({ executablePath: BROWSER, args: [...FLAGS, ...SPACE] });
});
after(async () => {
  await browser?.close();
  for (const child of children) child.kill("SIGINT");
});

/** Opens a studio and a page of it; `prepare` runs in the page first. Its errors fail the test. */
async function open(scenario, folder, options = {}, prepare = () => {}, where = browser) {
  const child = spawn(COMMAND, ["studio", ...[scenario].flat()], { cwd: folder });
  return visit(child, options, prepare, where);
}

/** What a process prints: the first group of a pattern. */
function said(child, pattern) {
  return new Promise((resolve) => {
    let heard = "";
    child.stdout.on("data", (text) => {
      heard += String(text);
      const found = pattern.exec(heard);
      if (found) resolve(found[1]);
    });
  });
}

/** A page of a studio that a process has started and whose address it prints. */
async function visit(child, options = {}, prepare = () => {}, where = browser) {
  children.push(child);
  const address = await said(child, /open (http\S+)\s/);
  const page = await where.newPage({ viewport: { width: 1440, height: 900 }, colorScheme: "dark", ...options });
  page.on("pageerror", (error) => assert.fail(error.message));
  page.on("console", (message) => {
    if (message.type() === "error") assert.fail(message.text());
  });
  await page.addInitScript(() => {
    window.pad = null;
    Navigator.prototype.getGamepads = () => [window.pad];
  });
  await page.addInitScript(prepare);
  await page.goto(address);
  await page.waitForSelector("#pitch", PATIENCE);
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

/** Keeps a picture of the page, where pictures are wanted. */
async function shoot(page, name) {
  if (process.env.SHOTS) await page.screenshot({ path: join(process.env.SHOTS, `${name}.png`) });
}

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
  await shoot(page, "studio");
});

/** Waits for something with these words. */
async function appears(page, selector, words) {
  await page.locator(selector, { hasText: words }).first().waitFor(PATIENCE);
}

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

test("the text is completed, explained, mended, renamed and laid out", async () => {
  const { folder, file } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, "#problems", "no problems");
  await page.click(".cm-content");
  await page.keyboard.press("Control+End");
  await page.keyboard.insertText("scenario next extends drill {\n  end success when ball in them.");
  await page.keyboard.type("box");
  await appears(page, ".cm-tooltip-autocomplete li[aria-selected]", "box");
  // What has just been shown can't be taken yet: a key may have been meant for the text.
  await page.waitForTimeout(200);
  await page.keyboard.press("Enter");
  await waits(page, ".cm-content", "them.box");
  await page.keyboard.insertText("\n    reward scorin\n}\n");
  await waits(page, "#problems", "error");
  await page.locator(".cm-lintRange-error").last().hover();
  const fix = page.locator(".cm-diagnosticAction", { hasText: "scoring" });
  await fix.click(PATIENCE);
  await waits(page, "#problems", "no problems");
  await waits(page, ".cm-content", "reward scoring");
  await page.locator(".cm-line span", { hasText: /^0\.4$/ }).first().hover();
  await appears(page, ".cm-tooltip-hover", "21.76m");
  await page.mouse.move(0, 0);
  await page.keyboard.press("Shift+Alt+f");
  await waits(page, ".cm-content", "    end success when");
  await page.keyboard.press("Control+s");
  await waits(page, "#state", "saved");
  const laidOut = spawnSync(COMMAND, ["fmt", "--check", file], { encoding: "utf8" });
  assert.equal(laidOut.status, 0, laidOut.stdout + laidOut.stderr);
  // The name of a parameter, from where it is used.
  await page.locator(".cm-line", { hasText: "20m + gap" }).click();
  await page.keyboard.press("Home");
  for (let step = 0; step < "CB at (20m + g".length; step++) await page.keyboard.press("ArrowRight");
  await page.keyboard.press("F2");
  await page.locator(".cm-lsp-rename-panel input").fill("distance_ahead");
  await page.keyboard.press("Enter");
  await waits(page, ".cm-content", "param distance_ahead: length");
  await waits(page, ".cm-content", "20m \\+ distance_ahead");
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

/** Drags what is at a place on the pitch to another one, metres; `seen`: the length that is seen. */
async function drag(page, from, to, seen = 118) {
  const box = await page.locator("#pitch").boundingBox();
  const scale = box.width / seen;
  const at = ([x, y]) => [box.x + box.width / 2 + x * scale, box.y + box.height / 2 + y * scale];
  await page.mouse.move(...at(from));
  await page.mouse.down();
  await page.mouse.move(...at([0, 0]));
  await page.mouse.move(...at(to));
  await page.mouse.up();
}

test("a drag rewrites the numbers of one place and nothing else", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await rewind(page);
  await drag(page, [0.4 * 54.4, 0.2 * 83.6], [30, -20]);
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

test("the match is seen in space, from the stand and from anywhere", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await rewind(page);
  await page.selectOption("#view", "stand");
  await page.waitForTimeout(500);
  assert.ok((await page.locator("#pitch").isHidden()) && (await page.locator("#pitch-deep").isVisible()));
  const shot = async () => (await page.locator("#pitch-deep").screenshot(PATIENCE)).toString("base64");
  const before = await shot();
  await shoot(page, "studio-stand");
  await page.selectOption("#view", "free");
  const box = await page.locator("#pitch-deep").boundingBox();
  await page.mouse.move(box.x + 30, box.y + 30);
  await page.mouse.down();
  await page.mouse.move(box.x + 200, box.y + 60, { steps: 4 });
  await page.mouse.up();
  await page.waitForTimeout(300);
  assert.notEqual(await shot(), before);
  await page.dblclick("#pitch-deep", { position: { x: 8, y: 8 } });
  await waits(page, "#state", "follows the ball");
  await page.selectOption("#view", "above");
  assert.ok(await page.locator("#pitch").isVisible());
});

const ZONES = `region finishing = rect((30m, -12m), (44m, 12m)) | circle((25m, 0m), 6m)
behavior waits { do hold }
scenario zones extends academy {
    param near: length = 25m in 1m..60m
    ball at (20m, 20m)
    team left {
        GK at (-1, 0)
        striker: CF in finishing
        RM at (19m, 20m)
    }
    team right {
        GK at own (-1, 0)
        CB in right.box - right.six_yard
    }
    agents { left: [striker], right: 1 }
    require distance(striker, ball) < near
}
`;

function zones() {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  writeFileSync(join(folder, "zones.pitch"), ZONES);
  return folder;
}

/** The colour of a place on the pitch, metres; `seen`: the length that is seen. */
const colour = (page, [x, y], seen = 118) =>
  page.evaluate(([mx, my, seen]) => new Promise((resolve) => requestAnimationFrame(() => {
    const canvas = document.getElementById("pitch");
    const scale = canvas.width / seen;
    const [px, py] = [canvas.width / 2 + mx * scale, canvas.height / 2 + my * scale];
    resolve([...canvas.getContext("2d").getImageData(px, py, 1, 1).data].join());
  })), [x, y, seen]);

test("regions and requirements are drawn, and what fails is red", async () => {
  const page = await open("zones.pitch", zones());
  await waits(page, "#requires", "✓ distance\\(striker, ball\\) < near");
  await rewind(page);
  await shoot(page, "studio-regions");
  const inside = await colour(page, [25, -4]);
  assert.notEqual(inside, await colour(page, [25, 40 - 8]));
  await page.click("#zones");
  assert.notEqual(await colour(page, [25, -4]), inside);
  await page.click(".require");
  assert.match(await page.evaluate(() => getSelection().toString()), /require distance/);
  await page.locator(".param", { hasText: "near" }).locator("input").focus();
  await page.keyboard.press("Home");
  await page.waitForSelector(".require.fails", PATIENCE);
  await waits(page, "#state", "distance\\(striker, ball\\) < near");
});

const SMALL = `region danger = right.box
scenario small {
    param long: length = 60m in 20m..120m
    pitch { length: long, width: 40m, goal: 4m, goal_height: 2m, box: 9m, box_width: 20m }
    ball at (8m, 0m)
    team left {
        GK at left.goal + (1m, 0m)
        striker: CF at (9m, -6m)
    }
    team right {
        GK at right.goal - (1m, 0m)
        CB at (25m, -5m)
    }
    end success inside when ball in danger
    end limit 2s
}
`;

test("a pitch of another size is drawn to its size, from above and in space", async () => {
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  writeFileSync(join(folder, "small.pitch"), SMALL);
  const page = await open("small.pitch", folder);
  await rewind(page);
  // The whole width is seen, with 4 m of grass beside it.
  const seen = (40 + 2 * 4) * (118 / 80);
  const isLine = async (place, long) => Number((await colour(page, place, long)).split(",")[0]) > 120;
  for (const place of [[-30, -14], [0, -14], [30, -14], [-4, -20], [-4, 20], [-21, 7]]) {
    assert.ok(await isLine(place, seen), `a line at ${place}`);
  }
  for (const place of [[-31, -14], [2, -14], [31, -14], [-4, -21], [-4, 21], [-19, 7]]) {
    assert.ok(!(await isLine(place, seen)), `grass at ${place}`);
  }
  const places = [[23, 9], [23, 11]];
  const painted = await Promise.all(places.map((place) => colour(page, place, seen)));
  await page.click("#zones");
  assert.notEqual(await colour(page, places[0], seen), painted[0]);
  assert.equal(await colour(page, places[1], seen), painted[1]);
  await drag(page, [9, -6], [-12, 15], seen);
  await waits(page, ".cm-content", "striker: CF at \\(-1[12][.\\d]*m, 1[45][.\\d]*m\\)");
  // The same page shows a longer one.
  await page.selectOption("#view", "stand");
  await page.waitForTimeout(500);
  const shot = async () => (await page.locator("#pitch-deep").screenshot(PATIENCE)).toString("base64");
  const before = await shot();
  await page.locator(".param", { hasText: "long" }).locator("input").focus();
  await page.keyboard.press("End");
  await waits(page, '[data-shown="long"]', "120m");
  await page.waitForTimeout(1000);
  assert.notEqual(await shot(), before);
  await page.selectOption("#view", "above");
  for (const x of [-60, 0, 60]) assert.ok(await isLine([x, -14], 120 + 2 * 4), `a line at ${x}`);
});

test("a behaviour plays, beside another player, and the episode is kept as a file", async () => {
  const page = await open("zones.pitch", zones());
  await waits(page, "#agent", "waits");
  await page.selectOption("#agent", "waits");
  await page.selectOption("#beside", "run_and_shoot");
  await page.waitForSelector("#pitch-beside", PATIENCE);
  const captions = await page.locator(".screen p").allTextContents();
  assert.match(captions[0], /^waits · seed 0/);
  assert.match(captions[1], /^run_and_shoot · seed 0/);
  await page.selectOption("#beside", "nobody");
  await page.waitForSelector("#pitch-beside", { state: "hidden", ...PATIENCE });
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#record")]);
  assert.equal(download.suggestedFilename(), "zones_0_0.pitchr");
  const folder = mkdtempSync(join(tmpdir(), "studio-"));
  await download.saveAs(join(folder, "a.pitchr"));
  const both = await open(["a.pitchr", "a.pitchr"], folder);
  await both.waitForSelector("#pitch-beside", PATIENCE);
  await waits(both, "#score", " \\| ");
});

test("a policy of a Python program plays, and its environment is watched", async (t) => {
  if (!PYTHON) return t.skip("SETPIECE_PYTHON names no Python that has the package");
  const program = `
import time, setpiece
env = setpiece.make("academy_empty_goal_close")
page = setpiece.studio(env, policies={"right": lambda observation: 5}, every_s=0)
print("open", page.address, flush=True)
seed = 100
while True:
    env.reset(seed=seed)
    while not env.step(setpiece.Action.RIGHT)[2]:
        time.sleep(0.02)
    seed += 1
`;
  const page = await visit(spawn(PYTHON, ["-c", program]));
  await waits(page, "#state", "another program has played");
  assert.ok(Number(await page.inputValue("#seed")) >= 100);
  await page.selectOption("#agent", "right");
  await waits(page, "#state", "^$");
  await page.fill("#seed", "3");
  await page.keyboard.press("Enter");
  await page.evaluate(() => document.querySelector("#seed").blur());
  await page.waitForTimeout(1000);
  await page.keyboard.press("End");
  await waits(page, "#score", "^1 : 0.* · scored");
  // What was chosen stays, though the program goes on.
  await page.waitForTimeout(1500);
  assert.equal(await page.inputValue("#seed"), "3");
  await page.click("#follow");
  await waits(page, "#state", "another program has played");
});

test("a goal is played by keyboard and by gamepad", async () => {
  const page = await open("academy_empty_goal_close", tmpdir());
  await page.waitForSelector("#seats option:nth-child(2)", { state: "attached", ...PATIENCE });
  assert.equal(await page.inputValue("#seats select"), "left_0");
  await page.selectOption("#seats select", "");
  await page.click("#next");
  await page.waitForTimeout(500);
  assert.equal(await page.inputValue("#seats select"), "", "nobody stays nobody");
  await page.selectOption("#seats select", "left_0");
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

test("ten thousand frames need no more memory than the first", async (t) => {
  const { folder } = drill();
  // Without drawing in space, software draws faster.
  const flat = await chromium.launch({ executablePath: BROWSER, args: [...FLAGS, "--disable-gpu"] });
  t.after(() => flat.close());
  // Frames follow each other at once, not at the pace of a display.
  const page = await open("drill.pitch", folder, {}, () => {
    const { port1, port2 } = new MessageChannel();
    const waiting = [];
    port1.onmessage = () => waiting.shift()?.(performance.now());
    window.requestAnimationFrame = (callback) => {
      waiting.push(callback);
      port2.postMessage(0);
      return 0;
    };
  }, flat);
  const session = await page.context().newCDPSession(page);
  const heap = async () => {
    await session.send("HeapProfiler.collectGarbage");
    return (await session.send("Runtime.getHeapUsage")).usedSize;
  };
  const frames = (n) => page.evaluate((n) => new Promise((resolve) => {
    let left = n;
    const [toggle, next] = ["toggle", "next"].map((id) => document.getElementById(id));
    const step = () => {
      // What has been played begins again; now and then comes another episode.
      if (toggle.textContent === "Play") toggle.click();
      if (left % 200 === 0) next.click();
      if (left-- > 0) requestAnimationFrame(step);
      else resolve();
    };
    step();
  }), n);
  await page.selectOption("#speed", "4");
  await frames(400);
  const first = await heap();
  await frames(10_000);
  const last = await heap();
  assert.ok(last < 1.3 * first + 1e6, `${first} bytes at first, ${last} at last`);
});

test("ten tabs show the same, and one that closes stops nothing", async () => {
  const { folder } = drill();
  const page = await open("drill.pitch", folder);
  await waits(page, "#problems", "no problems");
  const tabs = [];
  for (let n = 0; n < 10; n++) {
    const tab = await browser.newPage();
    await tab.goto(page.url());
    tabs.push(tab);
  }
  for (const tab of tabs) await waits(tab, "#name", "drill");
  await page.fill("#seed", "77");
  await page.keyboard.press("Enter");
  await page.evaluate(() => document.querySelector("#seed").blur());
  await tabs.pop().close();
  for (const tab of tabs) {
    await tab.waitForFunction(() => document.querySelector("#seed").value === "77", null, PATIENCE);
    await tab.close();
  }
});

test("it fits every screen, dark and light", async () => {
  const { folder } = drill();
  const screens = [[1440, 900, "light", "-light"], [1024, 700, "light", "-1024"],
    [1024, 700, "dark", "-1024-dark"], [400, 800, "light", "-400"], [400, 800, "dark", "-400-dark"]];
  for (const [width, height, colorScheme, name] of screens) {
    const page = await open("drill.pitch", folder, { viewport: { width, height }, colorScheme });
    await waits(page, "#problems", "no problems");
    await waits(page, "#moment", "^(0\\.[5-9]|[1-9])");
    const over = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    assert.ok(over <= 0, `${over} pixels too wide at ${width}`);
    await shoot(page, `studio${name}`);
    await page.close();
  }
});

test("a notebook shows the studio of a Python program in a frame", async (t) => {
  if (!PYTHON) return t.skip("SETPIECE_PYTHON names no Python that has the package");
  const program = `
import http.server, setpiece
page = setpiece.studio("academy_corner")
html = f"<html><body>{page._repr_html_()}</body></html>".encode()
class Notebook(http.server.BaseHTTPRequestHandler):
    def do_GET(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(html)
    def log_message(self, *_):
        pass
server = http.server.HTTPServer(("127.0.0.1", 0), Notebook)
print("at", f"http://localhost:{server.server_port}/", flush=True)
server.serve_forever()
`;
  const child = spawn(PYTHON, ["-c", program]);
  children.push(child);
  const address = await said(child, /at (http\S+)\s/);
  const page = await browser.newPage();
  await page.goto(address);
  const frame = page.frameLocator("iframe");
  await frame.locator("#name", { hasText: "academy_corner" }).waitFor(PATIENCE);
  await frame.locator("#score", { hasText: "0 : 0" }).waitFor(PATIENCE);
});
