//! `subcert bound`.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Instant;

use anyhow::{Context, bail};
use clap::ValueEnum;
use subcert::bound::curve::curve_constant;
use subcert::bound::{Against, Constant, Family, Norm, Row, tabulate};
use subcert::report::constants;
use subcert::scheme::curve::Degree;
use subcert::scheme::{LoopWeights, Scheme};

use super::WeightsName;
use super::exit::Outcome;
use super::progress::Progress;

/// Encloses bound constants.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  subcert bound limit --scheme loop --valence 3..12 --level 0\n  \
        subcert bound rate --scheme catmull-clark --norm second --valence 3..20 --level 1..3\n  \
        subcert bound control --scheme doo-sabin --valence 5 --level 0..2 --certificates proofs-of-5\n  \
        subcert bound control --scheme cubic-curve --level 0..3\n\n\
        Constants are dimensionless: distance over the largest M of some differences of the control points\n\
        of a face with one extraordinary vertex. Norms: second (Loop: mixed second differences of Huang &\n\
        Wang 2008; Catmull-Clark: second differences of Cheng & Yong), first (Catmull-Clark: differences\n\
        between each corner of the face and the points round it), face (Doo-Sabin, --valence is the number\n\
        of sides: second differences through vertices of valence 4, and the diameter of the face; no\n\
        diameter at 4 sides). C_k: surface to level-k control mesh; B_k: to the level-k limit mesh; r_k: M of\n\
        level k over M of level 0. Each row is lo <= constant <= hi, proved; `exact` is the constant itself\n\
        where both sides meet, ck = 2 cos(2 pi k/n)."
)]
pub struct Bound {
    /// Which constant
    #[arg(value_enum)]
    constant: ConstantName,
    /// The subdivision scheme, or the kind of uniform B-spline curve
    #[arg(long, value_enum)]
    scheme: SchemeName,
    /// Vertex weights of Loop's scheme: those of Loop 1987, or Warren's 3/(8n) [default: original]
    #[arg(long, value_enum)]
    weights: Option<WeightsName>,
    /// The norm that constants are relative to: second, first (Catmull-Clark), face (Doo-Sabin)
    /// [default: face for Doo-Sabin, else second]
    #[arg(long, value_name = "NORM")]
    norm: Option<Norm>,
    /// Valence of the extraordinary vertex (Doo-Sabin: sides of the face), or a range: 7 or 3..12
    /// (both ends included)
    #[arg(long, value_name = "A..B")]
    valence: Option<Range>,
    /// Level, or a range of levels: 0 or 1..3 [default: 0, for rates 1]
    #[arg(long, value_name = "K")]
    level: Option<Range>,
    /// Relative gap (hi - lo) / hi to reach
    #[arg(long, value_name = "REL", default_value_t = 1e-6, value_parser = gap)]
    gap: f64,
    /// Write a certificate for each row into this folder, for subcert-check
    #[arg(long, value_name = "DIR")]
    certificates: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum SchemeName {
    Loop,
    CatmullClark,
    DooSabin,
    /// Cubic curves: Lanquetin & Neveu's Theorem 1
    CubicCurve,
    /// Quadratic curves: their Theorem 4
    QuadraticCurve,
}

/// What a name of a scheme stands for.
enum Setting {
    Mesh(Scheme),
    Curve(Degree),
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum ConstantName {
    /// r_k: how fast M of the extraordinary net falls in k steps
    Rate,
    /// The same over all 4^k parts of the face
    MeshRate,
    /// C_k: surface to the level-k control mesh
    Control,
    /// B_k: surface to the level-k limit mesh
    Limit,
    /// Huang & Wang's own bound of B_0, one program per Bezier coefficient (level 0)
    Beta,
}

impl ConstantName {
    /// The constant of a level; β has none.
    fn of_level(self, k: usize) -> Constant {
        match self {
            ConstantName::Rate => Constant::Rate(k),
            ConstantName::MeshRate => Constant::MeshRate(k),
            ConstantName::Control => Constant::Distance(Against::Control, k),
            ConstantName::Beta => Constant::Beta,
            ConstantName::Limit => Constant::Distance(Against::Limit, k),
        }
    }
}

/// `A..B`, both ends included, or one number.
#[derive(Clone, Copy, Debug)]
pub struct Range {
    pub first: u32,
    pub last: u32,
}

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |part: &str| {
            part.parse::<u32>()
                .map_err(|_| format!("{text:?} is no number or range: write 7, or 3..12"))
        };
        let (first, last) = match text.split_once("..") {
            None => (number(text)?, number(text)?),
            Some((first, last)) => (number(first)?, number(last.trim_start_matches('='))?),
        };
        if first > last {
            return Err(format!("{text:?} is empty: write the smaller number first"));
        }
        Ok(Range { first, last })
    }
}

/// A gap that the proofs' own precision allows.
fn gap(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(gap) if (1e-9..1.0).contains(&gap) => Ok(gap),
        _ => Err("a gap is a number from 1e-9 to below 1, such as 1e-6".into()),
    }
}

/// Largest valence and level: beyond, one constant takes minutes.
const LARGEST_VALENCE: u32 = 400;
const MOST_SIDES: u32 = 64;
const HIGHEST_LEVEL: u32 = 16;
const HIGHEST_RATE_LEVEL: u32 = 16;

