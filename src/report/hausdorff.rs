//! A Hausdorff distance as text and as JSON.

use std::fmt;

use serde_json::{Value, json as object};

use crate::distance::hausdorff::{Facets, Goal, Measurement, Side};
use crate::distance::model::Against;
use crate::scheme::Scheme;

/// What the first mesh stands for.
#[derive(Clone, Copy, Debug)]
pub enum First<'a> {
    /// Its limit surface.
    Surface {
        /// The scheme.
        scheme: Scheme,
        /// The boundary rule in words.
        boundary: &'a str,
    },
    /// Itself.
    Mesh,
}

/// What it is compared with.
#[derive(Clone, Copy, Debug)]
pub enum Second<'a> {
    /// The surface's own mesh.
    Own {
        /// Its level.
        level: u32,
        /// Control or limit mesh.
        against: Against,
    },
    /// A mesh from another file.
    Other(&'a str),
}

/// A distance and what it is about.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// Name of the mesh.
    pub mesh: &'a str,
    /// What it stands for.
    pub first: First<'a>,
    /// What it is compared with.
    pub second: Second<'a>,
    /// Which side.
    pub side: Side,
    /// What a polygon is.
    pub facets: Facets,
    /// How well, and for how long.
    pub goal: Goal,
    /// Which numbers the claim is about.
    pub claim: &'a str,
    /// What was found.
    pub found: &'a Measurement,
    /// Wall-clock time.
    pub seconds: f64,
}

impl Text<'_> {
    fn sides(&self) -> [String; 2] {
        let first = match self.first {
            First::Surface { .. } => "surface".to_string(),
            First::Mesh => "mesh".to_string(),
        };
        let second = match self.second {
            Second::Own { level, against } => format!("level-{level} {} mesh", against.name()),
            Second::Other(name) => name.to_string(),
        };
        [first, second]
    }

    /// The names of the two meshes whose faces are counted.
    fn side_of(&self, side: Side) -> String {
        let [first, second] = self.sides();
        match side {
            Side::MeshToSurface => format!("{second} to {first}"),
            _ => format!("{first} to {second}"),
        }
    }
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let found = self.found;
        writeln!(f, "mesh       {}", self.mesh)?;
        match self.first {
            First::Surface { scheme, boundary } => {
                let weights = scheme
                    .weights()
                    .map(|w| format!(", {w} weights"))
                    .unwrap_or_default();
                writeln!(f, "scheme     {}{weights}", scheme.name())?;
                writeln!(f, "boundary   {boundary}")?;
            }
            First::Mesh => writeln!(f, "scheme     none (the mesh itself)")?,
        }
        let [first, second] = self.sides();
        match self.side {
            Side::Both => writeln!(f, "distance   hausdorff, {first} and {second}, both sides")?,
            side => writeln!(f, "distance   one-sided hausdorff, {}", self.side_of(side))?,
        }
        match self.facets {
            Facets::Bilinear => writeln!(f, "facets     bilinear (polygons by quarters)")?,
            Facets::Triangles => {
                writeln!(
                    f,
                    "facets     triangles (a fan from each face's first corner)"
                )?;
            }
        }
        writeln!(f, "claim      about {}", self.claim)?;
        writeln!(f, "faces      {} against {}", found.faces, found.mesh_faces)?;
        writeln!(f, "lo         {:?}", found.lo)?;
        writeln!(f, "hi         {:?}", found.hi)?;
        let note = if found.rounding_level {
            " (hi is at the level of rounding errors: the distance may be 0)"
        } else {
            ""
        };
        writeln!(
            f,
            "gap        {:.2e} of the diagonal {:.6}, {:.2e} relative{note}",
            found.diagonal_gap(),
            found.diagonal,
            found.gap()
        )?;
        if let Some(budget) = self.goal.budget {
            let seconds = budget.as_secs_f64();
            writeln!(
                f,
                "budget     {seconds} s (the ends may depend on the machine)"
            )?;
        }
        if let Some(witness) = &found.witness {
            let ([x, y, z], [a, b, c]) = (witness.point, witness.foot);
            let (face, foot_face) = (witness.face + 1, witness.foot_face + 1);
            writeln!(f, "witness    {}:", self.side_of(witness.side))?;
            writeln!(
                f,
                "           point ({x}, {y}, {z}) on face {face} (from 1)"
            )?;
            writeln!(f, "           foot ({a}, {b}, {c}) on face {foot_face}")?;
        }
        if let Some(holder) = found.holders.first() {
            let faces: Vec<String> = found
                .holders
                .iter()
                .map(|h| (h.face + 1).to_string())
                .collect();
            let side = self.side_of(holder.side);
            writeln!(f, "hi held by {side}: faces {} (from 1)", faces.join(", "))?;
        }
        writeln!(f, "seconds    {:.3}", self.seconds)
    }
}

/// The same as one JSON object; `lo` and `hi` read back exactly. Faces count from 0.
pub fn json(text: &Text<'_>) -> Value {
    let found = text.found;
    let (scheme, weights, boundary) = match text.first {
        First::Surface { scheme, boundary } => (
            scheme.name(),
            scheme.weights().map(|w| w.to_string()),
            Some(boundary),
        ),
        First::Mesh => ("none", None, None),
    };
    let (level, against, other) = match text.second {
        Second::Own { level, against } => (Some(level), Some(against.name()), None),
        Second::Other(name) => (None, None, Some(name)),
    };
    object!({
        "mesh": text.mesh,
        "scheme": scheme,
        "weights": weights,
        "boundary": boundary,
        "distance": text.side.name(),
        "level": level,
        "against": against,
        "other": other,
        "facets": text.facets.name(),
        "claim": text.claim,
        "lo": found.lo,
        "hi": found.hi,
        "gap": found.gap(),
        "diagonal": found.diagonal,
        "diagonal_gap": found.diagonal_gap(),
        "met": found.met,
        "budget": text.goal.budget.map(|b| b.as_secs_f64()),
        "rounding_level": found.rounding_level,
        "noise": found.noise,
        "faces": found.faces,
        "mesh_faces": found.mesh_faces,
        "cells": found.cells,
        "probes": found.probes,
        "witness": found.witness,
        "hi_held_by": found.holders,
        "seconds": text.seconds,
    })
}
