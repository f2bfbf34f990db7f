//! The getters behind the names.

use super::table::{Subject, members};
use super::{Ctx, Point, SeenBall, SeenEvent, SeenPlayer, SeenScore, SeenTeam, ShownState, Vector};
use crate::judge::view::{self, MatchView, remaining_s};
use rhai::{Dynamic, Engine};
use setpiece_scenario::pitch::{STEPS_PER_S, X_SCALE_M};
use setpiece_scenario::vocabulary::{Qualifier, Team};

/// A getter of one kind of thing.
type Getter<T> = fn(&T) -> Dynamic;

pub(super) fn register(engine: &mut Engine) {
    for member in members() {
        let name = member.name;
        match member.of {
            Subject::Ctx => add(engine, name, ctx(name)),
            Subject::State => add(engine, name, state(name)),
            Subject::Ball => add(engine, name, ball(name)),
            Subject::Player => add(engine, name, player(name)),
            Subject::Team => add(engine, name, team(name)),
            Subject::Score => add(engine, name, score(name)),
            Subject::Event => add(engine, name, event(name)),
            Subject::Point => add(engine, name, point(name)),
            Subject::Vector => add(engine, name, vector(name)),
            Subject::Players
            | Subject::Events
            | Subject::Params
            | Subject::Memory
            | Subject::Named
            | Subject::Region
            | Subject::Table
            | Subject::Plain => {}
        }
    }
}

fn add<T: Clone + Send + Sync + 'static>(
    engine: &mut Engine,
    name: &str,
    getter: Option<Getter<T>>,
) {
    if let Some(getter) = getter {
        engine.register_get(name, move |subject: &mut T| getter(subject));
    }
}

/// Whether every name of the tables has its getter; used by the tests.
#[cfg(test)]
pub(super) fn is_registered(of: Subject, name: &str) -> bool {
    match of {
        Subject::Ctx => ctx(name).is_some(),
        Subject::State => state(name).is_some(),
        Subject::Ball => ball(name).is_some(),
        Subject::Player => player(name).is_some(),
        Subject::Team => team(name).is_some(),
        Subject::Score => score(name).is_some(),
        Subject::Event => event(name).is_some(),
        Subject::Point => point(name).is_some(),
        Subject::Vector => vector(name).is_some(),
        Subject::Players
        | Subject::Events
        | Subject::Params
        | Subject::Memory
        | Subject::Named
        | Subject::Region
        | Subject::Table
        | Subject::Plain => true,
    }
}

fn number(value: f32) -> Dynamic {
    f64::from(value).into()
}

fn whole(value: impl Into<i64>) -> Dynamic {
    Dynamic::from_int(value.into())
}

/// The heading of a vector in the reader's frame, radians.
fn heading(x: f64, y: f64) -> Dynamic {
    libm::atan2(y, x).into()
}

fn ctx(name: &str) -> Option<Getter<Ctx>> {
    Some(match name {
        "params" => |ctx| Dynamic::from_map((*ctx.0.scene.params).clone()),
        "named" => |ctx| ctx.0.named(),
        "side" => |ctx| ctx.0.perspective.us.name().into(),
        "agent" => |ctx| whole(ctx.0.perspective.agent as i64),
        "index" => |ctx| whole(ctx.0.scene.index as i64),
        "step" => |ctx| whole(ctx.0.scene.now.step),
        _ => return None,
    })
}

fn state(name: &str) -> Option<Getter<ShownState>> {
    Some(match name {
        "named" => |now| now.named(),
        "ball" => |now| Dynamic::from(SeenBall(now.clone())),
        "us" => |now| Dynamic::from(SeenTeam(now.clone(), now.perspective.us)),
        "them" => |now| Dynamic::from(SeenTeam(now.clone(), now.perspective.us.other())),
        "me" => |now| now.somebody(now.perspective.me),
        "players" => |now| now.players(None),
        "score" => |now| Dynamic::from(SeenScore(now.clone())),
        "possession" => |now| now.team_word(now.view().possession),
        "elapsed" => |now| (f64::from(now.view().step) / STEPS_PER_S).into(),
        "remaining" => |now| remaining_s(now.view().step, now.view().limit_steps).into(),
        "game_mode" => |now| now.view().mode.name().into(),
        "ball_dead" => |now| now.view().dead.into(),
        _ => return None,
    })
}

