//! Events: `pass completed by us to me from them.box`.

use super::reader::{CstNode, CstNodes, Reader};
use crate::ast::{EventExpr, Expr, Spanned};
use setpiece_grammar::Rule;
use setpiece_scenario::vocabulary::Qualifier;

impl Reader<'_> {
    /// An `event` or `end_event`.
    pub(super) fn event(&mut self, node: CstNode<'_>) -> Option<EventExpr> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let name = nodes.next().map(|name| self.ident(&name))?;
        let mut event = EventExpr { span, name, qualifier: None, by: None, to: None, from: None };
        for part in nodes {
            match part.as_rule() {
                Rule::event_by => event.by = self.phrase(part, Rule::actor),
                Rule::event_to => event.to = self.phrase(part, Rule::actor),
                Rule::event_from => event.from = self.phrase(part, Rule::area),
                _ => {
                    let span = self.span(&part);
                    event.qualifier =
                        Qualifier::from_name(part.as_str()).map(|node| Spanned { node, span });
                }
            }
        }
        Some(event)
    }

    /// `a or b or c`
    pub(super) fn events(&mut self, node: CstNode<'_>) -> Vec<EventExpr> {
        let events = node.into_inner().filter(|child| child.as_rule() != Rule::kw_or);
        events.filter_map(|event| self.event(event)).collect()
    }

    fn phrase(&mut self, node: CstNode<'_>, wanted: Rule) -> Option<Box<Expr>> {
        CstNodes::of(node).seek(wanted).map(|operand| Box::new(self.expr(operand)))
    }
}
