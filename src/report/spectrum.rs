//! Spectra as text and JSON.

use std::fmt::Write as _;

use serde_json::{Value, json as object};

use crate::scalar::Interval;
use crate::scheme::Scheme;
use crate::spectrum::characteristic::Sign;
use crate::spectrum::eigenvalue::Eigenvalue;
use crate::spectrum::inner::FourierNet;
use crate::spectrum::phase::Phase;
use crate::spectrum::table::{Entry, Row};
use crate::spectrum::{InnerMode, Rules};

fn scheme(rules: Rules) -> Scheme {
    match rules {
        Rules::Loop(weights) => Scheme::Loop(weights),
        Rules::CatmullClark => Scheme::CatmullClark,
    }
}

/// An aligned table for each valence.
pub fn text(rules: Rules, rows: &[Row], seconds: f64) -> String {
    let mut out = String::new();
    let scheme = scheme(rules);
    let weights = scheme.weights();
    let weights = weights.map_or_else(String::new, |weights| format!(", {weights} weights"));
    let _ = writeln!(
        out,
        "{}{weights}, spectra of the two-ring of 1 + {}n points",
        scheme.name(),
        rules.kinds()
    );
    for row in rows {
        let _ = writeln!(out, "\nn = {}: {}", row.n, summary(row));
        let names: Vec<String> = row
            .entries
            .iter()
            .map(|entry| modes(entry, row.n))
            .collect();
        let width = names
            .iter()
            .map(String::len)
            .max()
            .unwrap_or(0)
            .max("frequencies".len());
        let _ = writeln!(
            out,
            "{:>22} {:>22} {:>5} {:>7}  {:width$}  exact",
            "lo", "hi", "times", "vectors", "frequencies"
        );
        for (entry, name) in row.entries.iter().zip(names) {
            let _ = writeln!(
                out,
                "{:>22} {:>22} {:>5} {:>7}  {name:width$}  {}",
                format!("{:?}", entry.enclosure.inf()),
                format!("{:?}", entry.enclosure.sup()),
                entry.multiplicity,
                entry.geometric,
                entry.value
            );
        }
    }
    let _ = writeln!(out, "\n{} valences in {seconds:.2} s", rows.len());
    out
}

/// One sentence about a valence.
fn summary(row: &Row) -> String {
    let subdominant = match (row.subdominant(), row.subsubdominant()) {
        (Some(_), Some(third)) => format!(
            "subdominant of frequencies 1 and {}, then {}",
            row.n - 1,
            modes(third, row.n)
        ),
        _ => "no double subdominant eigenvalue of frequency 1".into(),
    };
    let jordan = if row.is_defective() {
        let defects = row.entries.iter().filter(|e| e.geometric < e.multiplicity);
        let names: Vec<String> = defects.map(|entry| entry.value.to_string()).collect();
        let blocks = row.modes.iter().filter(|mode| !mode.chain.is_empty());
        let blocks: Vec<String> = blocks.map(chain).collect();
        format!("DEFECTIVE at {}: {}", names.join(", "), blocks.join(", "))
    } else {
        "diagonalizable".into()
    };
    let map = match (row.map.regular, row.map.injective) {
        (Sign::Positive, Sign::Positive) => "regular and injective".to_string(),
        (regular, injective) => {
            format!("regular: {}, injective: {}", word(regular), word(injective))
        }
    };
    format!("{subdominant}; {jordan}; characteristic map {map}")
}

/// The Jordan block of a generalised eigenvector v.
fn chain(mode: &InnerMode<Interval>) -> String {
    let parts: Vec<String> = (mode.chain.iter())
        .map(|(_, factor)| format!("{:?}", factor.x.mid()))
        .collect();
    format!(
        "A v = λ v + {} u, v of frequency {}, u a sum of local modes",
        parts.join(" + "),
        mode.frequency
    )
}

