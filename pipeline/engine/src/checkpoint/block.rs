//! A finished row as it is written, little-endian: the key (16 bytes), the number of scale factors (u32), the peak
//! displacements in m (f64 each), the impacts (u32 each), and a CRC-32 of all that.

use std::io::Read;

use super::key::RowKey;

/// Most scale factors of a row; more is not a row.
const MOST_SCALES: u32 = 100_000;

/// A finished row: displacements (m) and impacts over the scale factors.
pub(super) type Row = (Vec<f64>, Vec<u32>);

pub(super) fn write_block(key: RowKey, displacement_m: &[f64], impacts: &[u32]) -> Vec<u8> {
    let mut block = Vec::with_capacity(24 + 12 * displacement_m.len());
    block.extend(key.0);
    block.extend(u32::try_from(displacement_m.len()).unwrap_or(u32::MAX).to_le_bytes());
    block.extend(displacement_m.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(impacts.iter().flat_map(|value| value.to_le_bytes()));
    block.extend(crc32fast::hash(&block).to_le_bytes());
    block
}

/// A block with its size in bytes, without a row if it is damaged; none at the end, and where a block was cut off.
pub(super) fn read_block(reader: &mut impl Read) -> Option<(Option<(RowKey, Row)>, u64)> {
    let mut head = [0; 20];
    reader.read_exact(&mut head).ok()?;
    let (key, count) = head.split_at(16);
    let count = u32::from_le_bytes(count.try_into().ok()?);
    if count > MOST_SCALES {
        return None;
    }
    let count = count as usize;
    let mut rest = vec![0; 12 * count + 4];
    reader.read_exact(&mut rest).ok()?;
    let size = (24 + 12 * count) as u64;
    let (content, sum) = rest.split_at(12 * count);
    let mut hasher = crc32fast::Hasher::new();
    hasher.update(&head);
    hasher.update(content);
    if hasher.finalize().to_le_bytes() != *sum {
        return Some((None, size));
    }
    let (displacement_m, impacts) = content.split_at(8 * count);
    let displacement_m =
        displacement_m.chunks_exact(8).map(|bytes| f64::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    let impacts =
        impacts.chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().unwrap_or_default())).collect();
    Some((Some((RowKey(key.try_into().ok()?), (displacement_m, impacts))), size))
}
