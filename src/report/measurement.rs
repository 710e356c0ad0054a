//! A measurement as text and as JSON.

use std::fmt;

use serde_json::{Value, json as object};

use crate::distance::measure::{Measurement, Request};

/// A measurement and what it is about.
#[derive(Clone, Copy, Debug)]
pub struct Text<'a> {
    /// Name of the mesh.
    pub mesh: &'a str,
    /// What was asked.
    pub request: &'a Request,
    /// The boundary rule in words.
    pub boundary: &'a str,
    /// Which numbers the claim is about.
    pub claim: &'a str,
    /// What was found.
    pub found: &'a Measurement,
    /// Wall-clock time.
    pub seconds: f64,
}

impl fmt::Display for Text<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (request, found) = (self.request, self.found);
        let weights = request
            .scheme
            .weights()
            .map(|w| format!(", {w} weights"))
            .unwrap_or_default();
        writeln!(f, "mesh       {}", self.mesh)?;
        writeln!(f, "scheme     {}{weights}", request.scheme.name())?;
        writeln!(f, "boundary   {}", self.boundary)?;
        writeln!(
            f,
            "distance   parametric, surface to level-{} {} mesh (polygons as bilinear quarters)",
            request.level,
            request.against.name()
        )?;
        writeln!(f, "claim      about {}", self.claim)?;
        writeln!(
            f,
            "faces      {} ({} with surface)",
            found.faces, found.measured
        )?;
        writeln!(f, "lo         {:?}", found.lo)?;
        writeln!(f, "hi         {:?}", found.hi)?;
        if let Some([lower, upper]) = &found.squares {
            if lower == upper {
                writeln!(f, "exact      distance^2 = {lower}")?;
            } else {
                writeln!(f, "lo^2       {lower}")?;
                writeln!(f, "hi^2       {upper}")?;
            }
        }
        let note = if found.rounding_level && found.gap() > request.goal.gap {
            " (hi is at the level of rounding errors: the distance may be 0)"
        } else {
            ""
        };
        writeln!(f, "gap        {:.2e}{note}", found.gap())?;
        if let Some(witness) = &found.witness {
            writeln!(f, "witness    {witness}")?;
        }
        writeln!(f, "seconds    {:.3}", self.seconds)
    }
}

/// The same as one JSON object; `lo` and `hi` read back exactly. Faces and quarters count from 0.
pub fn json(text: &Text<'_>) -> Value {
    let (request, found) = (text.request, text.found);
    let mut value = object!({
        "mesh": text.mesh,
        "scheme": request.scheme.name(),
        "weights": request.scheme.weights().map(|w| w.to_string()),
        "boundary": text.boundary,
        "distance": "parametric",
        "against": request.against.name(),
        "level": request.level,
        "claim": text.claim,
        "lo": found.lo,
        "hi": found.hi,
        "gap": found.gap(),
        "met": found.met,
        "rounding_level": found.rounding_level,
        "noise": found.noise,
        "faces": found.faces,
        "faces_with_surface": found.measured,
        "cells": found.cells,
        "witness": found.witness,
        "seconds": text.seconds,
    });
    if let (Some([lower, upper]), Value::Object(map)) = (&found.squares, &mut value) {
        map.insert("lo_squared".into(), lower.to_string().into());
        map.insert("hi_squared".into(), upper.to_string().into());
    }
    value
}
