//! Faults of certificates about Catmull-Clark and Doo-Sabin: what is not Loop's in each rule.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use subcert::bound::{Against, Constant, Family, Norm};

use super::{certificate, way, write};

const SECOND: Family = Family::CatmullClark(Norm::Second);
const FIRST: Family = Family::CatmullClark(Norm::First);

pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let control = |k| Constant::Distance(Against::Control, k);
    let limit = |k| Constant::Distance(Against::Limit, k);

    let c_0 = certificate(SECOND, 5, control(0))?;
    write(
        folder,
        &c_0,
        &[
            ("format-weights-of-another-scheme", |c| {
                c["claim"]["weights"] = json!("original");
            }),
            ("cosine-where-all-is-rational", |c| {
                c["cosine"] = json!(["4/5", "81/100"]);
            }),
            ("format-norm-of-another-scheme", |c| {
                c["claim"]["norm"] = json!("face");
            }),
            ("format-beta-of-quads", |c| {
                c["claim"]["kind"] = json!("beta")
            }),
            ("bases-rank-of-another-norm", |c| {
                // Fifteen points more or less: the second differences of another valence.
                c["claim"]["valence"] = json!(7);
            }),
            ("tail-opposite-corner-missing", |c| {
                let lemma = c["steps"][1]["tail"].as_array_mut().expect("a tail");
                lemma.pop();
            }),
            ("attained-corner-raised", |c| {
                // The net attains 1/3 and no more.
                c["claim"]["exact"] = json!("2/5");
                c["claim"]["hi"] = json!("1/2");
            }),
            ("attained-corner-beyond-the-square", |c| {
                c["steps"][0]["at"]["v"] = json!("3/2");
            }),
        ],
    )?;
    let other_norm = certificate(FIRST, 5, control(0))?;
    write(
        folder,
        &other_norm,
        &[("bases-of-another-norm", |c| {
            // There are more first differences than second.
            c["claim"]["norm"] = json!("second");
        })],
    )?;
    let b_0 = certificate(SECOND, 3, limit(0))?;
    write(
        folder,
        &b_0,
        &[
            ("cell-concave-outside-the-square", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "concave").expect("a concave cell");
                cell[2] = json!(["concave", "5/4", "1/2"]);
            }),
            ("cell-concave-tangent-off-the-middle", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "concave").expect("a concave cell");
                cell[2] = json!(["concave", "1/2", "1/3"]);
            }),
        ],
    )?;
    let b_1 = certificate(SECOND, 5, limit(1))?;
    write(
        folder,
        &b_1,
        &[
            ("cell-edge-of-a-pentagon", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "edge").expect("an edge");
                cell[2][1] = json!(4);
            }),
            ("cell-edge-next-in-turn", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "edge").expect("an edge");
                let edge = cell[2][1].as_u64().expect("a number");
                cell[2][1] = json!((edge + 1) % 4);
            }),
        ],
    )?;
    let c_2 = certificate(FIRST, 5, control(2))?;
    write(
        folder,
        &c_2,
        &[("cell-regular-in-the-first-norm", |c| {
            let cells = c["steps"][2]["cells"].as_array_mut().expect("cells");
            let basis = cells[0][1].as_u64().unwrap_or(0);
            // In place of all parts of the tile.
            cells.retain(|cell| !cell[0].as_str().is_some_and(|w| w.starts_with(['1', '3'])));
            cells.push(json!(["1", vec![basis; 26], "regular"]));
        })],
    )?;
    let rate = certificate(SECOND, 8, Constant::Rate(1))?;
    write(
        folder,
        &rate,
        &[("differences-weight-below-the-rate", |c| {
            // CY's W at N = 8 would be 3/4 + 2/8 - 21/128 > 3/4 = r_1; 7/10 is below both.
            c["claim"]["exact"] = Value::Null;
            c["claim"]["lo"] = json!("1/2");
            c["claim"]["hi"] = json!("7/10");
        })],
    )?;

    let face = certificate(Family::DooSabin, 5, control(0))?;
    write(
        folder,
        &face,
        &[
            ("cosine-of-a-face-missing", |c| c["cosine"] = Value::Null),
            ("format-limit-mesh-of-a-face", |c| {
                c["claim"]["kind"] = json!("limit");
            }),
            ("covering-beyond-the-root", |c| {
                let cells = c["steps"][1]["cells"].as_array_mut().expect("cells");
                let basis = cells[0][1].clone();
                cells.push(json!(["2", basis, "hull"]));
            }),
            ("covering-of-the-root-incomplete", |c| {
                let cells = c["steps"][1]["cells"].as_array_mut().expect("cells");
                cells.remove(0);
            }),
        ],
    )?;
    Ok(())
}
