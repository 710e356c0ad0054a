//! Exact numbers and enclosures as numbers of the type a caller computes with.

use crate::scalar::{Cyclotomic, Field, Interval, Rational};

/// A field that numbers of a spectrum can be handed out in.
pub trait Represent: Field {
    /// The image of an exact number; `None` if and only if the type lacks it.
    fn of_exact(x: &Cyclotomic) -> Option<Self>;

    /// The image of a number known by an enclosure; `None` for exact types.
    fn of_enclosure(x: &Interval) -> Option<Self>;
}

impl Represent for Cyclotomic {
    fn of_exact(x: &Cyclotomic) -> Option<Self> {
        Some(x.clone())
    }
    fn of_enclosure(_: &Interval) -> Option<Self> {
        None
    }
}

impl Represent for Rational {
    fn of_exact(x: &Cyclotomic) -> Option<Self> {
        x.to_rational()
    }
    fn of_enclosure(_: &Interval) -> Option<Self> {
        None
    }
}

impl Represent for Interval {
    fn of_exact(x: &Cyclotomic) -> Option<Self> {
        Some(x.enclose())
    }
    fn of_enclosure(x: &Interval) -> Option<Self> {
        Some(*x)
    }
}

impl Represent for f64 {
    /// Within two units in the last place.
    fn of_exact(x: &Cyclotomic) -> Option<Self> {
        Some(x.enclose().mid())
    }
    /// The middle.
    fn of_enclosure(x: &Interval) -> Option<Self> {
        Some(x.mid())
    }
}
