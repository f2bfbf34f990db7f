//! The language server's messages: every capability it names is answered, as an editor asks it.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

#[path = "lsp/late.rs"]
mod late;
#[path = "lsp/moving.rs"]
mod moving;

use lsp_server::{Message, Notification, Request, Response};
use serde_json::{Value, json};
use setpiece::lsp::{LanguageServer, capabilities};

const URI: &str = "file:///nowhere/pitches/one.pitch";
const TEXT: &str = "\
fn near(p: point) = distance(ball, p) < 3m
abstract scenario base extends academy {
    ball at (0.5, 0)
}
scenario a extends base {
    team left { striker: CF at (0.45, 0) }
    reward scorin
    end success a when near(right.goal)
}
";

struct Client {
    server: LanguageServer,
    asked: i32,
}

impl Client {
    fn new() -> Client {
        let initialize = json!({ "capabilities": { "textDocument": { "completion": {
            "completionItem": { "snippetSupport": true } } } } });
        let mut client = Client { server: LanguageServer::new(&initialize, false), asked: 0 };
        client.open(URI, TEXT);
        client
    }

    fn open(&mut self, uri: &str, text: &str) {
        self.say(
            "textDocument/didOpen",
            json!({ "textDocument": {
            "uri": uri, "languageId": "pitch", "version": 1, "text": text } }),
        );
    }

    fn say(&mut self, method: &str, params: Value) {
        let note = Notification { method: method.to_owned(), params };
        assert!(self.server.receive(Message::Notification(note)).is_empty());
    }

    fn ask(&mut self, method: &str, params: Value) -> Response {
        self.asked += 1;
        let request = Request { id: self.asked.into(), method: method.to_owned(), params };
        match self.server.receive(Message::Request(request)).remove(0) {
            Message::Response(response) => response,
            other => panic!("{other:?}"),
        }
    }

    fn result(&mut self, method: &str, params: Value) -> Value {
        self.ask(method, params).response_result.unwrap_or_else(|why| panic!("{method}: {why:?}"))
    }

    /// Asks about the place behind some words of the text.
    fn at(&mut self, method: &str, words: &str) -> Value {
        self.result(method, place(words))
    }

    /// The diagnostics that are sent now, by address.
    fn published(&mut self) -> Vec<(String, Vec<Value>)> {
        diagnostics_of(self.server.publish())
    }
}

fn diagnostics_of(messages: Vec<Message>) -> Vec<(String, Vec<Value>)> {
    let of = |message: Message| match message {
        Message::Notification(note) => (
            note.params["uri"].as_str().unwrap().to_owned(),
            note.params["diagnostics"].as_array().unwrap().clone(),
        ),
        other => panic!("{other:?}"),
    };
    messages.into_iter().map(of).collect()
}

/// The line and column behind some words.
fn position(words: &str) -> Value {
    let at = TEXT.find(words).expect(words) + words.len();
    let before = &TEXT[..at];
    let line = before.matches('\n').count();
    json!({ "line": line, "character": before.rsplit('\n').next().unwrap().len() })
}

fn place(words: &str) -> Value {
    json!({ "textDocument": { "uri": URI }, "position": position(words) })
}

#[test]
fn every_capability_is_answered() {
    let whole =
        json!({ "start": { "line": 0, "character": 0 }, "end": { "line": 99, "character": 0 } });
    let within = json!({ "textDocument": { "uri": URI }, "range": whole, "context": { "diagnostics": [] },
        "options": { "tabSize": 4, "insertSpaces": true } });
    let mut client = Client::new();
    for (capability, method, params, shows) in [
        ("hoverProvider", "textDocument/hover", place("ball at (0"), "27.2m"),
        ("definitionProvider", "textDocument/definition", place("when near"), "\"line\":0"),
        (
            "typeDefinitionProvider",
            "textDocument/typeDefinition",
            place("scenario a"),
            "\"line\":1",
        ),
        ("referencesProvider", "textDocument/references", place("fn near"), "\"line\":7"),
        (
            "documentHighlightProvider",
            "textDocument/documentHighlight",
            place("fn near"),
            "\"line\":7",
        ),
        (
            "renameProvider",
            "textDocument/rename",
            {
                let mut rename = place("fn near");
                rename["newName"] = "close".into();
                rename
            },
            "close",
        ),
        (
            "linkedEditingRangeProvider",
            "textDocument/linkedEditingRange",
            place("fn near"),
            "ranges",
        ),
        ("completionProvider", "textDocument/completion", place("reward sco"), "scoring"),
        (
            "signatureHelpProvider",
            "textDocument/signatureHelp",
            place("distance(ball, "),
            "distance(a, b)",
        ),
        ("documentSymbolProvider", "textDocument/documentSymbol", within.clone(), "striker"),
        ("workspaceSymbolProvider", "workspace/symbol", json!({ "query": "NEA" }), "near"),
        ("documentLinkProvider", "textDocument/documentLink", within.clone(), "[]"),
        ("foldingRangeProvider", "textDocument/foldingRange", within.clone(), "startLine"),
        (
            "selectionRangeProvider",
            "textDocument/selectionRange",
            json!({ "textDocument": { "uri": URI }, "positions": [position("striker")] }),
            "parent",
        ),
        ("semanticTokensProvider", "textDocument/semanticTokens/full", within.clone(), "data"),
        ("inlayHintProvider", "textDocument/inlayHint", within.clone(), "p:"),
        ("codeLensProvider", "textDocument/codeLens", within.clone(), "setpiece.run"),
        ("codeActionProvider", "textDocument/codeAction", within.clone(), "scoring"),
        ("documentFormattingProvider", "textDocument/formatting", within.clone(), "newText"),
        (
            "documentRangeFormattingProvider",
            "textDocument/rangeFormatting",
            within.clone(),
            "newText",
        ),
        (
            "documentOnTypeFormattingProvider",
            "textDocument/onTypeFormatting",
            place("fn near"),
            "[]",
        ),
        (
            "typeHierarchyProvider",
            "textDocument/prepareTypeHierarchy",
            place("scenario base"),
            "\"base\"",
        ),
        (
            "callHierarchyProvider",
            "textDocument/prepareCallHierarchy",
            place("fn near"),
            "\"near\"",
        ),
    ] {
        assert!(capabilities()["capabilities"].get(capability).is_some(), "{capability}");
        let answer = client.result(method, params).to_string();
        assert!(answer.contains(shows), "{method} doesn't show {shows}: {answer}");
    }
    let named = capabilities()["capabilities"].as_object().unwrap().len();
    assert_eq!(named, 23 + 2, "a capability isn't asked for (two are no requests)");
}

