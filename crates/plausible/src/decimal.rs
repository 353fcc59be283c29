//! Decimal commas, which spreadsheets of many countries write where semicolons separate the columns.

use std::fmt;

/// What the numbers of a table are written with, found by looking at all of them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DecimalMarks<P> {
    comma: Option<(P, String)>,
    point: Option<(P, String)>,
    /// The first comma that could part thousands; looked at only while no other comma tells.
    doubtful: Option<(P, String)>,
    is_certain: bool,
}

/// A table whose numbers can be read in two ways.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct AmbiguousMarks(String);

impl fmt::Display for AmbiguousMarks {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

impl std::error::Error for AmbiguousMarks {}

impl<P> Default for DecimalMarks<P> {
    fn default() -> Self {
        Self { comma: None, point: None, doubtful: None, is_certain: false }
    }
}

impl<P: fmt::Display> DecimalMarks<P> {
    /// Looks at a `cell` of the table at `place`; what is no number in either way is passed over.
    pub fn see(&mut self, place: impl FnOnce() -> P, cell: &str) {
        let first = match cell.matches(',').count() {
            0 if cell.contains('.') && cell.parse::<f64>().is_ok() => &mut self.point,
            1 if with_point(cell).is_some() => {
                if may_be_thousands(cell) {
                    &mut self.doubtful
                } else {
                    self.is_certain = true;
                    &mut self.comma
                }
            }
            _ => return,
        };
        if first.is_none() {
            *first = Some((place(), cell.to_owned()));
        }
    }

    /// Whether the table is written with decimal commas.
    ///
    /// # Errors
    /// [`AmbiguousMarks`] where commas stand beside points, or where every comma could part thousands; with the places.
    pub fn are_commas(self) -> Result<bool, AmbiguousMarks> {
        let comma = self.comma.or(self.doubtful);
        match (comma, self.point) {
            (Some((at, comma)), Some((other, point))) => Err(AmbiguousMarks(format!(
                "{at}: {comma} has a decimal comma, and {point} ({other}) a decimal point: write one of them throughout"
            ))),
            (Some((at, comma)), None) if !self.is_certain => {
                let [point, whole] = [".", ""].map(|mark| comma.replace(',', mark));
                Err(AmbiguousMarks(format!(
                    "{at}: {comma} may be {point} or {whole}: write decimal points, and nothing between thousands"
                )))
            }
            (comma, _) => Ok(comma.is_some()),
        }
    }
}

/// A number written with a decimal comma as one with a point; none for what is no such number.
pub fn with_point(cell: &str) -> Option<String> {
    if cell.matches(',').count() != 1 || cell.contains('.') {
        return None;
    }
    Some(cell.replace(',', ".")).filter(|text| text.parse::<f64>().is_ok())
}

/// Whether the commas of a number could part thousands: 1,500 and 1,000,000.5 may, 0,500 and 1,5 may not.
pub fn may_be_thousands(cell: &str) -> bool {
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = cell.trim_start_matches(['-', '+']);
    let whole = unsigned.split_once('.').map_or(unsigned, |(whole, _)| whole);
    let Some((first, groups)) = whole.split_once(',') else { return false };
    (1..=3).contains(&first.len())
        && are_digits(first)
        && !first.starts_with('0')
        && groups.split(',').all(|group| group.len() == 3 && are_digits(group))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marks(cells: &[&str]) -> Result<bool, String> {
        let mut marks = DecimalMarks::default();
        cells.iter().enumerate().for_each(|(index, cell)| marks.see(|| format!("line {}", index + 1), cell));
        marks.are_commas().map_err(|error| error.to_string())
    }

    #[test]
    fn commas_and_points() {
        assert_eq!(marks(&["iml", "0,12", "3", "1,5E-03", ""]), Ok(true));
        assert_eq!(marks(&["iml", "0.12", "3", "a,b", "1,2,3"]), Ok(false));
        // one that cannot part thousands decides for those that could
        assert_eq!(marks(&["1,500", "0,100"]), Ok(true));
        let mixed = marks(&["0,12", "3.4"]).unwrap_err();
        assert!(mixed.contains("line 1: 0,12 has a decimal comma, and 3.4 (line 2) a decimal point"), "{mixed}");
        let doubtful = marks(&["x", "1,500", "2,500"]).unwrap_err();
        assert!(doubtful.contains("line 2: 1,500 may be 1.500 or 1500"), "{doubtful}");
        for (cell, may) in
            [("1,500", true), ("-1,000,000.5", true), ("0,500", false), ("1,5", false), ("1,000,5", false)]
        {
            assert_eq!(may_be_thousands(cell), may, "{cell}");
        }
        assert_eq!(with_point("-1,5e3").as_deref(), Some("-1.5e3"));
        assert_eq!((with_point("1,2,3"), with_point("1.000,5"), with_point("a,b")), (None, None, None));
    }
}
