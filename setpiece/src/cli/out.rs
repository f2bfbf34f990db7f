//! Printing: text to standard output, problems to standard error, in colour if wanted.

use super::common::ColourChoice;
use crate::drawing::Paint;
use crate::dsl::report::{Format, printable, render};
use crate::dsl::{problem::Problem, source::Sources};
use crate::{Error, LoadOptions, Loaded};
use owo_colors::{OwoColorize, Style};
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
    pub(crate) fn new(colour: ColourChoice, allow_outside: bool) -> Out {
        let wanted = |terminal: bool| match colour {
            ColourChoice::Always => true,
            ColourChoice::Never => false,
            ColourChoice::Auto => {
                terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty())
            }
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

    /// Prints a line; a reader that has gone away (`| head`) is no error, a full disk is.
    pub(crate) fn line(&self, text: impl Into<StyledText>) {
        self.text(text.into().text("\n"));
    }

    /// Prints a text. On a terminal the styles that it was given are all that reaches it: control
    /// characters of authors become their pictures.
    pub(crate) fn text(&self, text: impl Into<StyledText>) {
        let mut stdout = std::io::stdout();
        // A file or another program gets what was written.
        let steady = stdout.is_terminal() || self.stdout_colour;
        let shown = text.into().shown(steady, self.stdout_colour);
        if let Err(why) = stdout.write_all(shown.as_bytes()).and_then(|()| stdout.flush())
            && why.kind() != std::io::ErrorKind::BrokenPipe
        {
            self.failed.set(true);
        }
    }

    /// Goes up this many lines, to print over them. No-op where the output isn't a terminal.
    pub(crate) fn up(&self, lines: usize) {
        let mut stdout = std::io::stdout();
        if stdout.is_terminal() && write!(stdout, "\x1b[{lines}A").is_err() {
            self.failed.set(true);
        }
    }

    /// Whether something could not be printed.
    pub(crate) fn failed(&self) -> bool {
        self.failed.get()
    }

    /// Prints a line to standard error.
    pub(crate) fn note(&self, text: impl Into<StyledText>) {
        let _ = writeln!(std::io::stderr(), "{}", text.into().shown(true, self.stderr_colour));
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
        let head = StyledText::default().styled(code, Style::new().red().bold()).text("\n  ");
        self.note(head.styled("×", Style::new().red()).text(" ").text(message));
        if let Some(help) = help {
            self.note(format!("  help: {help}"));
        }
    }

    /// Prints reports.
    pub(crate) fn problems(&self, problems: &[Problem], sources: &Sources) {
        let text =
            render(problems, sources, Format::Human { color: self.stderr_colour, width: 100 });
        // Steady already, with colours of its own.
        let _ = writeln!(std::io::stderr(), "{}", text.trim_end());
    }

    /// Prints a scenario's warnings.
    pub(crate) fn warnings(&self, loaded: &Loaded) {
        if !loaded.warnings.is_empty() {
            self.problems(&loaded.warnings, &loaded.sources);
        }
    }
}

/// A text in parts, some of them in a style. Styles are given here alone: what a part contains sets
/// none.
#[derive(Clone, Debug, Default)]
pub(crate) struct StyledText(Vec<(String, Option<Style>)>);

impl StyledText {
    /// Adds a part as it is.
    pub(crate) fn text(mut self, text: &str) -> StyledText {
        self.0.push((text.to_owned(), None));
        self
    }

    /// Adds a bold part.
    pub(crate) fn bold(self, text: &str) -> StyledText {
        self.styled(text, Style::new().bold())
    }

    /// Adds a dimmed part.
    pub(crate) fn dim(self, text: &str) -> StyledText {
        self.styled(text, Style::new().dimmed())
    }

    /// Adds a part in the colour of what it stands for.
    pub(crate) fn paint(self, text: &str, paint: Paint) -> StyledText {
        match paint {
            Paint::Left => self.styled(text, Style::new().yellow().bold()),
            Paint::Right => self.styled(text, Style::new().cyan().bold()),
            Paint::Ball => self.styled(text, Style::new().white().bold()),
            Paint::Success => self.styled(text, Style::new().green()),
            Paint::Failure => self.styled(text, Style::new().red()),
            Paint::Plain => self.text(text),
        }
    }

    fn styled(mut self, text: &str, style: Style) -> StyledText {
        self.0.push((text.to_owned(), Some(style)));
        self
    }

    /// The text as it is printed; `steady`: without control characters in its parts.
    fn shown(&self, steady: bool, colour: bool) -> String {
        let mut shown = String::new();
        for (text, style) in &self.0 {
            let text = if steady { printable(text, false) } else { text.into() };
            match style.filter(|_| colour) {
                Some(style) => shown += &text.style(style).to_string(),
                None => shown += &text,
            }
        }
        shown
    }
}

impl From<&str> for StyledText {
    fn from(text: &str) -> StyledText {
        StyledText::default().text(text)
    }
}

impl From<String> for StyledText {
    fn from(text: String) -> StyledText {
        StyledText(vec![(text, None)])
    }
}

impl From<&String> for StyledText {
    fn from(text: &String) -> StyledText {
        StyledText::from(text.as_str())
    }
}
