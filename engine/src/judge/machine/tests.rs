use crate::judge::MatchView;
use crate::random::{Purpose, Stream};
use crate::testing::{Code, event, run, view};
use setpiece_scenario::vocabulary::{EventKind, Field, Qualifier, Team};
use setpiece_scenario::*;
use std::f64::consts::PI;

fn value(build: impl FnOnce(&mut Code) -> Reg) -> f64 {
    let mut code = Code::default();
    let reg = build(&mut code);
    run(&code.program, &MatchView::EMPTY, &MatchView::EMPTY, &[], &mut [0.0; 4], false).regs
        [reg.index()]
}

fn binary(op: BinaryOp, a: f64, b: f64) -> f64 {
    value(|code| {
        let (a, b) = (code.number(a), code.number(b));
        code.binary(op, a, b)
    })
}

fn unary(op: UnaryOp, a: f64) -> f64 {
    value(|code| {
        let a = code.number(a);
        code.unary(op, a)
    })
}

#[test]
fn operators_of_two() {
    assert_eq!(binary(BinaryOp::Mod, -1.0, 3.0), 2.0);
    assert_eq!(binary(BinaryOp::Mod, 1.0, -3.0), -2.0);
    assert_eq!(binary(BinaryOp::Mod, 6.0, 3.0), 0.0);
    assert!(binary(BinaryOp::Mod, 1.0, 0.0).is_nan());
    assert!(binary(BinaryOp::Div, 1.0, 0.0).is_nan());
    assert_eq!(binary(BinaryOp::Hypot, 3.0, 4.0), 5.0);
    assert_eq!(binary(BinaryOp::Pow, 2.0, 10.0), 1024.0);
    assert!((binary(BinaryOp::Atan2, 1.0, 0.0) - PI / 2.0).abs() < 1e-15);
    assert_eq!(binary(BinaryOp::Min, 2.0, 1.0), 1.0);
    assert_eq!(binary(BinaryOp::Max, 2.0, 1.0), 2.0);
}

#[test]
fn operators_of_one() {
    assert!(unary(UnaryOp::Sqrt, -1.0).is_nan());
    assert!(unary(UnaryOp::Log, 0.0).is_nan());
    assert_eq!(unary(UnaryOp::Round, -2.5), -3.0);
    assert_eq!(unary(UnaryOp::Side, 1.0), -1.0);
    assert!(unary(UnaryOp::Side, -1.0).is_nan());
    assert_eq!(unary(UnaryOp::OtherTeam, 0.0), 1.0);
    assert_eq!(unary(UnaryOp::OtherTeam, -1.0), -1.0);
    assert_eq!(unary(UnaryOp::TeamOf, 11.0), 1.0);
    assert_eq!(unary(UnaryOp::TeamOf, -1.0), -1.0);
    assert_eq!(unary(UnaryOp::TeamOf, 22.0), -1.0);
    assert!((unary(UnaryOp::Wrap, 1.5 * PI) + PI / 2.0).abs() < 1e-12);
    assert!((unary(UnaryOp::Wrap, -3.0 * PI) - PI).abs() < 1e-12);
}

#[test]
fn nan_flows_compares_false_and_is_dropped_by_the_other_branch() {
    let nan = |code: &mut Code| {
        let minus = code.number(-1.0);
        code.unary(UnaryOp::Sqrt, minus)
    };
    for op in [BinaryOp::Add, BinaryOp::Min, BinaryOp::Max, BinaryOp::Mul] {
        let mixed = value(|code| {
            let (nan, one) = (nan(code), code.number(1.0));
            code.binary(op, one, nan)
        });
        assert!(mixed.is_nan(), "{op:?}");
    }
    for op in [BinaryOp::Lt, BinaryOp::Ge, BinaryOp::Eq, BinaryOp::Ne] {
        let compared = value(|code| {
            let nan = nan(code);
            code.binary(op, nan, nan)
        });
        assert_eq!(compared, 0.0, "{op:?}");
    }
    let chosen = value(|code| {
        let (nan, one, zero) = (nan(code), code.number(1.0), code.number(0.0));
        code.push(Instr::Select(zero, nan, one))
    });
    assert_eq!(chosen, 1.0);
    let doubted = value(|code| {
        let (nan, one, two) = (nan(code), code.number(1.0), code.number(2.0));
        code.push(Instr::Select(nan, one, two))
    });
    assert_eq!(doubted, 2.0);
}

