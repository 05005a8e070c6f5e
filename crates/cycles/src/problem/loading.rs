//! Tractions caused by boundaries, creeping parts of the fault and other loads.

use asperity_fem::table::Table;
use serde::{Deserialize, Serialize};

/// One load: an amplitude over time and the tractions at unit amplitude.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Part {
    amplitude: Table,
    /// Shear tractions, component by component \[Pa\].
    shear: Vec<f64>,
    /// Normal tractions, compression positive \[Pa\]; empty where they do not change.
    normal: Vec<f64>,
}

/// Loads of a fault; piecewise linear in time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Loading {
    /// Number of components of slip.
    components: usize,
    parts: Vec<Part>,
}

impl Loading {
    /// No loads, for slip of this many components.
    #[must_use]
    pub fn new(components: usize) -> Self {
        Self { components, parts: Vec::new() }
    }

    /// Adds a load: shear tractions, component by component, and normal tractions of all points at unit amplitude
    /// \[Pa\].
    ///
    /// `normal` is empty where normal tractions do not change.
    pub fn add(&mut self, amplitude: Table, shear: Vec<f64>, normal: Vec<f64>) {
        self.parts.push(Part { amplitude, shear, normal });
    }

    /// Adds all loads of another.
    pub fn append(&mut self, mut other: Self) {
        self.parts.append(&mut other.parts);
    }

    /// Times in (after, until) at which the rate of a load changes, ascending \[s\].
    #[must_use]
    pub fn breaks(&self, after: f64, until: f64) -> Vec<f64> {
        let mut times: Vec<f64> =
            self.parts.iter().flat_map(|p| p.amplitude.times().iter().copied()).collect();
        times.retain(|&t| t > after && t < until);
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// Rates of shear and normal tractions in the interval between two breaks that contains the time `within` \[s\].
    /// The second is empty where normal tractions do not change.
    #[must_use]
    pub fn rates(&self, within: f64, points: usize, couples_normal: bool) -> (Vec<f64>, Vec<f64>) {
        let mut shear = vec![0.0; points * self.components];
        let mut normal = vec![0.0; if couples_normal { points } else { 0 }];
        for part in &self.parts {
            let slope = part.amplitude.slope(within);
            shear.iter_mut().zip(&part.shear).for_each(|(sum, t)| *sum += slope * t);
            normal.iter_mut().zip(&part.normal).for_each(|(sum, t)| *sum += slope * t);
        }
        (shear, normal)
    }

    /// Changes of shear and normal tractions from one time to another \[s\]. The second is empty where normal tractions do
    /// not change.
    #[must_use]
    pub fn change(&self, [from, to]: [f64; 2], points: usize, couples_normal: bool) -> (Vec<f64>, Vec<f64>) {
        let mut shear = vec![0.0; points * self.components];
        let mut normal = vec![0.0; if couples_normal { points } else { 0 }];
        for part in &self.parts {
            let by = part.amplitude.value(to) - part.amplitude.value(from);
            shear.iter_mut().zip(&part.shear).for_each(|(sum, t)| *sum += by * t);
            normal.iter_mut().zip(&part.normal).for_each(|(sum, t)| *sum += by * t);
        }
        (shear, normal)
    }

    /// Mean rates of shear tractions until `end` \[Pa/s\], component by component.
    #[must_use]
    pub fn mean(&self, end: f64, points: usize) -> Vec<f64> {
        let mut mean = vec![0.0; points * self.components];
        for part in &self.parts {
            let rate = (part.amplitude.value(end) - part.amplitude.value(0.0)) / end;
            mean.iter_mut().zip(&part.shear).for_each(|(sum, t)| *sum += rate * t);
        }
        mean
    }
}
