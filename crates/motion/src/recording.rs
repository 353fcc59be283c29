//! A component as a record file holds it: the motion, and what the file says about it.

use std::fmt;
use std::str::FromStr;

use crate::accelerogram::Accelerogram;
use crate::error::MotionError;
use crate::read::excerpt;
use crate::unit::AccelerationUnit;

/// Layout of a record file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum RecordFormat {
    /// AT2 of the PEER strong motion databases.
    At2,
    /// ASCII files of the Engineering Strong Motion database (DYNA 1.2).
    Esm,
    /// ASCII files of K-NET and KiK-net.
    Knet,
    /// COSMOS strong motion data format, version 1.
    Cosmos,
    /// Volume 1 and 2 files of CSMIP (formerly CDMG), several components in a file.
    Csmip,
    /// One column (acceleration) or two (time, acceleration).
    Columns,
}

impl RecordFormat {
    /// Every layout.
    pub const ALL: [Self; 6] = [Self::At2, Self::Esm, Self::Knet, Self::Cosmos, Self::Csmip, Self::Columns];

    /// The words that [`FromStr`] accepts, for messages.
    pub const ACCEPTED: &'static str = "at2, esm, knet, cosmos, csmip, columns";

    /// Name in files and keys, e.g. "at2".
    pub fn key(self) -> &'static str {
        match self {
            Self::At2 => "at2",
            Self::Esm => "esm",
            Self::Knet => "knet",
            Self::Cosmos => "cosmos",
            Self::Csmip => "csmip",
            Self::Columns => "columns",
        }
    }
}

impl fmt::Display for RecordFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

/// Accepts the key of a layout, in any case.
impl FromStr for RecordFormat {
    type Err = MotionError;

    fn from_str(word: &str) -> Result<Self, MotionError> {
        let key = word.trim().to_lowercase();
        Self::ALL.into_iter().find(|format| format.key() == key).ok_or_else(|| MotionError::UnknownWord {
            what: "record format",
            given: word.to_owned(),
            accepted: Self::ACCEPTED,
        })
    }
}

/// Direction in which a sensor measures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Orientation {
    /// Horizontal: degrees clockwise from north.
    Azimuth(f64),
    /// Horizontal, but relative to something unknown (a structure, a survey mark); the number tells the
    /// components of one sensor apart.
    Horizontal(u8),
    /// Up or down.
    Vertical,
}

impl Orientation {
    /// Whether the direction is horizontal.
    pub fn is_horizontal(self) -> bool {
        !matches!(self, Self::Vertical)
    }
}

/// What a record file says beside the motion; `None` where it says nothing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RecordingDescription {
    /// Name of the earthquake, or its identifier.
    pub event: Option<String>,
    /// Origin time of the earthquake as the file writes it; a key to tell events apart.
    pub event_time: Option<String>,
    /// Magnitude; the moment magnitude where there are several.
    pub magnitude: Option<f64>,
    /// Distance from the epicentre to the station \[km\].
    pub epicentral_distance_km: Option<f64>,
    /// Closest distance to the rupture \[km\].
    pub rupture_distance_km: Option<f64>,
    /// Station with its network, e.g. "HI.ARS1"; the same for the components of one station.
    pub station: Option<String>,
    /// Name of the station's place.
    pub station_name: Option<String>,
    /// Mean shear-wave velocity of the upper 30 m \[m/s\].
    pub vs30_m_s: Option<f64>,
    /// Sensor among those of a station that records the same direction elsewhere (a borehole, another floor).
    pub sensor: Option<String>,
    /// Channel as the file names it, e.g. "HNE".
    pub channel: Option<String>,
    /// Direction of the component.
    pub orientation: Option<Orientation>,
    /// Corner of the high-pass filter \[Hz\].
    pub low_cut_hz: Option<f64>,
    /// Time of the first sample \[s\] since the beginning of 1970, in the time zone of the file.
    pub start_time_s: Option<f64>,
    /// Peak acceleration that the file states \[m/s²\].
    pub stated_pga_m_s2: Option<f64>,
    /// Whether the file holds raw data: no filter and no baseline correction.
    pub unprocessed: bool,
}

/// One component of a record file.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The motion.
    pub accelerogram: Accelerogram,
    /// Unit of the values in the file: the one it states, else the caller's.
    pub unit: AccelerationUnit,
    /// What the file says about it.
    pub description: RecordingDescription,
}

/// What a record file holds.
#[derive(Debug, Clone, PartialEq)]
pub struct RecordFile {
    /// Its layout.
    pub format: RecordFormat,
    /// Its acceleration components in the order of the file, at least one.
    pub recordings: Vec<Recording>,
}

impl RecordFile {
    /// One component: that of number `channel`, counted from one, or the only one. `name` stands in messages.
    ///
    /// # Errors
    ///
    /// [`MotionError::Channel`] where there are several and none is chosen, or the chosen one is not there.
    pub fn component(mut self, name: &str, channel: Option<usize>) -> Result<Recording, MotionError> {
        /// Components that a message names.
        const NAMED: usize = 24;
        let index = channel.unwrap_or(1).wrapping_sub(1);
        if index < self.recordings.len() && (channel.is_some() || self.recordings.len() == 1) {
            return Ok(self.recordings.swap_remove(index));
        }
        let called = |recording: &Recording| recording.description.channel.as_deref().map_or("unnamed".into(), excerpt);
        let mut named: Vec<String> = self.recordings.iter().take(NAMED).map(called).collect();
        if self.recordings.len() > NAMED {
            named.push("…".to_owned());
        }
        let (name, found) = (name.to_owned(), self.recordings.len());
        Err(MotionError::Channel { name, found, components: named.join(", ") })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_formats() {
        for format in RecordFormat::ALL {
            assert_eq!(format.to_string().to_uppercase().parse::<RecordFormat>().unwrap(), format);
            assert!(RecordFormat::ACCEPTED.contains(format.key()));
        }
        let message = "smc".parse::<RecordFormat>().unwrap_err().to_string();
        assert_eq!(message, format!("unknown record format \"smc\"; use one of: {}", RecordFormat::ACCEPTED));
    }
}
