//! `subcert-check`: reads certificates and says of each whether it is verified.

#![forbid(unsafe_code)]

use std::fs;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

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
    let (mut files, mut unreadable) = (Vec::new(), 0);
    for argument in &arguments {
        if let Err(error) = collect(argument, &mut files) {
            eprintln!("subcert-check: {}: {error}", argument.display());
            unreadable += 1;
        }
    }
    let (mut verified, mut rejected) = (0, 0);
    for file in &files {
        let bytes = match read(file) {
            Ok(bytes) => bytes,
            Err(error) => {
                eprintln!("subcert-check: {}: {error}", file.display());
                unreadable += 1;
                continue;
            }
        };
        let verdict = subcert_check::check(&bytes);
        let claim = verdict.claim.map(|claim| claim + ": ").unwrap_or_default();
        match verdict.outcome {
            Ok(()) => {
                writeln!(out, "{}: {claim}verified", file.display())?;
                verified += 1;
            }
            Err(rejection) => {
                writeln!(out, "{}: {claim}{rejection}", file.display())?;
                rejected += 1;
            }
        }
    }
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
