//! A person's keys: what is held becomes one action per step.

use crate::scenario::Action;
use serde::Deserialize;

/// What a person holds down.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeldKeys {
    /// The direction in the picture: x to the right, y down, each -1, 0 or 1.
    pub way: [i8; 2],
    /// The other keys, by the names of their actions.
    pub held: Vec<HeldKey>,
}

/// A key that isn't a direction, the more urgent first. (GRF's order.)
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HeldKey {
    /// A long pass.
    LongPass,
    /// A lofted pass.
    HighPass,
    /// A short pass.
    ShortPass,
    /// A shot.
    Shot,
    /// A slide.
    Sliding,
    /// Runs faster for as long as it is held.
    Sprint,
    /// Keeps the ball close for as long as it is held.
    Dribble,
}

impl HeldKey {
    const ALL: [HeldKey; 7] = [
        HeldKey::LongPass,
        HeldKey::HighPass,
        HeldKey::ShortPass,
        HeldKey::Shot,
        HeldKey::Sliding,
        HeldKey::Sprint,
        HeldKey::Dribble,
    ];

    fn pressed(self) -> Action {
        match self {
            HeldKey::LongPass => Action::LongPass,
            HeldKey::HighPass => Action::HighPass,
            HeldKey::ShortPass => Action::ShortPass,
            HeldKey::Shot => Action::Shot,
            HeldKey::Sliding => Action::Sliding,
            HeldKey::Sprint => Action::Sprint,
            HeldKey::Dribble => Action::Dribble,
        }
    }

    /// What its release sends; none for a key that acts for as long as it is sent.
    fn released(self) -> Option<Action> {
        match self {
            HeldKey::Sprint => Some(Action::ReleaseSprint),
            HeldKey::Dribble => Some(Action::ReleaseDribble),
            _ => None,
        }
    }
}

/// A person who plays an agent.
#[derive(Clone, Debug, Default)]
pub struct Hands {
    /// What is held now.
    pub keys: HeldKeys,
    /// What the match has been sent of it.
    way: [i8; 2],
    down: Vec<HeldKey>,
}

impl Hands {
    /// The action of the next step: a changed direction first, then a changed key, then a kick for
    /// as long as its key is held.
    ///
    /// `turns`: whether the agent's team attacks to the left, in whose own frame actions are.
    pub fn act(&mut self, turns: bool) -> Action {
        if self.keys.way != self.way {
            self.way = self.keys.way;
            return direction(self.way, turns);
        }
        for key in HeldKey::ALL {
            let is_held = self.keys.held.contains(&key);
            if is_held == self.down.contains(&key) {
                continue;
            }
            if is_held {
                self.down.push(key);
                return key.pressed();
            }
            self.down.retain(|other| *other != key);
            if let Some(action) = key.released() {
                return action;
            }
        }
        let mut kicks = HeldKey::ALL.into_iter().filter(|key| key.released().is_none());
        kicks.find(|key| self.down.contains(key)).map_or(Action::Idle, HeldKey::pressed)
    }
}

fn direction([x, y]: [i8; 2], turns: bool) -> Action {
    let side = if turns { -1 } else { 1 };
    match (x.signum() * side, y.signum() * side) {
        (-1, 0) => Action::Left,
        (-1, -1) => Action::TopLeft,
        (0, -1) => Action::Top,
        (1, -1) => Action::TopRight,
        (1, 0) => Action::Right,
        (1, 1) => Action::BottomRight,
        (0, 1) => Action::Bottom,
        (-1, 1) => Action::BottomLeft,
        _ => Action::ReleaseDirection,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_action_is_sent_a_step_and_nothing_is_lost() {
        let mut hands = Hands::default();
        assert_eq!(hands.act(false), Action::Idle);
        hands.keys = HeldKeys { way: [1, -1], held: vec![HeldKey::Sprint] };
        assert_eq!(
            [(); 3].map(|()| hands.act(false)),
            [Action::TopRight, Action::Sprint, Action::Idle]
        );
        hands.keys.held.push(HeldKey::Shot);
        assert_eq!([(); 2].map(|()| hands.act(false)), [Action::Shot, Action::Shot]);
        hands.keys = HeldKeys::default();
        assert_eq!(
            [(); 3].map(|()| hands.act(false)),
            [Action::ReleaseDirection, Action::ReleaseSprint, Action::Idle]
        );
    }

    #[test]
    fn the_right_team_s_directions_are_those_of_the_picture() {
        let mut hands = Hands::default();
        hands.keys.way = [1, -1];
        assert_eq!(hands.act(true), Action::BottomLeft);
    }
}
