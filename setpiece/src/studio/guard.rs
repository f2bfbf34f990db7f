//! Who may connect: pages of this machine that know the token.

use std::fmt::Write as _;

/// A token that nobody can guess, 32 hexadecimal digits.
///
/// # Errors
/// The system's message if it has no random numbers.
pub fn token() -> Result<String, String> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|why| why.to_string())?;
    let mut token = String::new();
    for byte in bytes {
        let _ = write!(token, "{byte:02x}");
    }
    Ok(token)
}

/// Why a request is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refusal {
    /// The `Host` isn't this machine: another name may lead here by a trick.
    Host,
    /// The `Origin` is a foreign page.
    Origin,
    /// The token is missing or wrong.
    Token,
}

impl Refusal {
    /// What the answer says.
    pub fn message(self) -> &'static str {
        match self {
            Refusal::Host => "the studio only answers to its own address",
            Refusal::Origin => "the studio only answers to its own page",
            Refusal::Token => "open the address that `setpiece studio` has printed",
        }
    }
}

/// Checks a request.
///
/// - `port`: the server's.
/// - `host`, `origin`: the headers. A browser sends an origin with every WebSocket, so one without
///   comes from a program of this machine, which needs the token too.
/// - `given`, `token`: the request's and the server's.
///
/// # Errors
/// [`Refusal`] says why.
pub fn check(
    port: u16,
    host: Option<&str>,
    origin: Option<&str>,
    given: Option<&str>,
    token: &str,
) -> Result<(), Refusal> {
    let own = [format!("127.0.0.1:{port}"), format!("localhost:{port}")];
    if !host.is_some_and(|host| own.iter().any(|own| own == host)) {
        return Err(Refusal::Host);
    }
    let is_own = |origin: &str| own.iter().any(|own| format!("http://{own}") == origin);
    if !origin.is_none_or(is_own) {
        return Err(Refusal::Origin);
    }
    if given.is_none_or(|given| !same(given.as_bytes(), token.as_bytes())) {
        return Err(Refusal::Token);
    }
    Ok(())
}

/// Whether two texts are equal, in a time that doesn't depend on where they differ.
fn same(a: &[u8], b: &[u8]) -> bool {
    a.len() == b.len() && a.iter().zip(b).fold(0, |differs, (a, b)| differs | (a ^ b)) == 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_this_machine_s_page_with_the_token_may_connect() {
        let ask = |host, origin, given| check(80, host, origin, given, "secret");
        let (host, own) = (Some("127.0.0.1:80"), Some("http://127.0.0.1:80"));
        assert_eq!(ask(host, own, Some("secret")), Ok(()));
        assert_eq!(ask(host, None, Some("secret")), Ok(()));
        assert_eq!(ask(Some("localhost:80"), own, Some("secret")), Ok(()));
        assert_eq!(ask(Some("evil.example:80"), own, Some("secret")), Err(Refusal::Host));
        assert_eq!(ask(Some("127.0.0.1:81"), own, Some("secret")), Err(Refusal::Host));
        assert_eq!(ask(None, own, Some("secret")), Err(Refusal::Host));
        assert_eq!(ask(host, Some("http://evil.example"), Some("secret")), Err(Refusal::Origin));
        assert_eq!(ask(host, Some("null"), Some("secret")), Err(Refusal::Origin));
        assert_eq!(ask(host, own, None), Err(Refusal::Token));
        assert_eq!(ask(host, own, Some("secreT")), Err(Refusal::Token));
        assert_eq!(ask(host, own, Some("")), Err(Refusal::Token));
    }

    #[test]
    fn tokens_differ() {
        let (a, b) = (token().unwrap(), token().unwrap());
        assert!(a != b && a.len() == 32 && a.chars().all(|digit| digit.is_ascii_hexdigit()));
    }
}
