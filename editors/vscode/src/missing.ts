// What is said if the command can't be run.

/** Installs the command. */
export const INSTALL = "cargo install --path setpiece";

/** Says which command can't be run, why, and how to get it. */
export function missingText(command: string, why: string): string {
  return (
    `The command \`${command}\` can't be run (${why}). ` +
    `In Setpiece's sources, \`${INSTALL}\` installs it; ` +
    "or the setting `setpiece.path` names where it is."
  );
}