#[test]
fn diagnostics_have_a_page_and_go_when_the_text_is_mended() {
    let mut client = Client::new();
    let published = client.published();
    let [(uri, diagnostics)] = published.as_slice() else { panic!("{published:?}") };
    assert_eq!(uri, URI);
    assert_eq!(diagnostics.len(), 1, "{diagnostics:?}");
    let one = &diagnostics[0];
    assert_eq!((one["code"].as_str(), one["severity"].as_i64()), (Some("SP0201"), Some(1)));
    let href = one["codeDescription"]["href"].as_str().unwrap();
    assert!(href.ends_with("/errors/SP0201/"), "{href}");
    assert!(one["message"].as_str().unwrap().contains("help: did you mean `scoring`?"));
    assert!(client.published().is_empty(), "nothing has changed");
    let text = TEXT.replace("scorin", "scoring");
    client.say(
        "textDocument/didChange",
        json!({
        "textDocument": { "uri": URI, "version": 2 }, "contentChanges": [{ "text": text }] }),
    );
    assert_eq!(client.published(), [(URI.to_owned(), Vec::new())]);
}

/// A text that was never on disk is gone once it is closed, and so are its problems.
#[test]
fn problems_of_a_text_that_is_gone_are_taken_back() {
    for uri in [URI, "untitled:Untitled-1"] {
        let mut client = Client::new();
        client.open(uri, TEXT);
        let shown = client.published();
        assert!(shown.iter().any(|(it, found)| it == uri && !found.is_empty()), "{shown:?}");
        client.say("textDocument/didClose", json!({ "textDocument": { "uri": uri } }));
        let taken_back = client.published();
        assert!(taken_back.contains(&(uri.to_owned(), Vec::new())), "{taken_back:?}");
    }
}

#[test]
fn only_the_kinds_of_action_that_are_asked_for_are_given() {
    let mut client = Client::new();
    let mut kinds = |only: Option<&[&str]>| -> Vec<String> {
        let (start, end) = (position("    reward "), position("reward scorin"));
        let asked = json!({ "textDocument": { "uri": URI },
            "range": { "start": start, "end": end }, "context": { "diagnostics": [], "only": only } });
        let found = client.result("textDocument/codeAction", asked);
        found.as_array().unwrap().iter().map(|it| it["kind"].as_str().unwrap().into()).collect()
    };
    assert!(kinds(None).contains(&"quickfix".to_owned()));
    assert!(kinds(Some(&["quickfix"])).iter().all(|kind| kind == "quickfix"));
    assert_eq!(kinds(Some(&["source"])), ["source.fixAll"]);
    assert_eq!(kinds(Some(&["refactor.extract"])), [""; 0]);
}

/// A pasted script is nothing but errors; the one action in it replaces it.
#[test]
fn a_script_of_google_research_football_is_translated() {
    const SCRIPT: &str = "file:///nowhere/pitches/drill.pitch";
    let mut client = Client::new();
    let text = "def build_scenario(builder):\n  builder.SetBallPosition(0.62, -0.1)\n";
    client.open(SCRIPT, text);
    for only in [None, Some(&["quickfix"])] {
        let here = json!({ "line": 1, "character": 4 });
        let asked = json!({ "textDocument": { "uri": SCRIPT },
            "range": { "start": here, "end": here },
            "context": { "diagnostics": [], "only": only } });
        let found = client.result("textDocument/codeAction", asked);
        let [action] = found.as_array().unwrap().as_slice() else { panic!("{found}") };
        assert_eq!((&action["kind"], &action["isPreferred"]), (&json!("quickfix"), &json!(true)));
        let edits = action["edit"].to_string();
        assert!(edits.contains("scenario drill {") && edits.contains("ball at (0.62, -0.1)"));
    }
}

