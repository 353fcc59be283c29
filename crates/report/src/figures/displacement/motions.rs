//! Spectra of single motions (Figures 2.9 and 3.13).

use super::super::DISPLACEMENT;
use super::DisplacementSource;
use uplift::UpliftError;
use uplift::result::SpectrumPlace;
use uplift_plot::{Axis, Figure, Panel};

/// Motions of a set that are shown.
const SHOWN: usize = 6;

pub(super) fn motions(source: &DisplacementSource<'_>) -> Result<Vec<Figure>, UpliftError> {
    let stored = source.stored;
    let scaling = ["unscaled", "1 PGV", "1 PGA"]
        .iter()
        .find_map(|wanted| stored.scalings.iter().position(|known| known == wanted))
        .unwrap_or_default();
    let Some((uplift, uplift_m)) = source.uplift_displacements().first().copied() else { return Ok(Vec::new()) };
    let lines = source.lines(uplift);
    let mut figures = Vec::new();
    for (set, of_set) in stored.sets.iter().enumerate() {
        let motions = source.file.motions(set)?;
        let place = SpectrumPlace { set, scaling, scaled_by: 0 };
        let panels = spread(&motions.pgv_cm_s)
            .into_iter()
            .map(|motion| {
                let series = lines
                    .iter()
                    .map(|line| {
                        let ordinates_m = motions.motion_displacements_m(place, line.position, motion);
                        source.line_beyond_overturning(line, ordinates_m)
                    })
                    .collect();
                let title = format!("{}, PGV {:.0} cm/s", motions.names[motion], motions.pgv_cm_s[motion]);
                Panel::lines(title, source.abscissa(), Axis::linear(DISPLACEMENT), series)
            })
            .collect();
        let scaled = match stored.scalings[scaling].as_str() {
            "unscaled" => "as recorded".to_owned(),
            to => format!("scaled to {to} by {}", stored.scaled_by[0]),
        };
        let uplift = uplift_m.map_or_else(String::new, |uplift_m| format!(", u_{{up}} = {uplift_m} m"));
        let caption = format!(
            "Peak displacement under single motions of the set {}, {scaled}{uplift} (Fig. 2.9, 3.13), evenly spaced \
             by their recorded PGV, from the weakest to the strongest.",
            of_set.name
        );
        figures.push(source.figure(
            format!("motions-{}", source.words[set]),
            format!("Single motions, {}, {scaled}", of_set.name),
            caption,
            2,
            panels,
        ));
    }
    Ok(figures)
}

/// Positions of a few values, evenly spread by rank from the smallest to the largest.
fn spread(values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    if order.len() <= SHOWN {
        return order;
    }
    (0..SHOWN).map(|index| order[index * (order.len() - 1) / (SHOWN - 1)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn from_the_weakest_to_the_strongest() {
        assert_eq!(spread(&[3.0, 1.0, 2.0]), [1, 2, 0]);
        let many: Vec<f64> = (0..28).rev().map(f64::from).collect();
        assert_eq!(spread(&many), [27, 22, 17, 11, 6, 0]);
    }
}
