//! Options: `{ key: value, … }`, and scripts.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{Field, FieldValue, ScriptRef, ScriptSource, Spanned};
use crate::problem::Problem;
use crate::problem::facts::Names;
use crate::source::Span;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The fields between braces.
    pub(super) fn fields(&mut self, node: CstNode<'_>) -> Vec<Field> {
        let fields = self.list(
            node,
            Context::Fields,
            |reader, field, _, _| reader.field(field),
            |_, _| None,
        );
        let fields: Vec<Field> = fields.into_iter().flatten().collect();
        for (index, field) in fields.iter().enumerate() {
            if let Some(first) =
                fields.iter().take(index).find(|first| first.key.node == field.key.node)
            {
                self.push(Problem::new(
                    field.key.span,
                    Names::GivenTwice {
                        what: format!("`{}`", field.key.node),
                        first: first.key.span,
                    },
                ));
            }
        }
        fields
    }

    /// Takes the next child if it is `fields`.
    pub(super) fn take_fields(&mut self, nodes: &mut CstNodes<'_>) -> Vec<Field> {
        nodes.want(Rule::fields).map(|fields| self.fields(fields)).unwrap_or_default()
    }

    /// `key: value`
    pub(super) fn field(&mut self, node: CstNode<'_>) -> Option<Field> {
        let mut nodes = CstNodes::of(node);
        let key = nodes.want(Rule::word).map(|key| self.ident(&key))?;
        nodes.eat(Rule::colon);
        let value = nodes.next()?;
        let value = match value.as_rule() {
            Rule::fields => {
                let span = self.span(&value);
                FieldValue::Fields(self.fields(value), span)
            }
            Rule::script => FieldValue::Script(self.script(value)?),
            _ => FieldValue::Expr(self.expr(value)),
        };
        Some(Field { key, value })
    }

    /// `script "file.rhai"` or `script rhai """…"""`
    pub(super) fn script(&mut self, node: CstNode<'_>) -> Option<ScriptRef> {
        let span = self.span(&node);
        let source = match CstNodes::of(node).last()? {
            file if file.as_rule() == Rule::string => ScriptSource::File(self.string(&file)),
            // A script that is not closed was reported: it holds whatever follows it.
            raw if raw.as_span().end() + self.base > self.original().len() => return None,
            raw => {
                let text = raw.as_str();
                let text = text.get(3..text.len().saturating_sub(3)).unwrap_or_default().to_owned();
                let Span { file, start, .. } = self.span(&raw);
                let inner = Span { file, start: start + 3, end: start + 3 + text.len() as u32 };
                ScriptSource::Inline(Spanned { node: text, span: inner })
            }
        };
        Some(ScriptRef { span, source })
    }
}
