//! PLY, text and binary, through `ply-rs-bw`.

use std::io::{self, Write};
use std::path::Path;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, Property, PropertyAccess, PropertyAccessResult,
    PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

use super::decimal::Coordinate;
use super::scan::Fault;
use super::{MeshError, RawMesh, coordinate_fault, write_atomically};
use crate::mesh::{Mesh, Point};

/// The names under which files list the corners of a face.
const CORNER_LISTS: [&str; 2] = ["vertex_indices", "vertex_index"];

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

/// Writes a mesh as PLY: `double` coordinates, and per face any numbers and a colour.
#[derive(Clone, Debug)]
pub struct PlyWriter<'a> {
    mesh: &'a Mesh,
    text: bool,
    comments: Vec<&'a str>,
    face_numbers: Vec<(&'a str, &'a [f64])>,
    face_colors: Option<&'a [[u8; 3]]>,
}

impl<'a> PlyWriter<'a> {
    /// A binary (little endian) file of the mesh alone.
    pub fn new(mesh: &'a Mesh) -> Self {
        let (comments, face_numbers) = (Vec::new(), Vec::new());
        Self {
            mesh,
            text: false,
            comments,
            face_numbers,
            face_colors: None,
        }
    }

    /// Writes text, with the fewest digits that read back the same numbers.
    #[must_use]
    pub fn text(mut self) -> Self {
        self.text = true;
        self
    }

    /// Adds a line of comment.
    #[must_use]
    pub fn comment(mut self, comment: &'a str) -> Self {
        self.comments.push(comment);
        self
    }

    /// Adds a `double` property `name` to the faces, one value each.
    #[must_use]
    pub fn face_number(mut self, name: &'a str, values: &'a [f64]) -> Self {
        self.face_numbers.push((name, values));
        self
    }

    /// Adds the `uchar` properties `red`, `green` and `blue` to the faces, one colour each.
    #[must_use]
    pub fn face_colors(mut self, colors: &'a [[u8; 3]]) -> Self {
        self.face_colors = Some(colors);
        self
    }

    /// Writes the file, completely or not at all.
    ///
    /// # Errors
    /// As [`PlyWriter::write_to`]; also if the file can't be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), MeshError> {
        let path = path.as_ref();
        write_atomically(path, |out| self.write_to(out)).map_err(|source| MeshError::Write {
            path: path.to_path_buf(),
            source,
        })
    }

    /// Writes to any stream.
    ///
    /// # Errors
    /// If and only if the stream fails, a property hasn't one value for each face, two have one
    /// name, a name is no identifier, a comment is longer than a line, or the mesh has more than
    /// 2^31 vertices.
    pub fn write_to(&self, mut out: &mut dyn Write) -> io::Result<()> {
        self.check()?;
        let header = self.header();
        let vertex_def = &header.elements["vertex"];
        let face_def = &header.elements["face"];
        let vertices = Writer::<VertexOut>::new();
        vertices.write_header(&mut out, &header)?;
        for Point(point) in &self.mesh.positions {
            let row = VertexOut(*point);
            if self.text {
                vertices.write_ascii_element(&mut out, &row, vertex_def)?;
            } else {
                vertices.write_little_endian_element(&mut out, &row, vertex_def)?;
            }
        }
        let faces = Writer::<FaceOut>::new();
        let mut row = FaceOut {
            file: Some(self),
            ..FaceOut::new()
        };
        for f in 0..self.mesh.topology.face_count() {
            row.face = f as usize;
            row.corners.clear();
            row.corners
                .extend(self.mesh.topology.corners(f).iter().map(|&v| v as i32));
            if self.text {
                faces.write_ascii_element(&mut out, &row, face_def)?;
            } else {
                faces.write_little_endian_element(&mut out, &row, face_def)?;
            }
        }
        Ok(())
    }

    fn check(&self) -> io::Result<()> {
        let refuse = |what: String| Err(io::Error::new(io::ErrorKind::InvalidInput, what));
        let faces = self.mesh.topology.face_count() as usize;
        if self.mesh.topology.vertex_count() > 1 << 31 {
            return refuse("PLY indices are signed, so 2^31 vertices are the most".into());
        }
        let mut names = vec!["red", "green", "blue", CORNER_LISTS[0], CORNER_LISTS[1]];
        for &(name, values) in &self.face_numbers {
            let identifier = name.starts_with(|c: char| c.is_ascii_alphabetic())
                && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
            if !identifier || names.contains(&name) {
                return refuse(format!("'{name}' can't name a property"));
            }
            if values.len() != faces {
                return refuse(format!(
                    "'{name}' has {} values for {faces} faces",
                    values.len()
                ));
            }
            names.push(name);
        }
        if self.face_colors.is_some_and(|colors| colors.len() != faces) {
            return refuse(format!("the colours are not one for each of {faces} faces"));
        }
        if self.comments.iter().any(|c| c.contains(['\n', '\r'])) {
            return refuse("a comment is longer than a line".into());
        }
        Ok(())
    }

    fn header(&self) -> Header {
        let scalar = |name: &str, t| PropertyDef::new(name.into(), PropertyType::Scalar(t));
        let topology = &self.mesh.topology;
        let mut vertex = ElementDef::new("vertex".into());
        vertex.count = self.mesh.positions.len();
        for axis in ["x", "y", "z"] {
            vertex.properties.add(scalar(axis, ScalarType::Double));
        }
        let mut face = ElementDef::new("face".into());
        face.count = topology.face_count() as usize;
        let largest = (0..topology.face_count())
            .map(|f| topology.face_size(f))
            .max();
        let small = largest.is_none_or(|size| size < 256);
        let size = if small {
            ScalarType::UChar
        } else {
            ScalarType::UInt
        };
        let corners = PropertyType::List(size, ScalarType::Int);
        face.properties
            .add(PropertyDef::new(CORNER_LISTS[0].into(), corners));
        for (name, _) in &self.face_numbers {
            face.properties.add(scalar(name, ScalarType::Double));
        }
        if self.face_colors.is_some() {
            for channel in ["red", "green", "blue"] {
                face.properties.add(scalar(channel, ScalarType::UChar));
            }
        }
        let mut header = Header::new();
        header.encoding = if self.text {
            Encoding::Ascii
        } else {
            Encoding::BinaryLittleEndian
        };
        header.comments = self.comments.iter().map(ToString::to_string).collect();
        header.elements.add(vertex);
        header.elements.add(face);
        header
    }
}

struct VertexOut([f64; 3]);

impl PropertyAccess for VertexOut {
    fn new() -> Self {
        Self([0.0; 3])
    }
    fn get_double(&self, name: &str) -> Option<f64> {
        ["x", "y", "z"]
            .iter()
            .position(|axis| *axis == name)
            .map(|i| self.0[i])
    }
}

struct FaceOut<'a> {
    file: Option<&'a PlyWriter<'a>>,
    face: usize,
    corners: Vec<i32>,
}

impl PropertyAccess for FaceOut<'_> {
    fn new() -> Self {
        Self {
            file: None,
            face: 0,
            corners: Vec::new(),
        }
    }
    fn get_list_int(&self, _: &str) -> Option<&[i32]> {
        Some(&self.corners)
    }
    fn get_double(&self, name: &str) -> Option<f64> {
        let numbers = self
            .file?
            .face_numbers
            .iter()
            .find(|(other, _)| *other == name)?;
        Some(numbers.1[self.face])
    }
    fn get_uchar(&self, name: &str) -> Option<u8> {
        let channel = ["red", "green", "blue"].iter().position(|c| *c == name)?;
        Some(self.file?.face_colors?[self.face][channel])
    }
}
