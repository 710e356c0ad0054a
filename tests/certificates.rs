//! Certificates against the checker: the committed ones, fresh ones, faulty ones, thousands of mutants.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;
use subcert::bound::word::Word;
use subcert::bound::{Against, Constant, Family, Norm, tabulate};
use subcert::scalar::Rational;
use subcert::scheme::LoopWeights::{Original, Warren};
use subcert_check::check;

fn proofs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("proofs")
}

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(proofs().join(folder)).expect("a folder of proofs");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "json"));
    paths.sort();
    paths
}

/// The name of a file without its ending.
fn stem(path: &Path) -> String {
    path.file_stem()
        .expect("a name")
        .to_string_lossy()
        .into_owned()
}

/// A sample here; all of them are checked by the program in `.ci/run`.
#[test]
fn committed_certificates_are_verified() {
    let paths = files("certificates");
    assert!(paths.len() > 1000, "{} certificates", paths.len());
    for path in paths.iter().step_by(17) {
        let outcome = check(&fs::read(path).expect("a file")).outcome;
        assert!(outcome.is_ok(), "{}: {outcome:?}", stem(path));
    }
}

#[test]
fn committed_certificates_are_small() {
    let all = files("certificates").into_iter().chain(files("rejected"));
    let size: u64 = all
        .map(|path| fs::metadata(path).expect("a file").len())
        .sum();
    assert!(size < 10 << 20, "{size} bytes");
}

#[test]
fn rejected_files_are_rejected_by_the_rule_in_their_name() {
    let paths = files("rejected");
    let mut rules: HashMap<String, usize> = HashMap::new();
    for path in &paths {
        let rejection = check(&fs::read(path).expect("a file")).outcome;
        let rejection = rejection.expect_err(&stem(path));
        let rule = rejection.rule.name().to_string();
        assert!(
            stem(path).starts_with(&format!("{rule}-")),
            "{} was rejected by rule {rule}: {rejection:?}",
            stem(path)
        );
        *rules.entry(rule).or_default() += 1;
    }
    // Every rule of FORMAT.md's table has its file.
    let format = fs::read_to_string(proofs().join("FORMAT.md")).expect("FORMAT.md");
    let table = format
        .split("| rule | what makes it fail |")
        .nth(1)
        .expect("the table");
    let named: Vec<&str> = (table.lines().skip(2))
        .take_while(|line| line.starts_with("| `"))
        .filter_map(|line| line.split('`').nth(1))
        .collect();
    assert!(named.len() >= 15, "{named:?}");
    for rule in named {
        assert!(
            rules.contains_key(rule),
            "no file is rejected by rule {rule}"
        );
    }
}

fn constants() -> Vec<Constant> {
    let distances = [Against::Control, Against::Limit].into_iter();
    let distances = distances.flat_map(|a| (0..=2).map(move |k| Constant::Distance(a, k)));
    let rates = [Constant::Rate(1), Constant::Rate(2), Constant::MeshRate(1)];
    distances.chain(rates).chain([Constant::Beta]).collect()
}

fn bytes(row: &subcert::bound::Row) -> Vec<u8> {
    let mut text = Vec::new();
    let certificate = row.certificate.as_ref().expect("a certificate");
    certificate.write(&mut text).expect("memory");
    text
}

#[test]
fn fresh_certificates_are_verified() {
    for weights in [Original, Warren] {
        let valences = [3, 4, 5, 6, 7, 12, 13];
        for row in tabulate(weights, &valences, &constants(), 1e-6, true, &|_, _| ()) {
            let outcome = check(&bytes(&row)).outcome;
            assert!(
                outcome.is_ok(),
                "{weights}, {:?} of {}: {outcome:?}",
                row.constant,
                row.n
            );
        }
    }
}

/// Catmull-Clark in both norms and Doo-Sabin's faces, regular ones too.
fn quads() -> Vec<(Family, Vec<u32>, Vec<Constant>)> {
    let control = |k| Constant::Distance(Against::Control, k);
    let distances = constants()
        .into_iter()
        .filter(|constant| *constant != Constant::Beta)
        .collect::<Vec<_>>();
    vec![
        (
            Family::CatmullClark(Norm::Second),
            vec![3, 4, 5, 8, 9],
            distances.clone(),
        ),
        (
            Family::CatmullClark(Norm::First),
            vec![3, 4, 5, 8],
            distances,
        ),
        (
            Family::DooSabin,
            vec![3, 4, 5, 6, 9],
            vec![
                control(0),
                control(1),
                control(2),
                Constant::Rate(1),
                Constant::Rate(2),
            ],
        ),
    ]
}

