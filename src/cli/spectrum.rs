//! `subcert spectrum`.

use std::time::Instant;

use anyhow::bail;
use subcert::report::spectrum as report;
use subcert::scheme::LoopWeights;
use subcert::spectrum::Rules;
use subcert::spectrum::characteristic::Sign;
use subcert::spectrum::table::tabulate;

use super::bound::Range;
use super::exit::Outcome;
use super::{SchemeName, WeightsName};

/// Certifies spectra and characteristic maps.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  subcert spectrum --scheme loop --weights warren --valence 3..8\n  \
        subcert spectrum --scheme catmull-clark --valence 3..50 --json\n\n\
        The matrix is that of the two-ring of an interior vertex: 1 + 3n points (Loop), 1 + 6n\n\
        (Catmull-Clark). Each eigenvalue lies in lo..hi, proved; `exact` is the number itself, or the\n\
        quadratic polynomial that it is a root of, ck = 2 cos(2 pi k/n). Frequencies are those of its\n\
        modes on the first ring; `local` stands for modes of the second ring, one for each sector. The\n\
        characteristic map is that of frequency 1: regular if its Jacobian is positive, injective by a\n\
        winding argument."
)]
pub struct Spectrum {
    /// The subdivision scheme: loop or catmull-clark
    #[arg(long, value_enum)]
    scheme: SchemeName,
    /// Vertex weights of Loop's scheme: those of Loop 1987, or Warren's 3/(8n) [default: original]
    #[arg(long, value_enum)]
    weights: Option<WeightsName>,
    /// Valence of the vertex, or a range: 7 or 3..50 (both ends included)
    #[arg(long, value_name = "A..B")]
    valence: Range,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// Beyond, a single valence takes seconds.
const LARGEST_VALENCE: u32 = 200;

impl Spectrum {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let rules = self.rules()?;
        if self.valence.first < 3 || self.valence.last > LARGEST_VALENCE {
            bail!(
                "--valence must lie in 3..{LARGEST_VALENCE}: an interior vertex has at least three faces"
            );
        }
        let valences: Vec<u32> = (self.valence.first..=self.valence.last).collect();
        let rows = tabulate(rules, &valences);
        let seconds = start.elapsed().as_secs_f64();
        let json = || report::json(rules, &rows, seconds);
        super::print(self.json.then(json), || report::text(rules, &rows, seconds))?;
        if rows.iter().all(|row| row.map.injective == Sign::Positive) {
            return Ok(Outcome::Done);
        }
        eprintln!(
            "subcert: undecided: of some valences the characteristic map is not proved to be injective, but all that is said holds"
        );
        Ok(Outcome::Undecided)
    }

    fn rules(&self) -> anyhow::Result<Rules> {
        if self.weights.is_some() && self.scheme != SchemeName::Loop {
            bail!("--weights belongs to Loop's scheme: leave it out, or use --scheme loop");
        }
        Ok(match (self.scheme, self.weights) {
            (SchemeName::Loop, Some(WeightsName::Warren)) => Rules::Loop(LoopWeights::Warren),
            (SchemeName::Loop, _) => Rules::Loop(LoopWeights::Original),
            (SchemeName::CatmullClark, _) => Rules::CatmullClark,
            (SchemeName::DooSabin, _) => {
                bail!("spectra of doo-sabin are not known: use --scheme loop or catmull-clark")
            }
            (SchemeName::None, _) => {
                bail!("without a scheme there is no spectrum: use --scheme loop or catmull-clark")
            }
        })
    }
}
