//! Starts `setpiece lsp` for Zed.

use zed_extension_api::settings::{CommandSettings, LspSettings};
use zed_extension_api::{
    Command, Extension, LanguageServerId, Result, Worktree, register_extension,
};

/// The server's name in Zed's settings, and the command's on the `PATH`.
const NAME: &str = "setpiece";

/// What is said if the command can't be found.
const MISSING: &str = "`setpiece` is not on the PATH: in Setpiece's sources, \
    `cargo install --path setpiece` installs it; or set `lsp.setpiece.binary.path`";

/// The extension; it keeps nothing.
struct SetpieceExtension;

impl Extension for SetpieceExtension {
    fn new() -> Self {
        SetpieceExtension
    }

    fn language_server_command(
        &mut self,
        _: &LanguageServerId,
        worktree: &Worktree,
    ) -> Result<Command> {
        let settings = LspSettings::for_worktree(NAME, worktree)?;
        command(settings.binary, worktree.which(NAME), worktree.shell_env())
    }
}

/// The server's command line: what the settings name, else what is found on the `PATH`.
fn command(
    set: Option<CommandSettings>,
    found: Option<String>,
    mut env: Vec<(String, String)>,
) -> Result<Command> {
    let set = set.unwrap_or(CommandSettings { path: None, arguments: None, env: None });
    let command = set.path.or(found).ok_or_else(|| MISSING.to_owned())?;
    let args = set.arguments.unwrap_or_else(|| vec!["lsp".to_owned()]);
    env.extend(set.env.into_iter().flatten());
    Ok(Command { command, args, env })
}

register_extension!(SetpieceExtension);

#[cfg(test)]
mod tests {
    use super::*;

    fn settings(path: Option<&str>, arguments: Option<&[&str]>) -> CommandSettings {
        CommandSettings {
            path: path.map(str::to_owned),
            arguments: arguments.map(|list| list.iter().map(ToString::to_string).collect()),
            env: None,
        }
    }

    #[test]
    fn the_command_on_the_path_serves() {
        let made = command(None, Some("/bin/setpiece".to_owned()), Vec::new()).unwrap();
        assert_eq!(
            (made.command.as_str(), made.args.as_slice()),
            ("/bin/setpiece", &["lsp".to_owned()][..])
        );
    }

    #[test]
    fn the_settings_come_first() {
        let set = settings(Some("/opt/setpiece"), Some(&["lsp", "--allow-outside"]));
        let made = command(Some(set), Some("/bin/setpiece".to_owned()), Vec::new()).unwrap();
        assert_eq!(made.command, "/opt/setpiece");
        assert_eq!(made.args, ["lsp", "--allow-outside"]);
    }

    #[test]
    fn without_a_command_it_says_how_to_get_one() {
        assert_eq!(command(Some(settings(None, None)), None, Vec::new()).unwrap_err(), MISSING);
    }
}