#[test]
fn fresh_certificates_of_quads_are_verified() {
    for (family, valences, constants) in quads() {
        for row in tabulate(family, &valences, &constants, 1e-6, true, &|_, _| ()) {
            let outcome = check(&bytes(&row)).outcome;
            let what = format!("{family:?}, {:?} of {}", row.constant, row.n);
            assert!(outcome.is_ok(), "{what}: {outcome:?}");
        }
    }
}

/// Far above level k most parts are closed by their second differences.
#[test]
fn deep_levels_are_verified() {
    let constants = [
        Constant::Distance(Against::Control, 9),
        Constant::Distance(Against::Limit, 9),
        Constant::Rate(9),
    ];
    let second = Family::CatmullClark(Norm::Second);
    let of_loop = tabulate(Original, &[5, 8], &constants, 1e-3, true, &|_, _| ());
    let of_quads = tabulate(second, &[5, 8], &constants, 1e-3, true, &|_, _| ());
    for row in of_loop.into_iter().chain(of_quads) {
        let outcome = check(&bytes(&row)).outcome;
        assert!(
            outcome.is_ok(),
            "{:?} of {}: {outcome:?}",
            row.constant,
            row.n
        );
    }
}

/// Numbers without a pattern, the same every time (Steele, Lea & Flood's SplitMix).
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

/// The runs of digits in a text.
fn numbers(text: &str) -> Vec<(usize, usize)> {
    let mut runs = Vec::new();
    let mut start = None;
    for (i, c) in text.bytes().chain([b' ']).enumerate() {
        match (c.is_ascii_digit(), start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                runs.push((from, i));
                start = None;
            }
            _ => (),
        }
    }
    runs
}

/// One number, sign, index, character or line is changed.
fn mutant(text: &str, random: &mut Random) -> String {
    let runs = numbers(text);
    let (from, to) = runs[random.below(runs.len())];
    let digits = &text[from..to];
    let replaced = |new: &str| format!("{}{new}{}", &text[..from], &text[to..]);
    match random.below(9) {
        // Another number nearby, or one digit changed, added or dropped.
        0 => match digits.parse::<u128>() {
            Ok(k) => replaced(&(k + 1).to_string()),
            Err(_) => replaced("1"),
        },
        1 => match digits.parse::<u128>() {
            Ok(k) => replaced(&k.saturating_sub(1).to_string()),
            Err(_) => replaced("0"),
        },
        2 => {
            let at = from + random.below(to - from);
            let digit = char::from(b'0' + random.below(10) as u8);
            format!("{}{digit}{}", &text[..at], &text[at + 1..])
        }
        3 => replaced(&digits[1..]),
        4 => replaced(&format!("{digits}0")),
        // The sign.
        5 => {
            if text[..from].ends_with('-') {
                format!("{}{}", &text[..from - 1], &text[from..])
            } else {
                format!("{}-{}", &text[..from], &text[from..])
            }
        }
        // Two numbers exchanged.
        6 => {
            let (other, end) = runs[random.below(runs.len())];
            let ((a, b), (c, d)) = if from <= other {
                ((from, to), (other, end))
            } else {
                ((other, end), (from, to))
            };
            if b > c {
                return text.to_string();
            }
            [
                &text[..a],
                &text[c..d],
                &text[b..c],
                &text[a..b],
                &text[d..],
            ]
            .concat()
        }
        // A line dropped or doubled.
        7 => {
            let lines: Vec<&str> = text.lines().collect();
            let at = random.below(lines.len());
            let mut kept = lines.clone();
            if random.below(2) == 0 {
                kept.remove(at);
            } else {
                kept.insert(at, lines[at]);
            }
            kept.join("\n")
        }
        // A word or a way of a cell.
        _ => {
            let pairs = [
                ("control", "limit"),
                ("limit", "control"),
                ("rate", "mesh-rate"),
                ("original", "warren"),
                ("warren", "original"),
                ("edge", "concave"),
                ("hull", "regular"),
                ("null", "\"1/2\""),
                ("second", "first"),
                ("first", "second"),
                ("catmull-clark", "doo-sabin"),
            ];
            let (old, new) = pairs[random.below(pairs.len())];
            text.replacen(old, new, 1)
        }
    }
}

