//! PLY, text and binary, written through `ply-rs-bw`.

use std::io::{self, Write};
use std::path::Path;

use ply_rs_bw::ply::{
    Addable, ElementDef, Encoding, Header, PropertyAccess, PropertyDef, PropertyType, ScalarType,
};
use ply_rs_bw::writer::Writer;

use super::ply::CORNER_LISTS;
use super::{MeshError, write_atomically};
use crate::mesh::{Mesh, Point};

/// The names of a colour's parts.
const CHANNELS: [&str; 3] = ["red", "green", "blue"];

/// Writes a mesh as PLY: `double` coordinates, colours of vertices, and per face any numbers and a
/// colour.
#[derive(Clone, Debug)]
pub struct PlyWriter<'a> {
    mesh: &'a Mesh,
    text: bool,
    comments: Vec<&'a str>,
    face_numbers: Vec<(&'a str, &'a [f64])>,
    face_colors: Option<&'a [[u8; 3]]>,
    vertex_colors: Option<&'a [[u8; 3]]>,
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
            vertex_colors: None,
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

    /// Adds the `uchar` properties `red`, `green` and `blue` to the vertices, one colour each.
    #[must_use]
    pub fn vertex_colors(mut self, colors: &'a [[u8; 3]]) -> Self {
        self.vertex_colors = Some(colors);
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
    /// If and only if the stream fails, a property hasn't one value for each face or vertex, two have one
    /// name, a name is no identifier, a comment is longer than a line, or the mesh has more than
    /// 2^31 vertices.
    pub fn write_to(&self, mut out: &mut dyn Write) -> io::Result<()> {
        self.check()?;
        let header = self.header();
        let vertex_def = &header.elements["vertex"];
        let face_def = &header.elements["face"];
        let vertices = Writer::<VertexOut>::new();
        vertices.write_header(&mut out, &header)?;
        for (vertex, Point(point)) in self.mesh.positions.iter().enumerate() {
            let color = self.vertex_colors.map_or([0; 3], |colors| colors[vertex]);
            let row = VertexOut(*point, color);
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
        let vertices = self.mesh.positions.len();
        if self
            .vertex_colors
            .is_some_and(|colors| colors.len() != vertices)
        {
            return refuse(format!(
                "the colours are not one for each of {vertices} vertices"
            ));
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
        if self.vertex_colors.is_some() {
            for channel in CHANNELS {
                vertex.properties.add(scalar(channel, ScalarType::UChar));
            }
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
            for channel in CHANNELS {
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

struct VertexOut([f64; 3], [u8; 3]);

impl PropertyAccess for VertexOut {
    fn new() -> Self {
        Self([0.0; 3], [0; 3])
    }
    fn get_double(&self, name: &str) -> Option<f64> {
        ["x", "y", "z"]
            .iter()
            .position(|axis| *axis == name)
            .map(|i| self.0[i])
    }
    fn get_uchar(&self, name: &str) -> Option<u8> {
        CHANNELS.iter().position(|c| *c == name).map(|i| self.1[i])
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
        let channel = CHANNELS.iter().position(|c| *c == name)?;
        Some(self.file?.face_colors?[self.face][channel])
    }
}
