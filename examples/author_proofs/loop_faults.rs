//! Faults of certificates about Loop's scheme: at least one for each rule.

use std::error::Error;
use std::path::Path;

use serde_json::{Value, json};
use subcert::bound::word::Word;
use subcert::bound::{Against, Constant};
use subcert::scheme::LoopWeights::{Original, Warren};

use super::{certificate, way, write};

pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let control = |k| Constant::Distance(Against::Control, k);
    let limit = |k| Constant::Distance(Against::Limit, k);

    let c_0 = certificate(Original, 7, control(0))?;
    write(
        folder,
        &c_0,
        &[
            ("format-unknown-field", |c| {
                c["remark"] = json!("true, believe me")
            }),
            ("format-version-two", |c| c["version"] = json!(2)),
            ("format-fraction-not-reduced", |c| {
                c["claim"]["lo"] = json!("2/6")
            }),
            ("format-number-as-a-float", |c| {
                c["claim"]["lo"] = json!(0.25)
            }),
            ("format-no-lower-bound", |c| {
                let steps = c["steps"].as_array_mut().expect("steps");
                steps.remove(0);
            }),
            ("format-no-conclusion", |c| {
                let steps = c["steps"].as_array_mut().expect("steps");
                steps.pop();
            }),
            ("claim-lo-above-hi", |c| {
                c["claim"]["lo"] = json!("3/4");
                c["claim"]["exact"] = Value::Null;
            }),
            ("claim-exact-outside", |c| {
                c["claim"]["exact"] = json!("5/8")
            }),
            ("claim-conclusion-of-another-kind", |c| {
                c["steps"][2] = json!({"rule": "weight", "basis": 0});
            }),
            ("cosine-missing", |c| c["cosine"] = Value::Null),
            ("cosine-of-another-valence", |c| {
                c["cosine"] = json!(["4/5", "81/100"])
            }),
            ("cosine-ends-exchanged", |c| {
                let [lo, hi] = [0, 1].map(|i| c["cosine"][i].clone());
                c["cosine"] = json!([hi, lo]);
            }),
            ("bases-not-increasing", |c| {
                let basis = c["bases"][0].as_array_mut().expect("a basis");
                basis.swap(0, 1);
            }),
            ("bases-too-short", |c| {
                c["bases"][0].as_array_mut().expect("a basis").pop();
            }),
            ("bases-beyond-the-differences", |c| {
                let basis = c["bases"][0].as_array_mut().expect("a basis");
                basis.pop();
                basis.push(json!(17));
            }),
            ("bases-cited-but-missing", |c| {
                c["steps"][1]["cells"][0][1] = json!(999)
            }),
            ("attained-net-too-large", |c| {
                // Twice the net has twice the differences.
                let net = c["steps"][0]["net"].as_array_mut().expect("a net");
                for y in net {
                    let text = y.as_str().expect("a number").to_string();
                    let (p, q) = text.split_once('/').unwrap_or((&text, "1"));
                    let p: i64 = p.parse().expect("a numerator");
                    let q: i64 = q.parse().expect("a denominator");
                    *y = json!(if q % 2 == 0 && q > 2 {
                        format!("{p}/{}", q / 2)
                    } else if q == 2 {
                        format!("{p}")
                    } else if q == 1 {
                        format!("{}", 2 * p)
                    } else {
                        format!("{}/{q}", 2 * p)
                    });
                }
            }),
            ("attained-value-too-small", |c| {
                let net = c["steps"][0]["net"].as_array_mut().expect("a net");
                net.iter_mut().for_each(|y| *y = json!("0"));
            }),
            ("attained-net-too-short", |c| {
                c["steps"][0]["net"].as_array_mut().expect("a net").pop();
            }),
            ("lemma-no-steps", |c| c["steps"][1]["steps"] = json!(0)),
            ("lemma-order-without-corner", |c| {
                c["steps"][1]["order"] = json!(1)
            }),
            ("apply-no-lemma", |c| c["steps"][2]["lemma"] = json!(0)),
            ("apply-lemma-too-weak", |c| {
                // Half as much again is as true, but no proof of 1/2.
                c["steps"][1]["bound"] = json!("3/4");
            }),
            ("covering-cell-missing", |c| {
                c["steps"][1]["cells"].as_array_mut().expect("cells").pop();
            }),
            ("covering-cell-superfluous", |c| {
                let cells = c["steps"][1]["cells"].as_array_mut().expect("cells");
                cells.push(json!(["13", 0, "hull"]));
            }),
            ("cell-hull-bound-too-small", |c| {
                c["steps"][1]["bound"] = json!("2/5")
            }),
            ("tail-basis-of-another", |c| {
                // The basis of a cell throughout: too weak.
                for corner in c["steps"][1]["tail"].as_array_mut().expect("a tail") {
                    for sign in corner.as_array_mut().expect("two signs") {
                        sign.as_array_mut().expect("bases").fill(json!(0));
                    }
                }
            }),
            ("tail-entry-missing", |c| {
                c["steps"][1]["tail"].as_array_mut().expect("a tail").pop();
            }),
        ],
    )?;

    let mut c_1 = certificate(Original, 7, control(1))?;
    c_1["claim"]["exact"] = Value::Null;
    write(
        folder,
        &c_1,
        &[
            ("cover-fewer-steps-than-levels", |c| {
                c["steps"][2]["steps"] = json!(0)
            }),
            ("cover-later-lemma", |c| c["steps"][2]["lemma"] = json!(2)),
            ("attained-point-outside", |c| {
                c["steps"][0]["at"]["v"] = json!("2")
            }),
        ],
    )?;

    let b_0 = certificate(Original, 8, limit(0))?;
    write(
        folder,
        &b_0,
        &[
            ("cell-edge-other-edge", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "edge").expect("an edge");
                let edge = cell[2][1].as_u64().expect("a number");
                cell[2][1] = json!((edge + 1) % 3);
            }),
            ("cell-edge-beyond-its-end", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "edge").expect("an edge");
                cell[2][2] = json!("5/4");
            }),
            ("cell-edge-tangent-elsewhere", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "edge").expect("an edge");
                cell[2][2] = json!("1/2");
            }),
        ],
    )?;
    let b_6 = certificate(Original, 6, limit(0))?;
    write(
        folder,
        &b_6,
        &[
            ("cell-concave-tangent-elsewhere", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "concave").expect("a concave cell");
                cell[2] = json!(["concave", "1/3", "1/4"]);
            }),
            ("cell-concave-outside", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "concave").expect("a concave cell");
                cell[2] = json!(["concave", "2/3", "2/3"]);
            }),
            ("cell-hull-where-concave", |c| {
                let cell = way(&mut c["steps"][2]["cells"], "concave").expect("a concave cell");
                cell[2] = json!("hull");
            }),
        ],
    )?;
    let c_2 = certificate(Original, 7, control(2))?;
    write(
        folder,
        &c_2,
        &[("cell-regular-at-level", |c| {
            // The factor needs a word above level k.
            let cells = c["steps"][2]["cells"].as_array_mut().expect("cells");
            let cell = cells
                .iter_mut()
                .find(|cell| cell[2] == "hull")
                .expect("a hull");
            let basis = cell[1].clone();
            cell[1] = json!(vec![basis.as_u64().unwrap_or(0); 15]);
            cell[2] = json!("regular");
        })],
    )?;
    let rate = certificate(Warren, 7, Constant::Rate(1))?;
    write(
        folder,
        &rate,
        &[
            ("differences-word-missing", |c| {
                c["steps"][1]["words"] = json!([])
            }),
            ("differences-basis-missing", |c| {
                c["steps"][1]["words"][0][1]
                    .as_array_mut()
                    .expect("bases")
                    .pop();
            }),
            ("differences-weight-too-large", |c| {
                c["claim"]["exact"] = Value::Null;
                c["claim"]["lo"] = json!("1/4");
                c["claim"]["hi"] = json!("1/2");
            }),
            ("attained-difference-of-another-level", |c| {
                c["steps"][0]["at"]["word"] = json!("00")
            }),
        ],
    )?;
    let delta = certificate(Original, 6, Constant::Coefficient(Word::EMPTY, 4))?;
    write(
        folder,
        &delta,
        &[
            ("weight-above-the-claim", |c| {
                c["claim"]["exact"] = Value::Null;
                c["claim"]["lo"] = json!("1/4");
                c["claim"]["hi"] = json!("2/5");
            }),
            ("claim-coefficient-without-place", |c| {
                c["claim"].as_object_mut().expect("a claim").remove("at");
            }),
        ],
    )?;
    let beta = certificate(Original, 7, Constant::Beta)?;
    write(
        folder,
        &beta,
        &[
            ("tiles-part-of-a-tile", |c| {
                c["steps"][2]["cells"][0][0] = json!("12")
            }),
            ("cell-split-too-deep", |c| {
                let hull = json!("hull");
                let deep = (0..13).fold(hull.clone(), |by, _| {
                    json!(["split", [by, hull, hull, hull]])
                });
                c["steps"][2]["cells"][0][2] = deep;
            }),
            ("attained-tile-net-missing", |c| {
                c["steps"][0]["nets"].as_array_mut().expect("nets").pop();
            }),
            ("attained-tile-value-too-small", |c| {
                c["steps"][0]["v"] = json!("0")
            }),
        ],
    )?;
    Ok(())
}
