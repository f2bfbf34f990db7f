//! The traps of parsing, one test each.

use super::{player, read, reported, reward, scenario, team};
use setpiece_dsl::ast::{
    Domain, Expr, ExprKind, GiveStmt, GiveValue, InfixOp, ItemKind, RewardStmtKind, RewardUseKind,
    ScenarioStmtKind, TeamStmtKind,
};
use setpiece_dsl::parse::MAX_BRACKETS;
use setpiece_scenario::vocabulary::{Role, Unit};

/// The value of the only `let`.
fn value(text: &str) -> Expr {
    match scenario(&format!("let x = {text}")).into_iter().next().map(|statement| statement.kind) {
        Some(ScenarioStmtKind::Let(binding)) => binding.value,
        other => panic!("no let: {other:?}"),
    }
}

fn operator(expr: &Expr) -> Option<InfixOp> {
    if let ExprKind::Binary(op, ..) = &expr.kind { Some(op.node) } else { None }
}

#[test]
fn p1_a_calls_bracket_touches_its_name() {
    assert!(matches!(value("f(1)").kind, ExprKind::Call { .. }));
    let problems = reported("scenario s { team left {\n CM at (0.6, 0) (0.7, 0.2)\n } }");
    assert_eq!(problems.len(), 1, "{problems:?}");
    assert_eq!(reported("scenario s { let x = f (1) }").len(), 1);
}

