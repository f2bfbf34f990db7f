//! `setpiece lsp`: messages on standard input and output.

use super::text;
use serde_json::{Value, json};
use std::io::Write;
use std::process::{Command, Stdio};

fn framed(message: &str) -> String {
    format!("Content-Length: {}\r\n\r\n{message}", message.len())
}

fn request(id: u32, method: &str, params: &Value) -> String {
    framed(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }).to_string())
}

/// What the server answers to some bytes, and its exit code.
fn answers(input: &str) -> (Vec<Value>, Option<i32>) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_setpiece"))
        .arg("lsp")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let said = text(&output.stdout);
    let messages = said.split("Content-Length: ").skip(1);
    let body = |message: &str| message.split_once("\r\n\r\n").unwrap().1.to_owned();
    let read = messages.map(|it| serde_json::from_str(&body(it)).unwrap());
    (read.collect(), output.status.code())
}

#[test]
fn a_message_that_is_no_json_is_refused_and_the_next_one_answered() {
    let input = [
        framed("{ \"jsonrpc\": \"2.0\", \"id\": 1, \"method\": "),
        request(2, "initialize", &json!({ "capabilities": {} })),
        framed("{ \"jsonrpc\": \"2.0\", \"method\": \"initialized\", \"params\": {} }"),
        framed("[1, 2]"),
        framed("\u{fc}"),
        format!("Content-Type: x\r\n{}", request(3, "shutdown", &Value::Null)),
        framed("{ \"jsonrpc\": \"2.0\", \"method\": \"exit\" }"),
    ];
    let (answers, code) = answers(&input.concat());
    let refused: Vec<&Value> = answers.iter().filter(|it| it["id"].is_null()).collect();
    let codes: Vec<i64> = refused.iter().map(|it| it["error"]["code"].as_i64().unwrap()).collect();
    assert_eq!(codes, [-32700, -32600, -32700], "{answers:?}");
    let answered = |id: u32| answers.iter().find(|it| it["id"] == id).unwrap();
    assert!(answered(2)["result"]["capabilities"].is_object());
    assert!(answered(3).get("error").is_none());
    assert_eq!(code, Some(0));
}

#[test]
fn an_editor_that_is_gone_ends_the_server() {
    let (answers, code) = answers(&request(1, "initialize", &json!({ "capabilities": {} })));
    assert_eq!(answers.len(), 1);
    assert_eq!(code, Some(1));
    let (answers, code) = answers_to_nothing();
    assert!(answers.is_empty());
    assert_eq!(code, Some(1));
}

fn answers_to_nothing() -> (Vec<Value>, Option<i32>) {
    answers("{\r\n\r\n")
}
