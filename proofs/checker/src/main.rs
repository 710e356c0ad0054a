//! `subcert-check`: reads certificates and says of each whether it is verified.

#![forbid(unsafe_code)]

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

use subcert_check::Verdict;

const HELP: &str = "\
Checks certificates with integers and rationals only. The format is proofs/FORMAT.md.

Usage: subcert-check FILES

FILES are certificates, or folders: of a folder, every *.json in it and below, in order of name.

One line for each file: the claim in words, then `verified` or `rejected: step k, rule R: why`.

Exit codes:
  0  every certificate is verified
  1  at least one is rejected
  2  none is rejected, but a file could not be read, there was none, or the usage was wrong
";

fn main() -> ExitCode {
    // A panic is turned into a rejection; its message is of no use on the way.
    std::panic::set_hook(Box::new(|_| ()));
    run().unwrap_or(ExitCode::from(2))
}

fn run() -> io::Result<ExitCode> {
    let arguments: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let mut out = io::stdout().lock();
    if arguments
        .iter()
        .any(|argument| argument.as_os_str() == "--help" || argument.as_os_str() == "-h")
    {
        out.write_all(HELP.as_bytes())?;
        return Ok(ExitCode::SUCCESS);
    }
    if let Some(option) =
        arguments.iter().find(|argument| argument.to_string_lossy().starts_with('-'))
    {
        eprintln!("subcert-check: there is no option {}; --help tells the usage", option.display());
        return Ok(ExitCode::from(2));
    }
    let (mut files, mut verified, mut rejected, mut unreadable) = (Vec::new(), 0, 0, 0);
    for argument in &arguments {
        if let Err(error) = collect(argument, &mut files) {
            eprintln!("subcert-check: {}: {error}", argument.display());
            unreadable += 1;
        }
    }
    // Each thread takes the next file that none has taken; the verdicts are printed in order.
    let files: Vec<_> = files.into_iter().map(|file| (file, OnceLock::new())).collect();
    let next = AtomicUsize::new(0);
    let work = || {
        while let Some((file, verdict)) = files.get(next.fetch_add(1, Ordering::Relaxed)) {
            let _ = verdict.set(read(file).map(|bytes| subcert_check::check(&bytes)));
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, Into::into).min(files.len()) {
            scope.spawn(work);
        }
        for (file, verdict) in &files {
            let name = file.display();
            match verdict.wait() {
                Err(error) => {
                    eprintln!("subcert-check: {name}: {error}");
                    unreadable += 1;
                }
                Ok(Verdict { claim, outcome }) => {
                    let claim =
                        claim.as_ref().map(|claim| format!("{claim}: ")).unwrap_or_default();
                    match outcome {
                        Ok(()) => writeln!(out, "{name}: {claim}verified")?,
                        Err(rejection) => writeln!(out, "{name}: {claim}{rejection}")?,
                    }
                    *if outcome.is_ok() { &mut verified } else { &mut rejected } += 1;
                }
            }
        }
        Ok::<(), io::Error>(())
    })?;
    if files.is_empty() && unreadable == 0 {
        eprintln!("subcert-check: no certificate: name files or folders; --help tells the usage");
    }
    if files.len() > 1 {
        writeln!(
            out,
            "{} certificates: {verified} verified, {rejected} rejected, {unreadable} unreadable",
            files.len()
        )?;
    }
    out.flush()?;
    Ok(match (rejected, unreadable, verified) {
        (0, 0, 1..) => ExitCode::SUCCESS,
        (1.., _, _) => ExitCode::FAILURE,
        _ => ExitCode::from(2),
    })
}

/// The file itself, or every *.json below a folder, in order of name; links to folders are not followed.
fn collect(path: &Path, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !fs::metadata(path)?.is_dir() {
        files.push(path.to_path_buf());
        return Ok(());
    }
    let mut entries = fs::read_dir(path)?.collect::<io::Result<Vec<_>>>()?;
    entries.sort_by_key(fs::DirEntry::file_name);
    for entry in entries {
        let json = entry.path().extension().is_some_and(|extension| extension == "json");
        if entry.file_type()?.is_dir() || json {
            collect(&entry.path(), files)?;
        }
    }
    Ok(())
}

/// The bytes of a file, one more than the largest certificate at most.
fn read(path: &Path) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(subcert_check::BYTES as u64 + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}
