//! Events in words, and how important each is.

use crate::engine::state::PlayerId;
use crate::engine::state::event::Event;
use crate::scenario::Team;
use crate::scenario::vocabulary::{EventKind, Qualifier};
use setpiece_render::scene::Mode;

/// A part of a sentence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Piece {
    /// Words.
    Text(&'static str),
    /// A player: their shirt and label.
    Player(PlayerId),
    /// A team: its colour and its name.
    Team(Team),
}

/// What happened, in a few words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sentence {
    /// Its parts, separated by blanks.
    pub pieces: Vec<Piece>,
    /// Its importance.
    pub weight: u32,
    /// How often it happened.
    pub times: u32,
}

/// The weight of events that decide matches.
pub const DECISIVE: u32 = 90;

/// The importance of an event: 0 is never reported, a goal is 100.
pub fn weight(event: &Event) -> u32 {
    use EventKind as E;
    match (event.kind, event.qualifier) {
        (E::Goal | E::OwnGoal, _) => 100,
        (E::RedCard, _) => 95,
        (E::Penalty, None) => DECISIVE,
        (E::Assist, _) => 80,
        (E::Shot, None) => 70,
        (E::Save, _) => 66,
        (E::Woodwork, _) => 64,
        (E::Penalty, _) => 62,
        (E::YellowCard, _) => 60,
        (E::Handball, _) => 55,
        (E::Foul, _) => 52,
        (E::Offside, _) => 50,
        (E::Corner, None) => 48,
        (E::Shot, Some(Qualifier::Blocked)) => 46,
        (E::HalfTime | E::FullTime, _) => 45,
        (E::FreeKick, None) => 40,
        (E::Advantage | E::Parry, _) => 36,
        (E::Corner | E::FreeKick, _) => 34,
        (E::Shot, _) => 32,
        (E::Catch, _) => 26,
        (E::Tackle, _) => 25,
        (E::GoalKick | E::Kickoff, None) => 22,
        (E::Interception, _) => 20,
        (E::OutOfPlay, _) => 18,
        (E::ThrowIn, None) => 17,
        (E::Slide, _) => 16,
        (E::Header, _) => 14,
        (E::Pass, None | Some(Qualifier::Attempted)) => 10,
        (E::GoalKick | E::Kickoff | E::ThrowIn, _) => 9,
        (E::Pass, _) => 8,
        (E::Touch | E::BallWon | E::BallLost | E::End, _) => 0,
    }
}

/// Describes events in words, in order. An event that another one includes is left out, and
/// repeated ones are counted.
pub fn tell(events: &[Event]) -> Vec<Sentence> {
    let mut sentences: Vec<Sentence> = Vec::new();
    for (index, event) in events.iter().enumerate() {
        let later = events.get(index + 1..).unwrap_or_default();
        if weight(event) == 0 || is_said_again(event, events, later) {
            continue;
        }
        let pieces = sentence(event);
        // Listed where it last happened.
        let before = sentences.iter().position(|sentence| sentence.pieces == pieces);
        let times = 1 + before.map_or(0, |before| sentences.remove(before).times);
        sentences.push(Sentence { pieces, weight: weight(event), times });
    }
    sentences
}

/// Whether another event describes the result of this one equally well.
fn is_said_again(event: &Event, all: &[Event], later: &[Event]) -> bool {
    use EventKind as E;
    let any = |events: &[Event], kind: E, by: Option<PlayerId>| {
        events.iter().any(|next| next.kind == kind && (by.is_none() || next.by == by))
    };
    match (event.kind, event.qualifier.filter(|&qualifier| qualifier != Qualifier::Attempted)) {
        (E::Pass, None) => any(later, E::Pass, event.by),
        (E::Pass, Some(Qualifier::Intercepted)) => any(later, E::Interception, event.to),
        (E::Shot, None) => any(later, E::Goal, event.by),
        (E::Shot, Some(Qualifier::OnTarget)) => any(all, E::Save, None) || any(all, E::Goal, None),
        (E::Header, _) => any(all, E::Save, event.by),
        _ => false,
    }
}

fn sentence(event: &Event) -> Vec<Piece> {
    let mut pieces = vec![Piece::Text(verb(event))];
    let by = event.by.map(Piece::Player).or_else(|| event.team.map(Piece::Team));
    let to = event.to.filter(|_| takes_another(event.kind)).map(Piece::Player);
    pieces.extend(by);
    if let Some(to) = to {
        let is_pass = matches!(event.kind, EventKind::Pass | EventKind::Assist);
        pieces.extend([Piece::Text(if is_pass { "→" } else { "on" }), to]);
    }
    pieces
}

/// Whether the receiver or victim is part of the sentence.
fn takes_another(kind: EventKind) -> bool {
    use EventKind as E;
    matches!(kind, E::Pass | E::Foul | E::Tackle | E::Advantage | E::Assist)
}

