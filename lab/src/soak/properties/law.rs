//! The clock, the score, cards, and which event belongs to which restart.

use super::{Step, must};
use crate::pitch::LabError;
use setpiece::engine::football::whistle::event_of;
use setpiece::engine::state::event::Event;
use setpiece::engine::state::{Match, PlayerId};
use setpiece::scenario::pitch::PLAYERS_MAX;
use setpiece::scenario::vocabulary::{EventKind, GameMode, Qualifier, Rule, Team};

/// The events that each rule, if switched off, removes.
const RULED_OUT: [(Rule, &[EventKind]); 6] = [
    (Rule::Offside, &[EventKind::Offside]),
    (Rule::Fouls, &[EventKind::Foul, EventKind::Advantage]),
    (Rule::Cards, &[EventKind::YellowCard, EventKind::RedCard]),
    (Rule::Penalties, &[EventKind::Penalty]),
    (Rule::Handball, &[EventKind::Handball]),
    (Rule::HalfTime, &[EventKind::HalfTime]),
];

/// Checks any single step.
pub(super) fn hold(before: &Match, step: &Step) -> Result<(), LabError> {
    clock(before, step)?;
    score(before, step)?;
    cards(before, step)?;
    tiredness(before, step)?;
    stop(before, step)?;
    restart(step)?;
    taken(before, step)?;
    for (rule, kinds) in RULED_OUT {
        let seen = step
            .events
            .iter()
            .find(|event| kinds.contains(&event.kind) && event.qualifier.is_none());
        must(step.judged.rule(rule) || seen.is_none(), || {
            format!("{} is off: {seen:?}", rule.name())
        })?;
    }
    Ok(())
}

/// How often something happened.
fn count(events: &[Event], which: impl Fn(&Event) -> bool) -> usize {
    events.iter().filter(|event| which(event)).count()
}

/// A step counts as one, with ten ticks if play isn't stopped. Half-time comes once and in time,
/// full time at the limit.
fn clock(before: &Match, step: &Step) -> Result<(), LabError> {
    let Step { judged, after, events, .. } = step;
    must(judged.step == before.step + 1, || {
        format!("step {} follows {}", judged.step, before.step)
    })?;
    let ticks = judged.tick - before.tick;
    must(ticks == 10 || judged.dead && (1..10).contains(&ticks), || {
        format!("a step of {ticks} ticks")
    })?;
    let restarted = (after.step, after.tick, after.play.second_half);
    must(restarted == (judged.step, judged.tick, judged.play.second_half), || {
        "a restart took time".to_owned()
    })?;
    let late = events.iter().find(|event| !(before.tick..=judged.tick).contains(&event.tick));
    must(late.is_none(), || format!("an event of another step: {late:?}"))?;
    let order = events.is_sorted_by_key(|event| event.tick);
    must(order, || "events out of order".to_owned())?;

    let half_time = judged.rules[Rule::HalfTime.index()];
    let due = half_time > 0.0 && f64::from(judged.step + judged.elapsed_at_start) >= half_time;
    let blown = count(events, |event| event.kind == EventKind::HalfTime) == 1;
    must(blown == (judged.play.second_half && !before.play.second_half), || {
        "half-time without its event".to_owned()
    })?;
    must(judged.play.second_half || !before.play.second_half, || {
        "the first half again".to_owned()
    })?;
    must(!blown || due, || "half-time too early".to_owned())?;
    let goes_on = !judged.dead && judged.play.set_piece.is_none();
    must(!due || judged.play.second_half || !goes_on, || "half-time is late".to_owned())?;
    let kicks_off = after.play.kick_off == Some(given_to(after, after.play.first_kickoff.other()));
    must(!blown || kicks_off, || format!("after half-time {:?} kicks off", after.play.kick_off))?;
    let full = judged.limit_steps.is_some_and(|limit| judged.step >= limit);
    let whistle = count(events, |event| event.kind == EventKind::FullTime);
    must(whistle == usize::from(full), || {
        format!("full time {whistle} times in step {}", judged.step)
    })
}

