//! Printing: text to standard output, problems to standard error, in colour if wanted.

use super::Colour;
use crate::drawing::Paint;
use crate::dsl::report::{Format, printable, render};
use crate::dsl::{problem::Problem, source::Sources};
use crate::{Error, LoadOptions, Loaded};
use owo_colors::OwoColorize;
use std::cell::Cell;
use std::io::{IsTerminal, Write};

/// Where and how to print, and what commands may read.
pub(crate) struct Out {
    stdout_colour: bool,
    stderr_colour: bool,
    failed: Cell<bool>,
    /// Whether imports and scripts may lie outside the scenario's folder.
    pub(crate) allow_outside: bool,
}

impl Out {
    /// Uses colour as requested; `auto` checks the terminal and `NO_COLOR`.
    pub(crate) fn new(colour: Colour, allow_outside: bool) -> Out {
        let wanted = |terminal: bool| match colour {
            Colour::Always => true,
            Colour::Never => false,
            Colour::Auto => terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        };
        Out {
            stdout_colour: wanted(std::io::stdout().is_terminal()),
            stderr_colour: wanted(std::io::stderr().is_terminal()),
            failed: Cell::new(false),
            allow_outside,
        }
    }

    /// How scenarios are loaded.
    pub(crate) fn loading(&self) -> LoadOptions<'static> {
        LoadOptions { allow_outside: self.allow_outside, ..LoadOptions::default() }
    }

    /// Prints a line. A closed reader (`| head`) isn't an error, but a full disk is.
    pub(crate) fn line(&self, text: &str) {
        self.text(&format!("{text}\n"));
    }

    /// Prints a text. On a terminal, control characters from an author's text are removed.
    pub(crate) fn text(&self, text: &str) {
        let mut stdout = std::io::stdout();
        // A file or another program gets the text unchanged.
        let text = if stdout.is_terminal() { printable(text, self.stdout_colour) } else { text.into() };
        if let Err(why) = stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush())
            && why.kind() != std::io::ErrorKind::BrokenPipe
        {
            self.failed.set(true);
        }
    }

    /// Whether something could not be printed.
    pub(crate) fn failed(&self) -> bool {
        self.failed.get()
    }

    /// Prints a line to standard error.
    pub(crate) fn note(&self, text: &str) {
        let _ = writeln!(std::io::stderr(), "{}", printable(text, self.stderr_colour));
    }

    /// Bold, padded to `width` (escapes don't count).
    pub(crate) fn bold(&self, text: &str, width: usize) -> String {
        let text = format!("{text:width$}");
        if self.stdout_colour { text.bold().to_string() } else { text }
    }

    /// Dimmed.
    pub(crate) fn dim(&self, text: &str) -> String {
        if self.stdout_colour { text.dimmed().to_string() } else { text.to_owned() }
    }

    /// In the colour of its meaning.
    pub(crate) fn paint(&self, text: &str, paint: Paint) -> String {
        if !self.stdout_colour {
            return text.to_owned();
        }
        match paint {
            Paint::Left => text.yellow().bold().to_string(),
            Paint::Right => text.cyan().bold().to_string(),
            Paint::Ball => text.white().bold().to_string(),
            Paint::Success => text.green().to_string(),
            Paint::Failure => text.red().to_string(),
            Paint::Plain => text.to_owned(),
        }
    }

    /// Prints an error: the reports of a compilation, or one message with its code and help.
    pub(crate) fn error(&self, error: &Error) {
        if let Error::Compile(failure) = error {
            self.problems(&failure.problems, &failure.sources);
        } else {
            self.fault(&error.code().to_string(), &error.to_string(), error.help().as_deref());
        }
    }

    /// Prints a message with a code and help.
    pub(crate) fn fault(&self, code: &str, message: &str, help: Option<&str>) {
        let (code, cross) = if self.stderr_colour {
            (code.red().bold().to_string(), "×".red().to_string())
        } else {
            (code.to_owned(), "×".to_owned())
        };
        self.note(&format!("{code}\n  {cross} {}", printable(message, false)));
        if let Some(help) = help {
            self.note(&format!("  help: {}", printable(help, false)));
        }
    }

    /// Prints reports.
    pub(crate) fn problems(&self, problems: &[Problem], sources: &Sources) {
        let text = render(problems, sources, Format::Human { color: self.stderr_colour, width: 100 });
        self.note(text.trim_end());
    }

    /// Prints a scenario's warnings.
    pub(crate) fn warnings(&self, loaded: &Loaded) {
        if !loaded.warnings.is_empty() {
            self.problems(&loaded.warnings, &loaded.sources);
        }
    }
}
