//! Options of teams and players.

use super::expr::path_of;
use super::people::{Presence, Scoped};
use super::value::Repr;
use super::{Lower, fields};
use crate::ast::{Arg, Expr, ExprKind, Field, FieldValue, ItemKind};
use crate::check::options::{PLAYER, TEAM};
use crate::check::types::Ty;
use crate::lower::known::{BehaviorUse, PlayedBy};
use crate::problem::facts::{Bounds, Chance, Kind, Names, Types};
use crate::problem::{Guess, Problem};
use setpiece_scenario::pitch::{PLAYER_SPEED_MAX_MPS, YELLOW_CARDS_MAX};
use setpiece_scenario::vocabulary::{Primitive, Stat, Team};
use setpiece_scenario::{Ai, Reg};

/// The options of a player.
pub(crate) struct PlayerOptions<'w> {
    /// Who plays the player without an agent: one of several, by their conditions. The built-in bot
    /// if there are none.
    pub(crate) ai: Vec<(Option<Reg>, PlayedBy<'w>)>,
    /// Whether an agent may control the player.
    pub(crate) controllable: bool,
    /// Whether the player may stand where another one does.
    pub(crate) overlap: bool,
    /// The player's own difficulty.
    pub(crate) difficulty: Option<Reg>,
    /// 0 fresh to 1 exhausted.
    pub(crate) fatigue: Option<Reg>,
    /// Cards that the player starts with.
    pub(crate) yellow_cards: Option<Reg>,
    /// World velocity.
    pub(crate) velocity: Option<(Reg, Reg)>,
    /// Statistics that replace the table's.
    pub(crate) stats: Vec<(Stat, Reg)>,
    /// Whether the player takes part.
    pub(crate) presence: Presence,
}

/// The difficulty of a team's bots: 1.0 for the left, 0.6 for the right unless it is written.
pub(crate) fn lower_difficulty(lower: &mut Lower<'_, '_>, team: Team) -> Reg {
    let world = lower.world;
    let mut found = None;
    for field in world.flat.teams.get(team.index()).into_iter().flat_map(|team| &team.fields) {
        if fields::is_known(lower, field, TEAM, fields::A_TEAM)
            && field.key.node == "difficulty"
            && let Some(expr) = fields::expression(lower, field)
        {
            found = Some(lower.drawing(&format!("{team} difficulty"), |lower| {
                share(lower, expr, "`difficulty`")
            }));
        }
    }
    found.unwrap_or_else(|| {
        lower.code.constant(if world.mirror.team(team) == Team::Left { 1.0 } else { 0.6 })
    })
}

/// A number of 0..1.
pub(super) fn share<'w>(lower: &mut Lower<'_, 'w>, expr: &'w Expr, what: &str) -> Reg {
    let reg = lower.want_reg(expr, Ty::Number);
    lower.check_range(reg, (0.0, 1.0), what, expr.span, "`0..1`");
    reg
}

/// Lowers a player's options, those of `each` included.
pub(crate) fn lower_player_options<'w>(
    lower: &mut Lower<'_, 'w>,
    index: usize,
) -> Option<PlayerOptions<'w>> {
    let world = lower.world;
    let player = world.roster.get(index)?;
    let mut options = PlayerOptions {
        ai: Vec::new(),
        controllable: true,
        overlap: false,
        difficulty: None,
        fatigue: None,
        yellow_cards: None,
        velocity: None,
        stats: Vec::new(),
        presence: Presence::default(),
    };
    let stream = player.stream();
    lower.for_team(player.team.index() as f64, |lower| {
        for Scoped { it: field, scope } in &player.fields {
            lower.within(scope.clone(), |lower| {
                lower.drawing(&format!("{stream} {}", field.key.node), |lower| {
                    option(lower, field, &mut options);
                });
            });
        }
    });
    options.presence = lower.presence_of(index, player.span);
    Some(options)
}

fn option<'w>(lower: &mut Lower<'_, 'w>, field: &'w Field, options: &mut PlayerOptions<'w>) {
    if !fields::is_known(lower, field, PLAYER, "a player") {
        return;
    }
    match (field.key.node.as_str(), &field.value) {
        ("stats", FieldValue::Fields(fields, _)) => {
            for stat in fields {
                stats(lower, stat, options);
            }
        }
        ("ai", FieldValue::Script(script)) => {
            options.ai = vec![(None, PlayedBy::Behavior(BehaviorUse::Script(script)))];
        }
        (key, FieldValue::Expr(expr)) => expression(lower, key, expr, options),
        ("stats", FieldValue::Script(script)) => not_a_group(lower, script.span),
        _ => {
            fields::expression(lower, field);
        }
    }
}

fn not_a_group(lower: &Lower<'_, '_>, span: crate::ast::Span) {
    lower.report(Problem::new(span, Types::StatsIsAGroup));
}

