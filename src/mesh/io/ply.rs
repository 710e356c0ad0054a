//! PLY, text and binary, read through `ply-rs-bw`.

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    ElementDef, Property, PropertyAccess, PropertyAccessResult, PropertyDef, PropertyType,
};

use super::decimal::Coordinate;
use super::scan::Fault;
use super::{RawMesh, coordinate_fault};
use crate::mesh::Point;

/// The names under which files list the corners of a face.
pub(super) const CORNER_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

pub(super) fn read<S: Coordinate>(bytes: &[u8]) -> Result<RawMesh<S>, Fault> {
    let mut reader = Reader::new(bytes);
    let header = Parser::<Skipped>::new()
        .read_header(&mut reader)
        .map_err(fault)?;
    let mut mesh = RawMesh::default();
    for (name, element) in &header.elements {
        check_element(element, reader.get_ref().len())?;
        match name.as_str() {
            "vertex" => {
                let rows = Parser::<VertexRow>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
                for (v, VertexRow(point)) in rows.iter().enumerate() {
                    let exact = |x: f64| {
                        S::from_stored(x).map_err(|e| whole(coordinate_fault(e, &x.to_string(), v)))
                    };
                    mesh.positions.push(Point([
                        exact(point[0])?,
                        exact(point[1])?,
                        exact(point[2])?,
                    ]));
                }
            }
            "face" => {
                let rows = Parser::<CornersRow>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
                for (f, CornersRow(corners)) in rows.into_iter().enumerate() {
                    let corners = corners.ok_or_else(|| {
                        whole(format!(
                            "face {} has a negative vertex index: correct it",
                            f + 1
                        ))
                    })?;
                    mesh.corners.extend(corners);
                    mesh.end_face(0).map_err(|e| whole(e.what))?;
                }
            }
            _ => {
                Parser::<Skipped>::new()
                    .read_payload_for_element(&mut reader, element, &header)
                    .map_err(fault)?;
                if matches!(name.as_str(), "edge" | "tristrips") && element.count > 0 {
                    mesh.warnings.push(format!(
                        "{} elements '{name}' are left out: only vertex and face are read",
                        element.count
                    ));
                }
            }
        }
    }
    mesh.face_line.clear();
    Ok(mesh)
}

/// Tests that an element has what we read, and isn't larger than what is left of the file.
fn check_element(element: &ElementDef, remaining: usize) -> Result<(), Fault> {
    let (name, count) = (&element.name, element.count);
    // Each property takes a byte at least, in a line of text or in binary.
    let fits = count
        .checked_mul(element.properties.len().max(1))
        .is_some_and(|n| n <= remaining);
    if count > 0 && (!fits || element.properties.is_empty()) {
        return Err(whole(format!(
            "the header announces {count} elements '{name}', more than the file holds: correct it"
        )));
    }
    let is_list = |p: &PropertyDef| matches!(p.data_type, PropertyType::List(..));
    match name.as_str() {
        "vertex" => {
            for axis in ["x", "y", "z"] {
                if element.properties.get(axis).is_none_or(is_list) {
                    return Err(whole(format!(
                        "element 'vertex' has no number '{axis}': add it"
                    )));
                }
            }
        }
        "face" => {
            let lists = CORNER_LISTS.map(|list| element.properties.get(list).is_some_and(is_list));
            if lists == [false, false] {
                return Err(whole(
                    "element 'face' has no list 'vertex_indices': add it".into(),
                ));
            }
        }
        _ => {}
    }
    Ok(())
}

fn whole(what: String) -> Fault {
    Fault { line: None, what }
}

fn fault(error: ParseError) -> Fault {
    let line = error.line().and_then(|line| u32::try_from(line).ok());
    let text = error.to_string();
    let text = line
        .and_then(|n| text.strip_prefix(&format!("Line {n}: ")))
        .unwrap_or(&text);
    // The parser's own account of what it expected says nothing to a user.
    let text = text.split("\tError:").next().unwrap_or(text);
    let words: Vec<&str> = text.split_whitespace().collect();
    let mut why: String = words
        .join(" ")
        .chars()
        .filter(|c| !c.is_control())
        .take(200)
        .collect();
    why.truncate(why.trim_end_matches('.').len());
    Fault {
        line,
        what: format!("the file breaks the PLY format ({why}): export it again"),
    }
}

/// An element that isn't read.
struct Skipped;

impl PropertyAccess for Skipped {
    fn new() -> Self {
        Self
    }
}

struct VertexRow([f64; 3]);

impl PropertyAccess for VertexRow {
    fn new() -> Self {
        Self([f64::NAN; 3])
    }
    fn set_double(&mut self, name: &str, value: f64) -> PropertyAccessResult {
        let axis = match name {
            "x" => 0,
            "y" => 1,
            "z" => 2,
            _ => return PropertyAccessResult::Ignored,
        };
        self.0[axis] = value;
        PropertyAccessResult::Set
    }
    fn set_float(&mut self, name: &str, value: f32) -> PropertyAccessResult {
        self.set_double(name, f64::from(value))
    }
    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        let value = match property {
            Property::Char(k) => f64::from(k),
            Property::UChar(k) => f64::from(k),
            Property::Short(k) => f64::from(k),
            Property::UShort(k) => f64::from(k),
            Property::Int(k) => f64::from(k),
            Property::UInt(k) => f64::from(k),
            _ => return PropertyAccessResult::Ignored,
        };
        self.set_double(name, value)
    }
}

/// The corners of a face; `None` if one is negative or no whole number.
struct CornersRow(Option<Vec<u32>>);

impl PropertyAccess for CornersRow {
    fn new() -> Self {
        Self(Some(Vec::new()))
    }
    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        if !CORNER_LISTS.contains(&name) {
            return PropertyAccessResult::Ignored;
        }
        self.0 = match property {
            Property::ListUInt(list) => Some(list),
            other => other.to_u32_list(),
        };
        PropertyAccessResult::Set
    }
}
