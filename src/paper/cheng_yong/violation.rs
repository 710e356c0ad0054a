//! Certificates of inequalities that a net violates.

use super::functional::Functional;
use crate::certificate::{Certificate, Claim, Form, NetViolation, Step};
use crate::scalar::Rational;
use crate::scheme::IntegerRow;

/// "|left| <= factor · max |right|" with a net for which it is false.
pub struct Violation<'a> {
    /// The name of the claim.
    pub claim: &'a str,
    /// The valence.
    pub n: u32,
    /// A combination of points of the net of a word.
    pub left: (&'a str, &'a Functional),
    /// The factor.
    pub factor: &'a Rational,
    /// Differences of points of the first net.
    pub right: &'a [IntegerRow],
    /// The net.
    pub net: &'a [Rational],
}

pub use crate::paper::proof::Named;

impl Violation<'_> {
    /// The certificate.
    pub fn certificate(&self) -> Named {
        let (word, left) = self.left;
        let left = points_form(word, left);
        // A difference may occur twice in a norm: V4 - V6 and V6 - V4.
        let mut right: Vec<Form> = Vec::new();
        for form in self.right.iter().map(first_net_form) {
            if !right.contains(&form) {
                right.push(form);
            }
        }
        let claim = Claim::Net(NetViolation {
            scheme: "catmull-clark".into(),
            weights: None,
            valence: self.n,
            kind: "violation".into(),
            left,
            factor: self.factor.to_string(),
            right,
        });
        let net = texts(self.net);
        let file = format!("cheng-yong-{}-n{:02}.json", self.claim, self.n);
        let step = Step::Violated { net };
        (file, Certificate::of_violation(claim, None, step))
    }
}

/// The numbers as texts.
pub fn texts(net: &[Rational]) -> Vec<String> {
    net.iter().map(Rational::to_string).collect()
}

/// A combination of the points of the net of a word.
pub fn points_form(word: &str, combination: &Functional) -> Form {
    let terms = combination.coefficients().iter().enumerate();
    let nonzero = terms.filter(|(_, a)| !num_traits::Zero::is_zero(*a));
    Form::Points {
        word: word.into(),
        terms: nonzero.map(|(i, a)| (i + 1, a.to_string())).collect(),
    }
}

/// The row with its first coefficient positive, so that a difference has one form.
pub fn first_net_form(row: &IntegerRow) -> Form {
    let terms = row.terms();
    let sign = terms.first().map_or(1, |(_, a)| a.signum());
    let text = |&(i, a): &(usize, i64)| (i + 1, (a * sign).to_string());
    Form::Points {
        word: String::new(),
        terms: terms.iter().map(text).collect(),
    }
}
