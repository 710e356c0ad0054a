//! A second way to the same connectivity: every invariant again, by sorting instead of buckets.

use super::{NONE, Topology};

impl Topology {
    /// Recomputes every invariant, on whatever way the topology was built.
    ///
    /// Not tested: the order of edges and of an edge's two half-edges, which are free.
    ///
    /// # Errors
    /// The first invariant that fails, in words.
    pub fn verify(&self) -> Result<(), String> {
        self.verify_faces()?;
        self.verify_edges()?;
        self.verify_vertices()
    }

    fn verify_faces(&self) -> Result<(), String> {
        let corners = self.origin.len();
        ensure(corners > 0 && corners < 1 << 31, || {
            format!("{corners} corners")
        })?;
        if let Some(m) = self.arity {
            ensure(
                self.face_start.is_empty() && self.face_of.is_empty(),
                || "face lists beside an arity".into(),
            )?;
            ensure(m >= 3 && corners.is_multiple_of(m as usize), || {
                format!("{corners} corners in faces of {m}")
            })?;
        } else {
            ensure(self.face_start.first() == Some(&0), || {
                "faces don't start at 0".into()
            })?;
            ensure(self.face_start.last() == Some(&(corners as u32)), || {
                "faces don't end with the corners".into()
            })?;
            ensure(self.face_of.len() == corners, || "length of face_of".into())?;
        }
        for f in 0..self.face_count() {
            let halfedges = self.halfedges(f);
            ensure(halfedges.len() >= 3, || {
                format!("face {f} has {} corners", halfedges.len())
            })?;
            let mut vertices = Vec::new();
            for h in halfedges.clone() {
                let next = if h + 1 == halfedges.end {
                    halfedges.start
                } else {
                    h + 1
                };
                ensure(self.face_of(h) == f, || format!("face of half-edge {h}"))?;
                ensure(self.next(h) == next, || format!("half-edge after {h}"))?;
                ensure(self.prev(next) == h, || format!("half-edge before {next}"))?;
                vertices.push(self.origin(h));
            }
            vertices.sort_unstable();
            vertices.dedup();
            ensure(vertices.len() == halfedges.len(), || {
                format!("face {f} repeats a vertex")
            })?;
            ensure(vertices.last() < Some(&self.vertex_count()), || {
                format!("face {f} names vertex {:?}", vertices.last())
            })?;
        }
        Ok(())
    }

    fn verify_edges(&self) -> Result<(), String> {
        ensure(self.edge_of.len() == self.origin.len(), || {
            "length of edge_of".into()
        })?;
        // All half-edges by (smaller end, larger end, direction): edges are the equal pairs.
        let mut sorted: Vec<_> = (0..self.halfedge_count())
            .map(|h| {
                let (a, b) = (self.origin(h), self.target(h));
                (a.min(b), a.max(b), a > b, h)
            })
            .collect();
        sorted.sort_unstable();
        let mut edges = 0;
        for run in sorted.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
            let (a, b) = (run[0].0, run[0].1);
            ensure(
                run.len() == 1 || (run.len() == 2 && run[0].2 != run[1].2),
                || format!("half-edges {run:?} on edge {a}-{b}"),
            )?;
            let h = run[0].3;
            let twin = run.get(1).map_or(NONE, |x| x.3);
            let e = self.edge_of(h);
            ensure(e < self.edge_count(), || {
                format!("half-edge {h} has edge {e}")
            })?;
            let halves = self.edge_halfedges(e);
            ensure(
                halves == [h, twin] || (twin != NONE && halves == [twin, h]),
                || format!("edge {e} has half-edges {halves:?}, not {h} and {twin}"),
            )?;
            ensure(self.twin(h) == twin, || format!("twin of {h}"))?;
            if twin != NONE {
                ensure(self.edge_of(twin) == e, || {
                    format!("edge of half-edge {twin}")
                })?;
                ensure(self.twin(twin) == h, || format!("twin of {twin}"))?;
            }
            edges += 1;
        }
        // Each run has an edge that lists just its half-edges, so equal counts leave none over.
        ensure(edges == self.edge_count(), || {
            format!("{} edges, not {edges}", self.edge_count())
        })
    }

    fn verify_vertices(&self) -> Result<(), String> {
        ensure(self.valence.len() == self.first.len(), || {
            "length of valence".into()
        })?;
        let mut corners = vec![0u32; self.first.len()];
        let mut boundary = vec![0u32; self.first.len()];
        for h in 0..self.halfedge_count() {
            corners[self.origin(h) as usize] += 1;
            boundary[self.origin(h) as usize] += u32::from(self.twin(h) == NONE);
        }
        for v in 0..self.vertex_count() {
            let (faces, open) = (corners[v as usize], boundary[v as usize]);
            let first = self.first_halfedge(v);
            ensure(open <= 1, || format!("vertex {v} has {open} boundary fans"))?;
            ensure(self.is_boundary_vertex(v) == (open == 1), || {
                format!("boundary bit of {v}")
            })?;
            ensure(self.valence(v) == faces + open, || {
                format!(
                    "vertex {v} has valence {}, not {}",
                    self.valence(v),
                    faces + open
                )
            })?;
            ensure((first == NONE) == (faces == 0), || {
                format!("first half-edge of {v}")
            })?;
            if faces == 0 {
                continue;
            }
            ensure(
                first < self.halfedge_count() && self.origin(first) == v,
                || format!("half-edge {first} doesn't start at vertex {v}"),
            )?;
            ensure(open == 0 || self.twin(first) == NONE, || {
                format!("half-edge {first} of boundary vertex {v} isn't the clockwise-most")
            })?;
            let fan = self.fan(v).take(faces as usize + 1).count();
            ensure(fan == faces as usize, || {
                format!("the first fan of vertex {v} has {fan} of its {faces} faces")
            })?;
            let last = self.fan(v).last().map(|h| self.rotate(h));
            let end = if open == 1 { NONE } else { first };
            ensure(last == Some(end), || {
                format!("the fan of vertex {v} ends at {last:?}")
            })?;
        }
        Ok(())
    }
}

fn ensure(holds: bool, message: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(message()) }
}
