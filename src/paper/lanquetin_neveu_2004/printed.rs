//! Every number that the paper prints, as printed, with its place; nothing else is typed here.

use crate::paper::Printed;

/// A fraction as printed: numerator, denominator.
pub type Fraction = (i64, i64);

/// (1): `e = (v + e + f + f) / 4`.
pub const EDGE_POINT_DENOMINATOR: i64 = 4;

/// (3): the weights of v^1 (times n^2), of each e_j^1 and of each f_j^1; the denominator is n (n + 5).
pub const LIMIT_OF_CATMULL_CLARK: [i64; 3] = [1, 4, 1];

/// (3): the number added to n in the denominator.
pub const LIMIT_SHIFT: i64 = 5;

/// (4): β at n = 3.
pub const BETA_OF_3: Fraction = (3, 16);

/// (4): the numbers of `5/8 - (3/8 + 1/4 cos)^2`.
pub const BETA: [Fraction; 3] = [(5, 8), (3, 8), (1, 4)];

/// (5): `3 / (8nβ + 3)` and `8β / (8nβ + 3)`: the numbers 3 and 8.
pub const LIMIT_OF_LOOP: [i64; 2] = [3, 8];

/// Theorem 1, (6).
pub const THEOREM_1: Fraction = (1, 6);
/// Theorem 2, (7).
pub const THEOREM_2: Fraction = (1, 3);
/// Theorem 4, (10).
pub const THEOREM_4: Fraction = (1, 8);
/// Theorem 5, (11).
pub const THEOREM_5: Fraction = (1, 4);
/// The rate of (6), (7), (10), (11).
pub const QUARTER: Fraction = (1, 4);

/// Proof of Theorem 3: `5/8 - nβ` at n = 3.
pub const RATE_OF_3: Fraction = (1, 16);

/// (9): the weights of the two neighbours.
pub const CHAIKIN: [Fraction; 2] = [(3, 4), (1, 4)];

/// Proof of Theorem 4: the weights of P_0, P_1, P_2 in the image of P_1.
pub const LIMIT_OF_QUADRATIC: [Fraction; 3] = [(1, 8), (3, 4), (1, 8)];

/// Accuracies and depths of a table, left to right.
pub type Depths = [(Printed, u32); 5];

const fn depths(rows: [(&'static str, u32); 5]) -> Depths {
    let mut depths = [(Printed::new(rows[0].0), rows[0].1); 5];
    let mut i = 1;
    while i < 5 {
        depths[i] = (Printed::new(rows[i].0), rows[i].1);
        i += 1;
    }
    depths
}

/// Table 1: the torus, 13 x 12 x 4, n = 6.
pub const TABLE_1: Depths = depths([
    ("0.5", 2),
    ("0.1", 3),
    ("0.01", 4),
    ("0.05", 5),
    ("0.001", 6),
]);

/// Table 2: the dolphin, 94 x 31 x 29.
pub const TABLE_2: Depths = depths([
    ("0.5", 2),
    ("0.2", 3),
    ("0.055", 4),
    ("0.05", 5),
    ("0.01", 8),
]);

/// Table 3: the bunny, 16 x 12 x 20.
pub const TABLE_3: Depths = depths([
    ("0.5", 1),
    ("0.1", 2),
    ("0.05", 3),
    ("0.012", 4),
    ("0.01", 5),
]);

/// The largest valence of the torus, the dolphin, the bunny.
pub const LARGEST_VALENCES: [u32; 3] = [6, 11, 10];

/// Figure 15, the bunny: the accuracy in the text, and in the caption.
pub const FIGURE_15: [Printed; 2] = [Printed::new("0.15"), Printed::new("0.1")];

/// Section 3.1, the box, 8 x 11 x 12: the accuracy, and (n, depth) twice.
pub const BOX: (Printed, [(u32, u32); 2]) = (Printed::new("0.05"), [(5, 3), (6, 4)]);

/// Figure 13, the spinning top, 8 x 8 x 14: the accuracy, and (n, depth) twice.
pub const TOP: (Printed, [(u32, u32); 2]) = (Printed::new("0.15"), [(6, 2), (18, 3)]);

/// Section 3.1: "all vertices inserted during the subdivision have valence 6"; for Doo-Sabin, section 4,
/// "the valence of any vertex of the Doo-Sabin surface is four".
pub const INSERTED_VALENCE: [u32; 2] = [6, 4];
