//! The page, as `cargo xtask studio` has built it.

/// A file of the page.
pub(super) struct Asset {
    /// Its path on the server.
    pub(super) path: &'static str,
    /// Its media type.
    pub(super) media: &'static str,
    /// Its content.
    pub(super) content: &'static [u8],
}

/// Every file of the page.
pub(super) const ASSETS: &[Asset] = &[
    Asset {
        path: "/",
        media: "text/html; charset=utf-8",
        content: include_bytes!(concat!(env!("SETPIECE_STUDIO_PAGE"), "/index.html")),
    },
    Asset {
        path: "/studio.js",
        media: "text/javascript; charset=utf-8",
        content: include_bytes!(concat!(env!("SETPIECE_STUDIO_PAGE"), "/studio.js")),
    },
    Asset {
        path: "/studio.css",
        media: "text/css; charset=utf-8",
        content: include_bytes!(concat!(env!("SETPIECE_STUDIO_PAGE"), "/studio.css")),
    },
];
