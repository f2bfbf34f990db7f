//! The reference of the command, made of the same declarations as its help.

use super::Args;
use clap::{Arg, Command, CommandFactory as _};
use std::fmt::Write as _;

/// Every command with its arguments and options, as Markdown.
pub fn reference() -> String {
    let mut root = Args::command();
    root.build();
    let mut text = String::from("## Options of every command\n\n");
    table(&mut text, root.get_arguments().filter(|arg| arg.is_global_set()));
    for command in root.get_subcommands_mut().filter(|command| command.get_name() != "help") {
        section(&mut text, command);
    }
    text
}

fn section(text: &mut String, command: &mut Command) {
    let usage = command.render_usage().to_string();
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let name = command.get_name();
    let _ = write!(text, "\n## `setpiece {name}`\n\n{}.\n\n", flow(&about));
    let usage = usage.trim_start_matches("Usage: ");
    let _ = write!(text, "```text\n{usage}\n```\n");
    let own = command.get_arguments().filter(|arg| {
        !arg.is_global_set() && !arg.is_hide_set() && !matches!(arg.get_id().as_str(), "help")
    });
    let own: Vec<&Arg> = own.collect();
    if !own.is_empty() {
        text.push('\n');
        table(text, own.into_iter());
    }
    if let Some(after) = command.get_after_help() {
        let after = after.to_string();
        let (examples, rest) = after.split_once("\n\n").unwrap_or((&after, ""));
        if let Some(examples) = examples.strip_prefix("Examples:\n") {
            let lines: Vec<&str> = examples.lines().map(str::trim_start).collect();
            let _ = write!(text, "\n```text\n{}\n```\n", lines.join("\n"));
        }
        if !rest.is_empty() {
            let _ = write!(text, "\n{}\n", flow(rest));
        }
    }
}

/// A row per argument: how it is written, its default, what it does.
fn table<'a>(text: &mut String, arguments: impl Iterator<Item = &'a Arg>) {
    text.push_str("| | default | |\n|---|---|---|\n");
    for arg in arguments {
        let shown = |value: &std::ffi::OsStr| format!("`{}`", value.to_string_lossy());
        let defaults: Vec<String> =
            arg.get_default_values().iter().map(|value| shown(value)).collect();
        let takes_value = arg.get_action().takes_values();
        let default = if takes_value { defaults.join(", ") } else { String::new() };
        let help = arg.get_help().map(ToString::to_string).unwrap_or_default();
        let mut help = help.replace('|', "\\|").replace('\n', " ");
        let values = arg.get_possible_values();
        let values: Vec<String> =
            values.iter().map(|value| format!("`{}`", value.get_name())).collect();
        if takes_value && !values.is_empty() {
            let _ = write!(help, ": {}", values.join(", "));
        }
        let _ = writeln!(text, "| {} | {default} | {help} |", written(arg));
    }
}

/// An argument as it is typed.
fn written(arg: &Arg) -> String {
    let value = arg.get_value_names().map(|names| names.join(" ")).unwrap_or_default();
    let value = if arg.get_action().takes_values() { value } else { String::new() };
    let long = arg.get_long().map(|long| format!("--{long}"));
    let short = arg.get_short().map(|short| format!("-{short}"));
    let names: Vec<String> = short.into_iter().chain(long).collect();
    if names.is_empty() {
        return format!("`{value}`");
    }
    format!("`{}`", format!("{} {value}", names.join("`, `")).trim_end())
}

/// Text without the breaks that help has for terminals.
fn flow(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let line = lines.last_mut().filter(|line| line.chars().count() + word.len() < 99);
        match line {
            Some(line) if line.is_empty() => line.push_str(word),
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]
    use super::*;
    use clap::Parser as _;

    /// The words of a line of a shell, up to a pipe or a redirection.
    fn words(line: &str) -> Vec<String> {
        let line = line.split("  ").next().unwrap();
        let line = line.split([' ']).take_while(|word| !matches!(*word, "|" | ">" | "<"));
        line.map(|word| word.trim_matches('\'').to_owned()).collect()
    }

    #[test]
    fn every_example_of_the_help_is_a_command_that_parses() {
        let mut seen = 0;
        for command in Args::command().get_subcommands() {
            let after = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            for line in after.lines().filter_map(|line| line.strip_prefix("  ")) {
                assert!(Args::try_parse_from(words(line)).is_ok(), "{line}");
                seen += 1;
            }
        }
        assert!(seen >= 30, "{seen}");
    }

    #[test]
    fn every_command_and_option_is_in_the_reference() {
        let text = reference();
        for command in Args::command().get_subcommands() {
            assert!(text.contains(&format!("## `setpiece {}`", command.get_name())));
            for long in command.get_arguments().filter_map(Arg::get_long) {
                assert!(text.contains(&format!("--{long}")), "--{long}");
            }
        }
    }
}