/// The constants that mutants may claim, enclosed by the library.
struct Truth(HashMap<Constants, Option<(Rational, Rational)>>);

/// Family, valence, kind, level, coefficient.
type Constants = (Family, u32, String, usize, Option<(Word, usize)>);

impl Truth {
    /// Whether lo <= constant <= hi may hold: not certainly false.
    fn allows(&mut self, claim: &Value) -> bool {
        let text = |key: &str| claim[key].as_str().expect("text").to_string();
        let number = |key: &str| -> Rational { text(key).parse().expect("a rational") };
        let (lo, hi) = (number("lo"), number("hi"));
        let valence = claim["valence"].as_u64().expect("a number") as u32;
        let level = claim["level"].as_u64().expect("a number") as usize;
        let family = match (text("scheme").as_str(), claim["weights"].as_str()) {
            ("loop", Some("original")) => Family::Loop(Original),
            ("loop", Some("warren")) => Family::Loop(Warren),
            ("catmull-clark", None) => Family::CatmullClark(text("norm").parse().expect("a norm")),
            ("doo-sabin", None) => Family::DooSabin,
            other => panic!("no scheme is {other:?}"),
        };
        let at = &claim["at"];
        let coefficient = at["index"].as_u64().map(|index| {
            let word: Word = at["word"].as_str().expect("text").parse().expect("a word");
            (word, index as usize)
        });
        let key = (family, valence, text("kind"), level, coefficient);
        let kind = key.2.clone();
        let known = (self.0.entry(key))
            .or_insert_with(|| enclose(family, valence, &kind, level, coefficient));
        let (least, most) = known.as_ref().expect("a constant the library knows");
        lo <= *most && *least <= hi
    }
}

fn enclose(
    family: Family,
    n: u32,
    kind: &str,
    k: usize,
    coefficient: Option<(Word, usize)>,
) -> Option<(Rational, Rational)> {
    let constant = match kind {
        "control" => Constant::Distance(Against::Control, k),
        "limit" => Constant::Distance(Against::Limit, k),
        "rate" => Constant::Rate(k),
        "mesh-rate" => Constant::MeshRate(k),
        "beta" => Constant::Beta,
        "coefficient" => coefficient.map(|(word, index)| Constant::Coefficient(word, index))?,
        _ => return None,
    };
    let rows = tabulate(family, &[n], &[constant], 1e-6, false, &|_, _| ());
    let proof = rows[0].proof.as_ref()?;
    Some((
        Rational::from_float(proof.lo)?,
        Rational::from_float(proof.hi)?,
    ))
}

/// How many mutants of a certificate were tried and how many verified, each with a claim that may hold.
fn try_mutants(text: &str, count: usize, random: &mut Random, truth: &mut Truth) -> (usize, usize) {
    let (mut tried, mut verified) = (0, 0);
    for _ in 0..count {
        let mutant = mutant(text, random);
        if mutant == text {
            continue;
        }
        tried += 1;
        if check(mutant.as_bytes()).outcome.is_ok() {
            verified += 1;
            let file: Value = serde_json::from_str(&mutant).expect("it was read");
            assert!(
                truth.allows(&file["claim"]),
                "verified, but false:\n{mutant}"
            );
        }
    }
    (tried, verified)
}

#[test]
fn mutants_of_quads_are_rejected_or_claim_what_is_true() {
    let mut random = Random(SEED + 1);
    let mut truth = Truth(HashMap::new());
    let (mut tried, mut verified) = (0, 0);
    for (family, valences, constants) in quads() {
        for row in tabulate(family, &valences[..3], &constants, 1e-6, true, &|_, _| ()) {
            let text = String::from_utf8(bytes(&row)).expect("text");
            let (more, good) = try_mutants(&text, MUTANTS_OF_EACH_QUAD, &mut random, &mut truth);
            tried += more;
            verified += good;
        }
    }
    println!("{tried} mutants, {verified} verified, all of these true");
    assert!(tried > 3_000, "{tried} mutants");
    assert!(
        verified < tried / 4,
        "{verified} of {tried} mutants verified"
    );
}