fn verb(event: &Event) -> &'static str {
    use EventKind as E;
    match (event.kind, event.qualifier) {
        (E::Goal, _) => "GOAL",
        (E::OwnGoal, _) => "own goal",
        (E::Shot, None) => "shot",
        (E::Shot, Some(Qualifier::OnTarget)) => "shot on target",
        (E::Shot, Some(Qualifier::Blocked)) => "shot blocked",
        (E::Shot, Some(_)) => "shot off target",
        (E::Save, _) => "save",
        (E::Catch, _) => "catch",
        (E::Parry, _) => "parry",
        (E::Woodwork, _) => "woodwork",
        (E::Pass, Some(Qualifier::Completed)) => "pass completed",
        (E::Pass, Some(Qualifier::Intercepted)) => "pass intercepted",
        (E::Pass, _) => "pass",
        (E::Touch, _) => "touch",
        (E::Header, _) => "header",
        (E::Tackle, _) => "tackle",
        (E::Slide, _) => "slide",
        (E::Interception, _) => "interception",
        (E::BallWon, _) => "ball won",
        (E::BallLost, _) => "ball lost",
        (E::Foul, _) => "foul",
        (E::Handball, _) => "handball",
        (E::Offside, _) => "offside",
        (E::YellowCard, _) => "yellow card",
        (E::RedCard, _) => "red card",
        (E::Advantage, _) => "advantage: foul",
        (E::Assist, _) => "assist",
        (E::ThrowIn, None) => "throw-in",
        (E::ThrowIn, _) => "throw-in taken",
        (E::Corner, None) => "corner",
        (E::Corner, _) => "corner taken",
        (E::GoalKick, None) => "goal kick",
        (E::GoalKick, _) => "goal kick taken",
        (E::FreeKick, None) => "free kick",
        (E::FreeKick, _) => "free kick taken",
        (E::Penalty, None) => "penalty",
        (E::Penalty, _) => "penalty taken",
        (E::Kickoff, None) => "kick-off",
        (E::Kickoff, _) => "kick-off taken",
        (E::OutOfPlay, _) => "out of play",
        (E::HalfTime, _) => "half-time",
        (E::FullTime, _) => "full time",
        (E::End, _) => "end",
    }
}

/// A pending set piece in words; none in open play.
pub const fn waiting(mode: Mode) -> Option<&'static str> {
    match mode {
        Mode::Normal => None,
        Mode::KickOff => Some("kick-off"),
        Mode::GoalKick => Some("goal kick"),
        Mode::FreeKick => Some("free kick"),
        Mode::Corner => Some("corner"),
        Mode::ThrowIn => Some("throw-in"),
        Mode::Penalty => Some("penalty"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn event(kind: EventKind, qualifier: Option<Qualifier>, by: u8, to: Option<u8>) -> Event {
        let (by, to) = (Some(PlayerId(by)), to.map(PlayerId));
        let team = by.map(PlayerId::team);
        Event {
            tick: 0,
            kind,
            qualifier,
            team,
            by,
            to,
            at: [0.0; 3].into(),
            length_m: 0.0,
            speed_mps: 0.0,
        }
    }

    fn described(events: &[Event]) -> Vec<String> {
        let word = |piece: &Piece| match piece {
            Piece::Text(text) => (*text).to_owned(),
            Piece::Player(id) => format!("{}", id.0),
            Piece::Team(team) => team.to_string(),
        };
        let sentence = |sentence: &Sentence| {
            let words: Vec<String> = sentence.pieces.iter().map(word).collect();
            format!("{} ×{}", words.join(" "), sentence.times)
        };
        tell(events).iter().map(sentence).collect()
    }

    #[test]
    fn a_pass_is_reported_once() {
        let struck = event(EventKind::Pass, Some(Qualifier::Attempted), 3, Some(4));
        let arrived = event(EventKind::Pass, Some(Qualifier::Completed), 3, Some(4));
        let cut_out = event(EventKind::Pass, Some(Qualifier::Intercepted), 3, Some(14));
        assert_eq!(described(&[struck]), ["pass 3 → 4 ×1"]);
        assert_eq!(described(&[struck, arrived]), ["pass completed 3 → 4 ×1"]);
        assert_eq!(
            described(&[struck, cut_out, event(EventKind::Interception, None, 14, Some(3))]),
            ["interception 14 ×1"]
        );
    }

    #[test]
    fn a_goal_says_all_of_its_shot() {
        let shot = event(EventKind::Shot, None, 9, None);
        let on_target = event(EventKind::Shot, Some(Qualifier::OnTarget), 9, None);
        assert_eq!(
            described(&[shot, on_target, event(EventKind::Goal, None, 9, None)]),
            ["GOAL 9 ×1"]
        );
        assert_eq!(
            described(&[
                event(EventKind::Goal, None, 9, None),
                event(EventKind::Assist, None, 8, Some(9))
            ]),
            ["GOAL 9 ×1", "assist 8 → 9 ×1"]
        );
        assert_eq!(
            described(&[shot, event(EventKind::Save, None, 11, None), on_target]),
            ["shot 9 ×1", "save 11 ×1"]
        );
    }

    #[test]
    fn what_happens_again_is_counted_where_it_happened_last() {
        let tackle = event(EventKind::Tackle, None, 3, Some(14));
        let touch = event(EventKind::Touch, None, 3, None);
        let slide = event(EventKind::Slide, None, 4, None);
        assert_eq!(described(&[tackle, touch, slide, tackle]), ["slide 4 ×1", "tackle 3 on 14 ×2"]);
    }
}