#[test]
fn effects_of_nan_do_nothing_and_are_counted() {
    let mut code = Code::default();
    let cell = code.cell();
    let one = code.number(1.0);
    let nobody = code.number(-1.0);
    let x = code.load_of(Field::PlayerX, nobody);
    code.push(Instr::Give { term: 0, value: x, guard: None });
    code.push(Instr::Give { term: 1, value: one, guard: None });
    code.push(Instr::Assign { cell, value: x, guard: None });
    let guard = Some(code.number(0.0));
    code.push(Instr::Give { term: 0, value: x, guard });
    let mut cells = [5.0];
    let left = run(&code.program, &MatchView::EMPTY, &MatchView::EMPTY, &[], &mut cells, false);
    assert_eq!((left.terms[0], left.terms[1], left.faults, cells[0]), (0.0, 1.0, 2, 5.0));
    let silent = run(&code.program, &MatchView::EMPTY, &MatchView::EMPTY, &[], &mut cells, true);
    assert_eq!((silent.terms[1], silent.faults, cells[0]), (0.0, 0, 5.0));
}

/// The values of a temporal instruction over a series; the first entry is the silent run on the
/// start state.
fn series(conditions: &[[bool; 2]], build: impl FnOnce(&mut Code, Reg, Reg) -> Reg) -> Vec<f64> {
    let mut code = Code::default();
    // The conditions are read from the ball's height and its vertical speed.
    let (height, speed) = (code.load(Field::BallHeight), code.load(Field::BallVz));
    let reg = build(&mut code, height, speed);
    let mut cells = [0.0; 2];
    let mut values = Vec::new();
    for (step, [first, second]) in conditions.iter().enumerate() {
        let now = MatchView {
            ball: [0.0, 0.0, f32::from(*first)],
            ball_vel: [0.0, 0.0, f32::from(*second)],
            ..MatchView::EMPTY
        };
        values.push(run(&code.program, &now, &now, &[], &mut cells, step == 0).regs[reg.index()]);
    }
    values
}

fn flags(text: &str) -> Vec<[bool; 2]> {
    text.chars().map(|c| [c == '1', false]).collect()
}

#[test]
fn temporal_series() {
    let held = |code: &mut Code, of, _| {
        let (seconds, cell) = (code.number(0.3), code.cell());
        code.push(Instr::Held { of, seconds, cell })
    };
    // Three states in a row; the start counts as one.
    assert_eq!(series(&flags("1101110"), held), [0., 0., 0., 0., 0., 1., 0.]);
    assert_eq!(series(&flags("1110"), held), [0., 0., 1., 0.]);
    let ever = |code: &mut Code, of, _| {
        let cell = code.cell();
        code.push(Instr::Ever { of, cell })
    };
    assert_eq!(series(&flags("0010"), ever), [0., 0., 1., 1.]);
    assert_eq!(series(&flags("10"), ever), [1., 1.]);
    let since = |code: &mut Code, of, _| {
        let cell = code.cell();
        code.push(Instr::Since { of, cell })
    };
    let inf = f64::INFINITY;
    assert_eq!(series(&flags("001001"), since), [inf, inf, 0., 0.1, 0.2, 0.]);
    let once = |code: &mut Code, of, _| {
        let cell = code.cell();
        code.push(Instr::Once { of, cell })
    };
    // Never on the start state, though it holds there.
    assert_eq!(series(&flags("101"), once), [0., 0., 1.]);
    assert_eq!(series(&flags("1111"), once), [0., 1., 0., 0.]);
}

#[test]
fn a_value_before_is_that_of_the_last_step_that_had_one() {
    let before = |code: &mut Code, of, there| {
        // Without a value where the second is 0.
        let value = code.push(Instr::Binary(BinaryOp::Div, of, there));
        let cell = code.cell();
        code.push(Instr::Before { of: value, cell })
    };
    let states = [[true, true], [false, true], [true, true], [false, false], [false, true]];
    assert_eq!(series(&states, before), [1., 1., 0., 1., 1.]);
}

#[test]
fn until_is_decided_once() {
    let until = |code: &mut Code, of, release| {
        let cell = code.cell();
        code.push(Instr::Until { of, release, cell })
    };
    let kept = [[true, false], [true, false], [false, true], [false, false]];
    assert_eq!(series(&kept, until), [1., 1., 1., 1.]);
    let broken = [[true, false], [false, false], [true, true]];
    assert_eq!(series(&broken, until), [1., 0., 0.]);
}

