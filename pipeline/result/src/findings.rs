//! What structures were asked under a result, and the answers, as they stand in its file.

use uplift_job::checksum::checksum;
use uplift_job::text::{rate, risk_in_words, short};
use uplift_labelled::{LabelledError, LabelledWriter};

use super::declared::group;
use super::file::ResultFile;
use super::layout::attribute::structure::STRUCTURE_SHA256;
use super::layout::attribute::{Attribute, answer, signature};
use super::layout::axis::{self, FINDING};
use super::layout::structures;
use crate::error::ResultError;

/// Letters of the key of a question: no two questions asked of a result share them.
const LETTERS: usize = 12;

/// What a structure is asked, each by a command of this name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Inquiry {
    /// Its demand, and whether it meets it.
    Design,
    /// How often it overturns.
    Overturning,
    /// What it must be for a target risk.
    Target,
    /// The risk of the frame itself.
    Risk,
}

impl Inquiry {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Design, Self::Overturning, Self::Target, Self::Risk];

    /// The command.
    pub fn key(self) -> &'static str {
        match self {
            Self::Design => "design",
            Self::Overturning => "overturning",
            Self::Target => "target",
            Self::Risk => "risk",
        }
    }
}

/// The answer to a question about a structure, in the one form that every command's has.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Name of the structure.
    pub structure: String,
    /// Its file, as it was given.
    pub structure_file: String,
    /// What stood in it.
    pub structure_toml: String,
    /// What was asked.
    pub inquiry: Inquiry,
    /// What it was asked for, name and value: the site, the risk and all else that the answer depends on, but for the
    /// structure and the result.
    pub request: Vec<(String, String)>,
    /// By what the numbers of the result are known that it was asked under.
    pub study_digest: String,
    /// The answer in numbers.
    pub rows: Vec<FindingRow>,
    /// Everything, as `--json` prints it, in one line.
    pub document: String,
}

/// A number of an answer.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct FindingRow {
    /// What it is: `demand on the structure`.
    pub quantity: String,
    /// The site; empty where it is of none.
    pub site: String,
    /// `PGV` or another measure; empty where it is of none.
    pub im: String,
    /// The number, in [`unit`](Self::unit); infinite where a structure overturns.
    pub value: f64,
    /// Limits of its band; NaN where there is none. Of what no run shows the upper one alone: what it is at most.
    pub limits: [f64; 2],
    /// `m`, `1/yr`, …; `1` where there is none.
    pub unit: String,
    /// What the band is of: `records`, `earthquakes`, …; empty where there is none.
    pub band: String,
}

group! {
    /// The numbers of an answer.
    pub const FINDINGS: Vec<FindingRow> = "/structures/<structure>/<command>/<key>";
    "quantity" [FINDING] Text "" "what the number is" = |of, at| of[at].quantity;
    "site" [FINDING] Text "" "site; may be empty" = |of, at| of[at].site;
    "im" [FINDING] Text "" "intensity measure; may be empty" = |of, at| of[at].im;
    "unit" [FINDING] Text "" "unit of value, lower and upper"
        ("unit of value, lower and upper: `m`, `1/yr`, … (`1` where there is none)") = |of, at| of[at].unit;
    "band" [FINDING] Text "" "source of the band"
        ("source of the band: `records`, `earthquakes`, `records and hazard`, `resampled records`, `structure, \
          records and hazard`, `at most`, …") = |of, at| of[at].band;
    "value" [FINDING] F64 "1" "the number, in its unit"
        ("the number, in its unit; `inf` where the structure overturns") = |of, at| of[at].value;
    "lower" [FINDING] F64 "1" "lower limit of its band"
        ("lower limit of its band, in its unit; NaN where there is none") = |of, at| of[at].limits[0];
    "upper" [FINDING] F64 "1" "upper limit of its band; alone where no run shows what it bounds"
        ("upper limit of its band; alone where no run shows what it bounds: what it is at most")
        = |of, at| of[at].limits[1];
}

/// An answer as a result keeps it.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredFinding {
    /// The answer.
    pub finding: Finding,
    /// When it was found, `2026-01-31T12:00:00Z`.
    pub created: String,
    /// Version of the program.
    pub version: String,
    /// Commit of the program, or `unknown`.
    pub commit: String,
    /// Whether the structure file was another when the structure was last asked something.
    pub is_of_earlier_file: bool,
}

impl Finding {
    /// By what the question is known: structure, command and request, and not the answer.
    pub fn key(&self) -> String {
        let mut key = checksum(format!("{}\n{}\n{:?}", self.structure, self.inquiry.key(), self.request).as_bytes());
        key.truncate(LETTERS);
        key
    }

    /// SHA-256 of the structure file.
    pub fn structure_sha256(&self) -> String {
        checksum(self.structure_toml.as_bytes())
    }

