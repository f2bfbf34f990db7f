//! Whether two scenarios have the same players and the same start.
//!
//! A register is compared by what it is computed from, not by its number: another limit moves the
//! numbers. Parameters are compared by name, so their values may differ.

use setpiece_scenario::{
    BallStart, Distribution, Instr, Kickoff, Over, Param, PlayerSlot, PlayerStart, Program, Reg,
    Scenario,
};
use std::collections::BTreeMap;
use std::mem::discriminant;

/// The first thing in which two scenarios' players and starts differ.
///
/// Parameters, difficulty, rewards, endings with the limit, agents, the observation, and who plays
/// players without an agent may differ.
pub(super) fn difference(one: &Scenario, other: &Scenario) -> Option<String> {
    let mut pair = Pair { sides: [one, other].map(StartProgram::of), known: BTreeMap::new() };
    if one.players.len() != other.players.len() {
        let counts = [one, other].map(|it| it.players.len());
        return Some(format!("the number of players, {} instead of {}", counts[0], counts[1]));
    }
    for (at, (player, known)) in one.players.iter().zip(&other.players).enumerate() {
        if !pair.are_same_players(player, known) {
            let (team, role) = (player.team.name(), player.role.name());
            return Some(format!("player {} (the {team} {role})", at + 1));
        }
    }
    let (start, known) = (&one.start, &other.start);
    if !pair.are_same_balls(&start.ball, &known.ball) {
        return Some("the ball's start".to_owned());
    }
    let rules = [start, known].map(|it| it.rules.iter().map(|it| (it.rule, it.value)).collect());
    let world = [start, known].map(|it| it.world.iter().map(|it| (it.figure, it.value)).collect());
    let pitch = [start, known].map(|it| it.pitch.iter().map(|it| (it.figure, it.value)).collect());
    let requires = [start, known].map(|it| it.requires.iter().map(|it| it.condition).collect());
    let chances = [start, known].map(|it| it.requires.iter().map(|it| it.probability).collect());
    let differs = [
        (start.kind != known.kind, "how play starts"),
        (!pair.same_option(start.taker, known.taker), "who takes the first ball"),
        (!pair.same_options(start.score, known.score), "the score at the start"),
        (!pair.same_option(start.elapsed, known.elapsed), "the clock at the start"),
        (!pair.are_same_kickoffs(start.kickoff.as_ref(), known.kickoff.as_ref()), "the kick-offs"),
        (!pair.same_settings(&rules), "the rules"),
        (!pair.same_settings(&world), "the world"),
        (!pair.same_settings(&pitch), "the pitch"),
        (!pair.same_option(start.rounds, known.rounds), "the rounds"),
        (!pair.same_lists(&requires), "what a start requires"),
        (!pair.same_option_lists(&chances), "what a start requires"),
    ];
    differs.into_iter().find(|(differs, _)| *differs).map(|(_, what)| what.to_owned())
}

/// A scenario's start program.
#[derive(Clone, Copy)]
struct StartProgram<'a> {
    program: &'a Program,
    params: &'a [Param],
}

impl StartProgram<'_> {
    fn of(scenario: &Scenario) -> StartProgram<'_> {
        StartProgram { program: &scenario.start.program, params: &scenario.params }
    }

    fn instr(&self, reg: Reg) -> Option<&Instr> {
        self.program.code.get(reg.index())
    }
}

/// Two start programs, and which of their registers are known to be the same or not.
struct Pair<'a> {
    sides: [StartProgram<'a>; 2],
    known: BTreeMap<(Reg, Reg), bool>,
}

