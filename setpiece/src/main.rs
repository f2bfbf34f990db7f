//! The command `setpiece`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(setpiece::cli::main(std::env::args_os()))
}
