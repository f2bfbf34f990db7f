//! The server: one page, and a socket for each tab.

use super::guard::{self, Refusal};
use super::language;
use super::message::{REQUEST_MAX_BYTES, Request};
use super::page::{ASSETS, Asset};
use super::session::{Command, Session};
use crate::replay::Replay;
use axum::Router;
use axum::extract::ws::{Message, WebSocket, WebSocketUpgrade};
use axum::extract::{Query, State};
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use serde::Deserialize;
use std::future::Future;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::sync::mpsc::Receiver;
use std::thread::JoinHandle;
use std::time::Duration;
use tokio::net::TcpListener;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::{broadcast, mpsc, oneshot};

/// Messages that a page may be behind before it starts over.
const BEHIND_MAX: usize = 16;
/// How long a studio that ends waits for a policy that is being asked.
const ENDS_WITHIN: Duration = Duration::from_secs(2);

/// What the page may load, and who may show it in a frame.
const ALONE: &str = "default-src 'self'; img-src 'self' data: blob:; \
                     style-src 'self' 'unsafe-inline'; frame-ancestors 'self'";
const FRAMED: &str = "default-src 'self'; img-src 'self' data: blob:; \
                      style-src 'self' 'unsafe-inline'; \
                      frame-ancestors 'self' http://localhost:* http://127.0.0.1:* \
                      vscode-webview:";

/// What every request needs.
#[derive(Clone)]
struct Shared {
    port: u16,
    token: Arc<str>,
    framed: bool,
    /// Whether imports and scripts may be outside the text's folder.
    allow_outside: bool,
    commands: mpsc::UnboundedSender<Command>,
    replies: broadcast::Sender<Arc<str>>,
}

/// How a session is served.
#[derive(Clone, Copy, Debug, Default)]
pub struct ServeOptions {
    /// The port; 0 for any that is free.
    pub port: u16,
    /// Whether pages of this machine, such as a notebook, may show the studio in a frame.
    pub framed: bool,
}

/// A server that listens.
pub struct Ready {
    /// The address to open, with its token.
    pub address: String,
    /// The port.
    pub port: u16,
    /// The way to the session.
    commands: mpsc::UnboundedSender<Command>,
    /// Ends with the session's thread.
    is_gone: Receiver<()>,
}

#[derive(Deserialize)]
struct Ticket {
    token: Option<String>,
}

/// Serves a session until Ctrl-C.
///
/// - `ready`: called once the server listens.
///
/// # Errors
/// The system's message if the port is taken or there are no random numbers.
pub fn serve(
    session: Session,
    options: ServeOptions,
    ready: impl FnOnce(Ready),
) -> Result<(), String> {
    serve_until(session, options, ready, async {
        // Without a handler the process ends anyway.
        let _ = tokio::signal::ctrl_c().await;
    })
}

/// A studio on a thread of its own. It ends when this is dropped.
pub struct Running {
    /// The address to open, with its token.
    pub address: String,
    /// The port.
    pub port: u16,
    commands: Option<mpsc::UnboundedSender<Command>>,
    stop: Option<oneshot::Sender<()>>,
    thread: Option<JoinHandle<Result<(), String>>>,
    /// Ends with the session's thread.
    is_gone: Receiver<()>,
    /// A forked process has no threads to wait for.
    process: u32,
}

impl Running {
    /// Shows an episode in every page. False if the studio has ended.
    pub fn watch(&self, replay: Replay) -> bool {
        let commands = self.commands.as_ref();
        commands.is_some_and(|sender| sender.send(Command::Watch(Box::new(replay))).is_ok())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        drop(self.stop.take());
        drop(self.commands.take());
        let Some(thread) = self.thread.take() else { return };
        if self.process != std::process::id() {
            std::mem::forget(thread);
            return;
        }
        // It has nothing to say any more.
        let _ = thread.join();
        // The session ends once nobody can send it anything; a policy may take its time.
        let _ = self.is_gone.recv_timeout(ENDS_WITHIN);
    }
}

/// Serves a session on a thread of its own.
///
/// # Errors
/// Like [`serve`].
pub fn start(session: Session, options: ServeOptions) -> Result<Running, String> {
    let (stop, stopped) = oneshot::channel::<()>();
    let (tell, hear) = std::sync::mpsc::channel();
    let thread = std::thread::spawn(move || {
        let ready = |ready| {
            let _ = tell.send(ready);
        };
        serve_until(session, options, ready, async {
            let _ = stopped.await;
        })
    });
    if let Ok(Ready { address, port, commands, is_gone }) = hear.recv() {
        return Ok(Running {
            address,
            port,
            commands: Some(commands),
            stop: Some(stop),
            thread: Some(thread),
            is_gone,
            process: std::process::id(),
        });
    }
    let ended = thread.join().unwrap_or(Ok(()));
    Err(ended.err().unwrap_or_else(|| "the server ended at once".to_owned()))
}

