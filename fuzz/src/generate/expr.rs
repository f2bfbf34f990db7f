//! Generated expressions, by type.

use super::{View, Writer};

/// Deepest nesting of an expression.
const DEPTH: usize = 3;
const EVENTS: &[&str] = &[
    "goal",
    "assist",
    "shot",
    "pass",
    "touch",
    "pass completed",
    "pass intercepted",
    "shot on_target",
    "shot off_target",
    "shot blocked",
    "save",
    "catch",
    "parry",
    "woodwork",
    "header",
    "tackle",
    "slide",
    "interception",
    "ball_won",
    "ball_lost",
    "foul",
    "offside",
    "yellow_card",
    "red_card",
    "throw_in",
    "corner",
    "goal_kick",
    "free_kick",
    "penalty",
    "kickoff",
    "out_of_play",
    "own_goal",
    "corner taken",
    "kickoff taken",
    "half_time",
];

impl Writer<'_, '_> {
    /// Some player's name.
    pub(super) fn somebody(&mut self) -> Option<String> {
        let all: Vec<&String> = self.squads.iter().flatten().collect();
        (!all.is_empty()).then(|| all[self.choices.below(all.len())].clone())
    }

    pub(super) fn number(&mut self, view: View) -> String {
        self.number_at(view, DEPTH)
    }

    pub(super) fn condition(&mut self, view: View) -> String {
        self.condition_at(view, DEPTH)
    }

    fn number_at(&mut self, view: View, depth: usize) -> String {
        let depth = depth.saturating_sub(1);
        if depth == 0 {
            return self.leaf(view);
        }
        match self.choices.below(19) {
            0 | 1 => self.leaf(view),
            2 => {
                let sign = self.choices.one(&["+", "-", "*", "/"]);
                format!("({} {sign} {})", self.number_at(view, depth), self.number_at(view, depth))
            }
            3 => format!("(distance({}, {}) / 1m)", self.point(view), self.point(view)),
            4 => {
                let function =
                    self.choices.one(&["sqrt", "log", "exp", "abs", "floor", "round", "ceil"]);
                format!("{function}({})", self.number_at(view, depth))
            }
            5 => {
                let function = self.choices.one(&["min", "max", "mod", "pow"]);
                format!(
                    "{function}({}, {})",
                    self.number_at(view, depth),
                    self.number_at(view, depth)
                )
            }
            6 => {
                let (c, a, b) = (
                    self.condition_at(view, depth),
                    self.number_at(view, depth),
                    self.number_at(view, depth),
                );
                format!("(if {c} then {a} else {b})")
            }
            7 => format!("count(p in {} where {})", self.set(view), self.of_player(view, "p")),
            8 => {
                let fold = self.choices.one(&["sum", "mean", "min", "max"]);
                format!("{fold}(p.x * p.y for p in {})", self.set(view))
            }
            9 if view.knows_time() => {
                let inner = self.number_at(inner(view), depth);
                let function = self.choices.one(&["prev", "delta"]);
                format!("{function}({inner})")
            }
            10 if view.knows_time() => {
                format!("(since({}) / 1s)", self.condition_at(inner(view), depth))
            }
            11 if view.knows_time() => format!("(closing(ball, {}) / 1m)", self.point(inner(view))),
            12 => format!("offside_line({})", self.team(view)),
            16 if !self.tables.is_empty() => self.looked_up(view),
            17 if view != View::Start => {
                let fold = self.choices.one(&["sum", "mean", "min", "max"]);
                let (grid, of) = (self.grid(), self.of_point(view));
                format!("{fold}({of} for q in {grid})")
            }
            18 if view != View::Start => {
                format!("count(q in {} where {} > 0.3)", self.grid(), self.of_point(view))
            }
            13 if view.judges() => format!("(count of {})", self.event(view)),
            14 if view.judges() => {
                let fold = self.choices.one(&["max", "min", "mean", "sum", "first", "last"]);
                format!("({fold} of {})", self.leaf(view))
            }
            _ => format!("(angle({}, {}) / 1rad)", self.point(view), self.point(view)),
        }
    }

    fn leaf(&mut self, view: View) -> String {
        match self.choices.below(11) {
            0 => format!("{:.2}", self.choices.between(0.0, 3.0)),
            1 => "ball.x".to_owned(),
            2 if !self.numbers.is_empty() && view != View::Behavior => {
                let at = self.choices.below(self.numbers.len());
                self.numbers[at].clone()
            }
            3 => "(ball.speed / 1m/s)".to_owned(),
            4 => format!("{}.x", self.player(view)),
            5 => format!("{}.fatigue", self.player(view)),
            6 => "(elapsed / 1s)".to_owned(),
            7 => "(remaining / 1s)".to_owned(),
            8 if view.judges() && !self.records.is_empty() => {
                let at = self.choices.below(self.records.len());
                self.records[at].clone()
            }
            9 => format!("({}.metres.y / 1m)", self.player(view)),
            _ => "(ball.height / 1m)".to_owned(),
        }
    }

