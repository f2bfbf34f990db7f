//! Rewards and endings by Rhai hooks, for what the language can't express.
//!
//! One Rhai engine serves the process, and each script of a scenario is compiled once; all matches
//! and threads share both. A hook sees the match through the language's own properties, in the
//! frame of the judged side. It can do nothing else: no files, no clock. Its modules are texts of
//! the scenario, joined with it. Operations,
//! depth and sizes are bounded, and random numbers come only from the episode's seed. `this` is the
//! script's memory: a map that lives as long as the episode.
//!
//! - `fn reward(ctx, now, prev, events)` returns a number, or a map of numbers by the names of its
//!   terms, each step, for each agent.
//! - `fn done(ctx, now, prev, events)` returns whether the episode ends: true, or its label.
//! - `fn act(ctx, me, now)` returns the action of the player it plays, each step.

mod api;
mod budget;
mod call;
mod chain;
mod check;
mod functions;
mod hooks;
mod host;
mod imports;
mod join;
mod limits;
mod place;
mod print;
mod scan;
mod terms;
mod words;

pub use api::{
    Argument, HookScene, Member, Params, Perspective, Subject, functions, interface, members,
};
pub(crate) use api::{EpisodeNames, Shelf};
pub use check::{ScriptFault, ScriptFaultKind, ScriptNames, check_script, script_imports};

use api::{NamedList, NamedProgram, ShownState, events_of};
use budget::Edits;
use call::CompiledScript;
use hooks::{DONE, RESET, REWARD};
use join::{Joined, UNFOLLOWED};
use place::hook_position;
use print::Printed;
use rhai::{Array, Dynamic, EvalAltResult, FuncArgs};
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{Action, Type};
use setpiece_scenario::{Param, Scenario, Script};
use std::sync::Arc;

/// A hook that failed. It ends the episode, not the process.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{script}:{line}:{column}: `{hook}` failed: {message} (seed {seed}, episode {index}, step {step})"
)]
pub struct ScriptError {
    /// The script, as the scenario names it.
    pub script: String,
    /// Line in the script's file, from 1. The hook's own line if the failure has no place.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// The hook.
    pub hook: String,
    /// The episode's seed.
    pub seed: u64,
    /// The episode's index.
    pub index: u64,
    /// The step it failed in.
    pub step: u32,
    /// What went wrong.
    pub message: String,
}

/// A script that can't be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{script}:{line}:{column}: {message}")]
pub struct ScriptLoadError {
    /// The script, as the scenario names it.
    pub script: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is wrong with it.
    pub message: String,
}

/// A script's memory of the episode.
#[derive(Clone, Debug)]
pub struct Memory {
    /// The value that the script calls `this`.
    this: Dynamic,
    /// Whether the episode's `reset` hook has been called.
    begun: bool,
}

impl Default for Memory {
    fn default() -> Memory {
        Memory { this: Dynamic::from_map(rhai::Map::new()), begun: false }
    }
}

/// The result of a `done` hook.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Done {
    /// The episode continues.
    No,
    /// It ends.
    Yes,
    /// It ends, under this name.
    Labelled(String),
}

/// What a reward asks of a script's hook.
#[derive(Clone, Copy, Debug, Default)]
pub struct RewardAsked<'a> {
    /// The keys of the map that the hook returns; none if it returns a number.
    pub terms: &'a [String],
    /// The reward's arguments.
    pub arguments: &'a [Argument<'a>],
}

/// The compiled scripts of a scenario.
#[derive(Clone, Debug)]
pub struct Scripts {
    list: Arc<[Compiled]>,
    params: Arc<[Param]>,
}

/// A line and column of a module, or of the script itself.
type AuthorPlace = (Option<usize>, (usize, usize));

#[derive(Debug)]
struct Compiled {
    name: String,
    /// Where its text begins in its file.
    at: (u32, u32),
    source: String,
    code: CompiledScript,
    /// Maps places in the code back to the joined text.
    edits: Edits,
    /// The text with its modules.
    joined: Joined,
    /// What the modules are called in messages.
    modules: Vec<String>,
    uses_me: bool,
    /// Whether a hook reads the step's events.
    reads_events: bool,
    /// Whether it has a `reset` hook.
    resets: bool,
    named: NamedList,
    /// How much it has printed.
    printed: Printed,
    /// Its share of the memory of an episode, one for each of the players and scripts.
    memory_bytes: usize,
}

