//! How a generated episode begins: the ball, the start, the teams.

use super::{View, Writer};

const OUTFIELD: &[&str] = &["CM", "CB", "CF", "LB", "RB", "DM", "LM", "RM", "AM"];
/// How many players a generated formation has.
const FORMED: usize = 4;
const STATS: &[&str] =
    &["speed", "shot_power", "agility", "stamina", "reaction", "dribble", "short_pass", "vision"];

impl Writer<'_, '_> {
    /// The ball and the start.
    pub(super) fn start(&mut self) {
        let team = self.choices.one(&["left", "right", "choice(left, right)"]);
        let point = self.spot(0.95, 0.4);
        let ball = match self.choices.below(8) {
            0 => format!("ball at {point}"),
            1 => format!("ball in {}", self.area(View::Start)),
            2 => {
                let (x, y, z) = (
                    self.choices.between(-30.0, 30.0),
                    self.choices.between(-30.0, 30.0),
                    self.choices.below(20),
                );
                let (height, spin) =
                    (self.choices.between(0.0, 20.0), self.choices.between(-200.0, 200.0));
                format!(
                    "ball at {point} {{ velocity: ({x:.1}m/s, {y:.1}m/s, {z}m/s), height: {height:.1}m, \
                     spin: ({spin:.0}, 3, {:.0}) }}",
                    -spin
                )
            }
            3 => match self.somebody() {
                Some(name) => format!("ball ahead of {name} by 1m {{ owner: {name} }}"),
                None => "ball at centre jitter 5m".to_owned(),
            },
            4 => format!("start kickoff for {team}"),
            5 => format!(
                "start {} for {team}",
                self.choices.one(&["corner", "goal_kick", "penalty"])
            ),
            6 => format!(
                "start {} for {team} at {point}",
                self.choices.one(&["free_kick", "throw_in"])
            ),
            _ => format!(
                "start corner for left at right.corner.bottom {{ score: [{}, 1] }}",
                self.choices.below(99)
            ),
        };
        self.line(&ball);
        if self.choices.rarely(8) {
            let (n, s) = (self.choices.between(1.0, 4.0).floor(), self.choices.below(4));
            self.line(&format!("rounds {n} when goal or round_elapsed > {s}s"));
        }
        if self.choices.rarely(6) {
            self.line("require min_gap(players) > 0.3m with 80%");
        }
    }

    pub(super) fn teams(&mut self) {
        for (side, name) in ["left", "right"].into_iter().enumerate() {
            let difficulty = self.choices.between(1.0, 0.0);
            self.line(&format!("team {name} {{ difficulty: {difficulty:.2}"));
            if self.squads[side].len() <= 11 - FORMED && self.choices.rarely(2) {
                self.formed();
            }
            // Players stand on separate lines, so that no two of them share a spot.
            for (n, player) in self.squads[side].clone().into_iter().enumerate() {
                self.place(n, &player);
            }
            self.line("}");
        }
    }

    /// A formation, of as many players as every other.
    pub(super) fn formation(&mut self, n: usize) {
        let share = self.choices.between(0.1, 0.9);
        self.line(&format!("formation form{n}(tired: number = {share:.2}) {{"));
        for at in 0..FORMED {
            let (role, x) = (self.choices.one(OUTFIELD), self.choices.between(-0.9, 0.5));
            let y = at as f64 * 0.15 - 0.3;
            self.line(&format!(
                "{role} at ({x:.2}, {y:.2}) {{ fatigue: tired, overlap: allowed }}"
            ));
        }
        self.line("}");
        self.formations.push(format!("form{n}"));
    }

    /// The formation of a team, or one of several, and what the scenario says of its players.
    fn formed(&mut self) {
        let Some(first) = self.formations.first().cloned() else { return };
        let last = self.formations.last().cloned().unwrap_or_default();
        let formation = match self.choices.below(4) {
            0 => first,
            1 => format!("{first}(tired: 0.9)"),
            2 => format!("choice({first}: 2, {last}: 1)"),
            _ => format!("if uniform(0, 1) > 0.5 then {first} else {last}"),
        };
        self.line(&format!("formation: {formation}"));
        let who = self.somebody().unwrap_or_else(|| "ball".to_owned());
        let value = self.numbers.first().cloned().unwrap_or_else(|| "0.3".to_owned());
        match self.choices.below(4) {
            0 => self.line("each all { ai: choice(press, hold) }"),
            1 => self.line(&format!("each outfield {{ difficulty: clamp({value}, 0, 1) }}")),
            2 if who != "ball" => self.line(&format!("each outfield {{ ai: mark({who}) }}")),
            _ => {}
        }
    }

