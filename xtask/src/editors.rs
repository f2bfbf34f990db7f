//! The plugins of editors, put together from `editors/` and the grammar's queries, and the tests
//! that drive the server from real clients.

mod dialect;

use crate::grammar::{self, QUERIES};
use crate::npm;
use crate::shell::{copy_folder, is_there, read, root, run, write};
use dialect::{Dialect, HELIX, NEOVIM, ZED};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the plugins are put together.
fn plugins() -> PathBuf {
    root().join("target/editors")
}

/// Puts the plugins for Neovim, Helix and Zed together: their own files, the queries in their
/// dialect, the parser.
pub(crate) fn assemble() -> Result<(), String> {
    let parser = grammar::generate()?;
    for editor in ["neovim", "helix", "zed"] {
        copy_folder(&root().join("editors").join(editor), &plugins().join(editor))?;
    }
    let neovim = plugins().join("neovim");
    queries(&NEOVIM, &neovim.join("queries/setpiece"))?;
    // Neovim's libraries have this ending on every system.
    grammar::build_parser(&parser, &neovim.join("parser/setpiece.so"))?;

    let helix = plugins().join("helix/runtime");
    queries(&HELIX, &helix.join("queries/pitch"))?;
    let library = format!("grammars/setpiece.{}", std::env::consts::DLL_EXTENSION);
    grammar::build_parser(&parser, &helix.join(library))?;

    queries(&ZED, &plugins().join("zed/languages/pitch"))?;
    let revision = repository(&parser)?;
    let address = format!("file://{}", parser.display());
    let places = [("@GRAMMAR@", address.as_str()), ("@REVISION@", revision.as_str())];
    fill(&plugins().join("zed/extension.toml"), &places)?;
    println!("editors: the plugins are in {}", plugins().display());
    Ok(())
}

/// Writes the queries that an editor knows, in its dialect.
fn queries(dialect: &Dialect, folder: &Path) -> Result<(), String> {
    for query in QUERIES.iter().filter(|query| dialect.has(query)) {
        let home = root().join(format!("grammar/tree-sitter/queries/{query}.scm"));
        write(&folder.join(format!("{query}.scm")), &dialect.translated(&read(&home)?))?;
    }
    Ok(())
}

/// Fills places of a file.
fn fill(path: &Path, places: &[(&str, &str)]) -> Result<(), String> {
    let mut text = read(path)?;
    for (place, words) in places {
        if !text.contains(place) {
            return Err(format!("{}: no {place} to fill", path.display()));
        }
        text = text.replace(place, words);
    }
    write(path, &text)
}

/// Makes the generated grammar a repository of its own, which Zed wants; returns its revision.
fn repository(folder: &Path) -> Result<String, String> {
    let git = |args: &[&str]| {
        let mut command = Command::new("git");
        command.args(["-c", "user.name=Setpiece", "-c", "user.email=setpiece@localhost"]);
        command.args(args).current_dir(folder);
        command
    };
    run(&mut git(&["init", "--quiet"]))?;
    run(&mut git(&["add", "--all", "--force", "."]))?;
    run(&mut git(&["commit", "--quiet", "--message", "The generated grammar"]))?;
    let head = git(&["rev-parse", "HEAD"]).output().map_err(|why| why.to_string())?;
    Ok(String::from_utf8_lossy(&head.stdout).trim().to_owned())
}

/// Drives the server from Node and from Neovim.
pub(crate) fn drive(command: &Path) -> Result<(), String> {
    drive_by_node(command)?;
    drive_by_neovim(command)
}

/// Drives the server from the clients that are there, and names the others.
pub(crate) fn drive_if_there(command: &Path) -> Result<(), String> {
    if npm::is_there() {
        drive_by_node(command)?;
    } else {
        println!("editors: left out, no npm here: no client of Node drives the server");
    }
    if has_neovim() {
        drive_by_neovim(command)
    } else {
        println!("editors: left out, no Neovim here: `apt-get install neovim` brings it");
        Ok(())
    }
}

fn drive_by_node(command: &Path) -> Result<(), String> {
    let tests = root().join("editors/tests");
    npm::install(&tests)?;
    run(npm::npm().args(["test", "--silent"]).env("SETPIECE", command).current_dir(tests))
}

/// Neovim's own test. With tree-sitter's command, the plugin has the parser too.
fn drive_by_neovim(command: &Path) -> Result<(), String> {
    let plugin = if grammar::is_there() {
        assemble()?;
        plugins().join("neovim")
    } else {
        println!("editors: no tree-sitter here: Neovim is tried without the parser");
        root().join("editors/neovim")
    };
    let texts = plugins().join("texts");
    copy_folder(&root().join("editors/tests/fixture"), &texts)?;
    run(Command::new("nvim")
        .args(["--headless", "--clean", "--cmd", "let g:setpiece_command = $SETPIECE", "--cmd"])
        .arg(format!("set runtimepath^={}", plugin.display()))
        .arg("-c")
        .arg(format!("luafile {}", root().join("editors/tests/neovim.lua").display()))
        .env("SETPIECE", command)
        .env("FIXTURE", &texts)
        .current_dir(&texts))
}

fn has_neovim() -> bool {
    is_there(&mut Command::new("nvim"))
}
