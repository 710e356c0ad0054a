//! Depths as text and as JSON. What is not safe is marked in both.

use std::fmt;

use serde_json::{Value, json as object};

use crate::depth::{Answer, Request};
use crate::scalar::Rational;
use crate::scalar::float::decimal_above;

/// The depths of a mesh and what they are about.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// Name of the mesh.
    pub mesh: &'a str,
    /// What was asked.
    pub request: &'a Request,
    /// The tolerance as a part of the bounding box's diagonal, if it was given so.
    pub relative: Option<f64>,
    /// The boundary rule in words.
    pub boundary: &'a str,
    /// Which numbers the claim is about.
    pub claim: &'a str,
    /// The least safe depth, if there is one.
    pub best: Option<&'a Answer>,
    /// The answers to show.
    pub answers: &'a [Answer],
    /// Wall-clock time.
    pub seconds: f64,
}

/// Whether an answer is safe, in a word; of no answer neither.
fn safety(answer: &Answer) -> &'static str {
    match (answer.depth, answer.safe) {
        (None, _) => "-",
        (_, true) => "yes",
        (_, false) => "NO",
    }
}

fn steps(depth: u32) -> String {
    match depth {
        1 => "1 step".into(),
        _ => format!("{depth} steps"),
    }
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let request = self.request;
        let weights = request
            .scheme
            .weights()
            .map(|w| format!(", {w} weights"))
            .unwrap_or_default();
        let part = self
            .relative
            .map(|part| format!(" ({part:?} of the bounding box's diagonal)"))
            .unwrap_or_default();
        writeln!(f, "mesh       {}", self.mesh)?;
        writeln!(f, "scheme     {}{weights}", request.scheme.name())?;
        writeln!(f, "boundary   {}", self.boundary)?;
        writeln!(
            f,
            "distance   {}, surface and {} mesh (polygons as bilinear quarters)",
            request.metric,
            request.against_name()
        )?;
        writeln!(f, "tolerance  {:?}{part}", request.tolerance)?;
        writeln!(f, "claim      about {}", self.claim)?;
        match self
            .best
            .and_then(|best| Some((best, best.depth?, best.bound_at_depth?)))
        {
            Some((best, depth, bound)) => writeln!(
                f,
                "best       {}, the distance being at most {} ({})",
                steps(depth),
                above(bound),
                best.method
            )?,
            None => writeln!(f, "best       no safe depth")?,
        }
        writeln!(f, "seconds    {:.3}", self.seconds)?;
        if self.answers.is_empty() {
            return Ok(());
        }
        writeln!(
            f,
            "\n{:<15}  {:>5}  {:>14}  {:<4}  why",
            "method", "depth", "bound at depth", "safe"
        )?;
        for answer in self.answers {
            let depth = answer.depth.map_or("-".into(), |depth| depth.to_string());
            let bound = answer.bound_at_depth;
            let bound = bound.map_or("-".into(), above);
            let no = match answer.depth {
                Some(_) => "",
                None => "no depth: ",
            };
            writeln!(
                f,
                "{:<15}  {depth:>5}  {bound:>14}  {:<4}  {no}{}",
                answer.method,
                safety(answer),
                answer.why
            )?;
        }
        Ok(())
    }
}

/// A length in seven digits that, read as a decimal, is not below it.
fn above(length: f64) -> String {
    // A decimal whose nearest f64 is at least the next one lies above this one.
    let exact = Rational::from_float(length.next_up()).filter(|_| length > 0.0);
    let upper = exact.and_then(|x| decimal_above(&x, 7).parse::<f64>().ok());
    format!("{:.6e}", upper.unwrap_or(length))
}

/// The same as one JSON object; bounds read back exactly.
///
/// `depth` is null where a method gives none; `safe` is false then, as it is where a depth is not proved.
pub fn json(text: &Text<'_>) -> Value {
    let request = text.request;
    let answer = |answer: &Answer| {
        object!({
            "method": answer.method.to_string(),
            "depth": answer.depth,
            "safe": answer.safe,
            "bound_at_depth": answer.bound_at_depth,
            "why": answer.why,
        })
    };
    object!({
        "mesh": text.mesh,
        "scheme": request.scheme.name(),
        "weights": request.scheme.weights().map(|w| w.to_string()),
        "boundary": text.boundary,
        "metric": request.metric.name(),
        "to": request.against_name(),
        "tolerance": request.tolerance,
        "relative": text.relative,
        "claim": text.claim,
        "best": text.best.map(answer),
        "methods": text.answers.iter().map(answer).collect::<Vec<_>>(),
        "seconds": text.seconds,
    })
}

#[cfg(test)]
mod tests {
    use super::above;

    #[test]
    fn printed_lengths_are_rounded_upward() {
        // By hand: 1/3 = 0.33333333.., and 0.25 itself would be a nearest decimal, but not above the f64.
        assert_eq!(above(1.0 / 3.0), "3.333334e-1");
        assert_eq!(above(0.25), "2.500001e-1");
        assert_eq!(above(0.0), "0.000000e0");
        assert_eq!(above(f64::INFINITY), "inf");
    }
}
