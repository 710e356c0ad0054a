//! Faults of certificates about eigensplines, characteristic maps and centres.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use subcert::certificate::Certificate;
use subcert::scheme::LoopWeights::Original;
use subcert::scheme::Scheme;
use subcert::spectrum::eigenspline::Against;
use subcert::spectrum::eigenspline::certificates::{
    centre_distance, characteristic_map, eigensplines,
};

use super::{text, write};

fn json_of(certificate: Option<Certificate>) -> Result<Value, Box<dyn Error>> {
    let certificate = certificate.ok_or("no certificate")?;
    println!("from {}", certificate.file_name().unwrap_or_default());
    Ok(serde_json::from_slice(&text(&certificate)?)?)
}

pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    maps(folder)?;
    centres(folder)?;
    distances(folder)
}

fn maps(folder: &Path) -> Result<(), Box<dyn Error>> {
    let of_loop = json_of(characteristic_map(Scheme::Loop(Original), 7, 4))?;
    write(
        folder,
        &of_loop,
        &[
            ("cosine-of-another-valence", |c| {
                // An enclosure of cos(π/28), given as that of cos(π/32).
                c["claim"]["valence"] = json!(8);
            }),
            ("cosine-of-a-map-missing", |c| {
                c["cosine"] = Value::Null;
            }),
            ("embedding-too-many-splits", |c| {
                c["steps"][0]["splits"] = json!(9);
            }),
            ("embedding-of-another-scheme", |c| {
                c["claim"]["scheme"] = json!("doo-sabin");
            }),
        ],
    )?;
    let quads = json_of(characteristic_map(Scheme::CatmullClark, 3, 4))?;
    write(
        folder,
        &quads,
        &[("embedding-cosine-far-too-wide", |c| {
            // True, but with it no coefficient of the Jacobian is certain.
            c["cosine"] = json!(["9/10", "1"]);
        })],
    )
}

fn centres(folder: &Path) -> Result<(), Box<dyn Error>> {
    let centre = json_of(Some(centre_distance(Original, 7)))?;
    write(
        folder,
        &centre,
        &[("sign-cosine-far-too-wide", |c| {
            // True, but with it no coefficient has a certain sign.
            c["cosine"] = json!(["1/2", "1"]);
        })],
    )
}

fn distances(folder: &Path) -> Result<(), Box<dyn Error>> {
    let control = json_of(eigensplines(Original, 5, Against::Control, 2))?;
    write(
        folder,
        &control,
        &[
            ("rings-hi-too-small", |c| {
                let ring = &mut c["steps"][0]["rings"][1];
                ring["hi"] = ring["lo"].clone();
            }),
            ("rings-lo-too-large", |c| {
                let ring = &mut c["steps"][1]["rings"][0];
                ring["lo"] = ring["hi"].clone();
            }),
            ("rings-point-of-another-triangle", |c| {
                c["steps"][1]["rings"][2]["at"]["triangle"] = json!([1, 0, 1]);
            }),
            ("rings-triangle-outside-of-ring-0", |c| {
                c["steps"][1]["rings"][2]["at"]["triangle"] = json!([0, 0, 0]);
            }),
            ("rings-point-outside-of-the-triangle", |c| {
                c["steps"][1]["rings"][0]["at"]["point"] = json!(["3/4", "1/2"]);
            }),
            ("rings-missing-level", |c| {
                c["steps"][0]["rings"].as_array_mut().expect("rings").pop();
            }),
            ("rings-near-hi-too-small", |c| {
                let near = &mut c["steps"][2]["near"];
                near["lo"] = json!("0");
                near["hi"] = json!("1/1000");
            }),
            ("rings-near-depth-too-small", |c| {
                // One ring, and what is said of all others together is too coarse.
                c["steps"][0]["near"]["depth"] = json!(0);
            }),
            ("rings-near-point-of-ring-0", |c| {
                c["steps"][1]["near"]["at"]["ring"] = json!(0);
            }),
            ("rings-distance-that-does-not-follow", |c| {
                let distances = &mut c["claim"]["modes"][0]["distances"];
                distances[1][1] = distances[1][0].clone();
            }),
            ("rings-distance-above-what-was-shown", |c| {
                let distances = &mut c["claim"]["modes"][1]["distances"];
                distances[2][0] = distances[2][1].clone();
            }),
            ("rings-of-another-polyhedron", |c| {
                c["claim"]["against"] = json!("limit");
            }),
            ("rings-of-another-frequency", |c| {
                c["claim"]["modes"][0]["frequency"] = json!(2);
                c["claim"]["modes"][1]["frequency"] = json!(0);
            }),
            ("claim-distances-out-of-order", |c| {
                let pair = c["claim"]["modes"][0]["distances"][0].as_array_mut();
                pair.expect("a pair").reverse();
            }),
            ("format-steps-not-one-for-each-mode", |c| {
                c["steps"].as_array_mut().expect("steps").pop();
            }),
        ],
    )?;
    let generalised = json_of(eigensplines(Original, 3, Against::Limit, 1))?;
    write(
        folder,
        &generalised,
        &[("rings-chain-not-earlier", |c| {
            c["steps"].as_array_mut().expect("steps").swap(0, 1);
            c["claim"]["modes"]
                .as_array_mut()
                .expect("modes")
                .swap(0, 1);
        })],
    )
}
