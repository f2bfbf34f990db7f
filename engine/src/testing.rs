//! Test helpers that build programs and scenarios by hand.

use crate::judge::MatchView;
use crate::judge::machine::{Crew, DrawKey, Input, Machine, Registers};
use crate::judge::view::Sight;
use crate::state::PlayerId;
use crate::state::event::Event;
use glam::Vec3;
use setpiece_scenario::vocabulary::{EventKind, Role, StartKind, Team};
use setpiece_scenario::*;

/// Writes a program instruction by instruction.
#[derive(Default)]
pub(crate) struct Code {
    pub(crate) program: Program,
}

impl Code {
    pub(crate) fn push(&mut self, instr: Instr) -> Reg {
        self.program.code.push(instr);
        Reg(self.program.code.len() as u32 - 1)
    }

    pub(crate) fn number(&mut self, value: f64) -> Reg {
        self.push(Instr::Const(value))
    }

    pub(crate) fn unary(&mut self, op: UnaryOp, a: Reg) -> Reg {
        self.push(Instr::Unary(op, a))
    }

    pub(crate) fn binary(&mut self, op: BinaryOp, a: Reg, b: Reg) -> Reg {
        self.push(Instr::Binary(op, a, b))
    }

    pub(crate) fn load(&mut self, field: Field) -> Reg {
        self.push(Instr::Load { field, of: None, when: When::Now })
    }

    pub(crate) fn load_of(&mut self, field: Field, of: Reg) -> Reg {
        self.push(Instr::Load { field, of: Some(of), when: When::Now })
    }

    pub(crate) fn cell(&mut self) -> u32 {
        self.program.cells += 1;
        self.program.cells - 1
    }

    /// Loops over the events of a kind by a team, paying `value` for each into `term`.
    pub(crate) fn give_on(&mut self, kind: EventKind, by: Reg, value: f64, term: u32) {
        let value = self.number(value);
        let filter = EventFilter { kind, qualifier: None, by: Some(Who::Team(by)), to: None };
        let fold = Fold { kind: FoldKind::Nothing, value: None, guard: None };
        self.push(Instr::Each(Box::new(Each { over: Over::Events(filter), body: 1, fold })));
        self.push(Instr::Give { term, value, guard: None });
    }
}

/// The state that a program leaves behind.
#[derive(Debug, PartialEq)]
pub(crate) struct Left {
    pub(crate) regs: Vec<f64>,
    pub(crate) terms: Vec<f64>,
    pub(crate) faults: u32,
}

/// Runs a program once on memory that the caller keeps.
pub(crate) fn run(
    program: &Program,
    now: &MatchView,
    prev: &MatchView,
    events: &[Event],
    cells: &mut [f64],
    silent: bool,
) -> Left {
    let mut regs = Registers::of(program);
    let mut lanes: Vec<[f64; 1]> = cells.iter().map(|cell| [*cell]).collect();
    let (mut terms, mut faults) = (vec![[0.0]; 4], 0);
    let (plan, values, points) = regs.parts();
    let mut machine = Machine {
        input: Input {
            now: Some(Sight::Kept(now)),
            prev: Some(Sight::Kept(prev)),
            events,
            params: &[7.0],
            lets: &[],
            index: 3,
            us: Team::Left,
            round: 1,
            round_start: 0,
            terminated: false,
            silent,
        },
        plan,
        crew: Crew::one(Some(PlayerId(1))),
        regs: values,
        points,
        cells: &mut lanes,
        terms: &mut terms,
        faults: &mut faults,
        draws: Some(DrawKey { seed: 1, index: 0, attempt: 0 }),
    };
    machine.begin();
    machine.run();
    for (cell, lane) in cells.iter_mut().zip(&lanes) {
        *cell = lane[0];
    }
    let regs = (0..program.code.len()).map(|at| regs.value(Reg(at as u32))).collect();
    Left { regs, terms: terms.iter().map(|term| term[0]).collect(), faults }
}

pub(crate) fn event(kind: EventKind, team: Option<Team>, by: Option<u8>) -> Event {
    Event {
        tick: 0,
        kind,
        qualifier: None,
        team,
        by: by.map(PlayerId),
        to: None,
        at: Vec3::ZERO,
        length_m: 0.0,
        speed_mps: 0.0,
    }
}

/// A view with the left keeper at the goal and players 1 and 12 at the given places, metres.
pub(crate) fn view(left: [f32; 2], right: [f32; 2], ball: [f32; 3]) -> MatchView {
    let mut view = MatchView { ball, ..MatchView::EMPTY };
    for (id, pos, role) in [(0, [-55.0, 0.0], Role::GK), (1, left, Role::CM), (12, right, Role::CB)]
    {
        let player = &mut view.players[id];
        (player.present, player.active, player.pos, player.role) = (true, true, pos, role);
    }
    view
}

