//! What a bootstrap takes, before anything is drawn.

use uplift_job::machine::{Needs, PROGRAM_BYTES};
use uplift_uniform_risk::StoredStripes;

use super::bands::BandSettings;

/// What `replicates` samples of each of so many `sizes` take.
///
/// A demand of the result has 8 bytes; a sample 12 bytes a record and some for itself, and 4 more where the draws are
/// written; a replicate 8 bytes an ordinate of the one site that a thread is at, and where whole spectra are wanted of
/// all of them, twice while they are put in order or kept. Repaired spectra are made of all demands of a measure, 12
/// bytes each in the order of their size, and of all replicates of a site, twice while they are gathered; of one with
/// weighted hazard curves by each of these, and once more while they are gathered.
pub(super) fn needs(
    stored: &StoredStripes,
    sizes: usize,
    replicates: u64,
    (settings, is_repaired): (&BandSettings, bool),
) -> Needs {
    let product = |factors: &[usize]| factors.iter().fold(1_u64, |product, &f| product.saturating_mul(f as u64));
    let samples = usize::try_from(replicates).unwrap_or(usize::MAX).saturating_mul(sizes);
    let (records, strengths) = (stored.records.len(), stored.strengths.len());
    let (sites, poes, measures) = (stored.sites.len(), stored.poes.len(), stored.measures.len());
    let levels: usize = stored.measures.iter().map(|measure| measure.levels.len()).sum();
    let demands = product(&[8, records, strengths, levels]);
    let draws = product(&[16, samples, records + 8]);
    let branches = stored.measures.iter().flat_map(|measure| &measure.branches).map(Vec::len).max().unwrap_or(0);
    let at_work = product(&[8, rayon::current_num_threads(), samples, poes, 2 + branches]);
    let kept = if settings.simultaneous { product(&[16, measures, strengths, sites, poes, samples]) } else { 0 };
    let most_levels = stored.measures.iter().map(|measure| measure.levels.len()).max().unwrap_or(0);
    let repaired = if is_repaired {
        let times = (2 * (1 + usize::from(settings.simultaneous))).max(1 + branches);
        let of_site = product(&[8, strengths, poes, samples, times]);
        product(&[12, records, strengths, most_levels]).saturating_add(of_site)
    } else {
        0
    };
    let bands = product(&[if is_repaired { 80 } else { 40 }, measures, strengths, sites, poes, sizes]);
    let sum = |terms: &[u64]| terms.iter().fold(0_u64, |sum, &term| sum.saturating_add(term));
    Needs {
        memory_bytes: sum(&[PROGRAM_BYTES, demands, draws, at_work.max(repaired), kept, bands]),
        disk_bytes: sum(&[draws / 4, bands, kept / 2]),
        disk_least_bytes: 0,
    }
}
