// The command's arguments, as plain data.

/** How many episodes a lens plays. */
const EPISODES = 20;

/** What a task does. */
export type Chore = "check" | "test" | "run";

/** Plays some episodes of a scenario of a file. */
export function runLine(path: string, scenario: string): string[] {
  return ["run", path, "--scenario", scenario, "--episodes", String(EPISODES)];
}

/** Draws the start of a scenario's first episode. */
export function drawLine(path: string, scenario: string, picture: string): string[] {
  return ["render", path, "--scenario", scenario, "--step", "0", "--output", picture];
}

/** Plays the checks of a file whose words contain a text. */
export function checkLine(path: string, words: string): string[] {
  return ["test", path, "--filter", words];
}

/** What a task runs; its reports are lines that the problem matcher reads. */
export function choreLine(chore: Chore, file: string, more: readonly string[]): string[] {
  const options = chore === "check" ? ["--message-format", "short"] : [];
  return [chore, file, ...options, ...more];
}

/** Two texts, as a lens hands them over: a path, and the name of what it stands at. */
export function isPathAndName(values: readonly unknown[]): values is [string, string] {
  return values.length === 2 && values.every((value) => typeof value === "string");
}

/** Whether a value of a `tasks.json` names a task. */
export function isChore(value: unknown): value is Chore {
  return value === "check" || value === "test" || value === "run";
}
