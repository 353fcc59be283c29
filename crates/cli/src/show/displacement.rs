//! What a run of a study of displacement spectra found: the medians at a few strengths or slendernesses.

use std::io::Write;

use uplift::displacement::{RunReport, printed};
use uplift::text::{metres, nearest, table};
use uplift_spectra::Noisy;
use uplift_study::Structures;

use super::ROUNDING_DECIDES;
use crate::error::CommandError;

pub(super) fn print_spectra(out: &mut impl Write, report: &RunReport) -> Result<(), CommandError> {
    let abscissa = report.structures.abscissa();
    let shown = printed(abscissa);
    // of the lines, the one that overturns last
    let (line, [name, which]) = match &report.structures {
        Structures::Oscillators(family) => (family.capacity_m.len() - 1, ["strength", "smallest u_up, largest u_cap"]),
        Structures::Blocks(family) => (family.height_m.len() - 1, ["tan(alpha)", "largest block"]),
    };
    let middle = nearest(&report.percentiles, &[50.0])[0];
    writeln!(
        out,
        "\nDisplacement spectra, {} % of each set, {which}: displacement in m{}",
        report.percentiles[middle],
        if report.head.synthetic { " (synthetic records)" } else { "" }
    )?;
    let header: Vec<String> = ["record set", "scaling", "by"]
        .map(str::to_owned)
        .into_iter()
        .chain(shown.iter().map(|&at| format!("{name} {:.3}", abscissa[at])))
        .collect();
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let row = |spectra: &uplift::displacement::SpectraReport| {
        let first = (line * report.percentiles.len() + middle) * shown.len();
        let names = [spectra.record_set.clone(), spectra.scaling.clone(), spectra.scaled_by.to_owned()];
        names.into_iter().chain(spectra.rounding[first..first + shown.len()].iter().map(ordinate)).collect()
    };
    let rows: Vec<Vec<String>> = report.spectra.iter().map(row).collect();
    writeln!(out, "{}", table(&header, &rows))?;
    if rows.iter().flatten().any(|cell| cell.contains('*')) {
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
