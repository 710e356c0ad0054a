use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::*;
use crate::rational::parse;

#[path = "../../tests/support/cosine.rs"]
mod cosine;

/// The cosines of a valence.
pub fn angles(n: usize) -> Angles {
    let ends = cosine::cosine(n).map(|x| parse(&x).unwrap());
    Angles::from_first(n, &double(4 * n, Some((&ends[0], &ends[1]))).unwrap())
}

pub fn float(x: Fixed) -> f64 {
    x.near().to_f64().unwrap()
}

#[test]
fn cosines_of_all_multiples() {
    for n in [3, 4, 5, 6, 8, 12, 30, 101, 400] {
        let angles = angles(n);
        for m in [0, 1, 2, 3, n - 1, n, n + 1, 2 * n - 1, 2 * n, 3 * n, 4 * n - 1, 5 * n + 2] {
            let (m, x) = (m as i64, std::f64::consts::TAU * m as f64 / (4 * n) as f64);
            let [re, im] = [angles.unit(m).re, angles.unit(m).im];
            assert!((float(re) - x.cos()).abs() < 1e-13, "{n} {m}");
            assert!((float(im) - x.sin()).abs() < 1e-13, "{n} {m}");
            // cos^2 + sin^2 = 1 is enclosed, and closely.
            let [lo, hi] = angles.unit(m).norm().ends().unwrap();
            let one = BigRational::from_integer(1.into());
            assert!(lo <= one && one <= hi && (hi - lo).to_f64().unwrap() < 1e-17, "{n} {m}");
        }
    }
}

#[test]
fn an_enclosure_of_another_cosine_is_refused() {
    let file = |cosine: &str| {
        let text = format!(
            r#"{{"format": "subcert", "version": 1, "claim": {{"scheme": "loop", "valence": 5, "kind": "characteristic-map"}}, "cosine": {cosine}, "bases": [], "steps": []}}"#
        );
        Angles::new(&crate::file::read(text.as_bytes()).unwrap(), 5)
    };
    // cos(π/20) = 0.98768834.., cos(π/5) = 0.809..
    assert!(
        file(r#"["98768/100000", "98769/100000"]"#.replace("98768/100000", "6173/6250").as_str())
            .is_ok()
    );
    assert!(file(r#"["4/5", "81/100"]"#).is_err());
    assert!(file("null").is_err());
}