#[test]
fn loads_read_now_and_prev() {
    let mut code = Code::default();
    let now = code.load(Field::BallX);
    let prev = code.push(Instr::Load { field: Field::BallX, of: None, when: When::Prev });
    let delta = code.binary(BinaryOp::Sub, now, prev);
    let (a, b) = (
        MatchView { ball: [3.0, 0.0, 0.0], ..MatchView::EMPTY },
        MatchView { ball: [1.0, 0.0, 0.0], ..MatchView::EMPTY },
    );
    assert_eq!(run(&code.program, &a, &b, &[], &mut [], false).regs[delta.index()], 2.0);
}

fn folded(kind: FoldKind, team: f64) -> f64 {
    let mut code = Code::default();
    let team = code.number(team);
    let fold = Fold { kind, value: Some(Reg(2)), guard: None };
    let each = code.push(Instr::Each(Box::new(Each {
        over: Over::Players { team, except: None },
        body: 1,
        fold,
    })));
    code.load_of(Field::PlayerX, each);
    let now = view([10.0, 0.0], [20.0, 0.0], [0.0; 3]);
    run(&code.program, &now, &now, &[], &mut [], false).regs[each.index()]
}

#[test]
fn folds_over_players() {
    assert_eq!(folded(FoldKind::Count, 0.0), 2.0);
    assert_eq!(folded(FoldKind::Count, -1.0), 3.0);
    assert_eq!(folded(FoldKind::Sum, -1.0), -25.0);
    assert_eq!(folded(FoldKind::Mean, 0.0), -22.5);
    assert_eq!(folded(FoldKind::Min, 0.0), -55.0);
    assert_eq!(folded(FoldKind::Max, 0.0), 10.0);
    assert_eq!(folded(FoldKind::ArgMax, -1.0), 12.0);
    assert_eq!(folded(FoldKind::ArgMin, -1.0), 0.0);
    assert_eq!(folded(FoldKind::All, 0.0), 1.0);
}

#[test]
fn folds_over_nobody() {
    let none = |kind| {
        value(|code| {
            let team = code.number(0.0);
            let fold = Fold { kind, value: Some(Reg(2)), guard: None };
            let each = code.push(Instr::Each(Box::new(Each {
                over: Over::Players { team, except: None },
                body: 1,
                fold,
            })));
            code.number(1.0);
            each
        })
    };
    assert_eq!(
        [none(FoldKind::Sum), none(FoldKind::Any), none(FoldKind::All), none(FoldKind::ArgMin)],
        [0., 0., 1., -1.]
    );
    assert!(
        none(FoldKind::Mean).is_nan()
            && none(FoldKind::Min).is_nan()
            && none(FoldKind::Max).is_nan()
    );
}

#[test]
fn loops_nest() {
    // For each of ours, how many of theirs stand further right: 1 each.
    let mut code = Code::default();
    let (ours, theirs) = (code.number(0.0), code.number(1.0));
    let count = Fold { kind: FoldKind::Count, value: None, guard: Some(Reg(6)) };
    let sum = Fold { kind: FoldKind::Sum, value: Some(Reg(4)), guard: None };
    let outer = code.push(Instr::Each(Box::new(Each {
        over: Over::Players { team: ours, except: None },
        body: 4,
        fold: sum,
    })));
    let own_x = code.load_of(Field::PlayerX, outer);
    let inner = code.push(Instr::Each(Box::new(Each {
        over: Over::Players { team: theirs, except: None },
        body: 2,
        fold: count,
    })));
    let x = code.load_of(Field::PlayerX, inner);
    code.binary(BinaryOp::Gt, x, own_x);
    let now = view([10.0, 0.0], [20.0, 0.0], [0.0; 3]);
    assert_eq!(run(&code.program, &now, &now, &[], &mut [], false).regs[outer.index()], 2.0);
}

fn counted(filter: EventFilter, events: &[crate::state::event::Event]) -> f64 {
    let mut code = Code::default();
    // The filters of the tests read registers 0 and 1.
    code.number(0.0);
    code.number(1.0);
    let fold = Fold { kind: FoldKind::Count, value: None, guard: None };
    let each = code.push(Instr::Each(Box::new(Each { over: Over::Events(filter), body: 0, fold })));
    run(&code.program, &MatchView::EMPTY, &MatchView::EMPTY, events, &mut [], false).regs
        [each.index()]
}

