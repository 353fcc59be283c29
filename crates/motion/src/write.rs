//! Accelerograms written for others.

use std::fmt::Write as _;

use crate::accelerogram::Accelerogram;

/// Values in a row of an AT2 file.
const VALUES_IN_A_ROW: usize = 5;

/// `accelerogram` as the text of an AT2 file, in g with seven digits; `gravity_m_s2` \[m/s²\] is one g.
///
/// `title` is the first line of the head; `event`, `date`, `station` and `component` make the second,
/// in which commas part them.
pub fn at2_text(
    accelerogram: &Accelerogram,
    title: &str,
    [event, date, station, component]: [&str; 4],
    gravity_m_s2: f64,
) -> String {
    let one_line = |text: &str| text.replace(['\r', '\n'], " ");
    let part = |text: &str| one_line(text).replace(',', " ");
    let mut text = format!(
        "{}\n{}, {}, {}, {}\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= {:6}, DT= {:9} SEC\n",
        one_line(title),
        part(event),
        part(date),
        part(station),
        part(component),
        accelerogram.len(),
        accelerogram.dt_s(),
    );
    for row in accelerogram.acceleration_m_s2().chunks(VALUES_IN_A_ROW) {
        for value in row {
            let _ = write!(text, "{:15.6E}", value / gravity_m_s2); // a String takes everything
        }
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ReadOptions, read_at2};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(
            values in prop::collection::vec(-20.0..20.0_f64, 2..40),
            dt_s in prop::sample::select(vec![0.01, 0.005, 0.0025, 1.0 / 300.0]),
        ) {
            let motion = Accelerogram::new(dt_s, values).unwrap();
            let text = at2_text(&motion, "a title", ["Event, of 1999", "1/2/1999", "Station", "090"], 9.81);
            let options = ReadOptions { gravity_m_s2: 9.81, ..ReadOptions::default() };
            let record = read_at2(text.as_bytes(), "written", &options).unwrap();
            prop_assert_eq!(record.header.event(), "Event  of 1999, 1/2/1999, Station, 090");
            prop_assert_eq!(record.accelerogram.dt_s(), dt_s);
            for (read, written) in record.accelerogram.acceleration_m_s2().iter().zip(motion.acceleration_m_s2()) {
                prop_assert!((read - written).abs() <= 1e-6 * written.abs());
            }
        }
    }
}
