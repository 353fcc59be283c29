//! The section `[spectra]`: response spectra of what the table plays, and the code's beside them (Fig. 6.12).

use serde::Serialize;
use uplift_motion::{ElasticSpectrum, GroundType, SpectrumShape};

use crate::grid::{Grid, GridRule};
use crate::keys::{Choice, Key, Number, SectionKeys, choice, grid, number};
use crate::reading::{Rule, Section};

pub(super) const KEYS: SectionKeys = SectionKeys::new("spectra", &[&PERIODS_S]);
const PERIODS_S: Key<GridRule> = grid("periods_s", PERIODS).with_default(&["0.02:0.02:0.2", "0.25:0.05:2"]).meaning(
    "natural periods of the response spectra (5 % damped) of what the table plays, s, in the time of the table: a \
         grid",
);

pub(super) const DESIGN_KEYS: SectionKeys =
    SectionKeys::new("spectra.design", &[&GROUND_ACCELERATION_G, &GROUND, &SHAPE]);
const GROUND_ACCELERATION_G: Key<Number> = number("ground_acceleration_g", "g", GROUND_ACCELERATION).meaning(
    "ground acceleration of the elastic spectrum of Eurocode 8 (EN 1998-1, 3.2.2.2) that the figure shows beside those \
     of the motions, g; times the importance factor",
);
const GROUND: Key<Choice<GroundType>> =
    choice("ground", &GroundType::ALL, GroundType::key).with_default(GroundType::C).meaning("its ground type");
const SHAPE: Key<Choice<SpectrumShape>> = choice("shape", &SpectrumShape::ALL, SpectrumShape::key)
    .with_default(SpectrumShape::Type1)
    .meaning("its shape: `\"type1\"` where earthquakes above magnitude 5.5 contribute most, else `\"type2\"`");

const PERIODS: GridRule = GridRule { unit: "s", each: Rule::From(1e-3, 100.0, "from 0.001 to 100 s"), least_count: 2 };
const GROUND_ACCELERATION: Rule = Rule::From(1e-3, 10.0, "from 0.001 to 10 g (in g, not in m/s2: Athens has 0.16)");

/// Of what response spectra are drawn.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SpectraPlan {
    /// Natural periods in the time of the table \[s\].
    pub periods_s: Grid,
    /// The code's spectrum beside them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub design: Option<DesignSpectrumPlan>,
}

/// An elastic response spectrum of Eurocode 8.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct DesignSpectrumPlan {
    /// Ground acceleration on type A, times the importance factor \[g\].
    pub ground_acceleration_g: f64,
    /// Ground type.
    pub ground: GroundType,
    /// Shape.
    pub shape: SpectrumShape,
}

impl DesignSpectrumPlan {
    /// The spectrum, where gravity is `gravity_m_s2` \[m/s²\].
    pub fn spectrum(&self, gravity_m_s2: f64) -> ElasticSpectrum {
        let ground_acceleration_m_s2 = self.ground_acceleration_g * gravity_m_s2;
        ElasticSpectrum { ground_acceleration_m_s2, ground: self.ground, shape: self.shape }
    }
}

/// Reads the section.
pub(super) fn read(mut section: Section<'_>) -> Option<SpectraPlan> {
    let periods_s = section.read(&PERIODS_S);
    let design = design(section.section("design"));
    section.finish();
    Some(SpectraPlan { periods_s: periods_s?, design: design? })
}

#[allow(clippy::option_option)] // wrong and absent are different things, and what is wrong is among the findings
fn design(mut section: Section<'_>) -> Option<Option<DesignSpectrumPlan>> {
    if !section.is_present() {
        return Some(None);
    }
    let help = "add ground_acceleration_g = 0.16, in g: that of the site times the importance factor";
    let message = "the design spectrum has no ground acceleration";
    let ground_acceleration_g = section.read_needed(&GROUND_ACCELERATION_G, message, help);
    let ground = section.read(&GROUND);
    let shape = section.read(&SHAPE);
    section.finish();
    Some(Some(DesignSpectrumPlan { ground_acceleration_g: ground_acceleration_g?, ground: ground?, shape: shape? }))
}