#[test]
fn events_are_filtered() {
    let left = Some(Team::Left);
    let filter = |kind, qualifier, by| EventFilter { kind, qualifier, by, to: None };
    let goals = [event(EventKind::Goal, left, Some(1)), event(EventKind::Goal, left, Some(12))];
    assert_eq!(counted(filter(EventKind::Goal, None, Some(Who::Team(Reg(0)))), &goals), 2.0);
    // The second is an own goal: a goal for the team, but not of any player.
    assert_eq!(counted(filter(EventKind::Goal, None, Some(Who::Player(Reg(1)))), &goals), 1.0);
    let taken = crate::state::event::Event {
        qualifier: Some(Qualifier::Taken),
        ..event(EventKind::Corner, left, None)
    };
    let corners = [event(EventKind::Corner, left, None), taken];
    assert_eq!(counted(filter(EventKind::Corner, None, None), &corners), 1.0);
    assert_eq!(counted(filter(EventKind::Corner, Some(Qualifier::Taken), None), &corners), 1.0);
    let end = crate::state::event::Event {
        qualifier: Some(Qualifier::Success),
        ..event(EventKind::End, None, None)
    };
    assert_eq!(counted(filter(EventKind::End, None, None), &[end]), 1.0);
    assert_eq!(counted(filter(EventKind::End, Some(Qualifier::Failure), None), &[end]), 0.0);
}

#[test]
fn draws_stay_within_their_ends_and_are_keyed_by_name() {
    let drawn = |key, from: fn(Reg, Reg) -> Distribution| {
        value(|code| {
            let (low, high) = (code.number(-1.0), code.number(2.0));
            code.push(Instr::Random { key, from: Box::new(from(low, high)) })
        })
    };
    let mut seen = [0; 4];
    for key in 0..400 {
        let share = drawn(key, Distribution::Uniform);
        assert!((-1.0..2.0).contains(&share));
        let whole = drawn(key, Distribution::Integer);
        assert!(whole.fract() == 0.0 && (-1.0..=2.0).contains(&whole));
        seen[(whole + 1.0) as usize] += 1;
        let cut = drawn(key, |low, high| Distribution::TruncatedNormal(low, high, low, high));
        assert!((-1.0..=2.0).contains(&cut));
    }
    assert!(seen.iter().all(|&n| n > 60), "{seen:?}");
    assert_ne!(drawn(1, Distribution::Uniform), drawn(2, Distribution::Uniform));
    assert_eq!(drawn(1, Distribution::Uniform), drawn(1, Distribution::Uniform));
}

#[test]
fn weights_choose_in_proportion() {
    let mut seen = [0; 3];
    for key in 0..2000 {
        let chosen = value(|code| {
            let weights = [3.0, 0.0, 1.0].map(|weight| code.number(weight));
            code.push(Instr::Random {
                key,
                from: Box::new(Distribution::Weighted(weights.to_vec())),
            })
        });
        seen[chosen as usize] += 1;
    }
    assert_eq!(seen[1], 0);
    assert!((1400..1600).contains(&seen[0]), "{seen:?}");
}

#[test]
fn every_operator_runs_as_it_is_folded() {
    let values = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.1,
        2.5,
        -2.5,
        11.0,
        21.0,
        22.0,
        PI,
        -PI,
        1e300,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::NAN,
    ];
    let same = |one: f64, other: f64| one == other || (one.is_nan() && other.is_nan());
    for op in UnaryOp::ALL.iter().copied().filter(|op| *op != UnaryOp::Exists) {
        for a in values {
            let folded = op.fold(a).unwrap();
            assert!(same(unary(op, a), folded), "{op:?} of {a}: {folded}");
        }
    }
    for op in BinaryOp::ALL.iter().copied() {
        for a in values {
            for b in values {
                let folded = op.apply(a, b);
                assert!(same(binary(op, a, b), folded), "{op:?} of {a} and {b}: {folded}");
            }
        }
    }
}

