// Bundles the extension into dist/; with `--tests`, its tests too.

import { copyFileSync, readdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { build } from "esbuild";

const tests = process.argv.includes("--tests");
const files = tests ? readdirSync("test").map((name) => `test/${name}`) : ["src/extension.ts"];
const outdir = tests ? "dist/test" : "dist";

rmSync(outdir, { recursive: true, force: true });
// The page of the panel holds its script.
const panel = await build({
  entryPoints: ["src/panel.ts"],
  bundle: true,
  write: false,
  platform: "browser",
  target: "es2023",
  format: "iife",
  minify: !tests,
  logLevel: "warning",
});
const { metafile } = await build({
  metafile: true,
  entryPoints: files,
  outdir,
  bundle: true,
  platform: "node",
  target: "node20",
  format: "cjs",
  define: { PANEL: JSON.stringify(panel.outputFiles[0].text) },
  external: ["vscode", "playwright-core"],
  minify: !tests,
  logLevel: "warning",
});
if (!tests) {
  writeFileSync("dist/NOTICES.txt", notices(Object.keys(metafile.inputs)));
  // The colours have their home beside the grammar, the licence in the root.
  copyFileSync("../../grammar/setpiece.tmLanguage.json", "dist/setpiece.tmLanguage.json");
  copyFileSync("../../LICENSE", "LICENSE");
}

/** The licences of the packages that the bundle's files come from. */
function notices(inputs) {
  const folders = inputs.map((path) => /^node_modules\/(@[^/]+\/)?[^/]+/.exec(path)?.[0]);
  const packages = [...new Set(folders)].filter(Boolean);
  return packages.map((folder) => {
    const { name, version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find((it) => /^licen[cs]e/i.test(it));
    if (!file) throw new Error(`${name} has no licence's text`);
    return `${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`;
  }).join(`\n${"-".repeat(80)}\n\n`);
}