#[test]
fn hierarchies_go_on_from_their_items() {
    let mut client = Client::new();
    let base = client.at("textDocument/prepareTypeHierarchy", "scenario base")[0].clone();
    let children = client.result("typeHierarchy/subtypes", json!({ "item": base }));
    assert_eq!(children[0]["name"], "a");
    let parents = client.result("typeHierarchy/supertypes", json!({ "item": children[0] }));
    assert_eq!(parents[0]["name"], "base");
    let near = client.at("textDocument/prepareCallHierarchy", "fn near")[0].clone();
    let callers = client.result("callHierarchy/incomingCalls", json!({ "item": near }));
    assert_eq!(callers[0]["from"]["name"], "a");
    let callees =
        client.result("callHierarchy/outgoingCalls", json!({ "item": callers[0]["from"] }));
    let names: Vec<&str> =
        callees.as_array().unwrap().iter().map(|it| it["to"]["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"near"), "{names:?}");
}

#[test]
fn a_file_of_the_library_can_be_opened() {
    let mut client = Client::new();
    let place = client.at("textDocument/definition", "extends academy");
    let uri = place["uri"].as_str().unwrap().to_owned();
    let path = uri.strip_prefix("file://").unwrap();
    let text = std::fs::read_to_string(path).expect("the file is on disk");
    client.open(&uri, &text);
    let published = client.published();
    let of_library = published.iter().find(|(it, _)| *it == uri);
    assert!(of_library.is_none_or(|(_, found)| found.is_empty()), "{published:?}");
    let symbols = client
        .result("textDocument/documentSymbol", json!({ "textDocument": { "uri": uri } }))
        .to_string();
    assert!(symbols.contains("academy"), "{symbols}");
}

#[test]
fn the_start_is_drawn_unless_the_text_is_broken() {
    let mut client = Client::new();
    let broken = client.result("setpiece/preview", place("striker"));
    let words = "1 error in the text";
    assert_eq!(broken, json!({ "scenario": "a", "version": 1, "message": words }));
    client.open(URI, &TEXT.replace("scorin", "scoring"));
    let drawn = client.result("setpiece/preview", place("striker"));
    assert!(drawn["svg"].as_str().unwrap().contains(">striker</text>"), "{drawn}");
    assert_eq!(drawn["view"], json!([-59.5, -40.5, 119.0, 81.0]));
    assert!(drawn["svg"].as_str().unwrap().contains("viewBox=\"-59.5 -40.5 119 81\""));
    let [striker, ball] = drawn["things"].as_array().unwrap().as_slice() else { panic!("{drawn}") };
    assert_eq!((&striker["name"], &ball["name"]), (&json!("striker"), &json!("ball")));
    assert_eq!(
        (&striker["player"], &ball["player"]),
        (&json!({ "team": "left", "slot": 0 }), &Value::Null)
    );
    let at = |thing: &Value| [0, 1].map(|axis| thing["at"][axis].as_f64().unwrap());
    assert!((at(striker)[0] - 24.48).abs() < 1e-3 && (at(ball)[0] - 27.2).abs() < 1e-3);
}

#[test]
fn what_cannot_be_answered_is_an_error_that_says_why() {
    let mut client = Client::new();
    let mut refused = |method: &str, params: Value| {
        let why = client.ask(method, params).response_result.expect_err(method);
        (why.code, why.message)
    };
    let (code, message) = refused("textDocument/nonsense", json!({}));
    assert_eq!((code, message.as_str()), (-32601, "`textDocument/nonsense` is not supported"));
    assert_eq!(refused("textDocument/hover", json!({ "textDocument": 3 })).0, -32602);
    let other = json!({ "textDocument": { "uri": "file:///nowhere/else.pitch" }, "position": { "line": 0, "character": 0 } });
    let (_, message) = refused("textDocument/hover", other);
    assert!(message.contains("else.pitch"), "{message}");
    let mut rename = place("reward scorin");
    rename["newName"] = "x".into();
    let (_, message) = refused("textDocument/rename", rename);
    assert!(message.contains("no name stands here"), "{message}");
    // A place beyond the text is its end.
    let beyond =
        json!({ "textDocument": { "uri": URI }, "position": { "line": 9999, "character": 9999 } });
    assert_eq!(client.result("textDocument/hover", beyond), Value::Null);
    let uri = "untitled:Untitled-1";
    client.open(uri, "scenario x extends academy {\n    ball at (0.5, 0)\n}\n");
    assert!(client.published().iter().any(|(it, _)| it == uri));
}

#[test]
fn references_leave_the_declaration_out_if_they_are_asked_to() {
    let mut client = Client::new();
    for (is_wanted, number) in [(true, 2), (false, 1)] {
        let mut params = place("when near");
        params["context"] = json!({ "includeDeclaration": is_wanted });
        let found = client.result("textDocument/references", params);
        assert_eq!(found.as_array().unwrap().len(), number, "{found}");
    }
}
