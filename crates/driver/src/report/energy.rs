//! Energy budgets in reports.

use crate::views;
use crate::warning::Warning;
use asperity_cycles::Energy;
use asperity_mechanics as mechanics;
use asperity_output::view::EnergyParts;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Imbalance above which a run warns: forces and speeds then err by some per cent.
const DOUBTFUL: f64 = 0.05;

/// Energy budget as reports have it, of every kind of run: what was given is kept, lost or missing.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct EnergyTable {
    /// J; J/m of thickness in plane strain and antiplane motion; J/m² for spring-sliders.
    pub unit: &'static str,
    /// Energies that are stored, by their names.
    pub kept: BTreeMap<&'static str, f64>,
    /// Energies that are dissipated or carried away.
    pub lost: BTreeMap<&'static str, f64>,
    /// Works, and energy at the start.
    pub given: BTreeMap<&'static str, f64>,
    /// Energy given minus energy kept and lost, at the end.
    pub missing: f64,
    /// Missing energy over the largest part \[-\]: the largest of all steps of bodies with inertia, otherwise that at the end.
    pub imbalance: f64,
    /// Sum over steps of the size of the work on openings, which closing returns; it counts as a part.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub exchanged: Option<f64>,
}

/// Name and value of an energy.
type Part = (&'static str, f64);

impl EnergyTable {
    /// The budget of these parts: kept, lost and given.
    pub(crate) fn new(unit: &'static str, parts: [&[Part]; 3], (missing, imbalance): (f64, f64)) -> Self {
        let [kept, lost, given] = parts.map(|parts| parts.iter().copied().collect());
        Self { unit, kept, lost, given, missing, imbalance, exchanged: None }
    }
}

/// Energy budget of bodies at the end of a run, with its imbalance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
#[serde(into = "EnergyTable")]
#[schemars(with = "EnergyTable")]
pub struct Budget {
    /// Unit of energies.
    pub unit: &'static str,
    /// Energy budget \[J; J per metre of thickness in plane strain and antiplane motion\].
    pub parts: EnergyParts,
    /// Largest amount by which the budget missed its closure in any step, over the largest of its parts in the run \[-\].
    pub imbalance: f64,
}

impl From<Budget> for EnergyTable {
    fn from(Budget { unit, parts: e, imbalance }: Budget) -> Self {
        let kept =
            [("kinetic", e.kinetic), ("elastic", e.elastic), ("contact", e.contact), ("springs", e.springs)];
        let lost = [
            ("plastic", e.plastic),
            ("viscous", e.viscous),
            ("friction", e.friction),
            ("numerical", e.numerical),
            ("handover", e.handover),
        ];
        let given = [("start", e.start), ("loads", e.loads), ("motions", e.motions)];
        Self::new(unit, [&kept, &lost, &given], (e.missing, imbalance))
    }
}

/// Energy budget of faults or sliders, with its imbalance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(into = "EnergyTable")]
#[schemars(with = "EnergyTable")]
pub struct EnergyBalance {
    /// Unit of energies.
    pub unit: &'static str,
    /// Energy budget.
    pub parts: Energy,
    /// |loads + opening - elastic - friction - radiated - kinetic| over the largest of these terms \[-\].
    pub imbalance: f64,
}

impl EnergyBalance {
    /// The budget in this unit.
    #[must_use]
    pub fn new(unit: &'static str, parts: Energy) -> Self {
        Self { unit, parts, imbalance: parts.imbalance() }
    }
}

impl From<EnergyBalance> for EnergyTable {
    fn from(EnergyBalance { unit, parts: e, imbalance }: EnergyBalance) -> Self {
        let kept = [("kinetic", e.kinetic), ("elastic", e.elastic)];
        let lost = [("friction", e.friction), ("radiated", e.radiated)];
        let given = [("loads", e.loads), ("opening", e.opening)];
        let exchanged = (e.exchanged != 0.0).then_some(e.exchanged);
        Self { exchanged, ..Self::new(unit, [&kept, &lost, &given], (e.missing(), imbalance)) }
    }
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
    pub(crate) fn note(&mut self, energy: Option<mechanics::Energy>) {
        let Some(energy) = energy else { return };
        self.missing = self.missing.max(energy.missing().abs());
        self.largest = self.largest.max(energy.largest());
    }

    /// Budget at the end of a run.
    pub(crate) fn closure(&self, end: mechanics::Energy, unit: &'static str) -> Budget {
        let imbalance = if self.missing == 0.0 { 0.0 } else { self.missing / self.largest };
        Budget { unit, parts: views::energy(&end), imbalance }
    }
}
