//! p of several tests at once.

/// Each p adjusted so that, at any level, the chance of one false rejection or more is at most that level: the i-th
/// smallest of k times `k − i + 1`, and no smaller than those before, in the order given.
///
/// # Source
/// S. Holm (1979), "A simple sequentially rejective multiple test procedure".
pub fn holm_adjusted(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|one, other| p[*one].total_cmp(&p[*other]));
    let mut adjusted = vec![0.0; p.len()];
    let mut largest = 0.0_f64;
    for (rank, &index) in order.iter().enumerate() {
        largest = largest.max((p.len() - rank) as f64 * p[index]).min(1.0);
        adjusted[index] = largest;
    }
    adjusted
}
