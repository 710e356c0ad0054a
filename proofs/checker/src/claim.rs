//! The claim in words.

use num_rational::BigRational;

use crate::covering::text;
use crate::file::{Claim, Kind, Norm, Scheme, Value, Weights};
use crate::rational::decimal;

/// The claim in words: scheme, weights, valence, level, kind, norm, lo, hi, exact.
pub fn in_words(claim: &Claim) -> String {
    let (n, k) = (claim.valence, claim.level);
    let (Scheme::Loop, Norm::Second) = (claim.scheme, claim.norm);
    let weights = match claim.weights {
        Weights::Original => "original",
        Weights::Warren => "Warren's",
    };
    let constant = match (claim.kind, &claim.at) {
        (Kind::Control, _) => format!("distance to the control mesh, C_{k}({n})"),
        (Kind::Limit, _) => format!("distance to the limit mesh, B_{k}({n})"),
        (Kind::Rate, _) => format!("rate round the extraordinary vertex, r_{k}({n})"),
        (Kind::MeshRate, _) => "rate of the whole mesh".to_string(),
        (Kind::Beta, _) => format!("bound of B_0({n}) by the method of HW"),
        (Kind::Coefficient, Some(at)) => format!(
            "coefficient {} over the word {} of S - F, F the limit mesh",
            at.index,
            text(&at.word.0)
        ),
        (Kind::Coefficient, None) => "coefficient".to_string(),
    };
    let exact = match &claim.exact {
        None => String::new(),
        Some(Value::Rational(r)) => format!(", exactly {}", number(&r.0)),
        Some(Value::OverQ(list)) => {
            let terms: Vec<_> =
                list.iter().enumerate().map(|(k, c)| format!("{} beta^{k}", c.0)).collect();
            format!(", exactly ({}) / (3 + 8 beta)", terms.join(" + "))
        }
    };
    let (lo, hi) = (number(&claim.lo.0), number(&claim.hi.0));
    format!(
        "Loop, {weights} weights, valence {n}, level {k}: {constant}, in second differences, is from {lo} to {hi}{exact}"
    )
}

/// A rational, with decimals if it is not an integer.
fn number(x: &BigRational) -> String {
    let written = x.to_string();
    match (x.is_integer(), written.len() > 24) {
        (true, _) => written,
        (false, true) => decimal(x, 12),
        (false, false) => format!("{written} = {}", decimal(x, 12)),
    }
}
