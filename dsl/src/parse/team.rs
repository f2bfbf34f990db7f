//! Teams, formations, players and places.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{
    Expr, ExprKind, Facing, Field, FieldValue, Place, PlaceKind, PlayerStmt, Spanned, TeamStmt,
    TeamStmtKind,
};
use crate::check::options::TEAM;
use crate::problem::Problem;
use crate::problem::facts::Players;
use crate::source::Span;
use setpiece_grammar::Rule;
use setpiece_scenario::vocabulary::{Role, Unit};

impl Reader<'_> {
    /// The statements between a team's or formation's braces.
    pub(super) fn team_body(&mut self, node: CstNode<'_>) -> Vec<TeamStmt> {
        let mut body = self.list(node, Context::Team, Self::team_stmt, |span, _| TeamStmt {
            span,
            kind: TeamStmtKind::Broken,
        });
        self.find_named_shares(&mut body);
        body
    }

    /// `b: 30% CF` reads as an option and a player, and is meant to be one player.
    fn find_named_shares(&mut self, body: &mut [TeamStmt]) {
        for index in 1..body.len() {
            let Some([option, next]) = body.get_mut(index - 1..=index) else { continue };
            let (TeamStmtKind::Field(Field { key, value }), TeamStmtKind::Player(player)) =
                (&option.kind, &next.kind)
            else {
                continue;
            };
            let share = match value {
                FieldValue::Expr(Expr { kind: ExprKind::Number { unit, .. }, span })
                    if *unit == Some(Unit::Percent) =>
                {
                    self.text.get(span.start as usize..span.end as usize).unwrap_or_default()
                }
                FieldValue::Expr(Expr { kind: ExprKind::Name(word), .. }) if word == "maybe" => {
                    "50%"
                }
                _ => continue,
            };
            let between = self.text.get(option.span.end as usize..next.span.start as usize);
            let is_option = TEAM.contains(&key.node.as_str());
            if is_option || player.name.is_some() || between.is_none_or(|it| it.contains('\n')) {
                continue;
            }
            let form = format!("maybe {share} {}: {}", key.node, player.role.node);
            let (span, text) = (option.span.to(player.role.span), key.node.clone());
            self.push(Problem::new(span, Players::NameBeforeShare { name: text, form }));
            self.lost.insert(key.node.clone());
            option.kind = TeamStmtKind::Broken;
        }
    }

    fn team_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> TeamStmt {
        let kind = node.into_inner().next().and_then(|node| self.team_stmt_kind(node));
        TeamStmt { span, kind: kind.unwrap_or(TeamStmtKind::Broken) }
    }

    fn team_stmt_kind(&mut self, node: CstNode<'_>) -> Option<TeamStmtKind> {
        let rule = node.as_rule();
        if rule == Rule::field {
            return self.field(node).map(TeamStmtKind::Field);
        }
        let mut nodes = CstNodes::of(node);
        Some(match rule {
            Rule::moved => {
                nodes.eat(Rule::kw_place);
                let who = nodes.next()?;
                // A name stands for a player whose role only the resolver knows.
                let role = Role::from_name(who.as_str()).unwrap_or(Role::CM);
                let role = Spanned { node: role, span: self.span(&who) };
                let who = self.ident(&who);
                TeamStmtKind::Override { who, change: self.player_rest(&mut nodes, role) }
            }
            Rule::each => {
                nodes.eat(Rule::kw_each);
                let who = nodes.next().map(|who| self.ident(&who))?;
                TeamStmtKind::Each { who, fields: self.take_fields(&mut nodes) }
            }
            Rule::absent => TeamStmtKind::Absent(self.role(&nodes.next()?)?),
            _ => {
                let maybe = nodes
                    .want(Rule::maybe)
                    .and_then(|maybe| CstNodes::of(maybe).seek(Rule::share))
                    .map(|share| self.expr(share));
                let name = nodes.want(Rule::ident).map(|name| self.value_name(&name));
                nodes.eat(Rule::colon);
                let least = nodes.want(Rule::least).and_then(|least| self.count(&least));
                nodes.eat(Rule::range_dots);
                let count = nodes.want(Rule::count).and_then(|count| self.count(&count));
                let role = nodes.want(Rule::role).and_then(|role| self.role(&role))?;
                let player = self.player_rest(&mut nodes, role);
                TeamStmtKind::Player(PlayerStmt { name, maybe, least, count, ..player })
            }
        })
    }

    fn role(&self, node: &CstNode<'_>) -> Option<Spanned<Role>> {
        Role::from_name(node.as_str()).map(|role| Spanned { node: role, span: self.span(node) })
    }

    fn count(&mut self, node: &CstNode<'_>) -> Option<Spanned<u32>> {
        let span = self.span(node);
        let Ok(count) = node.as_str().parse() else {
            let text = node.as_str().get(..20).unwrap_or(node.as_str()).to_owned();
            self.push(Problem::new(span, Players::TooManyInLine { text }));
            return None;
        };
        Some(Spanned { node: count, span })
    }

    /// What follows a player's role.
    fn player_rest(&mut self, nodes: &mut CstNodes<'_>, role: Spanned<Role>) -> PlayerStmt {
        let place = nodes.want(Rule::place).and_then(|place| self.place(place));
        // Either may stand first.
        let jitter = self.jitter(nodes);
        let facing = nodes.want(Rule::facing).and_then(|facing| self.facing(facing));
        let jitter = jitter.or_else(|| self.jitter(nodes));
        let when =
            nodes.want(Rule::player_when).and_then(|when| CstNodes::of(when).seek(Rule::condition));
        let when = when.map(|when| self.expr(when));
        PlayerStmt {
            maybe: None,
            name: None,
            least: None,
            count: None,
            role,
            place,
            facing,
            jitter,
            when,
            fields: self.take_fields(nodes),
        }
    }

    /// `jitter 1m`
    pub(super) fn jitter(&mut self, nodes: &mut CstNodes<'_>) -> Option<Expr> {
        let jitter = nodes.want(Rule::jitter)?;
        CstNodes::of(jitter).seek(Rule::length).map(|length| self.expr(length))
    }

    fn facing(&mut self, node: CstNode<'_>) -> Option<Facing> {
        let mut nodes = CstNodes::of(node);
        nodes.eat(Rule::kw_facing);
        let away = nodes.eat(Rule::kw_away);
        let target = nodes.seek(Rule::direction).map(|target| self.expr(target))?;
        Some(Facing { away, target })
    }

    /// A place.
    pub(super) fn place(&mut self, node: CstNode<'_>) -> Option<Place> {
        let span = self.span(&node);
        let form = node.into_inner().next()?;
        let rule = form.as_rule();
        let first = form.clone().into_inner().next()?;
        let operands = form.into_inner().filter(|part| {
            matches!(
                part.as_rule(),
                Rule::point | Rule::area | Rule::length | Rule::direction | Rule::share
            )
        });
        let mut operands =
            operands.map(|operand| self.expr(operand)).collect::<Vec<_>>().into_iter();
        let kind = match rule {
            Rule::place_at => PlaceKind::At(operands.next()?),
            Rule::place_in => PlaceKind::In(operands.next()?),
            Rule::relative => PlaceKind::Relative {
                direction: self.ident(&first),
                of: operands.next()?,
                by: operands.next()?,
            },
            Rule::between => {
                PlaceKind::Between { a: operands.next()?, b: operands.next()?, at: operands.next() }
            }
            Rule::beyond => PlaceKind::Beyond {
                of: operands.next()?,
                by: operands.next()?,
                from: operands.next()?,
            },
            _ => PlaceKind::Offset {
                from: operands.next()?,
                along: operands.next()?,
                by: operands.next()?,
            },
        };
        Some(Place { span, kind })
    }
}
