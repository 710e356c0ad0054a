use super::*;
use crate::eigen::tests::angles;

/// Why the map is rejected, if it is.
fn why(map: &Map, n: usize) -> String {
    map.check(n, &angles(n), 2).err().map_or(String::new(), |rejection| rejection.why)
}

#[test]
fn each_condition_counts() {
    for n in [3, 5, 8] {
        for make in [of_loop, of_catmull_clark] {
            let map = || make(&angles(n));
            assert_eq!(why(&map(), n), "");
            let mirrored = |net: &mut Net| net.iter_mut().for_each(|z| *z = z.conjugate());
            let mut other = map();
            mirrored(&mut other.patches[1]);
            assert!(why(&other, n).contains("patch 1: the Jacobian"));
            let mut other = map();
            other.ray.reverse();
            assert!(why(&other, n).contains("ray"));
            // Run through the other way; on the other side of the centre.
            let last = other.arcs.len() - 1;
            let mut other = map();
            other.arcs[last].reverse();
            assert!(
                why(&other, n).contains(&format!(
                    "arc {last} of the outer boundary is not shown to turn one"
                ))
            );
            let mut other = map();
            other.arcs[0].iter_mut().for_each(|z| *z = -*z);
            assert!(
                why(&other, n).contains("arc 0 of the outer boundary is not shown to turn less")
            );
        }
    }
}
