//! Certificates of the constants of regular patches, and of Catmull-Clark's rates round a vertex.

use crate::bound::{Against, Constant, Family, Norm};
use crate::paper::proof::{Proof, Wanted, constants};

const fn control(k: usize) -> Constant {
    Constant::Distance(Against::Control, k)
}

/// The regular valence of Catmull-Clark, the regular number of sides of Doo-Sabin.
const REGULAR: u32 = 4;

const BICUBIC: Wanted<'_> = &[
    (control(0), &["theorem-2-regular", "corollary-2-regular"]),
    (control(1), &["theorem-2-regular", "corollary-2-regular"]),
    (
        Constant::MeshRate(1),
        &["theorem-2-regular", "corollary-2-regular"],
    ),
];

const BIQUADRATIC: Wanted<'_> = &[
    (control(0), &["theorem-5", "corollary-5"]),
    (control(1), &["theorem-5", "corollary-5"]),
    (Constant::Rate(1), &["theorem-5", "corollary-5"]),
];

/// The constants that the claims on Catmull-Clark and Doo-Sabin rest on.
pub fn of(asked: &[u32]) -> Vec<Proof> {
    let second = Family::CatmullClark(Norm::Second);
    let mut proofs = constants(second, REGULAR, BICUBIC);
    proofs.extend(constants(Family::DooSabin, REGULAR, BIQUADRATIC));
    for &n in asked.iter().filter(|n| **n != REGULAR) {
        let rate: Wanted<'_> = &[(Constant::Rate(1), &["theorem-2"])];
        proofs.extend(constants(second, n, rate));
    }
    proofs
}
