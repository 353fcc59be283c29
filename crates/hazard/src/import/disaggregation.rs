//! What shakes a site: the disaggregation of its hazard over magnitude and distance, as the engine exports it.

use crate::declaration::same_measure;
use crate::error::{HazardError, Place};
use crate::probability::rate_of;
use crate::text::{excerpt, fields, number};

use super::openquake::value;

/// The earthquakes by which a level of a measure is exceeded at a site, on the average.
#[derive(Debug, Clone, PartialEq)]
pub struct Disaggregation {
    /// The intensity measure as the engine names it, e.g. "PGA", "SA(1.0)".
    pub measure: String,
    /// Probability of exceeding the level.
    pub poe: f64,
    /// Years that it refers to.
    pub years: f64,
    /// Mean moment magnitude, each bin weighed by its rate.
    pub mean_magnitude: f64,
    /// Mean distance, km, each bin weighed by its rate.
    pub mean_distance_km: f64,
}

impl Disaggregation {
    /// The rate at which the level is exceeded, 1/yr: −ln(1 − p)/T (Eq. 4.8).
    pub fn rate_per_year(&self) -> f64 {
        rate_of(self.poe, self.years)
    }

    /// Whether it is of `measure`, however that is spelt.
    pub fn is_of(&self, measure: &str) -> bool {
        same_measure(&self.measure, measure)
    }
}

/// The sums of one measure and probability.
struct Sums {
    measure: String,
    poe: f64,
    rate: f64,
    magnitude: f64,
    distance_km: f64,
}

/// Reads the table over magnitude and distance of an `OpenQuake` disaggregation, `Mag_Dist-…csv` of version 3.15 and
/// later: columns `imt`, `poe`, `mag`, `dist`, and the probability of each bin as `mean`, or by realization, of which
/// the weighted mean is taken.
///
/// - `text`: the file, its first line the comment of the engine.
/// - `name`: what messages call it.
///
/// One entry each measure and probability, in the order of the file.
///
/// # Errors
/// [`HazardError::File`] for another table, or one without investigation time; [`HazardError::Row`] with the line of a
/// field that is no number.
pub fn read_disaggregation(text: &str, name: &str) -> Result<Vec<Disaggregation>, HazardError> {
    let file = |reason: &str| HazardError::File { file: name.to_owned(), reason: reason.to_owned() };
    let comment = text.lines().next().filter(|line| line.trim_start_matches(['"', '\u{feff}']).starts_with('#'));
    let comment = comment.ok_or_else(|| file("the first line is not the comment that the engine writes"))?;
    let years = value(comment, "investigation_time").and_then(|years| years.parse::<f64>().ok());
    let years = years.filter(|years| years.is_finite() && *years > 0.0);
    let years = years.ok_or_else(|| file("the first line does not say investigation_time"))?;
    let mut lines = text.lines().enumerate().skip(1).filter(|(_, line)| !line.trim().is_empty());
    let header: Vec<&str> = lines.next().map_or_else(Vec::new, |(_, line)| fields(line, ',').collect());
    let column = |wanted: &str| header.iter().position(|name| *name == wanted);
    let (Some(imt), Some(poe), Some(mag), Some(dist)) = (column("imt"), column("poe"), column("mag"), column("dist"))
    else {
        return Err(file(
            "no columns imt, poe, mag, dist: give the table Mag_Dist of a disaggregation by an engine of version 3.15 \
             or later",
        ));
    };
    let shares = shares(&header, comment).ok_or_else(|| {
        file("several realizations without weights: export the mean, or keep the line that the engine writes first")
    })?;
    let mut all: Vec<Sums> = Vec::new();
    for (index, line) in lines {
        let place = || Place::Line { file: name.to_owned(), line: index + 1 };
        let row: Vec<&str> = fields(line, ',').collect();
        if row.len() != header.len() {
            let reason = format!("{} columns where the column names are {}", row.len(), header.len());
            return Err(HazardError::Row { place: place(), reason });
        }
        let probability = |column: usize| -> Result<f64, HazardError> {
            let value = number(row[column], place)?;
            if (0.0..1.0).contains(&value) {
                return Ok(value);
            }
            let reason = format!("{} is not a probability below 1", excerpt(row[column]));
            Err(HazardError::Row { place: place(), reason })
        };
        let (level, magnitude, distance_km) = (probability(poe)?, number(row[mag], place)?, number(row[dist], place)?);
        let mut rate = 0.0;
        for (column, weight) in &shares {
            rate += weight * rate_of(probability(*column)?, years);
        }
        let known = all.iter().rposition(|sums| sums.measure == row[imt] && sums.poe == level);
        let at = known.unwrap_or_else(|| {
            all.push(Sums { measure: row[imt].to_owned(), poe: level, rate: 0.0, magnitude: 0.0, distance_km: 0.0 });
            all.len() - 1
        });
        let sums = &mut all[at];
        sums.rate += rate;
        sums.magnitude += rate * magnitude;
        sums.distance_km += rate * distance_km;
    }
    if all.iter().all(|sums| sums.rate == 0.0) {
        return Err(file("no bin has a probability above 0"));
    }
    let mean = |sums: Sums| Disaggregation {
        measure: sums.measure,
        poe: sums.poe,
        years,
        mean_magnitude: sums.magnitude / sums.rate,
        mean_distance_km: sums.distance_km / sums.rate,
    };
    Ok(all.into_iter().filter(|sums| sums.rate > 0.0).map(mean).collect())
}

