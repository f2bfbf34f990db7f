//! Statements of a reward.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{Expr, GiveStmt, GiveValue, RewardStmt, RewardStmtKind, Spanned, TermList};
use crate::problem::Problem;
use crate::problem::facts::{Names, Rewards, Syntax};
use crate::source::Span;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The statements between a reward's or block's braces.
    pub(super) fn reward_body(&mut self, node: CstNode<'_>) -> Vec<RewardStmt> {
        let span = self.span(&node);
        let read = |reader: &mut Self| {
            reader.list(node, Context::Reward, Self::reward_stmt, |span, _| RewardStmt {
                span,
                kind: RewardStmtKind::Broken,
            })
        };
        let body = self.nested(span, read).unwrap_or_default();
        self.find_blocks_after_give(&body);
        body
    }

    /// `give 1 on goal by us { … }` reads as a `give` of every step and a block: surely not what
    /// was meant.
    fn find_blocks_after_give(&mut self, body: &[RewardStmt]) {
        for pair in body.windows(2) {
            let [give, block] = pair else { continue };
            let head = match &block.kind {
                RewardStmtKind::On { .. } => "on …",
                RewardStmtKind::When { .. } => "when …",
                _ => continue,
            };
            let between = self
                .original()
                .get(give.span.end as usize..block.span.start as usize)
                .unwrap_or_default();
            // A label ends its `give`.
            let RewardStmtKind::Give(GiveStmt { value, on, when, label, .. }) = &give.kind else {
                continue;
            };
            let named = label.as_ref().map(|label| label.span);
            let named = named.or(match value {
                GiveValue::Script { terms: Some(terms), .. } => Some(terms.span),
                _ => None,
            });
            let ended = named.is_some_and(|named| named.end == give.span.end);
            if !(ended && (!on.is_empty() || when.is_some())) && !between.contains(['\n', ';']) {
                let moved = (!self.when_begins_a_line(block)).then_some(head);
                let fact = Syntax::BlockAfterGive { give: give.span, moved };
                self.push(Problem::new(block.span.head(self.original()), fact));
            }
        }
    }

    /// `on goal by us` and a `when … {` on the next line: two statements for the author, one for
    /// the grammar.
    fn when_begins_a_line(&self, block: &RewardStmt) -> bool {
        let RewardStmtKind::On { events, when: Some(when), .. } = &block.kind else { return false };
        let from = events.last().map_or(block.span.start, |event| event.span.end);
        let between = self.original().get(from as usize..when.span.start as usize);
        between.is_some_and(|between| between.contains('\n'))
    }

    fn reward_stmt(&mut self, node: CstNode<'_>, span: Span, _doc: String) -> RewardStmt {
        let kind = node.into_inner().next().and_then(|node| self.reward_stmt_kind(node));
        RewardStmt { span, kind: kind.unwrap_or(RewardStmtKind::Broken) }
    }

    fn reward_stmt_kind(&mut self, node: CstNode<'_>) -> Option<RewardStmtKind> {
        let rule = node.as_rule();
        match rule {
            Rule::state => return self.binding(node).map(RewardStmtKind::State),
            Rule::let_stmt => return self.binding(node).map(RewardStmtKind::Let),
            Rule::give => return self.give(node).map(RewardStmtKind::Give),
            _ => {}
        }
        let mut nodes = CstNodes::of(node);
        Some(match rule {
            Rule::on_block => {
                let events = nodes.seek(Rule::events).map(|events| self.events(events))?;
                let when = nodes
                    .want(Rule::block_when)
                    .and_then(|when| CstNodes::of(when).seek(Rule::condition));
                let when = when.map(|when| self.expr(when));
                let body = nodes.want(Rule::reward_body)?;
                RewardStmtKind::On { events, when, body: self.reward_body(body) }
            }
            Rule::when_block => return self.when_block(nodes),
            _ => {
                let name = nodes.want(Rule::ident)?;
                let name = self.assigned_name(&name);
                nodes.eat(Rule::equals);
                RewardStmtKind::Assign { name, value: nodes.next().map(|value| self.expr(value))? }
            }
        })
    }

    /// The arms of `else when` hang in each other, so they count as depth.
    fn when_block(&mut self, mut nodes: CstNodes<'_>) -> Option<RewardStmtKind> {
        let condition = nodes.seek(Rule::condition).map(|condition| self.expr(condition))?;
        let then = nodes.want(Rule::reward_body).map(|body| self.reward_body(body))?;
        let otherwise = match nodes.peek() {
            Some(Rule::else_when) => {
                let first = nodes.peek_range()?;
                let span = self.between(first.start + self.base, first.end + self.base);
                self.nested(span, |reader| reader.else_when(nodes))
                    .map(|inner| inner.into_iter().collect())
            }
            Some(_) => CstNodes::of(nodes.next()?)
                .seek(Rule::reward_body)
                .map(|body| self.reward_body(body)),
            None => None,
        };
        Some(RewardStmtKind::When { condition, then, otherwise })
    }

    /// An `else when …` and all that follows it, as one statement.
    fn else_when(&mut self, mut nodes: CstNodes<'_>) -> Option<RewardStmt> {
        let arm = nodes.next()?;
        let span = self.span(&arm);
        let mut inner = CstNodes::of(arm);
        let condition = inner.seek(Rule::condition).map(|condition| self.expr(condition))?;
        let then = inner.want(Rule::reward_body).map(|body| self.reward_body(body))?;
        let (mut span, mut otherwise) = (span, None);
        match nodes.peek() {
            Some(Rule::else_when) => {
                let next = self.nested(span, |reader| reader.else_when(nodes)).flatten();
                if let Some(next) = &next {
                    span = span.to(next.span);
                }
                otherwise = next.map(|next| vec![next]);
            }
            Some(_) => {
                let last = nodes.next()?;
                span = span.to(self.span(&last));
                otherwise =
                    CstNodes::of(last).seek(Rule::reward_body).map(|body| self.reward_body(body));
            }
            None => {}
        }
        Some(RewardStmt { span, kind: RewardStmtKind::When { condition, then, otherwise } })
    }

    /// `for WHO`, `to WHO`: who receives what is paid.
    pub(super) fn clause(&mut self, nodes: &mut CstNodes<'_>, rule: Rule) -> Option<Expr> {
        let who = nodes.want(rule).and_then(|clause| CstNodes::of(clause).seek(Rule::actor))?;
        Some(self.expr(who))
    }

    fn give(&mut self, node: CstNode<'_>) -> Option<GiveStmt> {
        let mut nodes = CstNodes::of(node);
        nodes.eat(Rule::kw_give);
        let value = nodes.next()?;
        let value = if value.as_rule() == Rule::script {
            GiveValue::Script { script: self.script(value)?, terms: None }
        } else {
            GiveValue::Expr(self.expr(value))
        };
        let to = self.clause(&mut nodes, Rule::give_to);
        let per_second = nodes.eat(Rule::per_second);
        let once = nodes.want(Rule::kw_once).map(|once| self.span(&once));
        let mut give =
            GiveStmt { value, to, per_second, once, on: Vec::new(), when: None, label: None };
        while let Some(rule) = nodes.peek() {
            match rule {
                Rule::label => give.label = self.label(&mut nodes),
                Rule::labels => match (self.terms(&mut nodes), &mut give.value) {
                    (named, GiveValue::Script { terms, .. }) => *terms = named,
                    (named, GiveValue::Expr(_)) => self.refuse_terms(named),
                },
                Rule::give_on => {
                    let events = nodes.next().and_then(|on| CstNodes::of(on).seek(Rule::events));
                    give.on = events.map(|events| self.events(events)).unwrap_or_default();
                }
                _ => {
                    let condition =
                        nodes.next().and_then(|when| CstNodes::of(when).seek(Rule::condition));
                    give.when = condition.map(|condition| self.expr(condition));
                }
            }
        }
        Some(give)
    }

    /// Reports several terms of what isn't a script.
    pub(super) fn refuse_terms(&mut self, terms: Option<TermList>) {
        if let Some(terms) = terms {
            self.push(Problem::new(terms.span, Rewards::TermsOfNoScript));
        }
    }

    /// `as ["x", "y"]`
    pub(super) fn terms(&mut self, nodes: &mut CstNodes<'_>) -> Option<TermList> {
        let node = nodes.want(Rule::labels)?;
        let span = self.span(&node);
        let words = CstNodes::of(node).filter(|word| word.as_rule() == Rule::string);
        let words: Vec<Spanned<String>> = words.map(|word| self.string(&word)).collect();
        let span = words.first().map_or(span, |first| Span { start: first.span.start, ..span });
        let mut terms: Vec<Spanned<String>> = Vec::new();
        for word in words {
            if word.node.trim().is_empty() {
                self.push(Problem::new(word.span, Rewards::EmptyLabel));
            } else if let Some(first) = terms.iter().find(|other| other.node == word.node) {
                let (what, first) = (format!("the term `{}`", word.node), first.span);
                self.push(Problem::new(word.span, Names::GivenTwice { what, first }));
            } else {
                terms.push(word);
            }
        }
        Some(Spanned { node: terms, span })
    }
}

impl Span {
    /// The part up to the first `{`: a block's head.
    fn head(self, text: &str) -> Span {
        let own = text.get(self.start as usize..self.end as usize).unwrap_or_default();
        let head = own.split('{').next().unwrap_or_default().trim_end().len();
        Span { end: self.start + head as u32, ..self }
    }
}
