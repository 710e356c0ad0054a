//! Distances of Loop's eigensplines.

use num_traits::ToPrimitive;
use subcert::scheme::LoopWeights::Original;
use subcert::spectrum::eigenspline::{Against, distances};

#[test]
fn explore() {
    let list: Vec<u32> = std::env::var("VALENCES")
        .unwrap_or("5".into())
        .split(',')
        .map(|x| x.parse().unwrap())
        .collect();
    for n in list {
        for against in [Against::Control, Against::Limit] {
            let start = std::time::Instant::now();
            let all = distances(Original, n, against, 6).expect("distances");
            println!("n {n} {against} {:?}", start.elapsed());
            for mode in &all {
                let f = |x: &subcert::scalar::Rational| x.to_f64().unwrap();
                print!(
                    "{} {:?} Q{} mu",
                    mode.label.family, mode.label.frequency, mode.depth
                );
                for [lo, hi] in &mode.distances {
                    print!(" {:.7}({:.0e})", f(hi), (f(hi) - f(lo)) / f(hi));
                }
                print!("\n      D");
                for e in mode.rings.iter().chain([&mode.near]) {
                    print!(" {:.7}({:.0e})", f(&e.hi), (f(&e.hi) - f(&e.lo)) / f(&e.hi));
                }
                println!();
            }
        }
    }
}
