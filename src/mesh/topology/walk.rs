//! Walks: round a vertex, along the boundary, over components; and what they count.

use std::collections::BTreeMap;

use super::{NONE, Topology};

/// The outgoing half-edges of a vertex, counterclockwise; see [`Topology::fan`].
#[derive(Clone, Debug)]
pub struct Fan<'a> {
    topology: &'a Topology,
    start: u32,
    next: u32,
}

impl Iterator for Fan<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        if self.next == NONE {
            return None;
        }
        let h = self.next;
        let after = self.topology.rotate(h);
        self.next = if after == self.start { NONE } else { after };
        Some(h)
    }
}

/// The connected components of a mesh; see [`Topology::components`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Components {
    /// Number of components.
    pub count: u32,
    /// Component of each vertex, numbered by smallest vertex; [`NONE`] for an isolated vertex.
    pub of_vertex: Vec<u32>,
}

impl Topology {
    /// The outgoing half-edges of `v`, counterclockwise: each of its faces once, on the boundary
    /// from the clockwise-most face on. Empty for an isolated vertex.
    #[inline]
    pub fn fan(&self, v: u32) -> Fan<'_> {
        let start = self.first_halfedge(v);
        Fan {
            topology: self,
            start,
            next: start,
        }
    }

    /// The neighbours of `v` along edges, counterclockwise: `valence(v)` of them, on the boundary
    /// from the first to the last boundary edge.
    pub fn ring(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let last = self.is_boundary_vertex(v).then(|| {
            let h = self.fan(v).last().expect("a boundary vertex has a face");
            self.origin(self.prev(h))
        });
        self.fan(v).map(|h| self.target(h)).chain(last)
    }

    /// The boundary loops, each as its half-edges in order (the surface on their left), from the
    /// smallest half-edge on, and the loops in order of those.
    pub fn boundary_loops(&self) -> Vec<Vec<u32>> {
        let mut starts: Vec<u32> = self
            .edges
            .iter()
            .filter(|halves| halves[1] == NONE)
            .map(|halves| halves[0])
            .collect();
        starts.sort_unstable();
        let mut seen = vec![false; self.vertex_count() as usize];
        let mut loops = Vec::new();
        for start in starts {
            let mut cycle = Vec::new();
            let mut h = start;
            while !std::mem::replace(&mut seen[self.origin(h) as usize], true) {
                cycle.push(h);
                // The first half-edge of a boundary vertex runs along the boundary.
                h = self.first_halfedge(self.target(h));
            }
            if !cycle.is_empty() {
                loops.push(cycle);
            }
        }
        loops
    }

    /// The connected components.
    pub fn components(&self) -> Components {
        // Trees of vertices whose roots are the least of their trees: each edge joins two.
        let mut above: Vec<u32> = (0..self.vertex_count()).collect();
        for &[h, _] in &self.edges {
            let [a, b] = [self.origin(h), self.target(h)].map(|v| root(&mut above, v));
            above[a.max(b) as usize] = a.min(b);
        }
        let mut count = 0;
        for v in 0..self.vertex_count() {
            let least = above[v as usize];
            above[v as usize] = if self.first_halfedge(v) == NONE {
                NONE
            } else if least == v {
                count += 1;
                count - 1
            } else {
                // What is above v is less than v: its component is there already.
                above[least as usize]
            };
        }
        Components {
            count,
            of_vertex: above,
        }
    }

    /// The vertices without any face, in order. They are allowed, but deserve a warning.
    pub fn isolated_vertices(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.vertex_count()).filter(|&v| self.first_halfedge(v) == NONE)
    }

    /// Vertices − edges + faces, isolated vertices left out.
    pub fn euler_characteristic(&self) -> i64 {
        let vertices = self.first.iter().filter(|&&h| h != NONE).count();
        vertices as i64 - i64::from(self.edge_count()) + i64::from(self.face_count())
    }

    /// The number of handles, all components together.
    pub fn genus(&self) -> u32 {
        self.handles(self.components().count, self.boundary_loops().len())
    }

    /// With c components, b boundary loops and Euler characteristic χ, there are (2c − b − χ) / 2 handles.
    pub(crate) fn handles(&self, components: u32, loops: usize) -> u32 {
        // Even and never negative: oriented components are spheres with handles and holes.
        ((2 * i64::from(components) - loops as i64 - self.euler_characteristic()) / 2) as u32
    }

    /// How many vertices there are of each valence: interior ones, then boundary ones. Isolated
    /// vertices are in neither.
    pub fn valence_histograms(&self) -> [BTreeMap<u32, u32>; 2] {
        let mut histograms = [BTreeMap::new(), BTreeMap::new()];
        for v in (0..self.vertex_count()).filter(|&v| self.first_halfedge(v) != NONE) {
            let histogram = &mut histograms[usize::from(self.is_boundary_vertex(v))];
            *histogram.entry(self.valence(v)).or_insert(0) += 1;
        }
        histograms
    }

    /// The valence of regular interior vertices: 6 if all faces are triangles, else 4.
    #[inline]
    pub fn regular_valence(&self) -> u32 {
        if self.arity == Some(3) { 6 } else { 4 }
    }

    /// Whether `v` is an interior vertex of another valence than the regular one.
    #[inline]
    pub fn is_extraordinary_vertex(&self, v: u32) -> bool {
        let valence = self.valence[v as usize];
        valence < super::BOUNDARY && valence != self.regular_valence() && valence != 0
    }
}

/// The root of the tree of `v`; the way there is halved for those who come later.
#[inline]
fn root(above: &mut [u32], mut v: u32) -> u32 {
    while above[v as usize] != v {
        let next = above[above[v as usize] as usize];
        above[v as usize] = next;
        v = next;
    }
    v
}