/// The score only rises with a goal event of the team, by at most one per step.
fn score(before: &Match, step: &Step) -> Result<(), LabError> {
    let Step { judged, after, events, .. } = step;
    for team in [Team::Left, Team::Right] {
        let goals =
            count(events, |event| event.kind == EventKind::Goal && event.team == Some(team));
        let (was, is) = (before.score[team.index()], judged.score[team.index()]);
        must(usize::from(is) == usize::from(was) + goals, || {
            format!("{is} after {was} and {goals} goals")
        })?;
    }
    must(after.score == judged.score, || "a restart changed the score".to_owned())?;
    let goals: Vec<&Event> = events.iter().filter(|event| event.kind == EventKind::Goal).collect();
    must(goals.len() <= 1, || "two goals in a step".to_owned())?;
    let own = count(events, |event| event.kind == EventKind::OwnGoal);
    let goal = goals.first();
    let into_his_own =
        goal.is_some_and(|goal| goal.by.is_some_and(|id| Some(id.team()) != goal.team));
    must(own == usize::from(into_his_own), || format!("{own} own goals beside {goal:?}"))
}

/// Cards are never taken back and only rise with their event. The second yellow is red. Red removes
/// a player for good, unless they are the last.
fn cards(before: &Match, step: &Step) -> Result<(), LabError> {
    let Step { judged, after, events, .. } = step;
    must(judged.squad == after.squad, || "a restart changed who takes part".to_owned())?;
    for i in 0..PLAYERS_MAX {
        let (was, is) = (&before.players[i], &judged.players[i]);
        let of =
            |kind| count(events, |event| event.kind == kind && event.by == Some(PlayerId(i as u8)));
        let (yellow, red) = (of(EventKind::YellowCard), of(EventKind::RedCard));
        let sum = usize::from(was.yellow_cards) + yellow;
        must(usize::from(is.yellow_cards) == sum, || {
            format!("player {i}: {} cards, not {sum}", is.yellow_cards)
        })?;
        must(yellow == 0 || is.yellow_cards < 2 || red > 0, || {
            format!("player {i} has a second yellow card")
        })?;
        must(yellow + red == 0 || was.active, || {
            format!("player {i} is not there and is shown a card")
        })?;
        let last = judged.team(PlayerId(i as u8).team()).count() == 1 && is.active;
        let goes = was.active && !is.active;
        must(goes == (red > 0 && !last), || format!("player {i}: {red} red cards, gone: {goes}"))?;
        let then = &after.players[i];
        let same = (is.active, is.yellow_cards) == (then.active, then.yellow_cards);
        must(same, || format!("a restart changed who player {i} is"))?;
    }
    Ok(())
}

/// Nobody recovers except at half-time, and nobody tires if fatigue is off.
fn tiredness(before: &Match, step: &Step) -> Result<(), LabError> {
    let renewed = step.judged.play.second_half && !before.play.second_half;
    for (i, (was, is)) in before.players.iter().zip(&step.judged.players).enumerate() {
        let grows = is.fatigue >= was.fatigue
            && (step.judged.rule(Rule::Fatigue) || is.fatigue == was.fatigue);
        let holds = if renewed { is.fatigue == 0.0 } else { grows };
        must(holds, || format!("player {i}: tired by {} after {}", is.fatigue, was.fatigue))?;
    }
    Ok(())
}

/// The event that awards a restart, if there is one.
fn award(events: &[Event]) -> Option<&Event> {
    events.iter().find(|event| is_restart(event.kind) && event.qualifier.is_none())
}

fn is_restart(kind: EventKind) -> bool {
    use EventKind::{Corner, FreeKick, GoalKick, Kickoff, Penalty, ThrowIn};
    matches!(kind, Corner | FreeKick | GoalKick | Kickoff | Penalty | ThrowIn)
}

