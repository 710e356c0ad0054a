//! Faults of certificates of Hausdorff distances.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};

use super::{hausdorff, text, write};

pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let all = hausdorff::all()?;
    let of = |name: &str| -> Result<Value, Box<dyn Error>> {
        let found = all.iter().find(|(file, _)| file == name);
        let (_, certificate) = found.ok_or_else(|| format!("no certificate {name}"))?;
        println!("from {name}");
        Ok(serde_json::from_slice(&text(certificate)?)?)
    };
    saddle(folder, &of("loop-original-saddle-n08.json")?)?;
    bilinear(folder, &of("catmull-clark-saddle-n08.json")?)?;
    both(folder, &of("hausdorff-loop-octahedron-both.json")?)
}

/// Cells of a step.
fn cells(c: &mut Value, step: usize) -> &mut Vec<Value> {
    c["steps"][step]["cells"].as_array_mut().expect("cells")
}

fn saddle(folder: &Path, certificate: &Value) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        certificate,
        &[
            // PW, Figure 5: the distance is 0.1168..
            ("far-lo-too-large", |c| {
                c["claim"]["lo"] = json!("11681/100000")
            }),
            ("far-another-corner", |c| {
                let corner = c["steps"][0]["at"]["corner"].as_u64().expect("a corner");
                c["steps"][0]["at"]["corner"] = json!((corner + 1) % 3);
            }),
            ("far-of-a-boundary-face", |c| {
                c["steps"][0]["at"]["face"] = json!(1)
            }),
            ("near-mesh-hi-too-small", |c| {
                c["claim"]["lo"] = json!("0");
                c["claim"]["hi"] = json!("73/625");
            }),
            ("near-mesh-cell-missing", |c| {
                cells(c, 1).pop();
            }),
            ("near-mesh-cell-twice", |c| {
                let cell = cells(c, 1)[0].clone();
                cells(c, 1).push(cell);
            }),
            ("near-mesh-another-facet", |c| {
                for cell in cells(c, 1) {
                    cell[2] = json!(0);
                }
            }),
            ("vertex-too-small", |c| {
                c["claim"]["vertex"] = json!("39/1000")
            }),
            ("mesh-eigen-of-another-frequency", |c| {
                c["claim"]["eigen"]["frequency"] = json!(3)
            }),
            ("mesh-eigen-amplitude-changed", |c| {
                c["claim"]["eigen"]["amplitude"] = json!("1000001/1000000");
            }),
            ("mesh-edge-twice", |c| {
                let face = c["claim"]["faces"][0].clone();
                c["claim"]["faces"]
                    .as_array_mut()
                    .expect("faces")
                    .push(face);
            }),
            ("cosine-of-a-mesh-missing", |c| {
                c["cosine"].as_array_mut().expect("a list").remove(0);
            }),
            ("format-without-surface-step", |c| {
                c["steps"].as_array_mut().expect("steps").remove(1);
            }),
        ],
    )
}

fn bilinear(folder: &Path, certificate: &Value) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        certificate,
        &[
            ("near-mesh-oblique-segment", |c| {
                let cell = cells(c, 1).iter_mut().find(|cell| cell[2].is_array());
                cell.expect("a segment")[2][1] = json!(["1/7", "1/5"]);
            }),
            ("near-mesh-triangle-of-a-quad", |c| {
                let cell = cells(c, 1).iter_mut().find(|cell| cell[2].is_array());
                let cell = cell.expect("a segment");
                cell[2] = cell[2][0].clone();
            }),
        ],
    )
}

fn both(folder: &Path, certificate: &Value) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        certificate,
        &[
            ("near-surface-path-missing", |c| {
                cells(c, 2).pop();
            }),
            ("near-surface-another-point", |c| {
                let cell = cells(c, 2).iter_mut().find(|cell| cell[2].is_array());
                cell.expect("a point")[2] = json!([6, "3", 0]);
            }),
            ("near-surface-hi-too-small", |c| {
                c["claim"]["lo"] = json!("0");
                c["claim"]["hi"] = json!("9/4");
            }),
        ],
    )
}
