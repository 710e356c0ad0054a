//! The nets and norms of a valence.

use super::functional::{Functional, label};
use super::norm::Norm;
use super::printed;
use crate::scalar::Rational;
use crate::scheme::{IntegerRow, Tile, catmull_clark};

/// The levels up to which rates are computed.
pub const LEVELS: usize = 3;

/// Points of all levels as functionals of the first net, and the two norms.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The valence N.
    pub n: u32,
    /// Level 0: the 2N + 8 points; level k: the 2N + 17 points of the extended net.
    pub levels: Vec<Vec<Functional>>,
    /// The differences of (18): G_0, G_1, G_2, G_3.
    pub first: [Vec<IntegerRow>; 4],
    /// The norm G.
    pub g: Norm,
    /// The norm Z, the second-order norm.
    pub z: Norm,
}

impl Setting {
    /// The setting of a valence.
    pub fn new(n: u32) -> Self {
        let size = catmull_clark::local_net_size(n);
        let mut levels = vec![
            (1..=size)
                .map(|i| Functional::point(size, i))
                .collect::<Vec<_>>(),
        ];
        for k in 0..=LEVELS {
            let next = catmull_clark::extended_net::<Rational, _>(n, &levels[k][..size]);
            levels.push(next);
        }
        let first = [0, 1, 2, 3].map(|i| {
            let (centre, members) = phi(n, i);
            let others = members.into_iter().filter(|&j| j != centre);
            others.map(|j| difference(centre, j)).collect::<Vec<_>>()
        });
        Setting {
            n,
            levels,
            g: Norm::new(first.iter().flatten().cloned().collect(), size),
            z: Norm::new(catmull_clark::second_differences(n), size),
            first,
        }
    }

    /// The number of points, 2N + 8.
    pub fn size(&self) -> usize {
        self.levels[0].len()
    }

    /// The norm `max G_j` over some j.
    pub fn norm(&self, which: &[usize]) -> Norm {
        let rows = which.iter().flat_map(|&j| self.first[j].iter().cloned());
        Norm::new(rows.collect(), self.size())
    }

    /// A printed combination of points.
    pub fn parse(&self, text: &str) -> Functional {
        Functional::parse(text, self.size(), &|token| label(self.n, token))
    }

    /// Rows taken of the points of a level.
    pub fn rows_of(&self, rows: &[IntegerRow], level: usize) -> Vec<Functional> {
        let points = &self.levels[level];
        rows.iter()
            .map(|row| row.apply::<Rational, _>(points))
            .collect()
    }

    /// The 16 points of Π_3 of a level from 1 on: grid order, u fastest.
    pub fn third(&self, level: usize) -> [Functional; 16] {
        catmull_clark::tile_net(self.n, Tile::Third, &self.levels[level])
    }
}

/// The centre and the members of Φ_i.
pub fn phi(n: u32, i: usize) -> (usize, Vec<usize>) {
    if i == 0 {
        return (1, (1..=2 * n as usize + 1).collect());
    }
    let (centre, members) = printed::PHI[i - 1];
    let read = |text: &str| label(n, text).expect("a printed point");
    (read(centre), members.split_whitespace().map(read).collect())
}

/// `V_a - V_b`.
pub fn difference(a: usize, b: usize) -> IntegerRow {
    IntegerRow::new([(a - 1, 1), (b - 1, -1)])
}

/// The 16 second differences of a 4 x 4 grid: indices (a, b, c) of `2 b - a - c`, rows first.
pub fn grid_differences() -> Vec<[usize; 3]> {
    let along = (0..4).flat_map(|j| [0, 1].map(|i| [4 * j + i, 4 * j + i + 1, 4 * j + i + 2]));
    let across = (0..4).flat_map(|i| [0, 1].map(|j| [4 * j + i, 4 * (j + 1) + i, 4 * (j + 2) + i]));
    along.chain(across).collect()
}

/// Those second differences of a net.
pub fn second_differences_of(net: &[Functional; 16]) -> Vec<Functional> {
    let rows = grid_differences().into_iter();
    rows.map(|[a, b, c]| IntegerRow::new([(b, 2), (a, -1), (c, -1)]).apply::<Rational, _>(net))
        .collect()
}
