//! The subdivision schemes: refinement masks, limit masks, boundary rules, local nets.
//!
//! Every file of this folder has the same verbs, each generic over the arithmetic: `vertex_mask`,
//! `limit_mask`, `edge_point`, and a local net with its `subdivision_matrix`. A mask is a convex
//! combination: weights are nonnegative and sum to one.

use std::fmt;

use crate::scalar::{Field, Module};

pub mod catmull_clark;
pub mod curve;
pub mod doo_sabin;
pub mod linear;
pub mod loop_scheme;

pub use linear::IntegerRow;

/// One of the three regular quarters that a step of refinement splits off a local net.
///
/// Each local net knows its own: `tile_labels`, `tile_net`, `tile_matrix`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Tile {
    /// Towards the end of the first parameter.
    First,
    /// Opposite to the extraordinary corner.
    Second,
    /// Towards the end of the second parameter.
    Third,
}

impl Tile {
    /// The three tiles in order.
    pub const ALL: [Tile; 3] = [Tile::First, Tile::Second, Tile::Third];

    /// The lower left index of the tile's grid on the level-1 lattice of quad schemes.
    pub const fn lower_left(self) -> (i32, i32) {
        match self {
            Tile::First => (0, -1),
            Tile::Second => (0, 0),
            Tile::Third => (-1, 0),
        }
    }
}

/// The weights of a point rule at a vertex, by the class of the neighbours.
///
/// The result is `center P + edge Σ e_i + face Σ f_i`: e_i the n edge neighbours, f_i the n face
/// points or diagonal vertices (`face` is 0 for Loop).
#[derive(Clone, Debug, PartialEq)]
pub struct StarMask<S> {
    /// Weight of the vertex itself.
    pub center: S,
    /// Weight of each edge neighbour.
    pub edge: S,
    /// Weight of each face point or diagonal vertex.
    pub face: S,
}

impl<S: Field> StarMask<S> {
    /// Applies the mask to the vertex and the sums over its neighbours.
    #[inline]
    pub fn apply<V: Module<S>>(&self, center: &V, edge_sum: &V, face_sum: &V) -> V {
        center.clone() * &self.center
            + &(edge_sum.clone() * &self.edge)
            + &(face_sum.clone() * &self.face)
    }

    /// Applies a mask whose `face` weight is zero.
    #[inline]
    pub fn apply_ring<V: Module<S>>(&self, center: &V, edge_sum: &V) -> V {
        center.clone() * &self.center + &(edge_sum.clone() * &self.edge)
    }
}

/// The two vertex weights in use for Loop's scheme.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LoopWeights {
    /// Loop 1987: `n b = 5/8 - (3/8 + c/4)^2`, c = cos 2π/n.
    Original,
    /// Warren: `b = 3/(8n)` for n > 3, 3/16 for n = 3.
    Warren,
}

impl fmt::Display for LoopWeights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            LoopWeights::Original => "original",
            LoopWeights::Warren => "warren",
        })
    }
}

/// A subdivision scheme for meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scheme {
    /// Loop's scheme on triangles.
    Loop(LoopWeights),
    /// Catmull-Clark on polygons.
    CatmullClark,
    /// Doo-Sabin on polygons.
    DooSabin,
}

impl Scheme {
    /// The name used on the command line and in every file.
    pub fn name(&self) -> &'static str {
        match self {
            Scheme::Loop(_) => "loop",
            Scheme::CatmullClark => "catmull-clark",
            Scheme::DooSabin => "doo-sabin",
        }
    }

    /// The Loop weights, if the scheme has any.
    pub fn weights(&self) -> Option<LoopWeights> {
        match self {
            Scheme::Loop(weights) => Some(*weights),
            _ => None,
        }
    }
}

/// What a boundary vertex with a single face does under Loop and Catmull-Clark.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum CornerRule {
    /// It follows the cubic B-spline rule of the boundary curve.
    #[default]
    Smooth,
    /// It stays where it is.
    Sharp,
}

/// Boundary rules shared by Loop and Catmull-Clark: the uniform cubic B-spline along the boundary.
pub mod boundary {
    use super::{Field, Module};

    /// `6/8 P + 1/8 (a + b)`, a and b the neighbours along the boundary.
    #[inline]
    pub fn vertex_point<S: Field, V: Module<S>>(p: &V, a: &V, b: &V) -> V {
        p.clone() * &S::ratio(3, 4) + &((a.clone() + b) * &S::ratio(1, 8))
    }

    /// `(a + b) / 2`.
    #[inline]
    pub fn edge_point<S: Field, V: Module<S>>(a: &V, b: &V) -> V {
        (a.clone() + b) * &S::ratio(1, 2)
    }

    /// Limit position `4/6 P + 1/6 (a + b)`, for any number of faces at the vertex.
    #[inline]
    pub fn limit_point<S: Field, V: Module<S>>(p: &V, a: &V, b: &V) -> V {
        p.clone() * &S::ratio(2, 3) + &((a.clone() + b) * &S::ratio(1, 6))
    }
}