fn ball(name: &str) -> Option<Getter<SeenBall>> {
    fn at(ball: &SeenBall) -> Point {
        let [x, y, _] = ball.0.view().ball;
        ball.0.point([x, y])
    }
    fn velocity(ball: &SeenBall) -> [f64; 2] {
        let [x, y, _] = ball.0.view().ball_vel;
        [x, y].map(|speed| ball.0.side() * f64::from(speed))
    }
    Some(match name {
        "at" => |ball| Dynamic::from(at(ball)),
        "x" => |ball| at(ball).own()[0].into(),
        "y" => |ball| at(ball).own()[1].into(),
        "metres" => |ball| Dynamic::from(Vector { own: at(ball).own_metres() }),
        "height" => |ball| number(ball.0.view().ball[2]),
        "speed" => |ball| {
            let [x, y, z] = ball.0.view().ball_vel.map(f64::from);
            libm::sqrt(x * x + y * y + z * z).into()
        },
        "velocity" => |ball| Dynamic::from(Vector { own: velocity(ball) }),
        "heading" => |ball| {
            let [x, y] = velocity(ball);
            heading(x, y)
        },
        "owner" => |ball| ball.0.somebody(ball.0.view().owner),
        _ => return None,
    })
}

fn player(name: &str) -> Option<Getter<SeenPlayer>> {
    Some(match name {
        "at" => |player| Dynamic::from(player.point()),
        "x" => |player| player.point().own()[0].into(),
        "y" => |player| player.point().own()[1].into(),
        "metres" => |player| Dynamic::from(Vector { own: player.point().own_metres() }),
        "speed" => |player| {
            let [x, y] = player.view().vel.map(f64::from);
            libm::hypot(x, y).into()
        },
        "velocity" => |player| {
            let side = player.0.side();
            Dynamic::from(Vector { own: player.view().vel.map(|speed| side * f64::from(speed)) })
        },
        "heading" => |player| {
            let (side, world) = (player.0.side(), f64::from(player.view().heading_rad));
            heading(side * libm::cos(world), side * libm::sin(world))
        },
        "fatigue" => |player| number(player.view().fatigue),
        "yellow_cards" => |player| whole(player.view().yellow_cards),
        "role" => |player| player.view().role.name().into(),
        "team" => |player| player.0.team_word(Some(player.1.team())),
        "active" => |player| player.view().active.into(),
        "controlled" => |player| player.view().controlled.into(),
        "action" => |player| {
            let seen = player.view();
            if seen.active { seen.action.name().into() } else { Dynamic::UNIT }
        },
        "sprinting" => |player| player.view().sprinting.into(),
        "dribbling" => |player| player.view().dribbling.into(),
        "has_ball" => |player| (player.0.view().owner == Some(player.1)).into(),
        _ => return None,
    })
}

fn team(name: &str) -> Option<Getter<SeenTeam>> {
    fn view(team: &SeenTeam) -> &MatchView {
        team.0.view()
    }
    Some(match name {
        "players" => |team| team.0.players(Some(team.1)),
        "goal" => |team| {
            Dynamic::from(Point {
                metres: [-team.1.side() * f64::from(view(team).half_length_m), 0.0],
                side: team.0.side(),
            })
        },
        "score" => |team| whole(view(team).score[team.1.index()]),
        "has_ball" => |team| view(team).owner.is_some_and(|owner| owner.team() == team.1).into(),
        "offside_line" => |team| {
            (team.0.side() * view::Sight::Kept(view(team)).offside_line_m(team.1) / X_SCALE_M)
                .into()
        },
        _ => return None,
    })
}

fn score(name: &str) -> Option<Getter<SeenScore>> {
    fn goals(score: &SeenScore, team: Team) -> Dynamic {
        whole(score.0.view().score[team.index()])
    }
    Some(match name {
        "us" => |score| goals(score, score.0.perspective.us),
        "them" => |score| goals(score, score.0.perspective.us.other()),
        _ => return None,
    })
}

fn event(name: &str) -> Option<Getter<SeenEvent>> {
    Some(match name {
        "kind" => |event| event.1.kind.name().into(),
        "qualifier" => |event| event.1.qualifier.map_or("", Qualifier::name).into(),
        "team" => |event| event.0.team_word(event.1.team),
        "by" => |event| event.0.somebody(event.1.by),
        "to" => |event| event.0.somebody(event.1.to),
        "at" => |event| Dynamic::from(event.0.point([event.1.at.x, event.1.at.y])),
        "length" => |event| number(event.1.length_m),
        "speed" => |event| number(event.1.speed_mps),
        _ => return None,
    })
}

fn point(name: &str) -> Option<Getter<Point>> {
    Some(match name {
        "x" => |point| point.own()[0].into(),
        "y" => |point| point.own()[1].into(),
        "metres" => |point| Dynamic::from(Vector { own: point.own_metres() }),
        _ => return None,
    })
}

fn vector(name: &str) -> Option<Getter<Vector>> {
    Some(match name {
        "x" => |vector| vector.own[0].into(),
        "y" => |vector| vector.own[1].into(),
        _ => return None,
    })
}