/// A scenario with these players at constant places, the ball at the centre and a limit of 50
/// steps; one left agent.
pub(crate) fn scenario(players: &[(Team, Role, f64, f64)]) -> Scenario {
    let mut code = Code::default();
    let zero = code.number(0.0);
    let one = code.number(1.0);
    let limit = code.number(5.0);
    let slots = players
        .iter()
        .map(|&(team, role, x, y)| PlayerSlot {
            team,
            role,
            name: None,
            ai: Ai::Bot,
            sometimes: Vec::new(),
            instead: false,
            controllable: role != Role::GK,
            overlap: false,
            stats: Vec::new(),
            start: PlayerStart {
                x: code.number(x),
                y: code.number(y),
                heading: None,
                velocity: None,
                fatigue: None,
                yellow_cards: None,
                difficulty: None,
                present: None,
                active: None,
            },
        })
        .collect();
    Scenario {
        name: "test".to_owned(),
        doc: String::new(),
        params: Vec::new(),
        scripts: Vec::new(),
        players: slots,
        agents: Agents {
            sides: [SideAgents::Count(one), SideAgents::Count(zero)],
            others: Others::Bot,
            switching: Switching::Auto,
        },
        start: Start {
            program: code.program,
            lets: Vec::new(),
            ball: BallStart {
                x: zero,
                y: zero,
                height: None,
                velocity: None,
                spin: None,
                owner: None,
            },
            kind: StartKind::Open,
            taker: None,
            score: None,
            elapsed: None,
            kickoff: None,
            difficulty: [one, one],
            rules: Vec::new(),
            world: Vec::new(),
            pitch: Vec::new(),
            limit: Some(limit),
            rounds: None,
            requires: Vec::new(),
        },
        rewards: Vec::new(),
        library: Vec::new(),
        endings: Endings::default(),
        records: Vec::new(),
        observation: None,
        behaviors: Vec::new(),
    }
}

/// +1 for our goals, -1 for theirs.
pub(crate) fn scoring() -> Reward {
    let mut code = Code::default();
    let us = code.push(Instr::Us);
    let them = code.unary(UnaryOp::OtherTeam, us);
    code.give_on(EventKind::Goal, us, 1.0, 0);
    code.give_on(EventKind::Goal, them, -1.0, 1);
    Reward {
        name: "scoring".to_owned(),
        doc: String::new(),
        body: RewardBody {
            init: Program::default(),
            step: code.program,
            terms: vec!["1".to_owned(), "2".to_owned()],
            hooks: Vec::new(),
        },
    }
}

/// The checkpoints of the standard library with 10 regions of 0.1, as the compiler would write
/// them.
pub(crate) fn checkpoints() -> Reward {
    let mut code = Code::default();
    let collected = code.cell();
    let us = code.push(Instr::Us);
    let side = code.unary(UnaryOp::Side, us);
    let (ball_x, ball_y) = (code.load(Field::BallX), code.load(Field::BallY));
    let scale_x = code.number(pitch::X_SCALE_M);
    let scale_y = code.number(pitch::Y_SCALE_M);
    let x = code.binary(BinaryOp::Div, ball_x, scale_x);
    let y = code.binary(BinaryOp::Div, ball_y, scale_y);
    let x = code.binary(BinaryOp::Mul, x, side);
    let one = code.number(1.0);
    let dx = code.binary(BinaryOp::Sub, x, one);
    let d = code.binary(BinaryOp::Hypot, dx, y);
    let outer = code.number(0.99);
    let gap = code.number(0.8 / 9.0);
    let inside = code.binary(BinaryOp::Sub, outer, d);
    let share = code.binary(BinaryOp::Div, inside, gap);
    let whole = code.unary(UnaryOp::Floor, share);
    let reached = code.binary(BinaryOp::Add, whole, one);
    let zero = code.number(0.0);
    let reached = code.binary(BinaryOp::Max, reached, zero);
    let regions = code.number(10.0);
    let reached = code.binary(BinaryOp::Min, reached, regions);
    let me = code.push(Instr::Me);
    let owner = code.load(Field::BallOwner);
    let has = code.binary(BinaryOp::Eq, me, owner);
    let here = code.unary(UnaryOp::Exists, me);
    let has = code.binary(BinaryOp::And, has, here);
    let before = code.push(Instr::Cell(collected));
    let more = code.binary(BinaryOp::Gt, reached, before);
    let guard = Some(code.binary(BinaryOp::And, has, more));
    let n = code.binary(BinaryOp::Sub, reached, before);
    let each = code.number(0.1);
    let value = code.binary(BinaryOp::Mul, n, each);
    code.push(Instr::Give { term: 0, value, guard });
    code.push(Instr::Assign { cell: collected, value: reached, guard });
    let filter =
        EventFilter { kind: EventKind::Goal, qualifier: None, by: Some(Who::Team(us)), to: None };
    let fold = Fold { kind: FoldKind::Nothing, value: None, guard: None };
    code.push(Instr::Each(Box::new(Each { over: Over::Events(filter), body: 5, fold })));
    let before = code.push(Instr::Cell(collected));
    let rest = code.binary(BinaryOp::Sub, regions, before);
    let value = code.binary(BinaryOp::Mul, rest, each);
    code.push(Instr::Give { term: 1, value, guard: None });
    code.push(Instr::Assign { cell: collected, value: regions, guard: None });
    Reward {
        name: "checkpoints".to_owned(),
        doc: String::new(),
        body: RewardBody {
            init: Program { code: Vec::new(), cells: 1, ..Program::default() },
            step: code.program,
            terms: vec!["region".to_owned(), "rest".to_owned()],
            hooks: Vec::new(),
        },
    }
}
