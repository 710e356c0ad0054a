use super::*;
use proptest::prelude::*;

const TETRAHEDRON: &str =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

fn obj(text: &str) -> Result<Loaded, MeshError> {
    parse(text.as_bytes(), Format::Obj, "x.obj")
}

fn off(text: &str) -> Result<Loaded, MeshError> {
    parse(text.as_bytes(), Format::Off, "x.off")
}

fn says(result: Result<Loaded, MeshError>) -> String {
    result.expect_err("an error").to_string()
}

#[test]
fn obj_in_all_its_spellings_is_the_same_mesh() {
    let plain = obj(TETRAHEDRON).unwrap().mesh;
    let odd = "\u{feff}# caf\\\r\n# a comment that ends in a backslash \\\n\
        mtllib a b.mtl\no thing\nv 0 0 0 1\r\nv 1. .0 -0e5 0.5 0.5 0.5\n\
        vt 0 0\nvn 0 0 1\n  v\t0 1 0 1 0.1 0.2 0.3 # top\nv 0 \\\n 0 \\\r\n+1E+0\n\
        usemtl m\ns off\nf 1/1 3/1 2/1\nf -4//1 -3//1 -1//1\nf 2/1/1 3/1/1\\\n 4/1/1\nf 3 1 4";
    let loaded = obj(odd).unwrap();
    assert_eq!(loaded.mesh.topology, plain.topology);
    assert_eq!(loaded.mesh.positions, plain.positions);
    assert!(loaded.warnings.is_empty());
}

#[test]
fn obj_geometry_left_out_and_lone_vertices_are_warned_of() {
    let loaded = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 1 2\nl 1 2\nf 1 2 3\nl 1 3\np 4\n").unwrap();
    assert_eq!(
        loaded.warnings,
        [
            "2 records 'l' (the first on line 5) are left out: only v and f are read",
            "1 records 'p' (the first on line 8) are left out: only v and f are read",
            "1 vertices have no face (the first is vertex 4): they count for nothing",
        ]
    );
}

#[test]
fn obj_faults_name_line_element_and_cure() {
    for (text, message) in [
        ("v 0 0", "x.obj:1: vertex 1 has 2 coordinates: give three"),
        (
            "\n\nv 0 nan 0",
            "x.obj:3: coordinate 'nan' of vertex 1 is no finite decimal number: correct it",
        ),
        (
            "v 0 0 0\nv 0 0 -1e400",
            "x.obj:2: coordinate '-1e400' of vertex 2 is beyond 2^1000: scale the mesh down",
        ),
        (
            "v 0 0 0 0 0",
            "x.obj:1: vertex 1 has 5 numbers: give 3, or 4 with a weight, or 3 more for a colour",
        ),
        (
            "v 0 0 0\nf 1 2",
            "x.obj:2: face 1 has 2 corners: give it at least 3, or remove it",
        ),
        (
            "v 0 0 0\nf 1 0 1",
            "x.obj:2: face 1 names vertex 0: count vertices from 1",
        ),
        (
            "v 0 0 0\nf 1 -2 1",
            "x.obj:2: face 1 names vertex -2, but there are only 1 vertices above it: correct the index",
        ),
        (
            "v 0 0 0\nf 1 1\\\n x",
            "x.obj:3: corner 'x' of face 1 is no vertex index: write a, a/b, a//c or a/b/c",
        ),
        (
            "v 0 0 0\nf 99999999999 1 1",
            "x.obj:2: vertex index 99999999999 is too large: correct it",
        ),
        (
            "V 0 0 0",
            "x.obj:1: 'V' is no OBJ record: remove or correct the line",
        ),
        (
            "# only a comment",
            "x.obj: the file has no vertex: give a mesh with at least one face",
        ),
        ("v 0 0 0", "x.obj: the mesh has no face: give at least one"),
        (
            "v 0 0 0\nv 0 0 1\n\nf 1 2 7",
            "x.obj:4: face 1 names vertex 7, but there are 2 vertices: correct the index",
        ),
        (
            "v 0 0 0\nv 0 0 1\nf 1 2 2",
            "x.obj:3: face 1 names vertex 2 more than once: remove the repeated corner, or the face",
        ),
        (
            "",
            "x.obj: the file is empty: give a mesh with at least one face",
        ),
    ] {
        assert_eq!(says(obj(text)), message);
    }
    let utf16: Vec<u8> = [0xff, 0xfe].into_iter().chain("v\0 \0".bytes()).collect();
    let error = parse(&utf16, Format::Obj, "x.obj").unwrap_err().to_string();
    assert_eq!(error, "x.obj: the text is UTF-16: save it as UTF-8");
}

