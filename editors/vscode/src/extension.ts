// The extension: starts the server, and registers what is done on this side.

import { execFile } from "node:child_process";
import * as vscode from "vscode";
import {
  type Location, type Position, LanguageClient, type LanguageClientOptions, type ServerOptions,
} from "vscode-languageclient/node";
import { INSTALL, missingText } from "./missing";
import { Preview } from "./preview";
import { Tasks, command, lensCommands } from "./tasks";

let client: LanguageClient | undefined;
/** Tells the server of scripts and tables, which it reads from disk. */
let files: vscode.FileSystemWatcher | undefined;

/** Called by VS Code when a scenario is opened. */
export async function activate(context: vscode.ExtensionContext): Promise<void> {
  const preview = new Preview(() => client);
  files = vscode.workspace.createFileSystemWatcher("**/*.{pitch,rhai,csv}");
  context.subscriptions.push(
    files,
    preview,
    vscode.commands.registerCommand("setpiece.preview", () => preview.open()),
    vscode.commands.registerCommand("setpiece.restart", restart),
    vscode.commands.registerCommand("setpiece.uses", showUses),
    vscode.tasks.registerTaskProvider("setpiece", new Tasks()),
    vscode.workspace.onDidChangeConfiguration((change) => {
      if (change.affectsConfiguration("setpiece.path")) void restart();
    }),
    ...lensCommands(),
  );
  await restart();
}

/** Called by VS Code when it leaves. */
export async function deactivate(): Promise<void> {
  await client?.stop();
}

/** Starts the server; one that runs is stopped first. */
async function restart(): Promise<void> {
  await client?.dispose();
  client = undefined;
  const fault = await faultOf(command());
  if (fault) {
    // The extension is active all the same: the message may stay for long.
    void reportMissing(fault);
    return;
  }
  const server: ServerOptions = { command: command(), args: ["lsp"] };
  const options: LanguageClientOptions = {
    documentSelector: [
      { scheme: "file", language: "pitch" },
      { scheme: "untitled", language: "pitch" },
      // Scripts that scenarios name.
      { scheme: "file", language: "rhai" },
    ],
    synchronize: files ? { fileEvents: files } : {},
  };
  client = new LanguageClient("setpiece", "Setpiece", server, options);
  await client.start();
}

/** The command of the lens that counts uses: lists the places. */
async function showUses(uri: string, at: Position, places: Location[]): Promise<void> {
  const from = client?.protocol2CodeConverter;
  if (!from) return;
  const shown = [from.asUri(uri), from.asPosition(at), places.map((place) => from.asLocation(place))];
  await vscode.commands.executeCommand("editor.action.showReferences", ...shown);
}

/** Why the command can't be run; nothing if it can. */
function faultOf(name: string): Promise<string | undefined> {
  return new Promise((resolve) => {
    execFile(name, ["--version"], (error) => {
      resolve(error ? String(error.code ?? error.message) : undefined);
    });
  });
}

async function reportMissing(why: string): Promise<void> {
  const [copy, settings] = ["Copy the install command", "Open the setting"];
  const chosen = await vscode.window.showErrorMessage(missingText(command(), why), copy, settings);
  if (chosen === copy) await vscode.env.clipboard.writeText(INSTALL);
  if (chosen === settings) {
    await vscode.commands.executeCommand("workbench.action.openSettings", "setpiece.path");
  }
}