impl Bound {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let scheme = match self.setting()? {
            Setting::Mesh(scheme) => scheme,
            Setting::Curve(degree) => return self.curve(degree),
        };
        let family = self.family(scheme)?;
        let constants = self.constants()?;
        let Some(valence) = self.valence else {
            bail!("--valence is missing: write one, such as 5, or a range, such as 3..12");
        };
        let valences: Vec<u32> = (valence.first..=valence.last).collect();
        let largest = match family {
            Family::DooSabin => MOST_SIDES,
            Family::Loop(_) | Family::CatmullClark(_) => LARGEST_VALENCE,
        };
        if valence.first < 3 || valence.last > largest {
            bail!(
                "--valence must lie in 3..{largest}: a face has at least three sides, an interior vertex three faces"
            );
        }
        let progress = Progress::new();
        let rows = tabulate(
            family,
            &valences,
            &constants,
            self.gap,
            self.certificates.is_some(),
            &|done, count| progress.units(done, count, "valences"),
        );
        progress.finish();
        if let Some(folder) = &self.certificates {
            constants::write_certificates(folder, &rows).with_context(|| {
                format!(
                    "certificates can't be written to {}: name a folder that can be written",
                    folder.display()
                )
            })?;
        }
        self.print(family, &rows, start.elapsed().as_secs_f64())?;
        let met = |row: &Row| row.proof.as_ref().is_some_and(|p| p.gap() <= self.gap);
        if rows.iter().all(met) {
            return Ok(Outcome::Done);
        }
        eprintln!(
            "subcert: undecided: some rows miss the gap asked for, but what they say holds; ask for a larger --gap"
        );
        Ok(Outcome::Undecided)
    }

    fn setting(&self) -> anyhow::Result<Setting> {
        if self.weights.is_some() && self.scheme != SchemeName::Loop {
            bail!("--weights belongs to Loop's scheme: leave it out, or use --scheme loop");
        }
        Ok(match (self.scheme, self.weights) {
            (SchemeName::Loop, Some(WeightsName::Warren)) => {
                Setting::Mesh(Scheme::Loop(LoopWeights::Warren))
            }
            (SchemeName::Loop, _) => Setting::Mesh(Scheme::Loop(LoopWeights::Original)),
            (SchemeName::CatmullClark, _) => Setting::Mesh(Scheme::CatmullClark),
            (SchemeName::DooSabin, _) => Setting::Mesh(Scheme::DooSabin),
            (SchemeName::CubicCurve, _) => Setting::Curve(Degree::Cubic),
            (SchemeName::QuadraticCurve, _) => Setting::Curve(Degree::Quadratic),
        })
    }

    /// Constants of curves: exact, by closed forms that `bound::curve` proves.
    fn curve(&self, degree: Degree) -> anyhow::Result<Outcome> {
        if self.valence.is_some() {
            bail!("--valence has no meaning for curves: leave it out");
        }
        if self.norm.is_some_and(|norm| norm != Norm::Second) {
            bail!("curves are measured by second differences: leave --norm out");
        }
        if self.certificates.is_some() {
            bail!(
                "there are no certificates for curves, whose constants are closed forms: leave --certificates out"
            );
        }
        let against = match self.constant {
            ConstantName::Control | ConstantName::Rate => Against::Control,
            ConstantName::Limit => Against::Limit,
            ConstantName::MeshRate | ConstantName::Beta => {
                bail!("for curves ask for one of rate, control, limit")
            }
        };
        let constants = self.constants()?;
        let constant = curve_constant(degree, against).context("no closed form was found")?;
        let json = || constants::curve_json(degree, &constants, &constant);
        super::print(self.json.then(json), || {
            constants::curve_text(degree, &constants, &constant)
        })?;
        Ok(Outcome::Done)
    }

    /// The scheme with its norm, if the constant is known for them.
    fn family(&self, scheme: Scheme) -> anyhow::Result<Family> {
        let norm = self.norm.unwrap_or(Family::default_norm(scheme));
        let Some(family) = Family::new(scheme, norm) else {
            let known = match scheme {
                Scheme::Loop(_) => "second",
                Scheme::CatmullClark => "second or first",
                Scheme::DooSabin => "face",
            };
            bail!(
                "--norm {norm} is not known for --scheme {}: write --norm {known}",
                scheme.name()
            );
        };
        let known: Vec<ConstantName> = ConstantName::value_variants()
            .iter()
            .filter(|constant| family.knows(constant.of_level(1)))
            .copied()
            .collect();
        if !known.contains(&self.constant) {
            let name = |constant: &ConstantName| {
                let value = constant.to_possible_value();
                value.map_or_else(String::new, |value| value.get_name().to_string())
            };
            let list: Vec<String> = known.iter().map(name).collect();
            bail!(
                "{} constants are not known for --scheme {}: ask for one of {}",
                name(&self.constant),
                scheme.name(),
                list.join(", ")
            );
        }
        Ok(family)
    }

    fn constants(&self) -> anyhow::Result<Vec<Constant>> {
        let rate = matches!(self.constant, ConstantName::Rate | ConstantName::MeshRate);
        let one = Range {
            first: u32::from(rate),
            last: u32::from(rate),
        };
        let level = self.level.unwrap_or(one);
        if rate && level.first == 0 {
            bail!("--level of a rate is at least 1: r_0 = 1 by definition");
        }
        let highest = match self.constant {
            ConstantName::Beta => 0,
            ConstantName::Rate => HIGHEST_RATE_LEVEL,
            _ => HIGHEST_LEVEL,
        };
        if level.last > highest {
            bail!(
                "--level {} is beyond {highest}: ask for a lower level",
                level.last
            );
        }
        let constant = |k: u32| self.constant.of_level(k as usize);
        Ok((level.first..=level.last).map(constant).collect())
    }

    fn print(&self, family: Family, rows: &[Row], seconds: f64) -> anyhow::Result<()> {
        let json = || constants::json(family, rows, seconds);
        super::print(self.json.then(json), || {
            constants::text(family, rows, seconds)
        })
    }
}