#[test]
fn off_in_all_its_spellings_is_the_same_mesh() {
    let plain = obj(TETRAHEDRON).unwrap().mesh;
    let faces = "3 0 2 1\n3 0 1 3 255 0 0\n\n3 1 2 3 # red\n3 2 0 3";
    for text in [
        format!("OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{faces}"),
        format!("# first\nOFF 4 4\n\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{faces}\n# last\n\n"),
        format!(
            "COFF\r\n# c\r\n4 4 0\r\n0 0 0 1 1 1 1\r\n1 0 0 1 1 1 1\r\n0 1 0 9\n0 0 1\r\n{faces}"
        ),
        format!("4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{faces}"),
    ] {
        let mesh = off(&text).unwrap().mesh;
        assert_eq!(
            (mesh.topology, mesh.positions),
            (plain.topology.clone(), plain.positions.clone())
        );
    }
}

#[test]
fn off_faults_name_line_element_and_cure() {
    for (text, message) in [
        (
            "ply",
            "x.off:1: 'ply' is no OFF header: begin with OFF (or COFF, NOFF, STOFF), three coordinates a vertex",
        ),
        (
            "4OFF 1 1",
            "x.off:1: '4OFF' is no OFF header: begin with OFF (or COFF, NOFF, STOFF), three coordinates a vertex",
        ),
        (
            "OFF BINARY\n",
            "x.off:1: binary OFF is not read: save it as text",
        ),
        (
            "OFF\n3 x",
            "x.off:2: 'x' is no number of faces: correct the header",
        ),
        (
            "OFF 900000000000000000 1\n0 0 0",
            "x.off:2: the header announces 900000000000000000 vertices, but the file ends after 1: correct the counts",
        ),
        (
            "OFF 1 2\n0 0 0\n",
            "x.off:3: the header announces 2 faces, but the file ends after 0: correct the counts",
        ),
        (
            "OFF 1 1\n0 0 0\n3 0 1 0",
            "x.off:3: corner '1' of face 1 is no vertex: indices run from 0 to 0",
        ),
        (
            "OFF 1 1\n0 0 0\n999999999999 0",
            "x.off:3: face 1 announces 999999999999 corners, but has 1: correct the count",
        ),
        (
            "OFF 1 0\n0 0 0\n3 0",
            "x.off:3: '3' follows the 1 vertices and 0 faces of the header: correct its counts",
        ),
        (
            "OFF 0 0",
            "x.off: the file has no vertex: give a mesh with at least one face",
        ),
        (
            "OFF 1 0\n0 0",
            "x.off:2: vertex 1 has 2 coordinates: give three",
        ),
    ] {
        assert_eq!(says(off(text)), message);
    }
}

#[test]
fn ply_faults_name_element_and_cure() {
    let header = |body: &str| format!("ply\nformat ascii 1.0\n{body}end_header\n");
    let vertex = "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    let face = |n| format!("element face {n}\nproperty list uchar int vertex_indices\n");
    for (text, message) in [
        (
            header("element vertex 1\nproperty float x\n") + "0 0\n",
            "x.ply: element 'vertex' has no number 'y': add it",
        ),
        (
            header(&vertex.replace('1', "99999999999999")),
            "x.ply: the header announces 99999999999999 elements 'vertex', more than the file holds: correct it",
        ),
        (
            header("element vertex 18446744073709551615\n"),
            "x.ply: the header announces 18446744073709551615 elements 'vertex', more than the file holds: correct it",
        ),
        (
            header("element face 1\nproperty int n\n") + "0\n",
            "x.ply: element 'face' has no list 'vertex_indices': add it",
        ),
        (
            header(vertex) + "0 nan 0\n",
            "x.ply:8: the file breaks the PLY format (Couldn't read element line. String: '0 nan 0 '): export it again",
        ),
        (
            header(vertex) + "0 1e39 0\n",
            "x.ply: coordinate inf of vertex 1 is beyond 2^1000: scale the mesh down",
        ),
        (
            header(&(vertex.to_string() + &face(1))) + "0 0 0\n3 0 0 -1\n",
            "x.ply: face 1 has a negative vertex index: correct it",
        ),
        (
            header(&(vertex.to_string() + &face(1))) + "0 0 0\n3 0 0 1\n",
            "x.ply: face 1 names vertex 2, but there are 1 vertices: correct the index",
        ),
        (
            header(&(vertex.to_string() + &face(1))) + "0 0 0\n2 0 1\n",
            "x.ply: face 1 has 2 corners: give it at least 3, or remove it",
        ),
    ] {
        let result = parse(text.as_bytes(), Format::Ply, "x.ply");
        assert_eq!(result.unwrap_err().to_string(), message);
    }
    let binary = header(vertex)
        .replace("ascii", "binary_big_endian")
        .into_bytes();
    let nan = [binary, [[0; 4], f32::NAN.to_be_bytes(), [0; 4]].concat()].concat();
    assert_eq!(
        parse(&nan, Format::Ply, "x.ply").unwrap_err().to_string(),
        "x.ply: coordinate NaN of vertex 1 is no finite decimal number: correct it"
    );
    let cut = parse(b"ply\nformat asc", Format::Ply, "x.ply")
        .unwrap_err()
        .to_string();
    assert!(
        cut.starts_with("x.ply:2: the file breaks the PLY format (Couldn't parse line"),
        "{cut}"
    );
    assert!(!cut.contains('\n'));
}

