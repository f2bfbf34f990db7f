//! Sends what the session has to say to its pages.

use super::message::{Episode, Reply};
use super::moment::{MomentReply, pitch, roster};
use crate::render::Scene;
use std::sync::Arc;
use tokio::sync::broadcast;

/// Sends messages to every page.
pub(super) fn send_all(pages: &broadcast::Sender<Arc<str>>, messages: &[Arc<str>]) {
    for message in messages {
        // Without a page there is nobody to tell.
        let _ = pages.send(message.clone());
    }
}

/// Moments of a match that is played by hand.
pub(super) fn step(scenes: &[Scene]) -> Reply {
    let moments = scenes.iter().map(MomentReply::from).collect();
    Reply::Step { pitch: pitch(scenes), roster: roster(scenes), scenes: moments }
}

/// An episode as a message.
pub(super) fn said_episode(episode: Episode) -> Arc<str> {
    said(&Reply::Episode(Box::new(episode)))
}

/// A reply as a message.
pub(super) fn said(reply: &Reply) -> Arc<str> {
    serde_json::to_string(reply).unwrap_or_default().into()
}

/// Sends a reply to every page.
pub(super) fn tell(pages: &broadcast::Sender<Arc<str>>, reply: &Reply) {
    // Without a page there is nobody to tell.
    let _ = pages.send(said(reply));
}
