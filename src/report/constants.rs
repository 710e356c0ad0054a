//! Tables of bound constants as text, JSON and certificates.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Value, json as object};

use num_traits::One;

use crate::bound::curve::CurveConstant;
use crate::bound::{Constant, Family, Norm, Row};
use crate::mesh::io::write_atomically;
use crate::scalar::Rational;
use crate::scheme::curve::Degree;

/// The longest closed form that a text table shows whole.
const WIDEST: usize = 60;

/// An aligned table.
pub fn text(family: Family, rows: &[Row], seconds: f64) -> String {
    let mut out = String::new();
    let name = rows.first().map_or("", |row| row.constant.name());
    let scheme = family.scheme();
    let weights = scheme.weights();
    let weights = weights.map_or_else(String::new, |weights| format!(", {weights} weights"));
    let norm = match family.norm() {
        Norm::Second => "second-order norm",
        Norm::First => "first-order norm",
        Norm::Face => "norm of the face",
    };
    let _ = writeln!(
        out,
        "{}{weights}, {name} constants, {norm} (dimensionless)",
        scheme.name()
    );
    let _ = writeln!(
        out,
        "{:>3} {:>5} {:>22} {:>22} {:>8} {:>8}  exact",
        "n", "level", "lo", "hi", "gap", "seconds"
    );
    for row in rows {
        let _ = write!(out, "{:>3} {:>5} ", row.n, row.constant.level());
        let _ = match &row.proof {
            Some(proof) => {
                let exact = match &row.exact {
                    Some(text) if text.chars().count() > WIDEST => "in Q(2 cos 2π/n): see --json",
                    Some(text) => text,
                    None => "-",
                };
                writeln!(
                    out,
                    "{:>22} {:>22} {:>8.1e} {:>8.3}  {exact}",
                    format!("{:?}", proof.lo),
                    format!("{:?}", proof.hi),
                    proof.gap(),
                    row.seconds
                )
            }
            None => writeln!(out, "{:>22}", "no proof found"),
        };
    }
    let _ = writeln!(out, "{} rows in {seconds:.2} s", rows.len());
    out
}

/// `{"rows": [{"n", "level", "lo", "hi", "exact", "seconds"}], ..}`; lo and hi read back exactly.
pub fn json(family: Family, rows: &[Row], seconds: f64) -> Value {
    let row = |row: &Row| {
        object!({
            "n": row.n,
            "level": row.constant.level(),
            "lo": row.proof.as_ref().map(|p| p.lo),
            "hi": row.proof.as_ref().map(|p| p.hi),
            "exact": row.exact,
            "seconds": row.seconds,
        })
    };
    object!({
        "scheme": family.scheme().name(),
        "weights": family.scheme().weights().map(|weights| weights.to_string()),
        "constant": rows.first().map(|row| row.constant.name()),
        "norm": family.norm().name(),
        "rows": rows.iter().map(row).collect::<Vec<_>>(),
        "seconds": seconds,
    })
}

/// The value of a constant of a curve, and its name.
fn curve_value(constant: Constant, curve: &CurveConstant) -> Rational {
    match constant {
        Constant::Rate(k) => (0..k).fold(Rational::one(), |rate, _| rate * &curve.rate),
        other => curve.level(other.level()),
    }
}

fn curve_name(degree: Degree) -> &'static str {
    match degree {
        Degree::Cubic => "cubic-curve",
        Degree::Quadratic => "quadratic-curve",
    }
}

/// An aligned table of a curve's constants, all exact.
pub fn curve_text(degree: Degree, constants: &[Constant], curve: &CurveConstant) -> String {
    let mut out = String::new();
    let name = constants.first().map_or("", Constant::name);
    let _ = writeln!(
        out,
        "{}, {name} constants, second-order norm (dimensionless)",
        curve_name(degree)
    );
    let _ = writeln!(out, "{:>5}  exact", "level");
    for &constant in constants {
        let value = curve_value(constant, curve);
        let _ = writeln!(out, "{:>5}  {value}", constant.level());
    }
    if !matches!(constants.first(), Some(Constant::Rate(_))) {
        let _ = writeln!(
            out,
            "attained at parameter {} of an edge (and its mirror image)",
            curve.at
        );
    }
    out
}

/// As [`json`], for a curve.
pub fn curve_json(degree: Degree, constants: &[Constant], curve: &CurveConstant) -> Value {
    let row = |&constant: &Constant| {
        object!({
            "level": constant.level(),
            "exact": curve_value(constant, curve).to_string(),
        })
    };
    object!({
        "scheme": curve_name(degree),
        "constant": constants.first().map(Constant::name),
        "norm": "second",
        "rows": constants.iter().map(row).collect::<Vec<_>>(),
    })
}

/// Writes the certificates of all rows that have one; the files' paths.
///
/// # Errors
/// If the folder can't be made or a file can't be written.
pub fn write_certificates(folder: &Path, rows: &[Row]) -> io::Result<Vec<PathBuf>> {
    fs::create_dir_all(folder)?;
    let mut written = Vec::new();
    for row in rows {
        if let Some(certificate) = &row.certificate {
            let path = folder.join(certificate.file_name().expect("constants have names"));
            write_atomically(&path, |out| certificate.write(out))?;
            written.push(path);
        }
    }
    Ok(written)
}