/// A program with a loop over numbers, and the loop's register. With `one_by_one` effects in its
/// body have it run for one number at a time.
///
/// Its body computes from the number, from what stands outside, and in two loops of its own: over
/// players, whose values don't depend on the number but for one, and over numbers.
fn over_numbers(count: u32, kind: FoldKind, random: &mut Stream, one_by_one: bool) -> (Code, Reg) {
    let mut code = Code::default();
    code.program.tables.push(Table { columns: 2, values: vec![0.0, 1.5, -2.0, 4.0] });
    let cell = code.cell();
    let mut known = vec![code.number(0.7), code.number(-1.0), code.push(Instr::Me)];
    known.push(code.push(Instr::Us));
    known.push(code.load(Field::BallX));
    let each = |over, fold| Instr::Each(Box::new(Each { over, body: 0, fold }));
    let close = |code: &mut Code, at: Reg, fold: Fold| {
        let body = (code.program.code.len() - at.index() - 1) as u32;
        if let Instr::Each(each) = &mut code.program.code[at.index()] {
            (each.body, each.fold) = (body, fold);
        }
    };
    let any = |known: &[Reg], random: &mut Stream| known[random.below(known.len() as u32) as usize];
    let compute = |code: &mut Code, known: &mut Vec<Reg>, random: &mut Stream| {
        for _ in 0..random.below(8) {
            let [a, b, c] = [0; 3].map(|_| any(known, random));
            let two = BinaryOp::ALL[random.below(BinaryOp::ALL.len() as u32) as usize];
            let one = UnaryOp::ALL[random.below(UnaryOp::ALL.len() as u32) as usize];
            known.push(code.push(match random.below(7) {
                0 => Instr::Unary(one, a),
                1 => Instr::Select(a, b, c),
                2 => Instr::Table { table: 0, x: a, y: b, linear: random.below(2) == 0 },
                3 => Instr::Load { field: Field::PlayerX, of: Some(a), when: When::Now },
                4 => Instr::Cell(cell),
                _ => Instr::Binary(two, a, b),
            }));
        }
    };
    let nothing = Fold { kind: FoldKind::Nothing, value: None, guard: None };
    compute(&mut code, &mut known, random);
    let outer = code.push(each(Over::Numbers(count), nothing.clone()));
    known.push(outer);
    compute(&mut code, &mut known, random);
    let overs =
        [Over::Players { team: known[1], except: Some(known[2]) }, Over::Numbers(1 + count % 4)];
    for over in overs {
        let inner = code.push(each(over, nothing.clone()));
        let mut inside = known.clone();
        inside.push(inner);
        let x = code.load_of(Field::PlayerX, inner);
        inside.extend([x, code.binary(BinaryOp::Sub, x, outer)]);
        compute(&mut code, &mut inside, random);
        let guard = (random.below(2) == 0).then(|| any(&inside, random));
        let kind = if random.below(2) == 0 { FoldKind::Min } else { FoldKind::Sum };
        if one_by_one {
            let unused = code.cell();
            code.push(Instr::Assign { cell: unused, value: Reg(0), guard: None });
        }
        close(&mut code, inner, Fold { kind, value: Some(any(&inside, random)), guard });
        known.push(inner);
    }
    compute(&mut code, &mut known, random);
    let guard = (random.below(2) == 0).then(|| any(&known, random));
    let value = Some(any(&known, random));
    close(&mut code, outer, Fold { kind, value, guard });
    (code, outer)
}

#[test]
fn numbers_in_lanes_give_the_same_bits_as_one_by_one() {
    let kinds = [
        FoldKind::Count,
        FoldKind::Sum,
        FoldKind::Mean,
        FoldKind::Min,
        FoldKind::Max,
        FoldKind::Any,
        FoldKind::All,
        FoldKind::ArgMin,
        FoldKind::ArgMax,
    ];
    let now = view([10.0, 3.0], [20.0, -4.0], [0.3, 0.0, 0.0]);
    let mut finite = 0;
    for case in 0..4000 {
        let count = [1, 5, 11, 12, 13, 24, 40][case as usize % 7];
        let kind = kinds[case as usize % kinds.len()];
        let [together, one_by_one] = [false, true].map(|one_by_one| {
            let random = &mut Stream::new(case, 0, Purpose::Draw);
            let (code, reg) = over_numbers(count, kind, random, one_by_one);
            let plan = super::Plan::of(&code.program, 1);
            assert_eq!(plan.has_points(), !one_by_one, "{case}");
            let left = run(&code.program, &now, &now, &[], &mut [2.0, 0.0, 0.0], false);
            left.regs[reg.index()]
        });
        let same = together.to_bits() == one_by_one.to_bits();
        assert!(same || (together.is_nan() && one_by_one.is_nan()), "{case}: {together}");
        finite += u32::from(together.is_finite() && together != 0.0);
    }
    assert!(finite > 1000, "{finite}");
}
