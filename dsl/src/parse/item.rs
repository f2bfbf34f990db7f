//! Items of a file, parameters and references.

use super::reader::{CstNode, CstNodes, Reader};
use super::recover::Context;
use crate::ast::{
    BehaviorBody, BehaviorItem, Binding, CheckItem, CurriculumItem, Domain, FnItem, FormationItem,
    Ident, Item, ItemKind, ParamDecl, Ref, RewardItem, ScenarioItem, SuiteItem, TableItem,
    TableRows,
};
use crate::source::Span;
use pest::iterators::Pairs;
use setpiece_grammar::Rule;

impl Reader<'_> {
    /// The items of a file.
    pub(super) fn file(&mut self, mut pairs: Pairs<'_, Rule>) -> Vec<Item> {
        let Some(file) = pairs.next() else { return Vec::new() };
        self.list(file, Context::File, Self::item, |span, doc| Item {
            doc,
            span,
            kind: ItemKind::Broken,
        })
    }

    fn item(&mut self, node: CstNode<'_>, span: Span, doc: String) -> Item {
        let kind = node
            .into_inner()
            .next()
            .and_then(|node| self.item_kind(node))
            .unwrap_or(ItemKind::Broken);
        Item { doc, span, kind }
    }

    fn item_kind(&mut self, node: CstNode<'_>) -> Option<ItemKind> {
        let rule = node.as_rule();
        match rule {
            Rule::constant => return self.binding(node).map(ItemKind::Const),
            Rule::function => return self.function(node).map(ItemKind::Fn),
            Rule::region => return self.function(node).map(ItemKind::Region),
            Rule::ending => return self.function(node).map(ItemKind::Ending),
            _ => {}
        }
        let mut nodes = CstNodes::of(node);
        Some(match rule {
            Rule::import => {
                let path = nodes.seek(Rule::string)?;
                let path = self.string(&path);
                ItemKind::Import {
                    path,
                    alias: nodes.seek(Rule::ident).map(|name| self.value_name(&name)),
                }
            }
            Rule::scenario => {
                let is_abstract = nodes.eat(Rule::kw_abstract);
                let name = nodes.seek(Rule::free_name).map(|name| self.ident(&name))?;
                let (params, extends) = self.head(&mut nodes);
                let body = nodes.want(Rule::scenario_body)?;
                ItemKind::Scenario(ScenarioItem {
                    is_abstract,
                    name,
                    params,
                    extends,
                    body: self.scenario_body(body),
                })
            }
            Rule::reward_item => {
                let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
                let (params, extends) = self.head(&mut nodes);
                let body = nodes.want(Rule::reward_body)?;
                ItemKind::Reward(RewardItem { name, params, extends, body: self.reward_body(body) })
            }
            Rule::formation => {
                let name = nodes.seek(Rule::ident)?;
                let name = self.value_name(&name);
                let (params, extends) = self.head(&mut nodes);
                let body = nodes.want(Rule::team_body)?;
                ItemKind::Formation(FormationItem {
                    name,
                    params,
                    extends,
                    body: self.team_body(body),
                })
            }
            Rule::behavior => {
                let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
                let params =
                    nodes.want(Rule::params).map(|params| self.params(params)).unwrap_or_default();
                let body = nodes.next()?;
                let body = if body.as_rule() == Rule::script {
                    BehaviorBody::Script(self.script(body)?)
                } else {
                    BehaviorBody::Block(self.behavior_body(body))
                };
                ItemKind::Behavior(BehaviorItem { name, params, body })
            }
            Rule::table => {
                let name = nodes.seek(Rule::ident).map(|name| self.callable_name(&name))?;
                let over = if nodes.eat(Rule::kw_over) { nodes.next() } else { None };
                let over = over.map(|over| self.expr(over));
                nodes.eat(Rule::equals);
                let rows = nodes.next()?;
                let rows = if rows.as_rule() == Rule::table_file {
                    let path = CstNodes::of(rows).seek(Rule::string)?;
                    TableRows::File(self.string(&path))
                } else {
                    TableRows::Written(self.expr(rows))
                };
                ItemKind::Table(TableItem { name, over, rows })
            }
            Rule::suite => {
                let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
                let body = nodes.want(Rule::suite_body)?;
                ItemKind::Suite(SuiteItem { name, body: self.suite_body(body) })
            }
            Rule::check => {
                let name = nodes.seek(Rule::string).map(|name| self.string(&name))?;
                let body = nodes.want(Rule::check_body)?;
                ItemKind::Check(CheckItem { name, body: self.check_body(body) })
            }
            Rule::curriculum => {
                let name = nodes.seek(Rule::ident).map(|name| self.ident(&name))?;
                let body = nodes.want(Rule::curriculum_body)?;
                ItemKind::Curriculum(CurriculumItem { name, body: self.curriculum_body(body) })
            }
            _ => return None,
        })
    }

    /// `(params) extends parent`
    fn head(&mut self, nodes: &mut CstNodes<'_>) -> (Vec<ParamDecl>, Option<Ref>) {
        let params = nodes.want(Rule::params).map(|params| self.params(params)).unwrap_or_default();
        let extends = nodes
            .want(Rule::extends)
            .and_then(|extends| CstNodes::of(extends).seek(Rule::reference));
        (params, extends.and_then(|parent| self.reference(parent)))
    }

    /// `NAME [: type] = value`, whatever keyword stands before it.
    pub(super) fn binding(&mut self, node: CstNode<'_>) -> Option<Binding> {
        let mut nodes = CstNodes::of(node);
        let name = nodes.seek(Rule::ident)?;
        let name = self.value_name(&name);
        let ty = self.annotation(&mut nodes);
        nodes.eat(Rule::equals);
        let value = nodes.next().map(|value| self.expr(value))?;
        Some(Binding { name, ty, value })
    }

    /// `NAME [(params)] [-> type] = body`: a function, region or ending.
    pub(super) fn function(&mut self, node: CstNode<'_>) -> Option<FnItem> {
        let ending = node.as_rule() == Rule::ending;
        let mut nodes = CstNodes::of(node);
        let name = nodes.seek(Rule::ident)?;
        let name = if ending { self.ident(&name) } else { self.callable_name(&name) };
        let params = nodes.want(Rule::params).map(|params| self.params(params)).unwrap_or_default();
        let ty = nodes
            .eat(Rule::arrow)
            .then(|| nodes.want(Rule::type_name).map(|ty| self.ident(&ty)))
            .flatten();
        nodes.eat(Rule::equals);
        let body = nodes.next().map(|body| self.expr(body))?;
        Some(FnItem { name, params, ty, body })
    }

    fn annotation(&self, nodes: &mut CstNodes<'_>) -> Option<Ident> {
        let annotation = nodes.want(Rule::annotation)?;
        CstNodes::of(annotation).seek(Rule::type_name).map(|ty| self.ident(&ty))
    }

    /// Parameters in brackets.
    fn params(&mut self, node: CstNode<'_>) -> Vec<ParamDecl> {
        let mut params = Vec::new();
        let mut doc = String::new();
        let nodes =
            node.into_inner().filter(|child| matches!(child.as_rule(), Rule::doc | Rule::param));
        for child in self.bounded(nodes, "parameters") {
            match child.as_rule() {
                Rule::doc => add_doc(&mut doc, &child),
                Rule::param => params.extend(self.param(child, std::mem::take(&mut doc))),
                _ => {}
            }
        }
        params
    }

    /// `NAME [: type] [= default] [in domain]`
    pub(super) fn param(&mut self, node: CstNode<'_>, doc: String) -> Option<ParamDecl> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let name = nodes.want(Rule::ident)?;
        let name = self.value_name(&name);
        let ty = self.annotation(&mut nodes);
        nodes.eat(Rule::equals);
        let default = self.take_expr(&mut nodes, Rule::param_default);
        let domain = nodes.seek(Rule::domain).and_then(|domain| self.domain(domain));
        Some(ParamDecl { doc, name, ty, default, domain, span })
    }

    fn domain(&mut self, node: CstNode<'_>) -> Option<Domain> {
        let domain = node.into_inner().next()?;
        let span = self.span(&domain);
        let is_list = domain.as_rule() == Rule::list;
        let parts =
            domain.into_inner().filter(|part| matches!(part.as_rule(), Rule::expr | Rule::sum));
        let parts: Vec<_> =
            self.bounded(parts, "values").into_iter().map(|part| self.expr(part)).collect();
        if is_list {
            return Some(Domain::List(parts, span));
        }
        let mut parts = parts.into_iter();
        Some(Domain::Range(parts.next()?, parts.next()?))
    }

    /// `LOW..HIGH`
    pub(super) fn range_of(&mut self, node: CstNode<'_>) -> Option<Domain> {
        let mut nodes = CstNodes::of(node);
        let low = nodes.seek(Rule::sum).map(|low| self.expr(low))?;
        Some(Domain::Range(low, nodes.seek(Rule::sum).map(|high| self.expr(high))?))
    }

    /// A name with arguments.
    pub(super) fn reference(&mut self, node: CstNode<'_>) -> Option<Ref> {
        let span = self.span(&node);
        let mut nodes = CstNodes::of(node);
        let name = nodes.want(Rule::path).map(|name| self.ident(&name))?;
        let args = nodes.want(Rule::args).map(|args| self.args(args)).unwrap_or_default();
        Some(Ref { name, args, span })
    }
}

/// Adds a line `/// words` to a doc text.
pub(super) fn add_doc(doc: &mut String, node: &CstNode<'_>) {
    let line = node.as_str().trim_start_matches('/').trim_end();
    if !doc.is_empty() {
        doc.push('\n');
    }
    doc.push_str(line.strip_prefix(' ').unwrap_or(line));
}
