//! Exit codes with a meaning.

use std::process::ExitCode;

/// How a command that ran to its end came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done: code 0.
    Done,
    /// Undecided: the enclosure holds but is wider than asked: code 3.
    Undecided,
}

impl Outcome {
    /// The process' exit code.
    pub fn code(self) -> ExitCode {
        match self {
            Outcome::Done => ExitCode::SUCCESS,
            Outcome::Undecided => ExitCode::from(3),
        }
    }
}

/// Prints one sentence; code 2.
pub fn refuse(error: &anyhow::Error) -> ExitCode {
    // A closed pipe is the reader's wish, not an error of ours.
    let broken_pipe = error
        .downcast_ref::<std::io::Error>()
        .is_some_and(|e| e.kind() == std::io::ErrorKind::BrokenPipe);
    if broken_pipe {
        return ExitCode::SUCCESS;
    }
    eprintln!("subcert: {error}");
    ExitCode::from(2)
}

/// On Ctrl-C: no half-written file, one sentence, code 2.
pub fn on_interrupt() {
    // Without a handler Ctrl-C still ends the program, so a failure to set one is no reason to stop.
    let _ = ctrlc::set_handler(|| {
        subcert::mesh::io::remove_unfinished_files();
        eprintln!(
            "\nsubcert: interrupted; nothing was written, so run the command again for a result"
        );
        std::process::exit(2);
    });
}
