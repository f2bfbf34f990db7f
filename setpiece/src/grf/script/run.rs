//! Follows the statements of a script for one episode.

use super::lines::PyToken;
use super::tree::{PyNode, split, top_level};
use super::value::{PyNames, PyValue, calculated};
use crate::grf::recorded::{FIXED_SEED, GrfPlayer, GrfScenario};
use crate::scenario::vocabulary::{Role, Team};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// Where GRF puts the lazy keeper of a team without players.
const LONE_KEEPER: [f64; 2] = [-1.0, 0.42];

/// What the script has set so far.
pub(super) struct PyRun<'t> {
    /// What it has set.
    pub(super) recorded: GrfScenario,
    names: PyNames<'t>,
    /// The team that a player is added to; none if that isn't known.
    team: Option<Team>,
    /// Whether functions of the file may set the team when they are called.
    is_shared: bool,
    /// The names that functions of the file may change.
    global: BTreeSet<&'t str>,
    /// The teams that players may be lost of.
    lost: BTreeSet<Team>,
    /// The bytes of the statements that can't be read.
    left_out: Vec<Range<usize>>,
    /// The bytes of the statement that sets a seed.
    seed: Option<Range<usize>>,
    /// How many statements have set something.
    effects: usize,
}

/// Whether the statements after one are reached.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Goes {
    On,
    Back,
}

/// That a statement can't be read.
struct Unreadable;

