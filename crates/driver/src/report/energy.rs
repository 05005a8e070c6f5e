//! Energy budgets in reports.

use crate::views;
use crate::warning::Warning;
use asperity_cycles::Energy;
use asperity_mechanics as mechanics;
use asperity_mechanics::dynamics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;

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
    fn new(unit: &'static str, parts: [&[Part]; 3], (missing, imbalance): (f64, f64)) -> Self {
        let [kept, lost, given] = parts.map(|parts| parts.iter().copied().collect());
        Self { unit, kept, lost, given, missing, imbalance, exchanged: None }
    }

    /// Budget of faults or sliders.
    #[must_use]
    pub fn of_faults(unit: &'static str, e: &Energy) -> Self {
        let kept = [("kinetic", e.kinetic), ("elastic", e.elastic)];
        let lost = [("friction", e.friction), ("radiated", e.radiated)];
        let given = [("loads", e.loads), ("opening", e.opening)];
        let exchanged = (e.exchanged != 0.0).then_some(e.exchanged);
        Self { exchanged, ..Self::new(unit, [&kept, &lost, &given], (e.missing(), e.imbalance())) }
    }

    /// Budget of bodies with mass in explicit steps.
    #[must_use]
    pub fn of_waves(unit: &'static str, e: &dynamics::Budget) -> Self {
        let largest = e.largest();
        let imbalance = if largest > 0.0 { e.missing().abs() / largest } else { 0.0 };
        let kept = [("kinetic", e.kinetic), ("elastic", e.elastic)];
        let lost = [("viscous", e.viscous), ("friction", e.friction), ("absorbed", e.absorbed)];
        let given = [("start", e.initial), ("loads", e.loads), ("released", e.released)];
        Self::new(unit, [&kept, &lost, &given], (e.missing(), imbalance))
    }

    /// Budget of bodies with inertia, which missed its closure by `imbalance` of its largest part \[-\].
    fn of_bodies(unit: &'static str, energy: &mechanics::Energy, imbalance: f64) -> Self {
        let e = views::energy(energy);
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

    /// An energy by its name; 0 without one.
    #[must_use]
    pub fn part(&self, name: &str) -> f64 {
        [&self.kept, &self.lost, &self.given]
            .into_iter()
            .find_map(|parts| parts.get(name))
            .copied()
            .unwrap_or(0.0)
    }

    /// The budget in a line, without parts that are zero.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text = format!("energy [{}]:", self.unit);
        if [&self.given, &self.kept, &self.lost].iter().all(|parts| parts.values().all(|value| *value == 0.0))
        {
            return text + " none was given, kept or lost";
        }
        for (name, parts) in [("given", &self.given), ("kept", &self.kept), ("lost", &self.lost)] {
            let parts: Vec<String> = parts
                .iter()
                .filter(|part| *part.1 != 0.0)
                .map(|(name, value)| format!("{name} {value:.6e}"))
                .collect();
            if !parts.is_empty() {
                let _ = write!(text, " {name} {};", parts.join(", "));
            }
        }
        let _ = write!(text, " closes to {:.1e} of the largest", self.imbalance);
        text
    }

    /// Warning about a budget that does not close, with the usual `cause` and the help against it.
    #[must_use]
    pub fn doubt(&self, cause: &str, help: &str) -> Option<Warning> {
        (self.imbalance > DOUBTFUL).then(|| {
            let message =
                format!("the energy budget misses {:.2} of its largest part: {cause}", self.imbalance);
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
    pub(crate) fn closure(&self, end: mechanics::Energy, unit: &'static str) -> EnergyTable {
        let imbalance = if self.missing == 0.0 { 0.0 } else { self.missing / self.largest };
        EnergyTable::of_bodies(unit, &end, imbalance)
    }
}
