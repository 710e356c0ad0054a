//! Functionals of local nets, their exact norms, and certificates of violated inequalities.

use nalgebra::DMatrix;
use num_traits::{Signed, Zero};

use crate::certificate::{Certificate, Claim, Form, NetViolation, Step};
use crate::lp::Rows;
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::IntegerRow;

/// An integer as a rational.
pub fn integer(k: i64) -> Rational {
    <Rational as Ring>::from_integer(k)
}

/// Integers as rationals.
pub fn integers(values: &[i64]) -> Vec<Rational> {
    values.iter().copied().map(integer).collect()
}

/// A net in text.
pub fn texts(net: &[Rational]) -> Vec<String> {
    net.iter().map(Rational::to_string).collect()
}

/// `sup |t| / max |α|` over nets, and a net with `|α| <= 1` that attains it; `None` if t does not vanish
/// where all α do.
pub fn norm(rows: &Rows, t: &[Rational]) -> Option<(Rational, Vec<Rational>)> {
    let best = rows.minimise(t, rows.start())?;
    Some((best.value, best.y))
}

/// The value of a functional at a net.
pub fn at(t: &[Rational], net: &[Rational]) -> Rational {
    t.iter()
        .zip(net)
        .fold(Rational::zero(), |sum, (a, y)| sum + a * y)
}

/// The largest magnitude of some functionals at a net.
pub fn largest(rows: &[IntegerRow], net: &[Rational]) -> Rational {
    let values = rows
        .iter()
        .map(|row| row.apply::<Rational, Rational>(net).abs());
    values.fold(Rational::zero(), |m, x| if x > m { x } else { m })
}

/// The functional `Σ weight row_i` of a matrix's rows.
pub fn combine(
    matrix: &DMatrix<Rational>,
    terms: impl IntoIterator<Item = (usize, Rational)>,
) -> Vec<Rational> {
    let mut sum = vec![Rational::zero(); matrix.ncols()];
    for (i, weight) in terms {
        for (s, entry) in sum.iter_mut().zip(matrix.row(i).iter()) {
            *s += entry * &weight;
        }
    }
    sum
}

/// The form of an integer row of the net of a word.
pub fn row_form(word: &str, row: &IntegerRow) -> Form {
    let terms = row.terms().iter();
    Form::Points {
        word: word.into(),
        terms: terms.map(|&(i, c)| (i + 1, c.to_string())).collect(),
    }
}

/// The form of S - F_k, control mesh, at a point of a word.
pub fn distance_form(word: &str, level: usize, at: [i64; 2]) -> Form {
    Form::Distance {
        word: word.into(),
        against: "control".into(),
        level,
        at: at.map(|x| x.to_string()),
    }
}

/// "|left| <= factor max |right|" for a scheme, and the net that violates it.
pub fn violation(
    (scheme, weights, valence): (&str, Option<&str>, u32),
    left: Form,
    factor: &Rational,
    right: Vec<Form>,
    net: &[Rational],
    cosine: Option<[String; 2]>,
) -> Certificate {
    let claim = NetViolation {
        scheme: scheme.into(),
        weights: weights.map(str::to_string),
        valence,
        kind: "violation".into(),
        left,
        factor: factor.to_string(),
        right,
    };
    let step = Step::Violated { net: texts(net) };
    Certificate::of_violation(Claim::Net(claim), cosine, step)
}

/// p/q.
pub fn ratio(p: i64, q: i64) -> Rational {
    Rational::ratio(p, q)
}
