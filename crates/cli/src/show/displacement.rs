//! What a run of a study of displacement spectra found: the medians at a few strengths or slendernesses.

use std::io::Write;

use uplift::displacement::{RunReport, printed};
use uplift::text::{Table, metres, nearest};
use uplift_spectra::Noisy;
use uplift_study::Structures;

use super::ROUNDING_DECIDES;
use crate::error::CommandError;

/// The percentile of the median.
const MEDIAN: f64 = 50.0;

pub(super) fn print_spectra(out: &mut impl Write, report: &RunReport) -> Result<(), CommandError> {
    let abscissa = report.structures.abscissa();
    let shown = printed(abscissa);
    // of the lines, the one that overturns last
    let (line, [name, which]) = match &report.structures {
        Structures::Oscillators(family) => (family.capacity_m.len() - 1, ["strength", "smallest u_up, largest u_cap"]),
        Structures::Blocks(family) => (family.height_m.len() - 1, ["tan(alpha)", "largest block"]),
    };
    let middle = nearest(&report.percentiles, &[MEDIAN])[0];
    let fractile = match report.percentiles[middle] {
        MEDIAN => "median".to_owned(),
        percentile => format!("{percentile} % fractile"),
    };
    writeln!(
        out,
        "\nDisplacement spectra, {fractile} of the motions of each set, {which}: displacement in m{}",
        if report.head.synthetic { " (synthetic records)" } else { "" }
    )?;
    let table = Table::from_rows(&report.spectra)
        .left("record set", |spectra| &spectra.record_set)
        .right("scaling", |spectra| &spectra.scaling)
        .right("by", |spectra| spectra.scaled_by)
        .each(shown.iter().enumerate(), |table, (place, &at)| {
            let first = (line * report.percentiles.len() + middle) * shown.len();
            table.right(format!("{name} {:.3}", abscissa[at]), |spectra| ordinate(&spectra.rounding[first + place]))
        })
        .to_string();
    writeln!(out, "{table}")?;
    if table.contains('*') {
        writeln!(out, "{ROUNDING_DECIDES};\n   in brackets the lowest and highest of these")?;
    }
    Ok(())
}

fn shown_m(ordinate_m: f64) -> String {
    if ordinate_m.is_infinite() { "overturns".to_owned() } else { metres(ordinate_m) }
}

/// An ordinate; with its range where rounding decides it.
fn ordinate(ordinate: &Noisy) -> String {
    let [value, lowest, highest] = [ordinate.value, ordinate.lowest, ordinate.highest].map(shown_m);
    if ordinate.shows_otherwise(shown_m) { format!("{value}* [{lowest}, {highest}]") } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_ordinate_that_rounding_decides_is_marked() {
        let of = |lowest, highest| ordinate(&Noisy { value: 0.0465, lowest, highest });
        assert_eq!(of(0.0465 - 1e-9, 0.0465), "0.0465");
        assert_eq!(of(0.0101, 0.0757), "0.0465* [0.0101, 0.0757]");
        assert_eq!(of(0.0465, f64::INFINITY), "0.0465* [0.0465, overturns]");
    }
}