    /// Everything, as `--json` prints it.
    pub fn printed(&self) -> serde_json::Value {
        serde_json::from_str(&self.document).unwrap_or_default()
    }

    /// What to know before using it, the worst first, as it was reported.
    pub fn alarms(&self) -> Vec<serde_json::Value> {
        self.printed()["alarms"].as_array().cloned().unwrap_or_default()
    }

    /// Writes its numbers with their axis.
    ///
    /// # Errors
    /// Whatever keeps the file from being written.
    pub fn write_rows(&self, writer: &mut LabelledWriter) -> Result<(), LabelledError> {
        let (key, count) = (self.key(), self.rows.len());
        let (axis, numbers) = (axis::finding(&key), (1..).take(count).collect::<Vec<u32>>());
        let names = [("<command>", self.inquiry.key()), ("<key>", &key), ("<structure>", &self.structure)];
        FINDING.write(writer, &names, &numbers)?;
        FINDINGS.write(writer, &names, &[(&axis, count)], &self.rows)
    }

    /// The group that it stands in.
    pub fn group(&self) -> String {
        structures::answer(&self.structure, self.inquiry.key(), &self.key())
    }

    /// The command and what it was asked for: `design, site Athens, measure PGV, 475 years (9.991 % in 50 years)`.
    pub fn question(&self) -> String {
        let number = |wanted: &str| {
            let of = self.request.iter().find(|(name, _)| name == wanted);
            of.and_then(|(_, value)| value.parse::<f64>().ok())
        };
        // a return period is kept as the probability that it is in so many years: it is reported as it was asked for
        let risk = number("poe").zip(number("years")).map(|(poe, years)| risk_in_words(poe, years));
        let told = |(name, value): &(String, String)| match (name.as_str(), &risk) {
            ("poe", Some(risk)) => format!(", {risk}"),
            ("years", Some(_)) => String::new(),
            ("per year", _) => format!(", {name} {}", value.parse().map_or(value.clone(), short)),
            _ => format!(", {name} {value}"),
        };
        std::iter::once(self.inquiry.key().to_owned()).chain(self.request.iter().map(told)).collect()
    }
}

impl FindingRow {
    /// A number without site, measure and band.
    pub fn new(quantity: impl Into<String>, value: f64, unit: &str) -> Self {
        Self {
            quantity: quantity.into(),
            site: String::new(),
            im: String::new(),
            value,
            limits: [f64::NAN; 2],
            unit: if unit.is_empty() { "1" } else { unit }.to_owned(),
            band: String::new(),
        }
    }

    /// The same of a site and measure.
    #[must_use]
    pub fn at(self, site: &str, im: &str) -> Self {
        Self { site: site.to_owned(), im: im.to_owned(), ..self }
    }

    /// The same with a band.
    #[must_use]
    pub fn within(self, limits: [f64; 2], band: &str) -> Self {
        Self { limits, band: band.to_owned(), ..self }
    }

    /// The number as the command prints it, without its unit.
    pub fn shown(&self) -> String {
        match self.limits {
            // a count of none is no proof of never
            [lower, upper] if self.value == 0.0 && lower.is_nan() && !upper.is_nan() => format!("< {}", rate(upper)),
            _ => self.digits(self.value),
        }
    }

    /// The band as the command prints it; nothing where there is none.
    pub fn band_shown(&self) -> String {
        match self.limits {
            [lower, upper] if !lower.is_nan() && !upper.is_nan() => {
                format!("{} to {}", self.digits(lower), self.digits(upper))
            }
            _ => String::new(),
        }
    }

    fn digits(&self, value: f64) -> String {
        match self.unit.as_str() {
            _ if value.is_nan() => "-".to_owned(),
            "m" if value.is_infinite() => "overturns".to_owned(),
            _ if value.is_infinite() => "infinite".to_owned(),
            "m" => format!("{value:.4}"),
            "1/yr" if value == 0.0 => "none".to_owned(),
            "1/yr" => rate(value),
            _ => short(value),
        }
    }
}

impl ResultFile {
    /// What structures were asked under this result, by structure, then command, in the order of the questions; none
    /// before `uplift design` and the like.
    ///
    /// # Errors
    /// A file that is damaged.
    pub fn findings(&self) -> Result<Vec<StoredFinding>, ResultError> {
        let reader = &self.reader;
        if !reader.exists(structures::ROOT) {
            return Ok(Vec::new());
        }
        let mut found = Vec::new();
        for structure in reader.children(structures::ROOT)? {
            let last = STRUCTURE_SHA256.read(reader, &[("<structure>", &structure)])?;
            for inquiry in Inquiry::ALL {
                let group = format!("{}/{}", structures::group(&structure), inquiry.key());
                if !reader.exists(&group) {
                    continue;
                }
                for key in reader.children(&group)? {
                    let mut stored = self.finding((&structure, inquiry), &key)?;
                    stored.is_of_earlier_file = stored.finding.structure_sha256() != last;
                    found.push(stored);
                }
            }
        }
        found.sort_by(|a, b| order(&a.finding).cmp(&order(&b.finding)));
        Ok(found)
    }

