//! The first state of a match.

use crate::football::{
    forecast, lineup, noise, reach, recent, restart, set_piece, stats, switching,
};
use crate::physics::Ball;
use crate::random::Purpose;
use crate::start::{Drawn, DrawnPlayer};
use crate::state::play::{Play, Restart};
use crate::state::player::Body;
use crate::state::{AgentSlot, Match, Player, PlayerId};
use glam::Vec2;
use setpiece_scenario::pitch::PLAYERS_MAX;
use setpiece_scenario::vocabulary::{GameMode, PitchMeasure, Role, Rule, StartKind, Stat, Team};
use setpiece_scenario::{Ai, Others};

/// A player sets off at most this many ticks later than they could. Measured.
const SET_OFF_TICKS: f32 = 18.0;
/// How far players are put aside before the first step, metres: more than what they drift aside on
/// a few metres of their run.
const STAGGER_M: f32 = 8.0e-6;
/// The first at a ball nearer than this waits, metres. Measured.
const NEAR_M: f32 = 1.0;
const FRONT_M: f32 = 0.1;
/// A player who goes for the ball of a start needs no ticks to set off, besides the delay, if it is
/// nearer than this, metres. Measured at starts of the Academy, and far from the ball.
const FAR_M: f32 = 8.0;
const OFF_TICKS: i8 = 3;
/// How many ticks after they set off a player can touch the ball of a start without a motion.
/// Measured.
const FIRST_TICKS: i32 = 18;

/// Builds the match of a drawn start, before its first step is prepared.
pub fn begin(drawn: &Drawn) -> Match {
    let mut game = blank(drawn);
    for i in 0..PLAYERS_MAX {
        let Some(start) = &drawn.players[i] else { continue };
        let index = PlayerId(i as u8).in_team();
        let player = &mut game.players[i];
        let mut body = Body::blank();
        body.stats = stats::stats_of(index, start);
        body.level = stats::level_of(start.difficulty);
        body.speed_top_mps = stats::speed_top(body.stats[Stat::Speed.index()]);
        body.height_m = stats::height_of(index);
        body.kickoff = [start.pos; 2];
        let to_ball = (drawn.ball_pos.truncate() - start.pos).normalize_or(Vec2::X);
        body.facing = start.heading_rad.map_or(to_ball, crate::math::unit);
        player.body = body;
        player.heading_rad = start.heading_rad.unwrap_or_else(|| crate::math::heading(to_ball));
    }
    lineup::assign_slots(&mut game);
    game.play.others = drawn.others;
    let nearest = nearest_team(&mut game);
    game.play.first_kickoff = drawn.first_kickoff.or(drawn.taker).unwrap_or(nearest);
    place_kickoffs(&mut game, drawn);
    game.play.lead = drawn.owner.map_or(game.play.first_kickoff, PlayerId::team);
    let lead_is_early = noise::roll(&mut game) < 0.5;
    game.play.early = if lead_is_early { game.play.lead } else { game.play.lead.other() };
    let half_time = game.rules[Rule::HalfTime.index()];
    game.play.second_half = half_time > 0.0 && f64::from(drawn.elapsed_steps) >= half_time;
    game.possession = drawn.owner.map(PlayerId::team);
    forecast::renew(&mut game);
    reach::assess(&mut game);
    start_of(&mut game, drawn, nearest);
    recent::begin(&mut game);
    set_off(&mut game);
    switching::open(&mut game);
    game
}

/// Builds the match of a drawn start before any player has chosen what to do.
pub(crate) fn blank(drawn: &Drawn) -> Match {
    let player = |slot: &Option<DrawnPlayer>| {
        let drawn_player = slot.as_ref();
        Player {
            active: drawn_player.is_some_and(|p| p.active),
            role: drawn_player.map_or(Role::GK, |p| p.role),
            ai: drawn_player.map_or(Ai::Lazy, |p| p.ai),
            controllable: drawn_player.is_some_and(|p| p.controllable),
            pos: drawn_player.map_or(Vec2::ZERO, |p| p.pos),
            vel: drawn_player.map_or(Vec2::ZERO, |p| p.vel),
            heading_rad: drawn_player.and_then(|p| p.heading_rad).unwrap_or_default(),
            fatigue: drawn_player.map_or(0.0, |p| p.fatigue),
            yellow_cards: drawn_player.map_or(0, |p| p.yellow_cards),
            difficulty: drawn_player.map_or(0.0, |p| p.difficulty),
            body: Body::blank(),
        }
    };
    Match {
        tick: 0,
        step: drawn.steps_before,
        elapsed_at_start: drawn.elapsed_steps,
        limit_steps: drawn.limit_steps,
        score: drawn.score,
        ball: Ball { pos: drawn.ball_pos, vel: drawn.ball_vel, spin: drawn.ball_spin },
        squad: (0..)
            .zip(&drawn.players)
            .filter(|(_, slot)| slot.is_some())
            .map(|(id, _)| PlayerId(id))
            .collect(),
        players: std::array::from_fn(|i| player(&drawn.players[i])),
        owner: drawn.owner,
        possession: drawn.owner.map(PlayerId::team),
        last_touch: drawn.owner,
        mode: GameMode::Normal,
        dead: false,
        rules: drawn.rules,
        conditions: drawn.conditions,
        pitch: drawn.pitch,
        difficulty: drawn.difficulty,
        agents: drawn
            .agents
            .iter()
            .map(|agent| AgentSlot {
                team: agent.team,
                player: agent.fixed,
                fixed: agent.fixed.is_some(),
                sticky: 0,
                steer: None,
                key: None,
            })
            .collect(),
        play_random: noise::stream(drawn, Purpose::Play),
        bot_random: noise::stream(drawn, Purpose::Bot),
        play: Play::blank(),
    }
}

