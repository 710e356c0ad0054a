//! Papers, claim by claim: what is printed, and a verdict on it that the program computes.
//!
//! A paper is a folder with one file of printed numbers, as printed and with their places
//! (`printed.rs`), and one file for each group of claims. Nothing that is said of a printed number is
//! typed in: verdicts come from certified enclosures, by exact comparison.
//!
//! [`Report`] is what comes out: data that knows no paper, rendered by [`crate::report`].

pub mod cheng_yong;
mod enclosure;
pub mod huang_wang_2008;
pub mod lanquetin_neveu_2004;
pub mod peters_wu;
mod proof;
mod report;
mod words;

pub use enclosure::{Enclosure, Printed};
pub use report::{
    Claim, Counterexample, Line, Look, Picture, Plot, Report, Series, Table, Verdict,
};
