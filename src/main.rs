//! The command-line program. See `subcert --help`.

use std::process::ExitCode;

use clap::Parser;

mod cli;

fn main() -> ExitCode {
    let arguments = cli::Arguments::parse();
    cli::exit::on_interrupt();
    match cli::run(arguments) {
        Ok(outcome) => outcome.code(),
        Err(error) => cli::exit::refuse(&error),
    }
}
