//! Local control nets of a face, over any arithmetic, and the Bézier pieces they yield.
//!
//! A net holds the corners of a face with their full fans. One step of the scheme splits it into
//! smaller nets of the same kind; a net whose corners are all regular is one polynomial patch. So
//! any number of extraordinary vertices on a face, and any boundary, is handled by the same step.
//!
//! | file | net |
//! |---|---|
//! | `triangle_net` | Loop: three corners with their rings |
//! | `quad_net` | Catmull-Clark: corners with edge neighbours and diagonals (or face points) |
//! | `quarter_net` | Doo-Sabin: the quarter of a face at a vertex, with the faces round that vertex |

pub mod certain;
pub mod quad_net;
pub mod quarter_net;
pub mod rounding;
pub mod space;
pub mod triangle_net;

pub use certain::{Enclosing, Exact};
pub use space::{Float, Lane, Space};

/// Parameters of the corners of a piece within its face; the fourth is unused on triangles.
pub type Corners = [[f64; 2]; 4];

/// The mesh F that a net subtracts from the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Facet {
    /// F has the control points of the face for corners.
    Control,
    /// F has their limit positions for corners.
    Limit,
    /// F is the origin: pieces are those of the surface itself, relative to the face's first corner.
    Nothing,
}

/// Where the pieces of a face go: polynomial patches of S - F, and nets that need another step.
pub trait Sink<B, N> {
    /// A polynomial piece of S - F over the given parameters, after `steps` local steps.
    fn patch(&mut self, patch: &B, corners: Corners, steps: u32);

    /// A net for the caller to fill; returned by [`Sink::net`]. Reused storage, contents arbitrary.
    fn spare(&mut self) -> N;

    /// A net with one irregular corner.
    fn net(&mut self, net: N);

    /// Takes back storage that was not needed.
    fn discard(&mut self, net: N);
}

/// The largest squared distance of a point of a net to a corner of F: an upper bound of |S - F|^2
/// where S lies in the hull of the points and F in that of its corners, the distance of two points
/// being convex in both.
fn farthest<'a, A: Space>(
    points: impl Iterator<Item = &'a A::Point>,
    facet: &[A::Point],
) -> A::Square {
    let mut largest = A::zero();
    for point in points {
        for f in facet {
            let square = A::upper(&(point.clone() - f));
            if square > largest {
                largest = square;
            }
        }
    }
    largest
}
