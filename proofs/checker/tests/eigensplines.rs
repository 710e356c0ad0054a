//! Claims about the distances of eigensplines, as a search in floating point proposes them.

use subcert_check::check;

#[path = "support/cosine.rs"]
mod cosine;
#[path = "support/proposal.rs"]
mod proposal;
#[path = "support/web.rs"]
mod web;

use proposal::{Case, Name, propose};

fn names(n: usize) -> Vec<Name> {
    let rings = (0..=n / 2).map(|k| Name("ring", Some(k)));
    [Name("ray", Some(0)), Name("ray", None), Name("between", None)].into_iter().chain(rings).collect()
}

#[test]
fn profile() {
    for n in [6, 5, 8] {
        for against in ["control", "limit"] {
            for name in names(n) {
                if name == Name("ring", Some(1)) { continue; }
                let case = Case { n, weights: "original", against, levels: 3 };
                let (file, _) = propose(&case, &[name], 2e-3, 40);
                let start = std::time::Instant::now();
                let verdict = check(file.to_string().as_bytes());
                println!("{n} {against} {name:?} {:?} {:?}", start.elapsed(), verdict.outcome);
            }
        }
    }
}