impl Scripts {
    /// Compiles a scenario's scripts.
    ///
    /// # Errors
    /// The first script that isn't valid Rhai.
    pub fn compile(scenario: &Scenario) -> Result<Scripts, ScriptLoadError> {
        let memory_bytes = host::MEMORIES_BYTES_MAX / (PLAYERS_MAX * scenario.scripts.len().max(1));
        let compile = |script: &Script| {
            let modules = module_names(script);
            let failed = |(module, (line, column)): AuthorPlace, message| ScriptLoadError {
                script: module.and_then(|at| modules.get(at)).unwrap_or(&script.name).clone(),
                line,
                column,
                message,
            };
            let joined = Joined::of(&script.source, &script.modules)
                .map_err(|fault| failed((fault.module, fault.place), fault.message))?;
            let unread = |error: rhai::ParseError| {
                let place = words::line_column(error.position()).unwrap_or((1, 1));
                failed(joined.original(place), words::parse_message(&error))
            };
            let ast = joined.parse().map_err(unread)?;
            let (counted, edits) = budget::count_copies(&joined.text, &ast)
                .map_err(|place| failed(joined.original(place), UNFOLLOWED.to_owned()))?;
            let code = host::engine().compile(counted).map_err(unread)?;
            let resets = ast
                .iter_functions()
                .any(|function| function.name == RESET && function.params.len() == 1);
            Ok(Compiled {
                resets,
                memory_bytes,
                printed: Printed::default(),
                named: NamedProgram::list(scenario, &script.named),
                name: script.name.clone(),
                at: script.at,
                source: script.source.clone(),
                uses_me: check::mentions_me(&ast),
                reads_events: [REWARD, DONE].iter().any(|hook| check::mentions_events(&ast, hook)),
                code: CompiledScript::of(code),
                edits,
                joined,
                modules,
            })
        };
        Ok(Scripts {
            list: scenario.scripts.iter().map(compile).collect::<Result<_, _>>()?,
            params: scenario.params.clone().into(),
        })
    }

    #[cfg(test)]
    fn walked(mut self) -> Scripts {
        Arc::get_mut(&mut self.list)
            .into_iter()
            .flatten()
            .for_each(|compiled| compiled.code.walk());
        self
    }

    #[cfg(test)]
    fn is_lowered(&self) -> bool {
        self.list.iter().all(|compiled| compiled.code.is_lowered())
    }

    /// Whether a script reads the agent's own player, so that it must run for each agent.
    pub fn uses_me(&self, script: u32) -> bool {
        self.list.get(script as usize).is_some_and(|compiled| compiled.uses_me)
    }

    /// The scenario's parameters with these values, as scripts see them.
    pub fn params(&self, values: &[f64]) -> Params {
        let map = self
            .params
            .iter()
            .zip(values)
            .map(|(param, &value)| (param.name.as_str().into(), shown(param, value)));
        Arc::new(map.collect())
    }

    /// What scripts read by name in an episode with these values.
    pub(crate) fn names(
        &self,
        params: &[f64],
        lets: &[f64],
        (round, round_start): (u32, u32),
    ) -> Arc<EpisodeNames> {
        Arc::new(EpisodeNames {
            scripts: self.list.iter().map(|compiled| compiled.named.clone()).collect(),
            params: params.to_vec(),
            lets: lets.to_vec(),
            round,
            round_start,
        })
    }

    /// Calls a script's `reward` hook, which writes into `values`: one number, or one for each of
    /// its terms.
    ///
    /// # Errors
    /// [`ScriptError`] if the hook fails, or doesn't return a number, or a map of its terms.
    pub fn reward_terms(
        &self,
        script: u32,
        scene: &Arc<HookScene>,
        perspective: Perspective,
        asked: RewardAsked<'_>,
        memory: &mut Memory,
        values: &mut [f64],
    ) -> Result<(), ScriptError> {
        let RewardAsked { terms, arguments } = asked;
        let value = self.call(script, REWARD, scene, (perspective, arguments), memory)?;
        terms::read(&value, terms, values).map_err(|why| self.failed(script, REWARD, why, scene))
    }