/// Play is only stopped by something that leads to a restart, at most once per step.
fn stop(before: &Match, step: &Step) -> Result<(), LabError> {
    use EventKind::{
        Corner, Foul, FreeKick, Goal, GoalKick, HalfTime, Handball, Kickoff, Offside, OutOfPlay,
        Penalty,
    };
    let Step { judged, events, .. } = step;
    let awards = count(events, |event| is_restart(event.kind) && event.qualifier.is_none());
    must(awards == usize::from(judged.dead), || {
        format!("{awards} awards, play stopped: {}", judged.dead)
    })?;
    let Some(award) = award(events) else { return Ok(()) };
    let seen = |kinds: &[EventKind]| events.iter().any(|event| kinds.contains(&event.kind));
    let due = match award.kind {
        Kickoff => seen(&[Goal]) != seen(&[HalfTime]),
        // The last condition: six seconds.
        FreeKick => {
            seen(&[Foul, Handball, Offside])
                || before.play.advantage.is_some()
                || before.play.hands.is_some()
        }
        Penalty => seen(&[Foul, Handball]),
        Corner | GoalKick | EventKind::ThrowIn => seen(&[OutOfPlay]) && !seen(&[Goal]),
        _ => false,
    };
    must(due, || format!("nothing is worth {award:?}"))?;
    let pending = judged.play.pending.map(|restart| (event_of(restart.mode), Some(restart.team)));
    must(pending == Some((award.kind, award.team)), || format!("{pending:?} waits after {award:?}"))
}

/// The team that plays what a team is awarded: the other one, if it has no players.
fn given_to(game: &Match, team: Team) -> Team {
    if game.team(team).next().is_none() { team.other() } else { team }
}

/// After a stop the ball lies where it was awarded, and the team that has it waits to play it.
/// Without a stop nothing changes.
fn restart(step: &Step) -> Result<(), LabError> {
    let Step { judged, after, events, .. } = step;
    must(!after.dead && after.play.pending.is_none(), || "a restart is left over".to_owned())?;
    if let Some(set_piece) = after.play.set_piece {
        let there =
            after.player(set_piece.taker).active && set_piece.taker.team() == set_piece.team;
        must(there, || format!("nobody takes {set_piece:?}"))?;
        let lies =
            after.ball.pos.truncate() == set_piece.spot && after.owner == Some(set_piece.taker);
        must(lies, || format!("{:?} is not where {set_piece:?} is", after.ball))?;
    }
    let open = if after.play.kick_off.is_some() { GameMode::KickOff } else { GameMode::Normal };
    let waits = after.play.set_piece.map_or(open, |set_piece| set_piece.mode);
    must(after.mode == waits, || format!("the mode is {:?} while {waits:?} waits", after.mode))?;
    let Some(award) = award(events) else { return Ok(()) };
    must(after.ball.pos.truncate() == award.at.truncate(), || {
        format!("{:?} after {award:?}", after.ball)
    })?;
    let waits =
        after.play.set_piece.map(|set_piece| (event_of(set_piece.mode), Some(set_piece.team)));
    let team = award.team.map(|team| given_to(after, team));
    let expected = (award.kind != EventKind::Kickoff
        && !judged.players.iter().all(|player| !player.active))
    .then_some((award.kind, team));
    must(waits == expected, || format!("{waits:?} waits after {award:?}"))?;
    let kicks_off = (award.kind == EventKind::Kickoff).then_some(team).flatten();
    must(after.play.kick_off == kicks_off, || {
        format!("{:?} kicks off after {award:?}", after.play.kick_off)
    })
}

/// A set piece is taken by its taker, once; nothing else ends it.
fn taken(before: &Match, step: &Step) -> Result<(), LabError> {
    let Step { judged, events, .. } = step;
    let of = |event: &&Event| event.qualifier == Some(Qualifier::Taken);
    let set_pieces: Vec<_> =
        events.iter().filter(of).filter(|event| event.kind != EventKind::Kickoff).collect();
    let expected = before.play.set_piece.filter(|_| judged.play.set_piece.is_none());
    let right = match (expected, set_pieces.as_slice()) {
        (None, []) => true,
        (Some(set_piece), [event]) => {
            event.kind == event_of(set_piece.mode) && event.by == Some(set_piece.taker)
        }
        _ => false,
    };
    must(right, || format!("{expected:?} was taken as {set_pieces:?}"))?;
    let same = judged
        .play
        .set_piece
        .is_none_or(|now| before.play.set_piece.is_some_and(|was| now.spot == was.spot));
    must(same, || format!("{:?} came without a stop", judged.play.set_piece))?;
    let kick_offs = count(events, |event| of(&event) && event.kind == EventKind::Kickoff);
    let kicked_off = before.play.kick_off.is_some() && judged.play.kick_off.is_none();
    must(kick_offs <= usize::from(kicked_off), || format!("{kick_offs} kick-offs taken"))
}