    fn condition_at(&mut self, view: View, depth: usize) -> String {
        let depth = depth.saturating_sub(1);
        let plain = depth == 0;
        match self.choices.below(15) {
            0 | 1 => {
                let sign = self.choices.one(&["<", ">", "<=", ">=", "==", "!="]);
                format!("{} {sign} {}", self.number_at(view, depth), self.number_at(view, depth))
            }
            2 => format!("ball in {}", self.area(view)),
            3 => format!("{} has ball", self.team(view)),
            4 => format!("possession == {}", self.team(view)),
            5 => format!("pressed({}, within: {}m)", self.player(view), 1 + self.choices.below(20)),
            14 => format!("sees({}, ball, within: 120deg)", self.player(view)),
            6 if !plain => format!("(not ({}))", self.condition_at(view, depth)),
            7 if !plain => {
                let word = self.choices.one(&["and", "or"]);
                format!(
                    "(({}) {word} ({}))",
                    self.condition_at(view, depth),
                    self.condition_at(view, depth)
                )
            }
            8 => {
                let fold = self.choices.one(&["any", "all"]);
                format!("{fold}(p in {} where {})", self.set(view), self.of_player(view, "p"))
            }
            9 if view.knows_time() && !plain => {
                let (inner, steps) =
                    (self.condition_at(inner(view), depth), self.choices.below(30));
                match self.choices.below(4) {
                    0 => format!("held({inner}, for: {steps} steps)"),
                    1 => format!("within({inner}, {steps} steps)"),
                    2 => format!("ever({inner})"),
                    _ => format!("always({inner})"),
                }
            }
            10 if view.knows_time() => self.event(view),
            11 if view.knows_time() => format!("possession changes to {}", self.team(view)),
            12 => format!(
                "game_mode == {}",
                self.choices.one(&["normal", "corner", "throw_in", "free_kick"])
            ),
            _ => "ball_dead".to_owned(),
        }
    }

    /// A condition on the player of a loop.
    fn of_player(&mut self, view: View, p: &str) -> String {
        match self.choices.below(7) {
            0 => format!("{p}.x > ball.x"),
            1 => format!("{p}.speed > {}m/s", self.choices.below(8)),
            2 => format!("{p} in {}", self.area(view)),
            3 => format!("pressed({p}, within: 5m)"),
            4 => format!("{p}.role != GK and {p}.active and not {p}.sprinting"),
            5 => format!(
                "{p}.action {}",
                self.choices.one(&["== shot", "!= idle", "in [left, short_pass]", "changes"])
            ),
            _ => format!("count(o in players where distance(o, {p}) < 9m) > 1"),
        }
    }

    /// A number of a table.
    fn looked_up(&mut self, view: View) -> String {
        let at = self.choices.below(self.tables.len());
        let (table, how) = (self.tables[at].clone(), self.choices.one(&["", ", linear"]));
        format!("{table}({}{how})", self.point(view))
    }

    fn grid(&mut self) -> String {
        let over = self.choices.one(&["", ", right.box", ", left.half"]);
        format!("grid({}, {}{over})", 1 + self.choices.below(6), 1 + self.choices.below(4))
    }

    /// A number of a grid's point `q`.
    fn of_point(&mut self, view: View) -> String {
        match (self.choices.below(4), self.tables.first().cloned()) {
            (0, Some(table)) => format!("{table}(q, linear)"),
            (1, _) => format!("(distance(q, {}) / 9m)", self.point(inner(view))),
            (2, _) => "q.x * q.y".to_owned(),
            _ => format!("min(distance(q, p) for p in {}) / 1m", self.set(view)),
        }
    }

    /// An event with its clauses.
    pub(super) fn event(&mut self, view: View) -> String {
        let mut event = self.choices.one(EVENTS).to_owned();
        if event != "half_time" && self.choices.rarely(2) {
            event.push_str(&format!(" by {}", self.team(view)));
        }
        if self.choices.rarely(6) {
            event.push_str(&format!(" from {}", self.area(view)));
        }
        event
    }

    pub(super) fn point(&mut self, view: View) -> String {
        match self.choices.below(6) {
            0 => "ball".to_owned(),
            1 => self.spot(1.0, 0.4),
            2 => format!("{}.goal", self.team(view)),
            3 => self.player(view),
            4 => format!("{}.zone.CM", self.team(view)),
            _ => format!("{}.corner.top", self.team(view)),
        }
    }

    pub(super) fn area(&mut self, view: View) -> String {
        let team = if view == View::Start {
            self.choices.one(&["left", "right"])
        } else {
            self.team(view)
        };
        match self.choices.below(8) {
            0 | 1 => {
                format!("{team}.{}", self.choices.one(&["box", "half", "third", "six_yard", "d"]))
            }
            2 => "centre_circle".to_owned(),
            3 | 4 if !self.regions.is_empty() => {
                let at = self.choices.below(self.regions.len());
                self.regions[at].clone()
            }
            5 => "(flank.top | half_space.bottom)".to_owned(),
            6 => "middle.third".to_owned(),
            _ => format!("circle({}, 9m)", self.spot(0.8, 0.3)),
        }
    }

    pub(super) fn team(&mut self, view: View) -> &'static str {
        if view.is_own() {
            self.choices.one(&["us", "them"])
        } else {
            self.choices.one(&["left", "right"])
        }
    }

    fn set(&mut self, view: View) -> &'static str {
        if view.is_own() {
            self.choices.one(&["us", "them", "mates", "players"])
        } else {
            self.choices.one(&["left", "right", "players"])
        }
    }

    /// A player, possibly nobody.
    pub(super) fn player(&mut self, view: View) -> String {
        let named = self.choices.rarely(2).then(|| self.somebody()).flatten();
        if let (Some(name), false) = (named, view == View::Behavior) {
            return name;
        }
        match self.choices.below(3) {
            0 if view.is_own() => "me".to_owned(),
            1 => format!("max_by(p.x for p in {})", self.set(view)),
            _ => format!("nearest({}, to: ball)", self.set(view)),
        }
    }
}

/// The context inside a temporal function.
fn inner(view: View) -> View {
    View::Inner { own: view.is_own() }
}