/// Delays when each player sets off, by chance, and when they can touch the ball.
///
/// The player of a team who goes for the ball sets off at once. If the ball is near, the first at
/// it is an exception. (Measured.)
fn set_off(game: &mut Match) {
    let first = reach::first(game);
    let ball = game.ball.pos.truncate();
    for id in game.order() {
        let waits = (noise::roll(game) * SET_OFF_TICKS) as i8;
        let goes = game.play.chaser[id.team().index()] == Some(id);
        let gap = game.player(id).pos.distance_squared(ball);
        let front = game.player(id).pos + game.player(id).body.facing * FRONT_M;
        let near = front.distance_squared(ball) < NEAR_M * NEAR_M;
        let waits = if goes && !(near && first == Some(id)) { 0 } else { waits };
        let body = &mut game.players[id.index()].body;
        body.lag_ticks = if goes && gap < FAR_M * FAR_M { OFF_TICKS - waits } else { -waits };
        body.ready_at = FIRST_TICKS + i32::from(waits);
    }
}

/// Puts the bot's players a few micrometres to one side, by chance.
///
/// It is invisible. But a player on the border between two pixels of a map falls into either, as in
/// GRF, where rounding decides.
pub fn stagger(game: &mut Match) {
    for id in game.order() {
        let aside = if noise::roll(game) < 0.5 { -STAGGER_M } else { STAGGER_M };
        let bots = game.player(id).ai == Ai::Bot && game.play.others == Others::Bot;
        if bots && !switching::controlled(game, id) {
            game.players[id.index()].pos.y += aside * id.team().side() as f32;
        }
    }
}

/// Sets where everybody stands at later kick-offs: where the scenario says, or at the places of the
/// start.
///
/// If the team that kicks off isn't the one of the start, teams of equal size swap their places.
/// (GRF's.)
fn place_kickoffs(game: &mut Match, drawn: &Drawn) {
    let sizes = [Team::Left, Team::Right].map(|team| game.team(team).count());
    for id in game.order() {
        let Some(start) = &drawn.players[id.index()] else { continue };
        let team = id.team();
        let twin = drawn.players[PlayerId::new(team.other(), id.in_team()).index()].as_ref();
        let swapped = twin.filter(|_| sizes[0] == sizes[1]).map_or(start.pos, |twin| -twin.pos);
        let places = if team == game.play.first_kickoff {
            [start.pos, swapped]
        } else {
            [swapped, start.pos]
        };
        game.players[id.index()].body.kickoff = start.kickoff.unwrap_or(places);
    }
}

/// Sets up a start that isn't open play.
fn start_of(game: &mut Match, drawn: &Drawn, nearest: Team) {
    let team = drawn.taker.unwrap_or(nearest);
    let side = team.side() as f32;
    let ball = drawn.ball_pos.truncate();
    let half = game.half();
    let top = if ball.y < 0.0 { -1.0 } else { 1.0 };
    let (mode, spot) = match drawn.kind {
        StartKind::Open => return,
        StartKind::Kickoff => (GameMode::KickOff, Vec2::ZERO),
        StartKind::Corner => (GameMode::Corner, Vec2::new(half.x * side, half.y * top)),
        StartKind::FreeKick => (GameMode::FreeKick, ball),
        StartKind::ThrowIn => (GameMode::ThrowIn, Vec2::new(ball.x, half.y * top)),
        StartKind::GoalKick => {
            let spot = game.measure(PitchMeasure::GoalKickSpot);
            (GameMode::GoalKick, Vec2::new((spot - half.x) * side, 0.0))
        }
        StartKind::Penalty => {
            let spot = game.measure(PitchMeasure::PenaltySpot);
            (GameMode::Penalty, Vec2::new((half.x - spot) * side, 0.0))
        }
    };
    let placed: [(Vec2, Vec2); PLAYERS_MAX] =
        std::array::from_fn(|i| (game.players[i].pos, game.players[i].vel));
    restart::place(game, Restart { mode, team, spot });
    // The scenario's places and velocities stay in force, except for the taker.
    if mode != GameMode::KickOff {
        for (player, (place, velocity)) in game.players.iter_mut().zip(placed) {
            (player.pos, player.vel) = (place, velocity);
        }
        set_piece::appoint(game);
        lineup::assign_slots(game);
        restart::face_ball(game);
        let taker = game.play.set_piece.map(|set_piece| set_piece.taker);
        for (i, player) in game.players.iter_mut().enumerate() {
            let given = drawn.players[i].as_ref().and_then(|start| start.heading_rad);
            if let Some(heading) = given.filter(|_| taker.is_none_or(|id| id.index() != i)) {
                player.heading_rad = heading;
                player.body.facing = crate::math::unit(heading);
            }
        }
        forecast::renew(game);
        reach::assess(game);
        switching::reassign(game);
    }
}

/// The team whose nearest player is nearer to the ball; chance breaks a tie.
fn nearest_team(game: &mut Match) -> Team {
    let ball = game.ball.pos.truncate();
    let least = |team| {
        game.team(team)
            .fold(f32::MAX, |least, (_, player)| least.min(player.pos.distance_squared(ball)))
    };
    let (left, right) = (least(Team::Left), least(Team::Right));
    let drawn = left == right && game.rule(Rule::Stochastic) && noise::happens(game, 0.5);
    if right < left || drawn { Team::Right } else { Team::Left }
}
