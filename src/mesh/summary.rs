//! What a mesh is made of, counted: for people as a table, for programs as JSON.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use super::{Mesh, Topology};

/// The counts of a mesh. Histograms map a value to how often it occurs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Summary {
    /// Vertices, isolated ones included.
    pub vertices: u32,
    /// Faces.
    pub faces: u32,
    /// Edges.
    pub edges: u32,
    /// Histogram of the faces' numbers of corners.
    pub face_sizes: BTreeMap<u32, u32>,
    /// Histogram of the valences of interior vertices.
    pub interior_valences: BTreeMap<u32, u32>,
    /// Histogram of the valences of boundary vertices.
    pub boundary_valences: BTreeMap<u32, u32>,
    /// Vertices without a face.
    pub isolated_vertices: u32,
    /// The valence of a regular interior vertex: 6 if all faces are triangles, else 4.
    pub regular_valence: u32,
    /// Interior vertices of any other valence.
    pub extraordinary_vertices: u32,
    /// Histogram of the faces' numbers of extraordinary vertices.
    pub extraordinary_per_face: BTreeMap<u32, u32>,
    /// Connected components.
    pub components: u32,
    /// Edges of each boundary loop, longest first.
    pub boundary_loops: Vec<u32>,
    /// Vertices − edges + faces, isolated vertices left out.
    pub euler_characteristic: i64,
    /// Handles, all components together.
    pub genus: u32,
    /// Smallest and largest coordinates of the vertices with faces.
    pub bounding_box: [[f64; 3]; 2],
}

impl Summary {
    /// Counts what `mesh` is made of.
    pub fn of(mesh: &Mesh) -> Self {
        let topology = &mesh.topology;
        let [interior_valences, boundary_valences] = topology.valence_histograms();
        let loops = topology.boundary_loops();
        let mut boundary_loops: Vec<u32> = loops.iter().map(|cycle| cycle.len() as u32).collect();
        boundary_loops.sort_unstable_by(|a, b| b.cmp(a));
        let components = topology.components().count;
        let vertices = 0..topology.vertex_count();
        let extraordinary = vertices
            .filter(|&v| topology.is_extraordinary_vertex(v))
            .count();
        Self {
            vertices: topology.vertex_count(),
            faces: topology.face_count(),
            edges: topology.edge_count(),
            face_sizes: per_face(topology, |corners| corners.len()),
            interior_valences,
            boundary_valences,
            isolated_vertices: topology.isolated_vertices().count() as u32,
            regular_valence: topology.regular_valence(),
            extraordinary_vertices: extraordinary as u32,
            extraordinary_per_face: per_face(topology, |corners| {
                corners
                    .iter()
                    .filter(|&&v| topology.is_extraordinary_vertex(v))
                    .count()
            }),
            components,
            boundary_loops,
            euler_characteristic: topology.euler_characteristic(),
            genus: topology.handles(components, loops.len()),
            bounding_box: mesh.bounding_box(),
        }
    }
}

fn per_face(topology: &Topology, count: impl Fn(&[u32]) -> usize) -> BTreeMap<u32, u32> {
    let mut histogram = BTreeMap::new();
    for f in 0..topology.face_count() {
        *histogram
            .entry(count(topology.corners(f)) as u32)
            .or_insert(0) += 1;
    }
    histogram
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut row = |name: &str, value: String| writeln!(f, "{name:<28}{value}");
        row("vertices", self.vertices.to_string())?;
        if self.isolated_vertices > 0 {
            row("  without a face", self.isolated_vertices.to_string())?;
        }
        row("edges", self.edges.to_string())?;
        row("faces", self.faces.to_string())?;
        row("  by corners", histogram(&self.face_sizes))?;
        row(
            "  by extraordinary corners",
            histogram(&self.extraordinary_per_face),
        )?;
        row("interior valences", histogram(&self.interior_valences))?;
        row("boundary valences", histogram(&self.boundary_valences))?;
        let rule = format!(
            "{} (valence not {})",
            self.extraordinary_vertices, self.regular_valence
        );
        row("extraordinary vertices", rule)?;
        row("components", self.components.to_string())?;
        row("boundary loops", loops(&self.boundary_loops))?;
        row(
            "Euler characteristic",
            self.euler_characteristic.to_string(),
        )?;
        row("genus", self.genus.to_string())?;
        let [low, high] = self
            .bounding_box
            .map(|[x, y, z]| format!("({x}, {y}, {z})"));
        row("bounding box", format!("{low} to {high}"))
    }
}

/// "12 of 5, 30 of 6", or "none".
fn histogram(histogram: &BTreeMap<u32, u32>) -> String {
    let parts: Vec<String> = histogram
        .iter()
        .map(|(value, count)| format!("{count} of {value}"))
        .collect();
    if parts.is_empty() {
        "none".into()
    } else {
        parts.join(", ")
    }
}

/// The number of loops and the first few lengths.
fn loops(lengths: &[u32]) -> String {
    if lengths.is_empty() {
        return "none, the mesh is closed".into();
    }
    let mut shown: Vec<String> = lengths.iter().take(8).map(u32::to_string).collect();
    if lengths.len() > shown.len() {
        shown.push("...".into());
    }
    format!("{} (edges: {})", lengths.len(), shown.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::io::{Format, parse};

    #[test]
    fn a_fan_of_five_is_told_in_words_and_in_json() {
        let text = "v 9 9 9\nv 0 0 0.5\nv 1 0 0\nv 1 1 0\nv -1 1 0\nv -1 -1 0\nv 1 -1 0\n\
            f 2 3 4\nf 2 4 5\nf 2 5 6\nf 2 6 7\nf 2 7 3\n";
        let summary = Summary::of(&parse(text.as_bytes(), Format::Obj, "x").unwrap().mesh);
        assert_eq!(
            summary.to_string(),
            "vertices                    7\n\
             \x20 without a face            1\n\
             edges                       10\n\
             faces                       5\n\
             \x20 by corners                5 of 3\n\
             \x20 by extraordinary corners  5 of 1\n\
             interior valences           1 of 5\n\
             boundary valences           5 of 3\n\
             extraordinary vertices      1 (valence not 6)\n\
             components                  1\n\
             boundary loops              1 (edges: 5)\n\
             Euler characteristic        1\n\
             genus                       0\n\
             bounding box                (-1, -1, 0) to (1, 1, 0.5)\n"
        );
        let json = serde_json::to_value(&summary).unwrap();
        assert_eq!(json["interior_valences"]["5"], 1);
        assert_eq!(json["boundary_loops"], serde_json::json!([5]));
        assert_eq!(json["bounding_box"][1][2], 0.5);
    }
}
