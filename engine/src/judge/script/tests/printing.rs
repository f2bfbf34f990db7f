//! What scripts print, and where it comes from.

use super::*;
use log::{Level, Log, Metadata, Record};
use std::sync::Mutex;
use std::thread::ThreadId;

/// Keeps the lines of each thread.
struct Lines(Mutex<Vec<(ThreadId, Level, String)>>);

impl Log for Lines {
    fn enabled(&self, _: &Metadata<'_>) -> bool {
        true
    }

    fn log(&self, record: &Record<'_>) {
        assert_eq!(record.target(), "setpiece.script");
        let line = (std::thread::current().id(), record.level(), record.args().to_string());
        self.0.lock().unwrap().push(line);
    }

    fn flush(&self) {}
}

static LINES: Lines = Lines(Mutex::new(Vec::new()));

/// What a hook prints in some calls, and what it pays at last.
fn printed(source: &str, calls: usize) -> (Vec<(Level, String)>, Result<f64, ScriptError>) {
    let _ = log::set_logger(&LINES);
    log::set_max_level(log::LevelFilter::Trace);
    let scripts = scripts(source);
    let perspective = Perspective { us: Team::Left, me: Some(PlayerId(1)), agent: 0 };
    let mut memory = Memory::default();
    let mut paid = Ok(0.0);
    for _ in 0..calls {
        paid = scripts.reward(0, &scene(&[]), perspective, &[], &mut memory);
    }
    let own = std::thread::current().id();
    let mut lines = LINES.0.lock().unwrap();
    let found = lines.iter().filter(|line| line.0 == own).map(|line| (line.1, line.2.clone()));
    let found = found.collect();
    lines.retain(|line| line.0 != own);
    (found, paid)
}

#[test]
fn values_are_printed_with_their_place() {
    let source = "fn reward(ctx, now, prev, events) {
    print(1); print(0.5); print(true);
    print(\"a\\nb\\u001b[2J\"); debug(\"a\");
    print([1, 2]); print(#{a: 1}); print(()); print('c');
    print(now.ball); print(now.me.at);
    let f = [3].map(|x| { print(x); x });
    f[0]
}";
    let (lines, paid) = printed(source, 1);
    assert_eq!(paid, Ok(3.0));
    let all: Vec<String> = lines.iter().map(|(level, line)| format!("{level} {line}")).collect();
    assert_eq!(
        all.join("\n"),
        "INFO own.rhai:2:5: 1
INFO own.rhai:2:15: 0.5
INFO own.rhai:2:27: true
INFO own.rhai:3:5: a b [2J
DEBUG own.rhai:3:29: \"a\"
INFO own.rhai:4:5: [1, 2]
INFO own.rhai:4:20: #{\"a\": 1}
INFO own.rhai:4:36: 
INFO own.rhai:4:47: c
INFO own.rhai:5:5: ball
INFO own.rhai:5:22: point
INFO own.rhai:6:27: 3"
    );
}

#[test]
fn a_script_prints_some_lines_and_no_more() {
    let source = "fn reward(ctx, now, prev, events) { for i in 0..300 { print(i); } 1 }";
    let (lines, paid) = printed(source, 5);
    assert_eq!((lines.len(), paid), (1_001, Ok(1.0)));
    assert!(lines[999].1.ends_with(": 99"), "{:?}", lines[999]);
    assert!(lines[1_000].0 == Level::Warn && lines[1_000].1.contains("at most"));
}

#[test]
fn printing_counts_as_work() {
    let source =
        "fn reward(ctx, now, prev, events) { let a = []; a.pad(400, 1); loop { print(a); } 1 }";
    let (lines, paid) = printed(source, 1);
    assert!(paid.unwrap_err().message.contains("operations"));
    assert!(lines.len() < 500, "{}", lines.len());
}
