//! The array of engineering demand parameters.

/// Peak displacements and impact counts over `[record, strength, level]`, row-major.
#[derive(Debug, Clone, PartialEq)]
pub struct EdpArray {
    pub(crate) shape: [usize; 3],
    pub(crate) edp_m: Vec<f64>,
    pub(crate) impacts: Vec<u32>,
}

impl EdpArray {
    /// Lengths of the axes: records, strengths, levels.
    pub fn shape(&self) -> [usize; 3] {
        self.shape
    }

    /// Peak displacements, m, row-major; `+∞` where the system overturned.
    pub fn edp_m(&self) -> &[f64] {
        &self.edp_m
    }

    /// Impacts of each run, row-major.
    pub fn impacts(&self) -> &[u32] {
        &self.impacts
    }

    /// The peaks of one strength over `[record, level]`, row-major, m.
    ///
    /// # Panics
    /// If the strength is out of range, which is a bug of the caller.
    pub fn of_strength(&self, strength: usize) -> Vec<f64> {
        let [records, strengths, levels] = self.shape;
        assert!(strength < strengths, "strength {strength} of {strengths}");
        (0..records)
            .flat_map(|record| {
                let start = (record * strengths + strength) * levels;
                self.edp_m[start..start + levels].iter().copied()
            })
            .collect()
    }
}