const SEED: u64 = 20_080_415;
const MUTANTS_OF_EACH: usize = 160;
/// Squares have more of them, and larger ones.
const MUTANTS_OF_EACH_QUAD: usize = 60;

#[test]
fn mutants_are_rejected_or_claim_what_is_true() {
    let mut random = Random(SEED);
    let mut truth = Truth(HashMap::new());
    let (mut tried, mut verified) = (0, 0);
    let coefficients = [Word::EMPTY, Word::zeros(1).child(2)];
    let coefficients = coefficients.map(|word| Constant::Coefficient(word, 4));
    for weights in [Original, Warren] {
        let rows = tabulate(weights, &[3, 5, 6, 8], &constants(), 1e-6, true, &|_, _| ());
        let more = tabulate(weights, &[6], &coefficients, 1e-6, true, &|_, _| ());
        for row in rows.into_iter().chain(more) {
            let text = String::from_utf8(bytes(&row)).expect("text");
            let (more, good) = try_mutants(&text, MUTANTS_OF_EACH, &mut random, &mut truth);
            tried += more;
            verified += good;
        }
    }
    println!("{tried} mutants, {verified} verified, all of these true");
    assert!(tried > 10_000, "{tried} mutants");
    assert!(
        verified < tried / 4,
        "{verified} of {tried} mutants verified"
    );
}

/// |left| and the largest |right| of a violation about Catmull-Clark at the net of its step, by the
/// library's own refinement.
fn both_sides(file: &Value) -> (Rational, Rational) {
    let number =
        |value: &Value| -> Rational { value.as_str().expect("text").parse().expect("a rational") };
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let n = file["claim"]["valence"].as_u64().expect("a number") as u32;
    let net: Vec<Rational> = list(&file["steps"][0]["net"]).iter().map(number).collect();
    let magnitude = |form: &Value| -> Rational {
        let word = form["word"].as_str().expect("a word");
        assert!(word.bytes().all(|letter| letter == b'0'), "{word}");
        let points = word.bytes().fold(net.clone(), |points, _| {
            subcert::scheme::catmull_clark::refine_local_net::<Rational, _>(n, &points)
        });
        let terms = list(&form["terms"]).into_iter().map(|term| {
            let label = term[0].as_u64().expect("a label") as usize;
            number(&term[1]) * &points[label - 1]
        });
        num_traits::Signed::abs(&terms.sum::<Rational>())
    };
    let right = list(&file["claim"]["right"]);
    let largest = right.iter().map(magnitude).max().expect("a right side");
    (magnitude(&file["claim"]["left"]), largest)
}

#[test]
fn mutants_of_violations_are_rejected_or_violations() {
    let mut random = Random(SEED + 2);
    let (mut tried, mut verified) = (0, 0);
    for name in [
        "cheng-yong-eq-49-n05",
        "cheng-yong-eq-52-second-n06",
        "cheng-yong-quads-faster-n03",
    ] {
        let path = proofs().join("certificates").join(format!("{name}.json"));
        let text = fs::read_to_string(path).expect("a certificate");
        for _ in 0..400 {
            let mutant = mutant(&text, &mut random);
            if mutant == text {
                continue;
            }
            tried += 1;
            if check(mutant.as_bytes()).outcome.is_ok() {
                verified += 1;
                let file: Value = serde_json::from_str(&mutant).expect("it was read");
                let factor = &file["claim"]["factor"];
                let factor: Rational = factor.as_str().expect("text").parse().expect("a rational");
                let (left, right) = both_sides(&file);
                assert!(
                    left > factor * right,
                    "verified, but no violation:\n{mutant}"
                );
            }
        }
    }
    println!("{tried} mutants, {verified} verified, all of these true");
    assert!(
        tried > 1_000 && verified < tried / 2,
        "{verified} of {tried}"
    );
}
