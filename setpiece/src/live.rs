//! A scenario that follows its files: recompiled when one of them changes.

use crate::error::Error;
use crate::load::{LoadOptions, Loaded, load_with};
use crate::watch::Watcher;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A scenario and a watcher on all its files: its own, imports and scripts.
pub struct Live {
    source: OsString,
    scenario: Option<String>,
    allow_outside: bool,
    loaded: Loaded,
    watcher: Watcher,
}

impl Live {
    /// Loads a scenario and watches its files.
    ///
    /// - `allow_outside`: see [`LoadOptions`].
    ///
    /// # Errors
    /// Like [`load_with`].
    pub fn open(source: impl AsRef<OsStr>, allow_outside: bool) -> Result<Live, Error> {
        Live::open_scenario(source, None, allow_outside)
    }

    /// The same of one scenario of a file.
    ///
    /// # Errors
    /// Like [`load_with`].
    pub fn open_scenario(
        source: impl AsRef<OsStr>,
        scenario: Option<&str>,
        allow_outside: bool,
    ) -> Result<Live, Error> {
        let source = source.as_ref().to_owned();
        let options = LoadOptions { scenario, allow_outside, ..LoadOptions::default() };
        // Before it is read, so that a change while it is compiled is noticed.
        let mut watcher = Watcher::new(&[PathBuf::from(&source)]);
        let loaded = load_with(&source, &options)?;
        watcher.watch(&loaded.inputs);
        let scenario = scenario.map(str::to_owned);
        Ok(Live { source, scenario, allow_outside, loaded, watcher })
    }

    /// The last good scenario.
    pub fn loaded(&self) -> &Loaded {
        &self.loaded
    }

    /// Whether there are files to watch; a scenario of the library has none.
    pub fn is_watching(&self) -> bool {
        !self.loaded.inputs.is_empty()
    }

    /// A file that has been missing for a while; its last good state goes on.
    pub fn missing(&self) -> Option<&Path> {
        self.watcher.missing()
    }

    /// Recompiles if a file has changed since the last call; waits for at most `timeout`.
    ///
    /// A broken file leaves the last good scenario in place. Files that it fails to import are
    /// watched too.
    ///
    /// # Errors
    /// Like [`load_with`], for the changed files.
    pub fn poll(&mut self, timeout: Duration) -> Option<Result<&Loaded, Error>> {
        if !self.watcher.changed(timeout) {
            return None;
        }
        let options = LoadOptions {
            scenario: self.scenario.as_deref(),
            allow_outside: self.allow_outside,
            ..LoadOptions::default()
        };
        Some(match load_with(&self.source, &options) {
            Ok(fresh) => {
                self.watcher.watch(&fresh.inputs);
                self.loaded = fresh;
                Ok(&self.loaded)
            }
            Err(error) => {
                let mut files: Vec<PathBuf> = self.loaded.inputs.clone();
                if let Error::Compile(failure) = &error {
                    files.extend(
                        failure
                            .inputs
                            .iter()
                            .filter(|file| !self.loaded.inputs.contains(file))
                            .cloned(),
                    );
                }
                self.watcher.watch(&files);
                Err(error)
            }
        })
    }
}
