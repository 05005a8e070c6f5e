//! Pore fluid whose pressure does not depend on slip: it is a function of place and time.

use crate::problem::{Acting, Field, Quantity, Time, Tractions};
use std::fmt::Debug;

/// Pressure of the fluid from wells.
pub static FLUID_PRESSURE: Quantity = Quantity {
    name: "fluid pressure",
    unit: "Pa",
    meaning: "pressure of the fluid from wells in excess of that at the start",
    over_events: None,
};

/// Pressure of fluid as a function of time.
pub trait PorePressure: Debug + Send + Sync {
    /// Adds the pressures of all points \[Pa\] and their rates \[Pa/s\] before `until` \[s\]: a flux that changes then is not seen.
    fn add_to(&self, time: f64, until: f64, sum: &mut [[f64; 2]]);

    /// Pressures of all points at a time \[Pa\].
    fn at(&self, time: f64, points: usize) -> Vec<f64> {
        let mut sum = vec![[0.0; 2]; points];
        self.add_to(time, f64::INFINITY, &mut sum);
        sum.into_iter().map(|felt| felt[0]).collect()
    }
}

/// Fluid in an integration.
#[derive(Debug)]
pub(super) struct ActingFluid<'a> {
    pressure: &'a dyn PorePressure,
    /// Pressure of each point \[Pa\] and its rate \[Pa/s\].
    felt: Vec<[f64; 2]>,
}

impl<'a> ActingFluid<'a> {
    /// Fluid of this pressure on a number of points.
    pub fn new(pressure: &'a dyn PorePressure, points: usize) -> Self {
        Self { pressure, felt: vec![[0.0; 2]; points] }
    }
}

impl Acting for ActingFluid<'_> {
    fn act(&mut self, time: Time, on: &mut Tractions<'_>) -> Result<(), usize> {
        self.felt.fill([0.0; 2]);
        self.pressure.add_to(time.at, time.until, &mut self.felt);
        on.normal.iter_mut().zip(&self.felt).for_each(|(f, felt)| *f -= felt[0]);
        if let Some(rates) = &mut on.rates {
            rates.normal.iter_mut().zip(&self.felt).for_each(|(rate, felt)| *rate -= felt[1]);
        }
        Ok(())
    }

    fn fields(&self) -> Vec<Field> {
        let values = self.felt.iter().map(|felt| felt[0]).collect();
        vec![Field { quantity: &FLUID_PRESSURE, values }]
    }
}
