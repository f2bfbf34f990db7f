//! Payments that no match can earn, and why.

use crate::lower::Lower;
use setpiece_scenario::pitch::STEPS_PER_S;
use setpiece_scenario::vocabulary::{EventKind, Field, Qualifier, Rule, Team};
use setpiece_scenario::{EventFilter, Instr, Over, Reg, UnaryOp, Who};

impl Lower<'_, '_> {
    /// Why no event of the match passes a filter, if none does.
    pub(super) fn never_happens(&self, filter: &EventFilter) -> Option<String> {
        if let Some(rule) = self.switched_off(filter.kind) {
            let write = if rule == Rule::HalfTime { "1500 steps" } else { "on" };
            return Some(format!("`{}` never happens: write `rules {{ {rule}: {write} }}`", filter.kind));
        }
        let (by, to) = (self.team_of(filter.by?)?, self.team_of(filter.to?)?);
        match filter.qualifier {
            Some(Qualifier::Completed) if by != to => {
                Some("a pass is completed to a team mate: write `pass intercepted`, or name one".to_owned())
            }
            Some(Qualifier::Intercepted) if by == to => {
                Some("an opponent intercepts a pass: write `pass completed`, or name one".to_owned())
            }
            _ => None,
        }
    }

    /// The rule without which there is no such event, if the scenario switches it off whatever its parameters are.
    fn switched_off(&self, kind: EventKind) -> Option<Rule> {
        let off = |rule: Rule| self.is_off(rule).then_some(rule);
        // Fouls and handballs are what is punished.
        let offences = || off(Rule::Handball).and_then(|_| off(Rule::Fouls));
        match kind {
            EventKind::Offside => off(Rule::Offside),
            EventKind::Handball => off(Rule::Handball),
            EventKind::HalfTime => off(Rule::HalfTime),
            EventKind::Foul | EventKind::Advantage => off(Rule::Fouls),
            EventKind::YellowCard | EventKind::RedCard => off(Rule::Cards).or_else(offences),
            // The match may begin with one.
            EventKind::Penalty if self.world.flat.start.is_none() => off(Rule::Penalties).or_else(offences),
            _ => None,
        }
    }

    fn team_of(&self, who: Who) -> Option<Team> {
        match who {
            Who::Team(reg) => self.known_team(reg),
            Who::Player(reg) => {
                let id = self.code.constant_of(reg)?;
                self.world.roster.iter().find(|player| f64::from(player.id) == id).map(|player| player.team)
            }
        }
    }

    fn known_team(&self, reg: Reg) -> Option<Team> {
        match self.code.instr(reg)? {
            Instr::Const(index) if *index == 0.0 => Some(Team::Left),
            Instr::Const(index) if *index == 1.0 => Some(Team::Right),
            Instr::Us => self.side_with_agents(),
            Instr::Unary(UnaryOp::OtherTeam, team) => Some(match self.known_team(*team)? {
                Team::Left => Team::Right,
                Team::Right => Team::Left,
            }),
            _ => None,
        }
    }

    /// Why a condition never holds, in a word about the one thing that it looks at.
    pub(super) fn why_never(&self, guard: Reg) -> String {
        let reads = |fields: &[Field]| {
            let test = |instr: &Instr| matches!(instr, Instr::Load { field, .. } if fields.contains(field));
            self.code.depends(guard, &test)
        };
        let counts = self
            .code
            .depends(guard, &|instr| matches!(instr, Instr::Each(each) if matches!(each.over, Over::Players { .. })));
        let limit =
            self.longest().map(|seconds| format!("the episode is over after {:.0} steps", seconds * STEPS_PER_S));
        let all = [
            (reads(PLACES), Some("x lies between about -1 and 1, y between -0.42 and 0.42".to_owned())),
            (reads(&[Field::BallVx, Field::BallVy, Field::BallVz]), Some("no ball flies as fast".to_owned())),
            (reads(&[Field::PlayerVx, Field::PlayerVy]), Some("nobody runs as fast".to_owned())),
            (reads(&[Field::PlayerYellowCards]), Some("a player has 0, 1 or 2 yellow cards".to_owned())),
            (reads(&[Field::PlayerFatigue]), Some("fatigue lies between 0 and 1".to_owned())),
            (reads(&[Field::BallHeight]), Some("no ball rises as high".to_owned())),
            (reads(&[Field::Elapsed, Field::Remaining]), limit),
            (counts, Some("a team has at most 11 players".to_owned())),
        ];
        let mut met = all.into_iter().filter(|(met, _)| *met);
        match (met.next(), met.next()) {
            (Some((_, Some(why))), None) => format!("its condition can't hold: {why}"),
            (None, _) => "its condition is never true: write another one, or leave it out".to_owned(),
            _ => "its condition can't hold: look at each of its values".to_owned(),
        }
    }
}

const PLACES: &[Field] = &[Field::BallX, Field::BallY, Field::PlayerX, Field::PlayerY];
