//! Energy budget of bodies with inertia in the report.

use crate::views;
use crate::warning::Warning;
use asperity_mechanics::Energy;
use asperity_output::view::EnergyParts;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Imbalance above which a run warns: forces and speeds then err by some per cent.
const DOUBTFUL: f64 = 0.05;

/// Energy budget at the end of a run, with its imbalance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Budget {
    /// Energy budget \[J; J per metre of thickness in plane strain and antiplane motion\].
    #[serde(flatten)]
    pub parts: EnergyParts,
    /// Largest amount by which the budget missed its closure in any step, over the largest of its parts in the run \[-\].
    pub imbalance: f64,
}

impl Budget {
    /// Warning about a budget that does not close.
    pub(crate) fn doubt(&self) -> Option<Warning> {
        (self.imbalance > DOUBTFUL).then(|| {
            let message = format!(
                "the energy budget misses {:.2} of its largest part: points of contact may open and close in every other step",
                self.imbalance
            );
            let help = "take shorter steps, a `spectral_radius` of 0.5 or less, or a softer penalty";
            Warning::at(0..0, message, help)
        })
    }
}

/// Closure of an energy budget during a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Closure {
    /// Largest missing energy so far \[J\].
    missing: f64,
    /// Largest part so far \[J\].
    largest: f64,
}

impl Closure {
    /// Notes the budget of a step, if there is one.
    pub(crate) fn note(&mut self, energy: Option<Energy>) {
        let Some(energy) = energy else { return };
        self.missing = self.missing.max(energy.missing().abs());
        self.largest = self.largest.max(energy.largest());
    }

    /// Budget at the end of a run.
    pub(crate) fn closure(&self, end: Energy) -> Budget {
        let imbalance = if self.missing == 0.0 { 0.0 } else { self.missing / self.largest };
        Budget { parts: views::energy(&end), imbalance }
    }
}
