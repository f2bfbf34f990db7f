// What runs in a terminal: tasks, and the actions behind the lenses.

import { tmpdir } from "node:os";
import { join } from "node:path";
import * as vscode from "vscode";
import {
  type Chore, checkLine, choreLine, drawLine, isChore, isPathAndName, runLine,
} from "./lines";

const KIND = "setpiece";
/** The file that is open, which VS Code fills in. */
const OPEN_FILE = "${file}";

/** The command's name or path. */
export function command(): string {
  return vscode.workspace.getConfiguration("setpiece").get("path", "setpiece");
}

function task(
  definition: vscode.TaskDefinition, name: string, line: readonly string[], matchers: string[],
  scope: vscode.WorkspaceFolder | vscode.TaskScope = vscode.TaskScope.Workspace,
): vscode.Task {
  const execution = new vscode.ProcessExecution(command(), [...line]);
  return new vscode.Task(definition, scope, name, KIND, execution, matchers);
}

/** The task of a definition. */
function choreTask(
  definition: vscode.TaskDefinition, scope?: vscode.WorkspaceFolder | vscode.TaskScope,
): vscode.Task | undefined {
  const chore: unknown = definition["task"];
  if (!isChore(chore)) return undefined;
  const file: unknown = definition["file"];
  const more: unknown = definition["args"];
  const line = choreLine(
    chore,
    typeof file === "string" ? file : OPEN_FILE,
    Array.isArray(more) ? more.map(String) : [],
  );
  const made = task(definition, chore, line, chore === "check" ? ["$setpiece"] : [], scope);
  if (chore !== "run") made.group = vscode.TaskGroup.Test;
  return made;
}

/** Offers to check, test and run the file that is open. */
export class Tasks implements vscode.TaskProvider {
  provideTasks(): vscode.Task[] {
    const chores: Chore[] = ["check", "test", "run"];
    return chores.flatMap((chore) => choreTask({ type: KIND, task: chore }) ?? []);
  }

  resolveTask({ definition, scope }: vscode.Task): vscode.Task | undefined {
    return choreTask(definition, scope);
  }
}

/** Saves what the command will read, and runs it in a terminal. */
async function execute(name: string, line: string[]): Promise<vscode.TaskExecution> {
  await vscode.workspace.saveAll(false);
  const made = task({ type: KIND, task: name }, name, line, []);
  made.presentationOptions = { panel: vscode.TaskPanelKind.Dedicated, clear: true };
  return vscode.tasks.executeTask(made);
}

/** Draws a start, and shows the picture once it is written. */
async function draw(path: string, scenario: string): Promise<void> {
  const picture = join(tmpdir(), `setpiece-${process.pid}-${scenario}.png`);
  const running = await execute(`draw ${scenario}`, drawLine(path, scenario, picture));
  const ended = vscode.tasks.onDidEndTaskProcess(({ execution, exitCode }) => {
    if (execution !== running) return;
    ended.dispose();
    const shown = vscode.Uri.file(picture);
    if (exitCode === 0) void vscode.commands.executeCommand("vscode.open", shown);
  });
}

/** The commands of the server's lenses: a path, and the name of what the lens stands at. */
const LENSES: Readonly<Record<string, (path: string, name: string) => Thenable<unknown>>> = {
  "setpiece.run": (path, scenario) => execute(`run ${scenario}`, runLine(path, scenario)),
  "setpiece.draw": draw,
  "setpiece.check": (path, words) => execute(`test ${words}`, checkLine(path, words)),
};

/** Registers the commands of the lenses. */
export function lensCommands(): vscode.Disposable[] {
  return Object.entries(LENSES).map(([name, action]) =>
    vscode.commands.registerCommand(name, async (...values: unknown[]) => {
      if (isPathAndName(values)) await action(values[0], values[1]);
    }),
  );
}