impl<'t> PyRun<'t> {
    /// Follows a file whose node `at` is the script, in one episode.
    pub(super) fn of(nodes: &[PyNode<'t>], at: usize, episode: i64) -> PyRun<'t> {
        let mut run = PyRun {
            recorded: GrfScenario::default(),
            names: PyNames { values: BTreeMap::new(), episode },
            team: Some(Team::Left),
            is_shared: false,
            global: BTreeSet::new(),
            lost: BTreeSet::new(),
            left_out: Vec::new(),
            seed: None,
            effects: 0,
        };
        // A file is run as a whole before its function is called.
        let (above, rest) = nodes.split_at(at.min(nodes.len()));
        run.block(above);
        if let Some((script, below)) = rest.split_first() {
            run.block(below);
            run.team = Some(Team::Left);
            run.script(script);
        }
        run
    }

    fn script(&mut self, script: &PyNode<'t>) {
        let (head, inline) = script.parts();
        let mut arguments = head.iter().skip(3).filter_map(|token| match token {
            PyToken::Word(name) => Some(*name),
            _ => None,
        });
        if let Some(builder) = arguments.next() {
            self.names.values.insert(builder, PyValue::Builder);
        }
        for other in arguments {
            self.names.values.remove(other);
        }
        if self.simple_line(inline, &script.line.range) == Goes::On {
            self.block(&script.body);
        }
    }

    /// Whether nothing was set.
    pub(super) fn is_empty(&self) -> bool {
        self.effects == 0
    }

    /// The bytes of what is left out.
    pub(super) fn left_out(&self) -> impl Iterator<Item = Range<usize>> {
        // A text has no seed of its own.
        let is_seeded =
            self.recorded.deterministic && self.recorded.game_engine_random_seed != FIXED_SEED;
        self.left_out.iter().cloned().chain(self.seed.clone().filter(|_| is_seeded))
    }

    /// What the script has set, with the keeper that GRF gives to a team without players.
    pub(super) fn finished(mut self) -> GrfScenario {
        self.recorded.game_engine_random_seed = FIXED_SEED;
        for &team in Team::ALL {
            let players = self.recorded.team_mut(team);
            if players.is_empty() {
                let (role, lazy, controllable) = (Role::GK, true, true);
                players.push(GrfPlayer { place: LONE_KEEPER, role, lazy, controllable });
            }
        }
        self.recorded
    }

    fn block(&mut self, nodes: &[PyNode<'t>]) -> Goes {
        let mut at = 0;
        while let Some(node) = nodes.get(at) {
            let chain = if node.line.word() == "if" {
                chain_at(nodes, at)
            } else {
                std::slice::from_ref(node)
            };
            at += chain.len();
            let goes = match node.line.word() {
                "if" => self.choice(chain),
                "def" => {
                    if let Some(PyToken::Word(name)) = node.line.tokens.get(1) {
                        self.names.values.remove(name);
                    }
                    self.share(&node.tokens());
                    self.left_out.push(node.range());
                    Goes::On
                }
                _ if node.body.is_empty() => self.simple_line(&node.line.tokens, &node.line.range),
                _ => {
                    self.leave_out(&node.tokens(), node.range());
                    Goes::On
                }
            };
            if goes == Goes::Back {
                return goes;
            }
        }
        Goes::On
    }

    /// An `if` with what belongs to it.
    fn choice(&mut self, chain: &[PyNode<'t>]) -> Goes {
        for node in chain {
            let (head, inline) = node.parts();
            let holds = match node.line.word() {
                "else" => Some(true),
                _ => head
                    .get(1..)
                    .and_then(|condition| self.names.value(condition))
                    .and_then(PyValue::truth),
            };
            match holds {
                Some(false) => {}
                Some(true) => {
                    let goes = self.simple_line(inline, &node.line.range);
                    return if goes == Goes::On { self.block(&node.body) } else { goes };
                }
                None => {
                    let tokens: Vec<_> = chain.iter().flat_map(PyNode::tokens).collect();
                    let start = chain.first().map_or(0, |first| first.line.range.start);
                    let end = chain.last().map_or(start, |last| last.range().end);
                    self.leave_out(&tokens, start..end);
                    return Goes::On;
                }
            }
        }
        Goes::On
    }

    /// Statements of one line.
    fn simple_line(&mut self, tokens: &[PyToken<'t>], range: &Range<usize>) -> Goes {
        for statement in split(tokens, ";") {
            match self.simple(statement, range) {
                Ok(Goes::On) => {}
                Ok(Goes::Back) => return Goes::Back,
                Err(Unreadable) => self.leave_out(statement, range.clone()),
            }
        }
        Goes::On
    }

    /// Leaves a statement out, and forgets what it may have changed.
    fn leave_out(&mut self, tokens: &[PyToken<'t>], range: Range<usize>) {
        self.left_out.push(range);
        for statement in split(tokens, ";") {
            self.forget(statement);
            if statement.contains(&PyToken::Word("AddPlayer")) {
                self.lose();
            }
        }
    }

    /// Notes that players of the team aren't known.
    fn lose(&mut self) {
        match self.team {
            Some(team) => drop(self.lost.insert(team)),
            None => self.lost.extend(Team::ALL),
        }
    }

    /// Whether nobody of a team is known who may be there.
    pub(super) fn lacks_a_team(&self) -> bool {
        let is_empty = |team: Team| match team {
            Team::Left => self.recorded.left_team.is_empty(),
            Team::Right => self.recorded.right_team.is_empty(),
        };
        self.lost.iter().any(|team| is_empty(*team))
    }

    /// Notes what calls may change from now on, by what is left out.
    fn share(&mut self, tokens: &[PyToken<'t>]) {
        self.is_shared = true;
        if tokens.contains(&PyToken::Word("AddPlayer")) {
            self.lost.extend(Team::ALL);
        }
        for statement in split(tokens, ";") {
            if let [PyToken::Word("global" | "nonlocal"), names @ ..] = statement {
                self.global.extend(names.iter().filter_map(|token| match token {
                    PyToken::Word(name) => Some(*name),
                    _ => None,
                }));
            }
        }
    }

    fn forget(&mut self, tokens: &[PyToken<'t>]) {
        let is_sign = |at: usize, signs: &[&str]| match tokens.get(at) {
            Some(PyToken::Sign(sign)) => signs.contains(sign),
            _ => false,
        };
        let is_assigned = |token: &PyToken<'t>| match token {
            PyToken::Sign("==" | "!=" | "<=" | ">=") => false,
            PyToken::Sign(sign) => sign.ends_with('='),
            _ => false,
        };
        let assigned = top_level(tokens).filter(|(_, it)| is_assigned(it)).last();
        let targets = assigned.map_or(0, |(at, _)| at);
        let mut binds = false;
        for (at, token) in tokens.iter().enumerate() {
            let word = match token {
                PyToken::Word(word) => *word,
                PyToken::Sign("," | "(" | ")" | "*") => continue,
                _ => {
                    binds = false;
                    continue;
                }
            };
            if matches!(word, "for" | "del" | "import") || word == "in" {
                binds = word != "in";
                continue;
            }
            let before = at.checked_sub(1).and_then(|at| tokens.get(at));
            if before == Some(&PyToken::Sign(".")) {
                let of = at.checked_sub(2).and_then(|at| tokens.get(at));
                let is_builders = matches!(of, Some(PyToken::Word(name))
                    if self.names.values.get(name) == Some(&PyValue::Builder));
                let is_called = self.is_shared && !is_builders && is_sign(at + 1, &["("]);
                if word == "SetTeam" || is_called {
                    self.team = None;
                }
                continue;
            }
            // Whoever has the builder may have changed the team, and may do so again.
            let is_builder = self.names.values.get(word) == Some(&PyValue::Builder);
            let is_handed = is_builder && !is_sign(at + 1, &["."]);
            self.is_shared |= is_handed || matches!(word, "lambda" | "class");
            if self.is_shared && (is_handed || is_sign(at + 1, &["("])) {
                self.team = None;
                for name in &self.global {
                    self.names.values.remove(name);
                }
            }
            let is_named = matches!(before, Some(PyToken::Word("as" | "class" | "def")));
            let is_target = at < targets && !is_sign(at + 1, &[".", "("]);
            if binds || is_named || is_target || is_sign(at + 1, &[":="]) {
                self.names.values.remove(word);
            }
        }
    }

    /// What an import brings isn't known: its names are forgotten.
    fn import(&mut self, tokens: &[PyToken<'t>]) {
        let names = &mut self.names.values;
        for token in tokens {
            match token {
                PyToken::Word(name) => drop(names.remove(name)),
                PyToken::Sign("*") => {
                    names.retain(|_, value| matches!(value, PyValue::Builder | PyValue::Config));
                }
                _ => {}
            }
        }
    }

    /// A statement without a block.
    fn simple(&mut self, tokens: &[PyToken<'t>], range: &Range<usize>) -> Result<Goes, Unreadable> {
        match tokens {
            [PyToken::Word("return"), ..] => return Ok(Goes::Back),
            [] | [PyToken::Text | PyToken::Word("pass")] => return Ok(Goes::On),
            [PyToken::Word("import" | "from"), ..] => {
                self.import(tokens);
                return Ok(Goes::On);
            }
            _ => {}
        }
        if let [PyToken::Word(name), PyToken::Sign(sign @ ("+=" | "-=" | "*=" | "/=")), rest @ ..] =
            tokens
        {
            let known = self.names.values.get(name).copied().ok_or(Unreadable)?;
            let sign = sign.trim_end_matches('=');
            let value = self.names.value(rest).and_then(|it| calculated(sign, known, it));
            self.names.values.insert(*name, value.ok_or(Unreadable)?);
            return Ok(Goes::On);
        }
        let parts = split(tokens, "=");
        match parts.split_last() {
            Some((value, targets)) if !targets.is_empty() => {
                for target in targets {
                    self.assign(target, value, range)?;
                }
            }
            _ => self.call(tokens)?,
        }
        Ok(Goes::On)
    }

    fn assign(
        &mut self,
        target: &[PyToken<'t>],
        value: &[PyToken<'t>],
        range: &Range<usize>,
    ) -> Result<(), Unreadable> {
        if let [PyToken::Word(name)] | [PyToken::Word(name), PyToken::Sign(":"), ..] = target {
            let value = self.names.value(value).ok_or(Unreadable)?;
            self.names.values.insert(*name, value);
            return Ok(());
        }
        let point = top_level(target).filter(|(_, it)| **it == PyToken::Sign(".")).last();
        let (of, setting) = target.split_at(point.ok_or(Unreadable)?.0);
        if self.names.value(of) != Some(PyValue::Config) {
            return Err(Unreadable);
        }
        self.set(setting.get(1..).unwrap_or_default(), value).ok_or(Unreadable)?;
        if matches!(setting, [_, PyToken::Word("game_engine_random_seed")]) {
            self.seed = Some(range.clone());
        }
        self.effects += 1;
        Ok(())
    }

    fn set(&mut self, setting: &[PyToken<'t>], value: &[PyToken<'t>]) -> Option<()> {
        if let [PyToken::Word("ball_position")] = setting {
            let [PyToken::Sign("[" | "("), inside @ .., PyToken::Sign("]" | ")")] = value else {
                return None;
            };
            let numbers = split(inside, ",").into_iter().map(|it| self.names.value(it)?.number());
            let numbers: Vec<f64> = numbers.collect::<Option<_>>()?;
            let ([x, y] | [x, y, _]) = numbers[..] else { return None };
            self.recorded.ball_position = [x, y];
            return Some(());
        }
        let value = self.names.value(value)?;
        if let [
            PyToken::Word("ball_position"),
            PyToken::Sign("["),
            PyToken::Whole(axis),
            PyToken::Sign("]"),
        ] = setting
        {
            // Its height has no effect on a text.
            let value = value.number()?;
            match usize::try_from(*axis).ok()? {
                2 => {}
                axis => *self.recorded.ball_position.get_mut(axis)? = value,
            }
            return Some(());
        }
        let [PyToken::Word(name)] = setting else { return None };
        let it = &mut self.recorded;
        let (flag, whole) = (value.whole().map(|it| it != 0), value.whole());
        match *name {
            "left_agents" => it.left_agents = whole?,
            "right_agents" => it.right_agents = whole?,
            "game_duration" => it.game_duration = whole?,
            "second_half" => it.second_half = whole?,
            "game_engine_random_seed" => it.game_engine_random_seed = whole?,
            "left_team_difficulty" => it.left_team_difficulty = value.number()?,
            "right_team_difficulty" => it.right_team_difficulty = value.number()?,
            "deterministic" => it.deterministic = flag?,
            "offsides" => it.offsides = flag?,
            "end_episode_on_score" => it.end_episode_on_score = flag?,
            "end_episode_on_out_of_play" => it.end_episode_on_out_of_play = flag?,
            "end_episode_on_possession_change" => it.end_episode_on_possession_change = flag?,
            "control_all_players" => it.control_all_players = flag?,
            "use_magnet" => it.use_magnet = flag?,
            "real_time" => it.real_time = flag?,
            // The order of the teams has no effect here.
            "reverse_team_processing" => drop(flag?),
            _ => return None,
        }
        Some(())
    }

    /// A call of one of the builder's methods.
    fn call(&mut self, tokens: &[PyToken<'t>]) -> Result<(), Unreadable> {
        let [
            PyToken::Word(builder),
            PyToken::Sign("."),
            PyToken::Word(method),
            PyToken::Sign("("),
            arguments @ ..,
            PyToken::Sign(")"),
        ] = tokens
        else {
            return Err(Unreadable);
        };
        if self.names.values.get(builder) != Some(&PyValue::Builder) {
            return Err(Unreadable);
        }
        let done = match *method {
            "SetTeam" => self.set_team(arguments),
            "SetBallPosition" => self.set_ball(arguments),
            "AddPlayer" => self.add_player(arguments),
            _ => None,
        };
        done.ok_or(Unreadable)
    }

    fn set_team(&mut self, arguments: &[PyToken<'t>]) -> Option<()> {
        let [team] = self.arguments(arguments, ["team"])?;
        self.team = Some(team?.team()?);
        Some(())
    }

    fn set_ball(&mut self, arguments: &[PyToken<'t>]) -> Option<()> {
        let [x, y] = self.arguments(arguments, ["x", "y"])?;
        self.recorded.ball_position = [x?.number()?, y?.number()?];
        self.effects += 1;
        Some(())
    }

    fn add_player(&mut self, arguments: &[PyToken<'t>]) -> Option<()> {
        let names = ["x", "y", "role", "lazy", "controllable"];
        let [x, y, role, lazy, controllable] = self.arguments(arguments, names)?;
        let flag = |given: Option<PyValue>, default: bool| match given {
            Some(value) => value.truth(),
            None => Some(default),
        };
        let player = GrfPlayer {
            place: [x?.number()?, y?.number()?],
            role: role?.role()?,
            lazy: flag(lazy, false)?,
            controllable: flag(controllable, true)?,
        };
        self.recorded.team_mut(self.team?).push(player);
        self.effects += 1;
        Some(())
    }

    /// The values of a call by their names; none where one is missing. None at all if one can't be
    /// read, or is given twice.
    fn arguments<const N: usize>(
        &self,
        tokens: &[PyToken<'t>],
        names: [&str; N],
    ) -> Option<[Option<PyValue>; N]> {
        let mut values = [None; N];
        let mut given = split(tokens, ",");
        // A comma may stand behind the last one.
        if given.last().is_some_and(|it| it.is_empty()) {
            given.pop();
        }
        for (position, argument) in given.into_iter().enumerate() {
            let (at, value) = match argument {
                [PyToken::Word(name), PyToken::Sign("="), value @ ..] => {
                    (names.iter().position(|known| known == name)?, value)
                }
                _ => (position, argument),
            };
            let value = self.names.value(value)?;
            if values.get_mut(at)?.replace(value).is_some() {
                return None;
            }
        }
        Some(values)
    }
}

/// An `if` with the `elif` and `else` that follow.
fn chain_at<'a, 't>(nodes: &'a [PyNode<'t>], at: usize) -> &'a [PyNode<'t>] {
    let rest = nodes.get(at..).unwrap_or_default();
    let is_part = |it: &&PyNode<'t>| matches!(it.line.word(), "elif" | "else");
    let parts = rest.iter().skip(1).take_while(is_part).count();
    rest.get(..=parts).unwrap_or(rest)
}