    fn finding(&self, (structure, inquiry): (&str, Inquiry), key: &str) -> Result<StoredFinding, ResultError> {
        let group = structures::answer(structure, inquiry.key(), key);
        let names = [("<command>", inquiry.key()), ("<key>", key), ("<structure>", structure), ("<group>", &group)];
        let text = |attribute: &Attribute<String>| attribute.read(&self.reader, &names);
        let request: serde_json::Map<String, serde_json::Value> = serde_json::from_str(&text(&answer::REQUEST)?)
            .map_err(|error| self.damaged(format!("attribute {} of {group}: {error}", answer::REQUEST.name)))?;
        let axis = axis::finding(key);
        let mut rows = vec![FindingRow::default(); self.reader.axis::<u32>(&axis)?.len()];
        FINDINGS.read(self, &names, &[(&axis, rows.len())], &mut rows)?;
        let value = |of: serde_json::Value| of.as_str().map_or_else(|| of.to_string(), str::to_owned);
        Ok(StoredFinding {
            finding: Finding {
                structure: structure.to_owned(),
                structure_file: text(&answer::STRUCTURE_FILE)?,
                structure_toml: text(&answer::STRUCTURE_TOML)?,
                inquiry,
                request: request.into_iter().map(|(name, of)| (name, value(of))).collect(),
                study_digest: text(&answer::STUDY_DIGEST)?,
                rows,
                document: text(&answer::DOCUMENT)?,
            },
            created: text(&signature::CREATED)?,
            version: text(&signature::VERSION)?,
            commit: text(&signature::COMMIT)?,
            is_of_earlier_file: false,
        })
    }
}

/// By structure, then command, then question, sites and risks as people read them.
fn order(finding: &Finding) -> (&str, Inquiry, String) {
    (&finding.structure, finding.inquiry, finding.question())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(site: &str, value: f64) -> Finding {
        Finding {
            structure: "pier".to_owned(),
            structure_file: "pier.toml".to_owned(),
            structure_toml: "kind = \"block\"\n".to_owned(),
            inquiry: Inquiry::Design,
            request: vec![("site".to_owned(), site.to_owned())],
            study_digest: "0".to_owned(),
            rows: vec![FindingRow::new("demand", value, "m")],
            document: format!("{{\"demand_m\":{value}}}"),
        }
    }

    #[test]
    fn a_question_is_known_by_what_was_asked_alone() {
        let key = finding("Here", 0.1).key();
        assert_eq!(key.len(), LETTERS);
        let changed = Finding { structure_toml: "kind = \"frame\"\n".to_owned(), ..finding("Here", 0.2) };
        assert_eq!(changed.key(), key);
        assert_ne!(changed.structure_sha256(), finding("Here", 0.1).structure_sha256());
        let others = [
            finding("There", 0.1),
            Finding { structure: "block".to_owned(), ..finding("Here", 0.1) },
            Finding { inquiry: Inquiry::Risk, ..finding("Here", 0.1) },
        ];
        assert!(others.iter().all(|other| other.key() != key));
        assert_eq!(finding("Here", 0.1).group(), format!("/structures/pier/design/{key}"));
        assert_eq!(finding("Here", 0.1).question(), "design, site Here");
    }

    #[test]
    fn numbers_are_shown_as_they_are_printed() {
        let shown = |value: f64, unit: &str, limits: [f64; 2]| {
            let row = FindingRow::new("", value, unit).within(limits, "records");
            [row.shown(), row.band_shown()]
        };
        let none = [f64::NAN; 2];
        assert_eq!(shown(0.123_456, "m", [0.1, f64::INFINITY]), ["0.1235", "0.1000 to overturns"]);
        assert_eq!(shown(f64::INFINITY, "m", none), ["overturns", ""]);
        assert_eq!(shown(1.234_56e-4, "1/yr", [1e-5, 2e-4]), ["1.2e-4", "1.0e-5 to 2.0e-4"]);
        assert_eq!(shown(0.0, "1/yr", [f64::NAN, 3e-6]), ["< 3.0e-6", ""]);
        assert_eq!(shown(0.0, "1/yr", none), ["none", ""]);
        assert_eq!(shown(f64::INFINITY, "", none), ["infinite", ""]);
        assert_eq!(shown(12.345_67, "N/m", none), ["12.346", ""]);
    }
}