#[test]
fn p2_a_blocks_head_is_not_a_gives_clause() {
    let body = reward(
        "give 0.1 * x\n on goal by us { x = 1 }\n give 0.01\n when c { x = 2 }\n give 1\n on goal when c { x = 3 }",
    );
    let kinds: Vec<_> =
        body.iter().map(|statement| matches!(statement.kind, RewardStmtKind::Give(_))).collect();
    assert_eq!(kinds, [true, false, true, false, true, false]);
    match body.first().map(|statement| &statement.kind) {
        Some(RewardStmtKind::Give(give)) => assert!(give.on.is_empty() && give.when.is_none()),
        other => panic!("{other:?}"),
    }
    match reward("give 1 on goal by us when c as \"x\"").first().map(|statement| &statement.kind) {
        Some(RewardStmtKind::Give(give)) => {
            assert!(give.on.len() == 1 && give.when.is_some() && give.label.is_some());
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn p3_a_block_behind_a_give_is_told() {
    for head in ["on goal by us", "when c", "on goal by us when c"] {
        let problems = reported(&format!("reward r {{\n give 1 {head} {{ x = 1 }}\n}}"));
        assert_eq!(problems, ["SP0103 a `give` has no block"], "{head}");
        assert!(reported(&format!("reward r {{\n give 1\n {head} {{ x = 1 }}\n}}")).is_empty());
    }
}

#[test]
fn p4_a_default_leaves_its_range() {
    match scenario("param d: number = 0.6 in 0..1")
        .into_iter()
        .next()
        .map(|statement| statement.kind)
    {
        Some(ScenarioStmtKind::Param(param)) => {
            assert!(matches!(param.default.map(|value| value.kind), Some(ExprKind::Number { .. })));
            assert!(matches!(param.domain, Some(Domain::Range(..))));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn p5_in_is_told_by_its_place() {
    assert!(player("CM in left.box").place.is_some());
    match value("count(p in them where p.x > 0)").kind {
        ExprKind::Call { args, .. } => {
            let arg = args.first().expect("one argument");
            assert!(
                operator(&arg.value) == Some(InfixOp::In)
                    && arg.filter.is_some()
                    && arg.binder.is_none()
            );
        }
        other => panic!("{other:?}"),
    }
    match value("min(p.x for p in them where p.x > 0)").kind {
        ExprKind::Call { args, .. } => {
            let arg = args.first().expect("one argument");
            assert!(arg.binder.is_some() && arg.filter.is_some());
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn p6_phrases_leave_their_words() {
    let body = team(
        "AM between ball and left.goal at 30%\nCM ahead of AM1 by 2m when n > 1\nCF in left.box | right.box facing ball",
    );
    assert_eq!(body.len(), 3);
    assert_eq!(reward("give 1 on pass by us from us.box | us.third when a and b").len(), 1);
}

#[test]
fn p7_a_sign_on_the_next_line_goes_on() {
    let body = reward("give a\n -1");
    match body.first().map(|statement| &statement.kind) {
        Some(RewardStmtKind::Give(GiveStmt { value: GiveValue::Expr(value), .. })) => {
            assert_eq!(operator(value), Some(InfixOp::Sub));
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(body.len(), 1);
}

#[test]
fn p8_words_are_read_whole() {
    let ratio = value("5m/sigma");
    assert_eq!(operator(&ratio), Some(InfixOp::Div));
    assert!(matches!(
        value("5m/s").kind,
        ExprKind::Number { unit: Some(Unit::MetrePerSecond), .. }
    ));
    assert!(matches!(value("5ms").kind, ExprKind::Number { unit: Some(Unit::Millisecond), .. }));
    assert!(matches!(
        value("5km/h").kind,
        ExprKind::Number { unit: Some(Unit::KilometrePerHour), .. }
    ));
    for name in [
        "onward",
        "once_more",
        "inner",
        "ended",
        "order",
        "offside_",
        "goals",
        "passed",
        "CBs",
        "trues",
    ] {
        assert!(matches!(value(name).kind, ExprKind::Name(_)), "{name}");
    }
}

#[test]
fn p9_nesting_costs_no_exponential_time() {
    let deep = MAX_BRACKETS - 2;
    for (open, close) in [("(", ")"), ("f(", ")"), ("[", "]"), ("(1, ", ")"), ("f(a: ", ")")] {
        let text = format!("{}1{}", open.repeat(deep), close.repeat(deep));
        value(&text);
        // Wrong ones are read twice, not once per level.
        assert!(
            !reported(&format!(
                "scenario s {{ let x = {}1 1{} }}",
                open.repeat(deep),
                close.repeat(deep)
            ))
            .is_empty()
        );
    }
}

#[test]
fn p10_brackets_are_counted_before_parsing() {
    for n in [MAX_BRACKETS, 10_000] {
        let text = format!("scenario s {{ let x = {}1{} }}", "(".repeat(n), ")".repeat(n));
        assert_eq!(reported(&text), ["SP0102 brackets are nested more than 64 deep"]);
        let text = format!("scenario s {{ let x = {}", "(".repeat(n));
        assert_eq!(reported(&text), ["SP0102 brackets are nested more than 64 deep"]);
    }
}

#[test]
fn p11_spans_are_trimmed() {
    let text = "scenario s {\n    team left { CB at (0.5, 0) // behind\n /* more */ }\n  // end\n}\n\nconst A = 1 ; // one\n";
    let (file, problems) = read(text);
    assert_eq!(problems, []);
    let texts: Vec<_> = file
        .items
        .iter()
        .map(|item| &text[item.span.start as usize..item.span.end as usize])
        .collect();
    assert!(texts.first().is_some_and(|text| text.ends_with("// end\n}")), "{texts:?}");
    assert_eq!(texts.last(), Some(&"const A = 1"));
    let Some(ItemKind::Scenario(scenario)) = file.items.first().map(|item| &item.kind) else {
        panic!("no scenario")
    };
    let Some(ScenarioStmtKind::Team { body, .. }) =
        scenario.body.first().map(|statement| &statement.kind)
    else {
        panic!("no team")
    };
    let span = body.first().expect("a player").span;
    assert_eq!(&text[span.start as usize..span.end as usize], "CB at (0.5, 0)");
}

#[test]
fn p12_keys_may_be_weights() {
    match value("choice(a: 3, 0.5: 1, (0, 1): 2, for: 2s, on: off)").kind {
        ExprKind::Call { args, .. } => {
            assert!(args.len() == 5 && args.iter().all(|arg| arg.key.is_some()));
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn p13_scenarios_names_may_begin_with_digits() {
    for name in ["5_vs_5", "2vs2", "11_vs_11_easy_stochastic"] {
        assert!(reported(&format!("scenario {name} extends 11_vs_11 {{ }}")).is_empty(), "{name}");
    }
    assert_eq!(reported("reward 5_vs_5 { }").len(), 1);
}

#[test]
fn p14_event_names_are_reserved_as_values_only() {
    assert!(matches!(value("goal").kind, ExprKind::Event(_)));
    assert!(matches!(value("left.goal").kind, ExprKind::Member(..)));
    assert!(matches!(value("f(goal: 1)").kind, ExprKind::Call { .. }));
    for text in [
        "let corner = 1",
        "param pass = 1",
        "let in = 1",
        "let CB = 3",
        "const when = 1",
        "let (a, shot) = b",
    ] {
        let problems = reported(&format!("scenario s {{ {text} }}"));
        assert!(
            problems.len() == 1 && problems.iter().all(|problem| problem.starts_with("SP0107")),
            "{text}: {problems:?}"
        );
    }
    assert_eq!(reward("x = 1\n give 1 on pass completed\n x = 2").len(), 3);
}

#[test]
fn p15_left_is_a_team_a_direction_and_a_value() {
    assert!(player("LM left of striker by 3m").place.is_some());
    assert!(matches!(value("left").kind, ExprKind::Name(_)));
    assert!(matches!(value("left.box").kind, ExprKind::Member(..)));
}

#[test]
fn p16_a_named_player_is_no_option() {
    assert_eq!(
        player("striker: CF at (0.5, 0)").name.map(|name| name.node).as_deref(),
        Some("striker")
    );
    let body = team("difficulty: 0.9");
    assert!(matches!(body.first().map(|statement| &statement.kind), Some(TeamStmtKind::Field(_))));
}

#[test]
fn p17_a_count_stands_before_a_role() {
    let body = team("difficulty: 1\n2 CB in left.box\nlate: 3\nsteps: 4");
    assert_eq!(body.len(), 4);
    match body.get(1).map(|statement| &statement.kind) {
        Some(TeamStmtKind::Player(player)) => {
            assert_eq!(player.count.as_ref().map(|count| count.node), Some(2));
        }
        other => panic!("{other:?}"),
    }
    assert_eq!(player("3 CM").role.node, Role::CM);
}

#[test]
fn p18_an_inline_reward_has_braces() {
    let body = scenario("reward x { }\nreward x * 0.5\nreward x(a: 1) as \"y\" * 2\nreward x");
    let inline: Vec<_> = body
        .iter()
        .map(|statement| match &statement.kind {
            ScenarioStmtKind::Reward(reward) => matches!(reward.what, RewardUseKind::Inline { .. }),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(inline, [true, false, false, false]);
}

#[test]
fn p19_not_binds_below_comparison_and_comparisons_do_not_chain() {
    assert!(
        matches!(value("not p in q").kind, ExprKind::Unary(_, inner) if operator(&inner) == Some(InfixOp::In))
    );
    assert_eq!(operator(&value("-x in q")), Some(InfixOp::In));
    for text in ["a < b < c", "a == b in c", "a < b + 1 < c and d"] {
        assert_eq!(
            reported(&format!("scenario s {{ let x = {text} }}")),
            ["SP0106 comparisons don't chain"],
            "{text}"
        );
    }
}

#[test]
fn p20_an_if_has_then_and_else() {
    assert!(matches!(value("if a then 1 else if b then 2 else 3").kind, ExprKind::If(..)));
    assert_eq!(reported("scenario s { let x = if a then 1 }").len(), 1);
}

#[test]
fn indentation_means_nothing_where_brackets_agree() {
    assert_eq!(
        reported("scenario s {\n        team left { CB at (0, 0)\n  }\n    }"),
        Vec::<String>::new()
    );
}