    /// Calls a script's `done` hook.
    ///
    /// # Errors
    /// [`ScriptError`] if the hook fails or returns neither a bool nor a label.
    pub fn done(
        &self,
        script: u32,
        scene: &Arc<HookScene>,
        perspective: Perspective,
        memory: &mut Memory,
    ) -> Result<Done, ScriptError> {
        let value = self.call(script, DONE, scene, (perspective, &[]), memory)?;
        match value.as_bool() {
            Ok(true) => Ok(Done::Yes),
            Ok(false) => Ok(Done::No),
            Err(_) => value
                .into_string()
                .map_err(|found| {
                    self.wrong_type(script, DONE, "true, false or a label", found, scene)
                })
                .map(
                    |label| if label.trim().is_empty() { Done::No } else { Done::Labelled(label) },
                ),
        }
    }

    /// Calls a script's `act` hook for the player of the perspective.
    ///
    /// # Errors
    /// [`ScriptError`] if the hook fails or returns no known action.
    pub fn act(
        &self,
        script: u32,
        scene: &Arc<HookScene>,
        perspective: Perspective,
        arguments: &[Argument<'_>],
        memory: &mut Memory,
    ) -> Result<Action, ScriptError> {
        const HOOK: &str = "act";
        let Some(compiled) = self.list.get(script as usize) else { return Ok(Action::Idle) };
        let own =
            (!arguments.is_empty()).then(|| Arc::new(scene.with_arguments(perspective, arguments)));
        let seen = own.as_ref().unwrap_or(scene);
        let now = ShownState::now(seen, perspective, script);
        compiled.begin(&now, memory)?;
        let called = compiled.call(HOOK, (now.ctx(), now.me(), now.clone()), memory, seen);
        if let Some(own) = &own {
            scene.take_random(own);
        }
        let word = called?
            .into_string()
            .map_err(|found| self.wrong_type(script, HOOK, "the name of an action", found, seen))?;
        // The other actions of the full set are team orders.
        let known = &Action::ALL[..Action::V2_SET];
        known.iter().copied().find(|action| action.name() == word).ok_or_else(|| {
            let names = known.iter().map(|action| action.name());
            let hint =
                check::suggest(&word, names).map(|hint| format!("; {hint}")).unwrap_or_default();
            compiled.error(HOOK, None, format!("no action is called `{word}`{hint}"), seen)
        })
    }

    fn call(
        &self,
        script: u32,
        hook: &str,
        scene: &Arc<HookScene>,
        (perspective, arguments): (Perspective, &[Argument<'_>]),
        memory: &mut Memory,
    ) -> Result<Dynamic, ScriptError> {
        let Some(compiled) = self.list.get(script as usize) else { return Ok(Dynamic::UNIT) };
        let own =
            (!arguments.is_empty()).then(|| Arc::new(scene.with_arguments(perspective, arguments)));
        let seen = own.as_ref().unwrap_or(scene);
        let now = ShownState::now(seen, perspective, script);
        compiled.begin(&now, memory)?;
        let events = if compiled.reads_events { events_of(&now) } else { Array::new() };
        let arguments = (now.ctx(), now.clone(), now.before(), events);
        let called = compiled.call(hook, arguments, memory, seen);
        if let Some(own) = &own {
            scene.take_random(own);
        }
        called
    }

    fn wrong_type(
        &self,
        script: u32,
        hook: &str,
        expected: &str,
        found: &str,
        scene: &HookScene,
    ) -> ScriptError {
        let message = format!("expected {expected}, found {}", api::type_words(found));
        self.failed(script, hook, message, scene)
    }

    /// A hook whose result can't be used.
    fn failed(&self, script: u32, hook: &str, message: String, scene: &HookScene) -> ScriptError {
        match self.list.get(script as usize) {
            Some(compiled) => compiled.error(hook, None, message, scene),
            None => ScriptError {
                script: String::new(),
                line: 1,
                column: 1,
                hook: hook.to_owned(),
                seed: scene.seed,
                index: scene.index,
                step: scene.step(),
                message,
            },
        }
    }
}

/// What a script's modules are called in messages: paths beside the script's.
fn module_names(script: &Script) -> Vec<String> {
    let is_file = script.at == (1, 1);
    let folder = script.name.rfind('/').filter(|_| is_file).map_or(0, |slash| slash + 1);
    let folder = script.name.get(..folder).unwrap_or_default();
    script.modules.iter().map(|module| format!("{folder}{}", module.name)).collect()
}

impl Compiled {
    /// Calls the `reset` hook before the first hook of an episode.
    fn begin(&self, now: &ShownState, memory: &mut Memory) -> Result<(), ScriptError> {
        if std::mem::replace(&mut memory.begun, true) || !self.resets {
            return Ok(());
        }
        self.call(RESET, (now.ctx(),), memory, now.scene()).map(drop)
    }

    /// Calls a hook; the memory that it leaves must be within bounds.
    fn call(
        &self,
        hook: &str,
        arguments: impl FuncArgs,
        memory: &mut Memory,
        scene: &HookScene,
    ) -> Result<Dynamic, ScriptError> {
        self.printed.begin();
        let value = self.code.call(hook, arguments, &mut memory.this);
        self.printed.end(|place| {
            let (script, line, column) = self.place(hook, place.map(|place| self.original(place)));
            format!("{script}:{line}:{column}")
        });
        let ended = budget::end(&mut memory.this);
        let called = value.map_err(|error| self.fault(hook, error, scene)).and_then(|value| {
            ended
                .and_then(|()| host::check_size(&memory.this, self.memory_bytes))
                .map_err(|why| self.error(hook, None, why, scene))?;
            Ok(value)
        });
        if called.is_err() {
            memory.this = Memory::default().this;
        }
        called
    }

    fn fault(&self, hook: &str, error: Box<EvalAltResult>, scene: &HookScene) -> ScriptError {
        let (position, message) = words::explain(error);
        self.error(hook, position.map(|place| self.original(place)), message, scene)
    }

    /// The author's place of a place in the code.
    fn original(&self, place: (usize, usize)) -> AuthorPlace {
        self.joined.original(self.edits.original(place))
    }

    /// The name, line and column under which a place is reported; the hook's if there is none.
    fn place(&self, hook: &str, position: Option<AuthorPlace>) -> (&str, usize, usize) {
        let (module, (line, column)) =
            position.unwrap_or_else(|| (None, hook_position(&self.source, hook)));
        let script = module.and_then(|at| self.modules.get(at));
        let (first_line, first_column) = match script {
            Some(_) => (1, 1),
            None => (self.at.0.max(1) as usize, self.at.1.max(1) as usize),
        };
        let column = if line == 1 { column + first_column - 1 } else { column };
        (script.unwrap_or(&self.name), line + first_line - 1, column)
    }

    fn error(
        &self,
        hook: &str,
        position: Option<AuthorPlace>,
        message: String,
        scene: &HookScene,
    ) -> ScriptError {
        let (script, line, column) = self.place(hook, position);
        ScriptError {
            script: script.to_owned(),
            line,
            column,
            hook: hook.to_owned(),
            seed: scene.seed,
            index: scene.index,
            step: scene.step(),
            message,
        }
    }
}

/// A parameter's value as a script sees it: words and teams by name, everything else as numbers in
/// SI units.
fn shown(param: &Param, value: f64) -> Dynamic {
    if let Some(word) = param.choices.get(value as usize) {
        return word.clone().into();
    }
    match param.ty {
        Type::Bool => (value != 0.0).into(),
        Type::Int => (value as i64).into(),
        Type::Team => match crate::judge::view::team_of_number(value) {
            Some(team) => team.name().into(),
            None => "none".into(),
        },
        _ => value.into(),
    }
}

#[cfg(test)]
mod tests;