fn serve_until(
    session: Session,
    options: ServeOptions,
    ready: impl FnOnce(Ready),
    ended: impl Future<Output = ()>,
) -> Result<(), String> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|why| why.to_string())?;
    let token: Arc<str> = guard::token()?.into();
    let allow_outside = session.allows_outside();
    runtime.block_on(async move {
        let address = SocketAddr::from((Ipv4Addr::LOCALHOST, options.port));
        let listener = TcpListener::bind(address).await.map_err(|why| why.to_string())?;
        let port = listener.local_addr().map_err(|why| why.to_string())?.port();
        let (replies, _) = broadcast::channel(BEHIND_MAX);
        let (commands, inbox) = mpsc::unbounded_channel();
        let sender = replies.clone();
        let (gone, is_gone) = std::sync::mpsc::channel::<()>();
        std::thread::spawn(move || {
            session.run(inbox, &sender);
            drop(gone);
        });
        let framed = options.framed;
        let shared =
            Shared { port, token: token.clone(), framed, allow_outside, commands, replies };
        let address = format!("http://127.0.0.1:{port}/?token={token}");
        ready(Ready { address, port, commands: shared.commands.clone(), is_gone });
        let mut routes =
            Router::new().route("/socket", get(socket)).route("/language", get(language));
        for asset in ASSETS {
            routes =
                routes.route(
                    asset.path,
                    get(move |state, headers, ticket| async move {
                        file(asset, &state, &headers, &ticket)
                    }),
                );
        }
        tokio::select! {
            served = axum::serve(listener, routes.with_state(shared)) => {
                served.map_err(|why| why.to_string())
            }
            () = ended => Ok(()),
        }
    })
}

fn admitted(shared: &Shared, headers: &HeaderMap, ticket: &Ticket) -> Result<(), Refusal> {
    let text = |name| headers.get(name).and_then(|value| value.to_str().ok());
    let (host, origin) = (text(header::HOST), text(header::ORIGIN));
    guard::check(shared.port, host, origin, ticket.token.as_deref(), &shared.token)
}

fn refused(why: Refusal) -> Response {
    (StatusCode::FORBIDDEN, why.message()).into_response()
}

/// A file of the page. It is no secret, but a foreign page may not embed it.
fn file(
    asset: &'static Asset,
    State(shared): &State<Shared>,
    headers: &HeaderMap,
    Query(ticket): &Query<Ticket>,
) -> Response {
    let needs_token = asset.path == "/";
    match admitted(shared, headers, ticket) {
        Err(Refusal::Token) if !needs_token => {}
        Err(why) => return refused(why),
        Ok(()) => {}
    }
    let headers = [
        (header::CONTENT_TYPE, asset.media),
        (header::CACHE_CONTROL, "no-store"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CONTENT_SECURITY_POLICY, if shared.framed { FRAMED } else { ALONE }),
    ];
    (headers, asset.content).into_response()
}

/// The language server of a tab's text.
async fn language(
    State(shared): State<Shared>,
    headers: HeaderMap,
    Query(ticket): Query<Ticket>,
    upgrade: WebSocketUpgrade,
) -> Response {
    match opened(&shared, &headers, &ticket, upgrade) {
        Ok(upgrade) => {
            upgrade.on_upgrade(move |socket| language::converse(socket, shared.allow_outside))
        }
        Err(why) => refused(why),
    }
}

/// The socket of a tab.
async fn socket(
    State(shared): State<Shared>,
    headers: HeaderMap,
    Query(ticket): Query<Ticket>,
    upgrade: WebSocketUpgrade,
) -> Response {
    match opened(&shared, &headers, &ticket, upgrade) {
        Ok(upgrade) => upgrade.on_upgrade(move |socket| talk(socket, shared)),
        Err(why) => refused(why),
    }
}

/// A socket for a page that may have one.
fn opened(
    shared: &Shared,
    headers: &HeaderMap,
    ticket: &Ticket,
    upgrade: WebSocketUpgrade,
) -> Result<WebSocketUpgrade, Refusal> {
    admitted(shared, headers, ticket)?;
    Ok(upgrade.max_message_size(REQUEST_MAX_BYTES).max_frame_size(REQUEST_MAX_BYTES))
}

async fn talk(mut socket: WebSocket, shared: Shared) {
    let mut replies = shared.replies.subscribe();
    if !join(&mut socket, &shared).await {
        return;
    }
    loop {
        tokio::select! {
            given = socket.recv() => match given {
                Some(Ok(Message::Text(text))) => {
                    let command = match serde_json::from_str::<Request>(&text) {
                        Ok(request) => Command::Request(request),
                        Err(why) => Command::Nonsense(why.to_string()),
                    };
                    if shared.commands.send(command).is_err() {
                        return;
                    }
                }
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => {}
                // Binary data, a message that is too large, a tab that has gone.
                _ => return,
            },
            said = replies.recv() => if !pass_on(&mut socket, said, &mut replies, &shared).await {
                return;
            },
        }
    }
}

/// Sends what the session said; a tab that is too far behind gets the present instead.
async fn pass_on(
    socket: &mut WebSocket,
    said: Result<Arc<str>, RecvError>,
    replies: &mut broadcast::Receiver<Arc<str>>,
    shared: &Shared,
) -> bool {
    match said {
        Ok(text) => socket.send(Message::Text((&*text).into())).await.is_ok(),
        Err(RecvError::Lagged(_)) => {
            *replies = shared.replies.subscribe();
            join(socket, shared).await
        }
        Err(RecvError::Closed) => false,
    }
}

/// Sends the present.
async fn join(socket: &mut WebSocket, shared: &Shared) -> bool {
    let (answer, present) = tokio::sync::oneshot::channel();
    if shared.commands.send(Command::Join(answer)).is_err() {
        return false;
    }
    let Ok(present) = present.await else { return false };
    for text in present {
        if socket.send(Message::Text((&*text).into())).await.is_err() {
            return false;
        }
    }
    true
}
