//! The rewards, records and endings of a generated episode, and its behaviours.

use super::{View, Writer};

impl Writer<'_, '_> {
    pub(super) fn reward(&mut self, n: usize) {
        let view = View::Own;
        let weight = self.choices.between(1.0, -2.0);
        let audience = self.choices.one(&["", "", "", " for left", " for CF", " for right"]);
        self.line(&format!("reward r{n}{audience} {{ state s = 0"));
        for at in 0..=self.choices.below(4) {
            let (value, condition) = (self.number(view), self.condition(view));
            let line = match self.choices.below(9) {
                0 => format!("give {value} when {condition} as \"a{at}\""),
                1 => format!("give {value} per second as \"b{at}\""),
                2 => format!("give {value} once when {condition} as \"c{at}\""),
                3 => {
                    format!("give event.length / 1m + {value} on {} as \"d{at}\"", self.event(view))
                }
                4 => {
                    format!("on {} {{ s = s + 1 give s * {value} as \"e{at}\" }}", self.event(view))
                }
                5 => format!("when {condition} {{ s = {value} }} else {{ give s as \"f{at}\" }}"),
                6 => {
                    let who =
                        self.choices.one(&["left", "CF", "assist", "[GK, right]", "ball.owner"]);
                    format!("give {value} to {who} when {condition} as \"h{at}\"")
                }
                7 => format!("give potential({value}, gamma: 0.99) as \"i{at}\""),
                _ => format!("give {value} on end success as \"g{at}\""),
            };
            self.line(&line);
        }
        self.line(&format!("}} * {weight:.2}"));
    }

    pub(super) fn ending(&mut self, n: usize) {
        let verdict = self.choices.one(&["", "success ", "failure "]);
        // Most endings wait, so that something is played.
        let after = self.choices.below(80);
        let condition = self.condition(View::World);
        self.line(&format!("end {verdict}e{n} when elapsed > {after} steps and ({condition})"));
    }

    pub(super) fn record(&mut self, n: usize) {
        let view = View::World;
        let kind = self.choices.below(6);
        let value = match kind {
            0 => format!("count of ({})", self.condition(view)),
            1 => format!(
                "{} of ({})",
                self.choices.one(&["max", "min", "mean", "sum"]),
                self.number(view)
            ),
            2 => format!("count of {}", self.event(view)),
            3 => "first of ball".to_owned(),
            4 => format!("series of ({})", self.number(view)),
            _ => self.number(view),
        };
        self.line(&format!("record m{n} = {value}"));
        if !matches!(kind, 3 | 4) {
            self.records.push(format!("m{n}"));
        }
    }

    pub(super) fn observation(&mut self) {
        let view = View::Observed;
        self.line("observe vector {");
        for n in 0..=self.choices.below(5) {
            let value = match self.choices.below(4) {
                0 => self.number(view),
                1 => self.point(view),
                2 => self.condition(view),
                _ => "ball.velocity".to_owned(),
            };
            let sight = match self.choices.below(6) {
                0 => "",
                1 => "delayed 0.3s",
                2 => "stack 3",
                3 => "when sees(me, ball, within: 120deg)",
                4 => "delayed uniform(0s, 0.5s) stack 2",
                _ => "when us has ball stack 2",
            };
            self.line(&format!("({value}) {sight} as \"o{n}\""));
            if self.choices.rarely(3) {
                self.line(&format!("ball noise normal(0, 0.3m) stack 2 as \"noisy{n}\""));
            }
        }
        self.line("}");
    }

    pub(super) fn substitution(&mut self) {
        let Some(name) = self.somebody() else { return };
        let condition = self.condition(View::World);
        let options = self.choices.one(&[
            "",
            " { fatigue: 0.2 }",
            " { difficulty: 0.5 }",
            " { stats: { speed: 0.9, stamina: 0.1 } }",
        ]);
        self.line(&format!("substitute {name} when {condition}{options}"));
    }

    pub(super) fn behavior(&mut self, n: usize) {
        self.line(&format!("behavior b{n} {{ state n = 0"));
        for _ in 0..=self.choices.below(4) {
            self.statement(2);
        }
        if self.choices.rarely(3) {
            let condition = self.condition(View::Behavior);
            self.line(&format!("interrupt when {condition} {{ do press for 3 steps }}"));
        }
        self.line("}");
        self.behaviors.push(format!("b{n}"));
    }

    fn statement(&mut self, depth: usize) {
        let view = View::Behavior;
        match self.choices.below(if depth == 0 { 4 } else { 10 }) {
            0..4 => {
                let act = self.act();
                let steps = self.choices.below(20);
                let line = match self.choices.below(3) {
                    0 => format!("do {act} for {steps} steps"),
                    1 => format!("do {act} until {} for {steps} steps", self.condition(view)),
                    _ => format!("do {act}"),
                };
                self.line(&line);
            }
            4 => {
                let condition = self.condition(view);
                self.line(&format!("if {condition} {{"));
                self.statement(depth - 1);
                self.line("} else {");
                self.statement(depth - 1);
                self.line("}");
            }
            5 => {
                self.line("choose { 2: {");
                self.statement(depth - 1);
                self.line("} 1: {");
                self.statement(depth - 1);
                self.line("} }");
            }
            6 => {
                let times = self.choices.below(9);
                self.line(&format!("repeat {times} times {{"));
                self.statement(depth - 1);
                self.line("}");
            }
            7 => {
                let condition = self.condition(view);
                self.line(&format!("repeat until {condition} {{"));
                self.statement(depth - 1);
                self.line("}");
            }
            8 => self.line("n = n + 1"),
            _ => self.line("if n > 3 { finish }"),
        }
    }

    fn act(&mut self) -> String {
        let view = View::Behavior;
        match self.choices.below(16) {
            0 => "hold".to_owned(),
            1 | 2 => {
                format!("move_to({}){}", self.point(view), self.choices.one(&["", " sprinting"]))
            }
            3 => format!("run({}deg)", self.choices.byte()),
            4 | 5 => format!("dribble_to({})", self.point(view)),
            6 => format!("pass_to(nearest(mates, to: {}))", self.point(view)),
            7 => "high_pass_to(max_by(p.x for p in mates))".to_owned(),
            8 => "long_pass_to(nearest(mates, to: them.goal))".to_owned(),
            9 => "shoot".to_owned(),
            10 => "shoot(at: them.top_post)".to_owned(),
            11 => "tackle".to_owned(),
            12 => "slide".to_owned(),
            13 => "mark(nearest(them, to: me))".to_owned(),
            14 => "press".to_owned(),
            _ => "bot".to_owned(),
        }
    }
}