/// `2, 5`, `2, 5 + local`, `local`.
fn modes(entry: &Entry, n: u32) -> String {
    let frequencies: Vec<String> = entry.frequencies(n).iter().map(u32::to_string).collect();
    let mut parts = Vec::new();
    if !frequencies.is_empty() {
        parts.push(frequencies.join(", "));
    }
    if entry.is_local() {
        parts.push("local".into());
    }
    parts.join(" + ")
}

fn word(sign: Sign) -> &'static str {
    match sign {
        Sign::Positive => "proved",
        Sign::Refuted => "refuted",
        Sign::Undecided => "undecided",
    }
}

/// `{"rows": [{"n", "points", "eigenvalues": [{"lo", "hi", ..}], "modes": [..], ..}], ..}`; lo and hi
/// read back exactly.
///
/// `subdominant` and `subsubdominant` are indices in `eigenvalues`, or null.
pub fn json(rules: Rules, rows: &[Row], seconds: f64) -> Value {
    let scheme = scheme(rules);
    let row = |row: &Row| {
        let eigenvalues = row.entries.iter().map(|entry| eigenvalue(entry, row.n));
        object!({
            "n": row.n,
            "points": 1 + rules.kinds() as u32 * row.n,
            "eigenvalues": eigenvalues.collect::<Vec<_>>(),
            "modes": row.modes.iter().map(|m| mode(rules, m)).collect::<Vec<_>>(),
            "subdominant": row.subdominant().map(|_| 1),
            "subsubdominant": row.subsubdominant().map(|_| 2),
            "defective": row.is_defective(),
            "characteristic_map": {
                "regular": word(row.map.regular),
                "injective": word(row.map.injective),
                "pieces": row.map.pieces,
            },
        })
    };
    object!({
        "scheme": scheme.name(),
        "weights": scheme.weights().map(|weights| weights.to_string()),
        "rows": rows.iter().map(row).collect::<Vec<_>>(),
        "seconds": seconds,
    })
}

/// Values x + y w, w = e^(2πi k/n), at the centre and at the points of sector 0; those of sector j
/// are `w^j` times these.
fn mode(rules: Rules, mode: &InnerMode<Interval>) -> Value {
    let interval = |x: &Interval| object!([x.inf(), x.sup()]);
    let phase = |z: &Phase<Interval>| object!({"x": interval(&z.x), "y": interval(&z.y)});
    let net = |net: &FourierNet<Interval>, kinds: usize| {
        let center = ("center".to_string(), phase(&net.center));
        let names = rules.kind_names()[..kinds].iter();
        let values = names
            .zip(&net.kinds)
            .map(|(name, z)| ((*name).to_string(), phase(z)));
        Value::Object([center].into_iter().chain(values).collect())
    };
    let value = mode.eigenvalue.enclose();
    let chain: Vec<Value> = (mode.chain.iter())
        .map(|(local, z)| object!({"local_mode": local, "factor": phase(z)}))
        .collect();
    object!({
        "frequency": mode.frequency,
        "eigenvalue": interval(&value),
        "right": net(&mode.right, rules.kinds()),
        "left": net(&mode.left, rules.inner_kinds()),
        "generalised_by": chain,
    })
}

fn eigenvalue(entry: &Entry, n: u32) -> Value {
    let (exact, polynomial) = match &entry.value {
        Eigenvalue::Exact(x) => (Some(x.to_string()), None),
        Eigenvalue::Root(root) => {
            let polynomial = object!({
                "trace": root.trace.to_string(),
                "determinant": root.determinant.to_string(),
                "irrational_by_prime": root.irrational_by(n),
                "root": if root.larger { "larger" } else { "smaller" },
            });
            (None, Some(polynomial))
        }
    };
    object!({
        "lo": entry.enclosure.inf(),
        "hi": entry.enclosure.sup(),
        "exact": exact,
        "quadratic": polynomial,
        "multiplicity": entry.multiplicity,
        "eigenvectors": entry.geometric,
        "frequencies": entry.frequencies(n),
        "local": entry.is_local(),
    })
}
