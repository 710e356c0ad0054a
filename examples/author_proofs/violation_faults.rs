//! Faults of certificates of inequalities, of nets that violate them, and of meshes.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use subcert::paper::{Report, cheng_yong, lanquetin_neveu_2004};

use super::{text, write};

/// A certificate of a paper as JSON.
fn of(report: &Report, name: &str) -> Result<Value, Box<dyn Error>> {
    let found = report.certificates.iter().find(|(file, _)| file == name);
    let (_, certificate) = found.ok_or_else(|| format!("no certificate {name}"))?;
    println!("from {name}");
    Ok(serde_json::from_slice(&text(certificate)?)?)
}

pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let cheng_yong = cheng_yong::examine(&[5], &|_, _| ());
    let lanquetin_neveu = lanquetin_neveu_2004::examine(&[5], &|_, _| ());
    inequalities(folder, &of(&cheng_yong, "cheng-yong-eq-45-n05.json")?)?;
    nets(folder, &of(&cheng_yong, "cheng-yong-eq-49-n05.json")?)?;
    let local = of(&lanquetin_neveu, "lanquetin-neveu-local-distance-n05.json")?;
    write(
        folder,
        &local,
        &[
            ("cosine-of-a-violation-missing", |c| {
                c["cosine"] = Value::Null
            }),
            ("violated-point-outside", |c| {
                let right = c["claim"]["right"].as_array_mut().expect("forms");
                right[0]["at"] = json!(["3/4", "3/4"]);
            }),
        ],
    )?;
    let recurrence = of(
        &lanquetin_neveu,
        "lanquetin-neveu-recurrence-tetrahedron.json",
    )?;
    let rate = of(&lanquetin_neveu, "lanquetin-neveu-rate-tetrahedron.json")?;
    let distance = of(
        &lanquetin_neveu,
        "lanquetin-neveu-distance-seven-vertices.json",
    )?;
    meshes(folder, [&recurrence, &rate, &distance])
}

fn inequalities(folder: &Path, certificate: &Value) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        certificate,
        &[
            ("combined-factor-too-small", |c| {
                c["claim"]["factor"] = json!("1/2");
            }),
            ("combined-multiplier-changed", |c| {
                c["steps"][0]["multipliers"][0][0][1] = json!("1/7");
            }),
            ("combined-right-side-twice", |c| {
                let list = c["steps"][0]["multipliers"][0]
                    .as_array_mut()
                    .expect("a list");
                let nothing = json!([list[0][0], "0"]);
                list.insert(0, nothing);
            }),
            ("combined-list-missing", |c| {
                c["steps"][0]["multipliers"]
                    .as_array_mut()
                    .expect("lists")
                    .pop();
            }),
            ("combined-left-side-of-another-level", |c| {
                c["claim"]["left"][0]["word"] = json!("00");
            }),
            ("reached-factor-too-large", |c| {
                // Still true, but not the least any more.
                c["claim"]["factor"] = json!("1");
            }),
            ("reached-no-such-left-side", |c| {
                c["steps"][1]["left"] = json!(999);
            }),
            ("reached-by-the-zero-net", |c| {
                let net = c["steps"][1]["net"].as_array_mut().expect("a net");
                net.iter_mut().for_each(|y| *y = json!("0"));
            }),
            ("claim-inequality-called-a-violation", |c| {
                c["claim"]["kind"] = json!("violation");
                c["claim"]["left"] = c["claim"]["left"][0].clone();
                c["steps"].as_array_mut().expect("steps").pop();
            }),
        ],
    )
}

fn nets(folder: &Path, certificate: &Value) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        certificate,
        &[
            ("violated-factor-too-large", |c| {
                c["claim"]["factor"] = json!("1");
            }),
            ("violated-by-the-zero-net", |c| {
                let net = c["steps"][0]["net"].as_array_mut().expect("a net");
                net.iter_mut().for_each(|y| *y = json!("0"));
            }),
            ("violated-nothing-on-the-right", |c| {
                c["claim"]["right"] = json!([]);
            }),
            ("violated-label-beyond-the-net", |c| {
                c["claim"]["left"]["terms"] = json!([[1, "1"], [19, "-1"]]);
            }),
            ("violated-net-too-short", |c| {
                c["steps"][0]["net"].as_array_mut().expect("a net").pop();
            }),
            ("bases-of-a-violation", |c| c["bases"] = json!([[1, 2]])),
        ],
    )
}

fn meshes(folder: &Path, [recurrence, rate, distance]: [&Value; 3]) -> Result<(), Box<dyn Error>> {
    write(
        folder,
        recurrence,
        &[
            ("mesh-face-missing", |c| {
                c["claim"]["faces"].as_array_mut().expect("faces").pop();
            }),
            ("mesh-face-turned", |c| {
                let face = c["claim"]["faces"][0].as_array_mut().expect("a face");
                face.swap(0, 1);
            }),
            ("recurrence-that-holds", |c| {
                // At the first step the middles of edges appear; later ones keep the ratio.
                c["claim"]["level"] = json!(1);
            }),
            ("claim-step-of-another-inequality", |c| {
                c["steps"][0]["rule"] = json!("rate");
            }),
        ],
    )?;
    write(
        folder,
        rate,
        &[("rate-at-level-zero", |c| c["claim"]["level"] = json!(0))],
    )?;
    write(
        folder,
        distance,
        &[
            ("distance-no-such-edge", |c| {
                c["steps"][0]["edge"] = json!([1, 1]);
            }),
            ("distance-within-the-displacements", |c| {
                // Another edge: there the surface is nearer than at some vertex.
                let edge = c["claim"]["faces"][0].clone();
                c["steps"][0]["edge"] = json!([edge[1], edge[2]]);
            }),
            ("distance-at-a-higher-level", |c| {
                c["claim"]["level"] = json!(1);
            }),
        ],
    )
}
