use crate::football::kick;
use crate::judge::MatchView;
use crate::snapshot::{SNAPSHOT_VERSION, match_bytes};
use crate::state::play::{Advantage, Flight, Restart, Save, SetPiece};
use crate::state::player::{Intent, KickKind, KickPlan, Stroke, Swing};
use crate::state::{Match, PlayerId};
use crate::statistics::Statistics;
use crate::step;
use crate::testing::event;
use glam::Vec2;
use serde_json::Value;
use setpiece_scenario::vocabulary::{Action, EventKind, GameMode, Team};
use std::collections::BTreeSet;

/// A match with everything under way that can be.
fn busy() -> Match {
    let mut environment = crate::environment::Environment::new(
        std::sync::Arc::new(crate::testing::scenario(&[(
            Team::Left,
            setpiece_scenario::vocabulary::Role::CF,
            0.0,
            0.0,
        )])),
        crate::environment::EnvironmentOptions::default(),
    )
    .unwrap();
    environment.reset(Some(1), None).unwrap();
    let mut game = step::begin(&environment.start().unwrap());
    let (id, spot, mode, team) = (PlayerId(0), Vec2::ZERO, GameMode::FreeKick, Team::Left);
    let restart = Restart { mode, team, spot };
    let flight = Some(Flight { by: id, to: Some(id), from: spot, tick: 0 });
    game.play.set_piece = Some(SetPiece { mode, team, taker: id, spot, waited_steps: 0 });
    game.play.pending = Some(restart);
    game.play.advantage = Some(Advantage { by: id, victim: id, restart, tick: 0 });
    (game.play.pass, game.play.shot) = (flight, flight);
    game.play.save[0] = Some(Save {
        from: 0,
        saw: 0,
        at: 0,
        place: spot.extend(1.0),
        hands: spot,
        high_m: 1.0,
        spot,
        vel: spot,
        holds: true,
        lies: 0,
    });
    game.play.acting[0].played = Some(Action::Idle);
    let body = &mut game.players[0].body;
    body.intent = Intent::Go(spot, 1.0);
    let kind = KickKind::Shot;
    let swing = Some(Swing {
        kind: KickKind::Shot,
        ready_at: 0,
        way: Some(spot),
        place: spot.extend(0.0),
        mate: Some(id),
        end_dmps: 0,
        left_m: 0.0,
        stroke: Some(Stroke { power: 1.0, hard: 0.0, natural: spot, body: spot }),
    });
    let (dir, point) = (Some(spot), Some(spot));
    body.kick = Some(KickPlan { dir, mate: Some(id), point, swing, ..kick::pressed(kind, 0) });
    game.play.acting[0].key = Some(kind);
    game.agents[0].key = Some(kind);
    game
}

/// Collects every name in a value, with the kind of its value.
fn names(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    let kind = match value {
        Value::Object(fields) => {
            return fields
                .iter()
                .for_each(|(name, value)| names(value, &format!("{path}.{name}"), found));
        }
        Value::Array(parts) => {
            return parts.iter().for_each(|part| names(part, &format!("{path}[]"), found));
        }
        Value::Null => return,
        Value::Bool(_) => "bool",
        Value::Number(number) if number.is_f64() => "float",
        Value::Number(_) => "whole",
        Value::String(_) => "word",
    };
    found.insert(format!("{path} {kind}"));
}

/// If this fails, the bytes of a match have changed: raise [`SNAPSHOT_VERSION`] as well.
#[test]
fn the_layout_is_that_of_the_version() {
    let game = busy();
    let mut found = BTreeSet::new();
    for (name, value) in [
        ("match", serde_json::to_value(&game).unwrap()),
        ("view", serde_json::to_value(MatchView::of(&game)).unwrap()),
        ("statistics", serde_json::to_value(Statistics::begin(&game)).unwrap()),
        ("event", serde_json::to_value(event(EventKind::Goal, Some(Team::Left), Some(0))).unwrap()),
    ] {
        names(&value, name, &mut found);
    }
    let found: Vec<String> = found.into_iter().collect();
    // How they are encoded.
    let length = match_bytes(&game).unwrap().len();
    let head = format!("version {SNAPSHOT_VERSION}\nmatch {length} bytes");
    insta::assert_snapshot!("layout", format!("{head}\n{}", found.join("\n")));
}