#[test]
fn files_that_cannot_be_read_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let missing = read(folder.path().join("no.obj")).unwrap_err().to_string();
    assert!(
        missing.ends_with("no.obj: there is no such file: check the path"),
        "{missing}"
    );
    let inner = folder.path().join("a.obj");
    fs::create_dir(&inner).unwrap();
    let directory = read(&inner).unwrap_err().to_string();
    assert!(
        directory.ends_with("a.obj: this is a folder: name a file in it"),
        "{directory}"
    );
    let unknown = read("a.stl").unwrap_err().to_string();
    assert_eq!(
        unknown,
        "a.stl: the extension names no mesh format: use .obj, .off or .ply"
    );
    let mesh = obj(TETRAHEDRON).unwrap().mesh;
    let nowhere = write(folder.path().join("no/such/a.obj"), &mesh)
        .unwrap_err()
        .to_string();
    assert!(nowhere.contains("the file can't be written"), "{nowhere}");
}

#[test]
fn exact_reading_keeps_the_decimals() {
    use crate::scalar::Field;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    fs::write(&path, "v 0.1 1e-400 -3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let exact = read_exact(&path).unwrap().mesh;
    assert_eq!(exact.positions[0].0[0], Rational::ratio(1, 10));
    assert_eq!(exact.positions[0].0[2], Rational::ratio(-3, 1));
    assert!(exact.positions[0].0[1] > Rational::ratio(0, 1));
    let nearest = read(&path).unwrap().mesh;
    assert_eq!(nearest.positions[0].0, [0.1, 0.0, -3.0]);
    // PLY stores the nearest number, and that is what exact reading gives back.
    let ply = folder.path().join("a.ply");
    write(&ply, &nearest).unwrap();
    let stored = read_exact(&ply).unwrap().mesh;
    assert_eq!(stored.positions[0].0[0], Rational::from_float(0.1).unwrap());
}

#[test]
fn ply_carries_numbers_and_colours_of_faces() {
    let mesh = obj(TETRAHEDRON).unwrap().mesh;
    let (values, colors) = ([0.5, 1e-300, -0.0, 3.0], [[1, 2, 3]; 4]);
    let writer = PlyWriter::new(&mesh)
        .comment("made here")
        .face_number("hi", &values);
    let writer = writer.face_colors(&colors);
    let mut text = Vec::new();
    writer.clone().text().write_to(&mut text).unwrap();
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("comment made here\n"));
    assert!(text.contains(
        "property list uchar int vertex_indices\nproperty double hi\nproperty uchar red\n"
    ));
    assert!(text.ends_with("3 2 0 3 3 1 2 3\n"));
    let mut binary = Vec::new();
    writer.clone().write_to(&mut binary).unwrap();
    assert!(binary.len() > 4 * 24 + 4 * (13 + 8 + 3));
    for bytes in [text.into_bytes(), binary] {
        let back = parse(&bytes, Format::Ply, "x.ply").unwrap().mesh;
        assert_eq!(
            (back.topology, back.positions),
            (mesh.topology.clone(), mesh.positions.clone())
        );
    }
    let mut sink = Vec::new();
    assert!(
        writer
            .clone()
            .face_number("hi", &values)
            .write_to(&mut sink)
            .is_err()
    );
    assert!(
        writer
            .clone()
            .face_number("a b", &values)
            .write_to(&mut sink)
            .is_err()
    );
    assert!(
        writer
            .face_number("few", &values[1..])
            .write_to(&mut sink)
            .is_err()
    );
    assert!(sink.is_empty());
}

proptest! {
    #[test]
    fn written_coordinates_read_back_bit_for_bit(bits in prop::collection::vec(any::<u64>(), 9)) {
        let mut mesh = obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3").unwrap().mesh;
        let kept = |bits: &u64| Some(f64::from_bits(*bits)).filter(|x| x.abs() < 1e301);
        let numbers: Vec<f64> = bits.iter().map(|b| kept(b).unwrap_or(-0.0)).collect();
        mesh.positions = numbers.chunks(3).map(|c| Point([c[0], c[1], c[2]])).collect();
        for format in [Format::Obj, Format::Off, Format::Ply] {
            let mut bytes = Vec::new();
            format_to(&mut bytes, &mesh, format).unwrap();
            let back = parse(&bytes, format, "x").unwrap().mesh;
            let bits = |m: &Mesh| m.positions.iter().flat_map(|p| p.0.map(f64::to_bits)).collect::<Vec<_>>();
            prop_assert_eq!(bits(&back), bits(&mesh));
        }
    }

    /// Random bytes, and random bytes after a good beginning, are refused or read, never worse.
    #[test]
    fn any_bytes_are_handled(
        bytes in prop::collection::vec(any::<u8>(), 0..200),
        start in prop::sample::select(vec!["", "v 0 0 0\nf ", "OFF\n3 1 0\n", "ply\nformat ascii 1.0\nelement "]),
    ) {
        let bytes = [start.as_bytes(), &bytes].concat();
        for format in [Format::Obj, Format::Off, Format::Ply] {
            let _ = parse(&bytes, format, "x");
        }
    }
}