    fn place(&mut self, n: usize, name: &str) {
        let role = if n == 0 && self.choices.rarely(2) { "GK" } else { self.choices.one(OUTFIELD) };
        let y = n as f64 * 0.07 - 0.36;
        let mut text = match self.choices.below(8) {
            0 | 1 => format!("{name}: {role} at ({:.2}, {y:.2})", self.choices.between(-1.0, 1.0)),
            2 => format!("{name}: {role} at own (-{:.2}, {y:.2})", self.choices.between(0.2, 1.0)),
            3 => format!("{name}: {role} in {}", self.area(View::Start)),
            4 => format!(
                "{name}: {role} at own.zone.{role} + ({n}m, {:.1}m)",
                self.choices.between(-3.0, 3.0)
            ),
            5 => format!(
                "{name}: {role} between (0, {y:.2}) and right.goal at {}%",
                self.choices.below(95)
            ),
            6 => format!(
                "{name}: {role} offset from centre along {}deg by 9m",
                n * 30 + self.choices.below(20)
            ),
            _ => {
                let goals = ["left.goal", "right.goal"];
                let (near, far) =
                    if name.starts_with('p') { (goals[0], goals[1]) } else { (goals[1], goals[0]) };
                format!("{name}: {role} beyond {near} by {:.2}m from {far}", n as f64 * 0.45)
            }
        };
        match self.choices.below(3) {
            1 => text.push_str(" facing ball"),
            2 => text.push_str(&format!(" facing {}deg", self.choices.byte())),
            _ => {}
        }
        if self.choices.rarely(4) {
            text.push_str(" jitter 1m");
        }
        let mut options = vec!["overlap: allowed".to_owned()];
        match self.choices.below(10) {
            1 => options.push("ai: hold".to_owned()),
            2 => options.push(
                self.choices
                    .one(&["ai: lazy", "ai: choice(press: 1, hold: 2)", "ai: press"])
                    .to_owned(),
            ),
            3..5 => {
                if let Some(behavior) = self.behaviors.get(n % self.behaviors.len().max(1)) {
                    options.push(format!("ai: {behavior}"));
                }
            }
            5 => {
                let (stat, value) = (self.choices.one(STATS), self.choices.between(0.0, 1.0));
                options.push(format!("stats: {{ {stat}: {value:.2} }}"));
            }
            6 => options.push(format!("fatigue: {:.2}", self.choices.between(0.0, 1.0))),
            7 => options.push("yellow_cards: 1".to_owned()),
            8 => {
                let (x, y) = (self.choices.between(-8.0, 8.0), self.choices.between(-8.0, 8.0));
                options.push(format!("velocity: ({x:.1}m/s, {y:.1}m/s)"));
            }
            _ => {}
        }
        text.push_str(&format!(" {{ {} }}", options.join(", ")));
        if self.choices.rarely(8) {
            // One name can't stand for several players.
            let of_many = text.split_once(": ").map(|(_, player)| player.to_owned());
            text = match of_many {
                Some(player) if self.choices.rarely(6) => format!("0..2 {player}"),
                _ => format!("maybe {}% {text}", self.choices.below(101)),
            };
        }
        self.line(&text);
    }

    /// A place on the pitch.
    pub(super) fn spot(&mut self, x: f64, y: f64) -> String {
        format!("({:.3}, {:.3})", self.choices.between(-x, x), self.choices.between(-y, y))
    }

    /// A region that is written out.
    pub(super) fn shape(&mut self) -> String {
        let (a, b) = (self.spot(0.9, 0.35), self.spot(0.9, 0.35));
        let metres = 2 + self.choices.below(20);
        match self.choices.below(7) {
            0 => "right.box".to_owned(),
            1 => format!("circle({a}, {metres}m)"),
            2 => format!("rect({a}, {b} + (0.01, 0.01))").replace(" + (0.01, 0.01)", ""),
            3 => format!("sector({a}, {metres}m, {}deg, {}deg)", metres * 9, metres * 9 + 90),
            4 => "polygon((0.8, -0.2), (0.95, -0.2), (0.85, -0.05), (0.8, -0.05))".to_owned(),
            5 => format!("left.half - circle({a}, {metres}m)"),
            _ => format!("right.third & (middle.lane | half_space.top) | circle({b}, {metres}m)"),
        }
    }
}