impl Pair<'_> {
    fn are_same_players(&mut self, one: &PlayerSlot, other: &PlayerSlot) -> bool {
        // The name, who plays them without an agent, and the difficulty may differ.
        let PlayerSlot { team, instead, role, controllable, overlap, stats, start, .. } = one;
        let PlayerStart {
            x,
            y,
            heading,
            velocity,
            fatigue,
            yellow_cards,
            difficulty: _,
            present,
            active,
        } = start;
        let (known, place) = (other, &other.start);
        (*team, *instead, *role) == (known.team, known.instead, known.role)
            && (*controllable, *overlap) == (known.controllable, known.overlap)
            && self.same_settings(&[stats.clone(), known.stats.clone()])
            && self.same(*x, place.x)
            && self.same(*y, place.y)
            && self.same_options(*velocity, place.velocity)
            && [
                (*heading, place.heading),
                (*fatigue, place.fatigue),
                (*yellow_cards, place.yellow_cards),
                (*present, place.present),
                (*active, place.active),
            ]
            .into_iter()
            .all(|(one, other)| self.same_option(one, other))
    }

    fn are_same_balls(&mut self, one: &BallStart, other: &BallStart) -> bool {
        let BallStart { x, y, height, velocity, spin, owner } = *one;
        self.same(x, other.x)
            && self.same(y, other.y)
            && self.same_option(height, other.height)
            && self.same_triples(velocity, other.velocity)
            && self.same_triples(spin, other.spin)
            && self.same_option(owner, other.owner)
    }

    fn are_same_kickoffs(&mut self, one: Option<&Kickoff>, other: Option<&Kickoff>) -> bool {
        let (Some(one), Some(other)) = (one, other) else {
            return one.is_none() && other.is_none();
        };
        let places = |it: &Kickoff| -> Vec<Reg> {
            let each = it.places.iter().flat_map(|it| [it.kicking, it.receiving]);
            each.flat_map(|(x, y)| [x, y]).collect()
        };
        self.same(one.first, other.first) && self.same_lists(&[places(one), places(other)])
    }

    fn same_settings<K: PartialEq>(&mut self, [one, other]: &[Vec<(K, Reg)>; 2]) -> bool {
        one.len() == other.len()
            && one
                .iter()
                .zip(other)
                .all(|((key, reg), (known, place))| key == known && self.same(*reg, *place))
    }

    fn same_lists(&mut self, [one, other]: &[Vec<Reg>; 2]) -> bool {
        one.len() == other.len()
            && one.iter().zip(other).all(|(one, other)| self.same(*one, *other))
    }

    fn same_option_lists(&mut self, [one, other]: &[Vec<Option<Reg>>; 2]) -> bool {
        one.len() == other.len()
            && one.iter().zip(other).all(|(one, other)| self.same_option(*one, *other))
    }

    fn same_option(&mut self, one: Option<Reg>, other: Option<Reg>) -> bool {
        match (one, other) {
            (Some(one), Some(other)) => self.same(one, other),
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    fn same_options(&mut self, one: Option<(Reg, Reg)>, other: Option<(Reg, Reg)>) -> bool {
        match (one, other) {
            (Some((x, y)), Some((to_x, to_y))) => self.same(x, to_x) && self.same(y, to_y),
            (one, other) => one.is_none() && other.is_none(),
        }
    }

    fn same_triples(
        &mut self,
        one: Option<(Reg, Reg, Reg)>,
        other: Option<(Reg, Reg, Reg)>,
    ) -> bool {
        let pair = |it: Option<(Reg, Reg, Reg)>| it.map(|(x, y, _)| (x, y));
        let last = |it: Option<(Reg, Reg, Reg)>| it.map(|(_, _, z)| z);
        self.same_options(pair(one), pair(other)) && self.same_option(last(one), last(other))
    }

    /// Whether two registers are computed in the same way. Registers are read only by later ones,
    /// so the walk ends, and each pair is compared once.
    fn same(&mut self, one: Reg, other: Reg) -> bool {
        if let Some(known) = self.known.get(&(one, other)) {
            return *known;
        }
        // An element of a loop reads the loop's own register: they are the same if the rest is.
        self.known.insert((one, other), true);
        let is_same = self.are_same_instrs(one, other);
        self.known.insert((one, other), is_same);
        is_same
    }

    fn are_same_instrs(&mut self, one: Reg, other: Reg) -> bool {
        let [side, known] = self.sides;
        let (Some(first), Some(second)) = (side.instr(one), known.instr(other)) else {
            return false;
        };
        let name = |side: StartProgram<'_>, at: u32| {
            side.params.get(at as usize).map(|it| it.name.clone())
        };
        let table = |side: StartProgram<'_>, at: u32| side.program.tables.get(at as usize).cloned();
        let is_same = match (first, second) {
            (Instr::Param(first), Instr::Param(second)) => {
                name(side, *first) == name(known, *second)
            }
            (Instr::Unary(first, _), Instr::Unary(second, _)) => first == second,
            (Instr::Binary(first, ..), Instr::Binary(second, ..)) => first == second,
            (Instr::Select(..), Instr::Select(..)) => true,
            (
                Instr::Table { table: first, linear, .. },
                Instr::Table { table: second, linear: known_linear, .. },
            ) => linear == known_linear && table(side, *first) == table(known, *second),
            (Instr::Random { key, from }, Instr::Random { key: known_key, from: known_from }) => {
                let count = |from: &Distribution| match from {
                    Distribution::Weighted(weights) => weights.len(),
                    _ => 0,
                };
                key == known_key
                    && discriminant(&**from) == discriminant(&**known_from)
                    && count(from) == count(known_from)
            }
            (Instr::Each(first), Instr::Each(second)) => {
                let is_same_over = match (&first.over, &second.over) {
                    (Over::Numbers(first), Over::Numbers(second)) => first == second,
                    (Over::Players { .. }, Over::Players { .. }) => true,
                    // A start has no events.
                    _ => false,
                };
                is_same_over
                    && (first.body, first.fold.kind) == (second.body, second.fold.kind)
                    && self.same_option(first.fold.value, second.fold.value)
                    && self.same_option(first.fold.guard, second.fold.guard)
                    && (1..=first.body)
                        .all(|step| self.same(Reg(one.0 + step), Reg(other.0 + step)))
            }
            (first, second) => first == second,
        };
        is_same && self.same_operands(first, second)
    }

    fn same_operands(&mut self, first: &Instr, second: &Instr) -> bool {
        let read = |instr: &Instr| {
            let mut regs = Vec::new();
            instr.operands(&mut |reg| regs.push(reg));
            regs
        };
        self.same_lists(&[read(first), read(second)])
    }
}
