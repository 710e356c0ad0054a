//! The methods: their names, and what each is about.

use std::fmt;
use std::str::FromStr;

use super::printed::{cheng_yong, huang_wang, lanquetin_neveu};
use super::{Metric, Request};
use crate::bound::Against;
use crate::mesh::Topology;
use crate::predict::Estimator;
use crate::scheme::{LoopWeights, Scheme};

/// A way to find a depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// The largest distance of a vertex to its limit. Bounds nothing.
    Heuristic,
    /// Corollaries 2, 3 and 5 of Lanquetin & Neveu.
    LanquetinNeveu,
    /// Theorems 4 and 9 of Cheng & Yong.
    ChengYong,
    /// (16) of Huang & Wang, with C_3: the earlier method of Huang, to control meshes.
    Huang,
    /// (14) of Huang & Wang, with β: to limit meshes.
    HuangWang,
    /// Ours: second differences and certified constants, after so many local subdivisions.
    Differences(u32),
    /// Peters & Wu's tabulated estimators, after so many local subdivisions.
    Tabulated(Estimator, u32),
}

/// Local subdivisions that are tried.
const STEPS: [u32; 3] = [0, 1, 2];

/// The estimators of Peters & Wu that are tabulated.
const TABULATED: [Estimator; 3] = [
    Estimator::TabApprox,
    Estimator::TabInterp,
    Estimator::TabEigen,
];

impl Method {
    /// All of them, the papers first.
    pub fn all() -> Vec<Method> {
        let mut all = vec![
            Method::Heuristic,
            Method::LanquetinNeveu,
            Method::ChengYong,
            Method::Huang,
            Method::HuangWang,
        ];
        for estimator in TABULATED {
            all.extend(STEPS.map(|steps| Method::Tabulated(estimator, steps)));
        }
        all.extend(STEPS.map(Method::Differences));
        all
    }

    /// Those that can be safe for a request and a mesh.
    pub fn candidates(request: &Request, topology: &Topology) -> Vec<Method> {
        let may_be_safe = |m: &Method| {
            m.bounds(request.metric) && m.applies(request).is_ok() && m.may_hold(request, topology)
        };
        Method::all().into_iter().filter(may_be_safe).collect()
    }

    /// Whether its verdict allows a safe answer for a mesh, by what is quick to see: false is certain.
    fn may_hold(self, request: &Request, topology: &Topology) -> bool {
        match self {
            Method::Heuristic => false,
            Method::LanquetinNeveu => lanquetin_neveu::may_be_safe(topology, request.scheme),
            Method::ChengYong => cheng_yong::may_be_safe(topology),
            Method::Huang | Method::HuangWang => huang_wang::may_be_safe(topology, request.against),
            Method::Differences(_) | Method::Tabulated(..) => true,
        }
    }

    /// Whether what it bounds, if anything, bounds that metric.
    pub fn bounds(self, metric: Metric) -> bool {
        match self {
            Method::Tabulated(..) => metric == Metric::SurfaceToMesh,
            _ => true,
        }
    }

    /// Whether it is about the scheme and the mesh of a request.
    ///
    /// # Errors
    /// If and only if it is not: why, in one sentence.
    pub fn applies(self, request: &Request) -> Result<(), String> {
        let original = Scheme::Loop(LoopWeights::Original);
        let (scheme, against) = match self {
            Method::Heuristic if request.scheme == Scheme::DooSabin => {
                return Err("vertices of a Doo-Sabin mesh are not those of the next level".into());
            }
            Method::LanquetinNeveu if request.scheme == Scheme::Loop(LoopWeights::Warren) => {
                return Err("it is stated for the weights of Loop 1987".into());
            }
            Method::Heuristic | Method::LanquetinNeveu => (None, Some(Against::Control)),
            Method::ChengYong => (Some(Scheme::CatmullClark), Some(Against::Control)),
            Method::Huang => (Some(original), Some(Against::Control)),
            Method::HuangWang => (Some(original), Some(Against::Limit)),
            Method::Differences(_) => (None, None),
            Method::Tabulated(estimator, _) => match request.scheme {
                Scheme::Loop(_) => (None, Some(estimator.against())),
                _ => (Some(original), None),
            },
        };
        if let Some(scheme) = scheme.filter(|scheme| *scheme != request.scheme) {
            return Err(match (scheme, request.scheme) {
                (Scheme::Loop(_), Scheme::Loop(_)) => {
                    "it is stated for the weights of Loop 1987".into()
                }
                _ => format!("it is about {}", scheme.name()),
            });
        }
        if against.is_some_and(|against| against != request.against) {
            return Err(match against {
                Some(Against::Limit) => "it is about distances to limit meshes".into(),
                _ => "it is about distances to control meshes".into(),
            });
        }
        Ok(())
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::Heuristic => f.pad("heuristic"),
            Method::LanquetinNeveu => f.pad("lanquetin-neveu"),
            Method::ChengYong => f.pad("cheng-yong"),
            Method::Huang => f.pad("huang"),
            Method::HuangWang => f.pad("huang-wang"),
            Method::Differences(steps) => f.pad(&format!("subcert-{steps}")),
            Method::Tabulated(estimator, steps) => f.pad(&format!("{estimator}-{steps}")),
        }
    }
}

/// No method has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no method {name}: use {known}")]
pub struct UnknownMethod {
    name: String,
    known: String,
}

impl FromStr for Method {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let all = Method::all();
        let found = all.iter().find(|method| method.to_string() == name);
        found.copied().ok_or_else(|| {
            let names: Vec<String> = all.iter().map(Method::to_string).collect();
            UnknownMethod {
                name: name.into(),
                known: names.join(", "),
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::CornerRule;

    #[test]
    fn names_are_read_back_and_differ() {
        let all = Method::all();
        let mut names: Vec<String> = all.iter().map(Method::to_string).collect();
        for (method, name) in all.iter().zip(&names) {
            assert_eq!(name.parse(), Ok(*method));
        }
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all.len());
        assert!("subcert-3".parse::<Method>().is_err());
    }

    #[test]
    fn every_request_has_a_candidate() {
        let faces = vec![0, 1, 2, 0, 2, 3, 0, 3, 1, 3, 2, 1];
        let mesh = Topology::from_uniform(4, 3, faces).expect("a tetrahedron");
        for scheme in [
            Scheme::Loop(LoopWeights::Original),
            Scheme::Loop(LoopWeights::Warren),
            Scheme::CatmullClark,
            Scheme::DooSabin,
        ] {
            for against in [Against::Control, Against::Limit] {
                for metric in [Metric::Parametric, Metric::SurfaceToMesh, Metric::Hausdorff] {
                    let request = Request {
                        scheme,
                        corner: CornerRule::Smooth,
                        against,
                        metric,
                        tolerance: 1.0,
                    };
                    let candidates = Method::candidates(&request, &mesh);
                    assert!(candidates.contains(&Method::Differences(0)));
                    assert!(!candidates.contains(&Method::Heuristic));
                    let tabulated = candidates
                        .iter()
                        .any(|m| matches!(m, Method::Tabulated(..)));
                    let expected = metric == Metric::SurfaceToMesh && scheme.weights().is_some();
                    assert_eq!(tabulated, expected, "{request:?}");
                }
            }
        }
    }
}