fn expression<'w>(
    lower: &mut Lower<'_, 'w>,
    key: &str,
    expr: &'w Expr,
    options: &mut PlayerOptions<'w>,
) {
    match key {
        "ai" => {
            let alternatives = lower.alternatives(expr);
            let found = alternatives.into_iter();
            options.ai = found.filter_map(|(when, expr)| Some((when, ai(lower, expr)?))).collect();
        }
        "stats" => not_a_group(lower, expr.span),
        "difficulty" => options.difficulty = Some(share(lower, expr, "`difficulty`")),
        "fatigue" => options.fatigue = Some(share(lower, expr, "`fatigue`")),
        "yellow_cards" => {
            let reg = lower.want_reg(expr, Ty::Int);
            lower.check_range(
                reg,
                (0.0, YELLOW_CARDS_MAX.into()),
                "`yellow_cards`",
                expr.span,
                "`0..1`",
            );
            options.yellow_cards = Some(reg);
        }
        "velocity" => {
            let value = lower.want(expr, Ty::Velocity);
            if let Repr::Three(..) = value.repr {
                lower.report(Problem::new(expr.span, Types::PlayersDontFly));
            }
            let velocity = lower.pair(&value);
            let zero = lower.code.constant(0.0);
            lower.check_speed(
                (velocity.0, velocity.1, zero),
                PLAYER_SPEED_MAX_MPS,
                "a player",
                expr.span,
            );
            options.velocity = Some(velocity);
        }
        "controllable" => {
            let reg = lower.condition(expr);
            match lower.code.constant_of(reg) {
                Some(value) => options.controllable = value != 0.0,
                None if lower.code.is_unknown(reg) => {}
                None => lower.report(Problem::new(expr.span, Chance::ControllableUnknown)),
            }
        }
        _ => match &expr.kind {
            ExprKind::Name(name) if name == "allowed" => options.overlap = true,
            _ => lower.report(Problem::new(expr.span, Bounds::Overlap)),
        },
    }
}

/// What plays a player; `None` after a report.
fn ai<'w>(lower: &Lower<'_, 'w>, expr: &'w Expr) -> Option<PlayedBy<'w>> {
    let (path, args): (_, &'w [Arg]) = match &expr.kind {
        ExprKind::Call { name, args } => (Some(name.node.clone()), args),
        _ => (path_of(expr), &[]),
    };
    let Some(name) = path else {
        lower.report(Problem::new(expr.span, Types::NoAi));
        return None;
    };
    let built_in = [("bot", Ai::Bot), ("hold", Ai::Hold), ("lazy", Ai::Lazy)];
    if let (Some((_, ai)), true) =
        (built_in.iter().find(|(known, _)| *known == name), args.is_empty())
    {
        return Some(PlayedBy::BuiltIn(*ai));
    }
    let library = lower.world.library;
    let found = library.find(expr.span.file, &name);
    if let Some((found, ItemKind::Behavior(item))) = found.map(|found| (found, &found.item.kind)) {
        if let Some(problem) = library.ambiguous(expr.span.file, &name, expr.span) {
            lower.report(problem);
            return None;
        }
        lower.world.mark_used(found.name.span);
        let used = BehaviorUse::Named { item, args, scope: lower.scope.clone(), span: expr.span };
        return Some(PlayedBy::Behavior(used));
    }
    // `wait` says how long in its statement; `hold` is the same without an end.
    let acts = || Primitive::ALL.iter().filter(|primitive| **primitive != Primitive::Wait);
    if let Some(&primitive) = acts().find(|primitive| primitive.name() == name) {
        let (scope, span) = (lower.scope.clone(), expr.span);
        return Some(PlayedBy::Behavior(BehaviorUse::Act { primitive, args, scope, span }));
    }
    let behaviors = library
        .visible(expr.span.file)
        .filter(|(_, found)| matches!(found.item.kind, ItemKind::Behavior(_)));
    let known: Vec<&str> =
        behaviors.map(|(name, _)| name).chain(built_in.iter().map(|(name, _)| *name)).collect();
    let known: Vec<&str> =
        known.into_iter().chain(acts().map(|primitive| primitive.name())).collect();
    let guess = Guess::similar_or(&name, &known, &[]);
    lower.report(Problem::new(expr.span, Names::Unknown { kind: Kind::Ai, name, guess }));
    None
}

fn stats<'w>(lower: &mut Lower<'_, 'w>, field: &'w Field, options: &mut PlayerOptions<'w>) {
    if let Some((stat, reg)) = stat_of(lower, field) {
        options.stats.retain(|(known, _)| *known != stat);
        options.stats.push((stat, reg));
    }
}

/// A statistic and its value; `None` after a report.
pub(super) fn stat_of<'w>(lower: &mut Lower<'_, 'w>, field: &'w Field) -> Option<(Stat, Reg)> {
    let Some(stat) = Stat::from_name(&field.key.node) else {
        let known: Vec<&str> = Stat::ALL.iter().map(|stat| stat.name()).collect();
        let (name, guess) = (field.key.node.clone(), Guess::or_all(&field.key.node, &known));
        let fact = Names::Unknown { kind: Kind::Statistic, name, guess };
        lower.report(Problem::new(field.key.span, fact));
        return None;
    };
    let expr = fields::expression(lower, field)?;
    Some((stat, share(lower, expr, &format!("`{stat}`"))))
}