/// The columns of probabilities with their weights; none where these are not known.
fn shares(header: &[&str], comment: &str) -> Option<Vec<(usize, f64)>> {
    if let Some(mean) = header.iter().position(|name| *name == "mean") {
        return Some(vec![(mean, 1.0)]);
    }
    let realizations: Vec<usize> = (0..header.len()).filter(|&column| header[column].starts_with("rlz")).collect();
    match realizations[..] {
        [] => None,
        [only] => Some(vec![(only, 1.0)]),
        _ => {
            let list = comment.split_once("weights=[")?.1.split_once(']')?.0;
            let weights: Vec<f64> = list.split(',').map(|weight| weight.trim().parse().ok()).collect::<Option<_>>()?;
            let total: f64 = weights.iter().sum();
            let sound = weights.len() == realizations.len() && (total - 1.0).abs() < 1e-3;
            sound.then(|| realizations.into_iter().zip(weights).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const COMMENT: &str = "#,,,,\"generated_by='OpenQuake engine 3.16.0', investigation_time=50.0, \
                           mag_bin_edges=[5.0, 6.0, 7.0], rlz_ids=[0, 3], weights=[0.25, 0.75], lon=0.0, lat=0.0\"";

    // Two bins of one level: rates in the ratio of 1 to 3.
    #[test]
    fn means_are_weighed_by_rates() {
        let p = |rate: f64| -(-50.0 * rate).exp_m1();
        let text = format!(
            "{COMMENT}\nimt,iml,poe,mag,dist,mean\nPGA,0.2,0.1,5.5,10,{}\nPGA,0.2,0.1,6.5,50,{}\nSA(1.0),0.1,0.1,6.5,20,{}\n",
            p(1e-4),
            p(3e-4),
            p(1e-3)
        );
        let found = read_disaggregation(&text, "Mag_Dist-mean-0.csv").unwrap();
        assert_eq!(found.len(), 2);
        assert!((found[0].mean_magnitude - 6.25).abs() < 1e-12 && (found[0].mean_distance_km - 40.0).abs() < 1e-12);
        assert!(found[0].is_of("pga") && found[1].is_of("SA(1)"));
        assert_eq!((found[1].mean_magnitude, found[1].mean_distance_km, found[1].years), (6.5, 20.0, 50.0));
        assert!((found[0].rate_per_year() - 0.002_107_21).abs() < 1e-8);
    }

    #[test]
    fn realizations_are_weighed() {
        let text = format!("{COMMENT}\nimt,poe,mag,dist,rlz0,rlz3\nPGA,0.1,5.5,10,1e-9,0\nPGA,0.1,6.5,50,0,1e-9\n");
        let found = read_disaggregation(&text, "a").unwrap();
        assert!((found[0].mean_magnitude - 6.25).abs() < 1e-9 && (found[0].mean_distance_km - 40.0).abs() < 1e-9);
    }

    #[test]
    fn what_is_no_such_table() {
        let error = |text: &str| read_disaggregation(text, "a.csv").unwrap_err().to_string();
        assert!(error("mag,dist,poe\n5,10,0.1\n").contains("a.csv: the first line"));
        assert!(error("#,,\"x\"\nimt,poe,mag,dist,rlz0\n").contains("investigation_time"));
        assert!(error(&format!("{COMMENT}\nmag,dist,poe\n5.5,10,0.1\n")).contains("3.15"));
        let rows = |rows: &str| error(&format!("{COMMENT}\nimt,poe,mag,dist,mean\n{rows}"));
        assert!(rows("PGA,0.1,5.5,10,0\n").contains("no bin"));
        assert!(rows("PGA,0.1,5.5,10,1.5\n").contains("line 3"));
        assert!(rows("PGA,0.1,5.5,10\n").contains("4 columns"));
        assert!(rows("PGA,0.1,x,10,0.1\n").contains("line 3"));
        let unweighed = COMMENT.replace("weights=", "other=");
        assert!(error(&format!("{unweighed}\nimt,poe,mag,dist,rlz0,rlz3\nPGA,0.1,5,1,0,0\n")).contains("weights"));
    }

    proptest! {
        #[test]
        fn any_text_gives_an_answer(text in ".{0,300}") {
            let _ = read_disaggregation(&text, "a");
            let _ = read_disaggregation(&format!("{COMMENT}\n{text}"), "a");
            let _ = read_disaggregation(&format!("{COMMENT}\nimt,poe,mag,dist,mean\n{text}"), "a");
        }
    }
}
