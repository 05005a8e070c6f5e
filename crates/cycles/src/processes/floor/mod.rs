//! Floor of normal traction: the smallest value that friction uses.
//!
//! Slip and loads may reduce normal tractions to zero, first near a free surface, and friction then determines no slip
//! rate. With a floor, friction uses `max(f_n, floor)` and its rate, which is zero below the floor. The unknown f_n, the
//! normal traction of the bodies, still evolves below the floor and returns along the same path. The product `f_n μ` is
//! continuous, so no unknown jumps. Its rate jumps, and the error control shortens steps that cross the floor. States
//! with a memory of normal traction respond to the value that friction uses.

mod floor_record;

pub use floor_record::{BODIES, FloorRecord, FloorSummary};

use crate::problem::{Account, Acting, Field, Host, Phase, Process, ProcessRecord, Time, Tractions};

/// The floors of the points \[Pa\]; minus infinity where there is none.
#[derive(Clone, Debug, PartialEq)]
pub struct Floor {
    least: Vec<f64>,
}

impl Floor {
    /// Floors of these points; none if no point has one.
    pub fn new(floors: impl Iterator<Item = Option<f64>>) -> Option<Self> {
        let least: Vec<f64> = floors.map(|f| f.unwrap_or(f64::NEG_INFINITY)).collect();
        least.iter().any(|f| f.is_finite()).then_some(Self { least })
    }

    /// The floor of a point \[Pa\].
    #[must_use]
    pub fn at(&self, point: usize) -> f64 {
        self.least[point]
    }

    /// Replaces normal tractions below the floor by the floor, and their rates by zero.
    pub fn hold(&self, normal: &mut [f64], rate: &mut [f64]) {
        for ((normal, rate), &least) in normal.iter_mut().zip(rate).zip(&self.least) {
            if *normal < least {
                (*normal, *rate) = (least, 0.0);
            }
        }
    }
}

impl Process for Floor {
    fn name(&self) -> &'static str {
        "floor"
    }

    fn phase(&self) -> Phase {
        Phase::Floor
    }

    fn begin<'a>(&'a self, _: Host<'a>, _: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(Holding { floor: self, bodies: Vec::new() })
    }

    fn presses(&self) -> bool {
        true
    }

    fn least(&self, point: usize) -> f64 {
        self.at(point)
    }

    fn account(&self, saved: Option<&ProcessRecord>) -> Option<Box<dyn Account>> {
        Some(Box::new(FloorRecord::new(self.least.clone(), saved)))
    }
}

/// Floors in an integration.
#[derive(Debug)]
struct Holding<'a> {
    floor: &'a Floor,
    /// Normal tractions before the floor, where rates were not asked for \[Pa\].
    bodies: Vec<f64>,
}

impl Acting for Holding<'_> {
    fn act(&mut self, _: Time, on: &mut Tractions<'_>) -> Result<(), usize> {
        if let Some(rates) = &mut on.rates {
            self.floor.hold(on.normal, rates.normal);
        } else {
            self.bodies.clear();
            self.bodies.extend_from_slice(on.normal);
            on.normal
                .iter_mut()
                .zip(&self.floor.least)
                .for_each(|(normal, least)| *normal = normal.max(*least));
        }
        Ok(())
    }

    fn fields(&self) -> Vec<Field> {
        vec![Field { quantity: &BODIES, values: self.bodies.clone() }]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::Floor;

    #[test]
    fn what_lies_below_its_floor_is_held_there_and_all_else_is_left() {
        let floor = Floor::new([None, Some(1e6), Some(1e6)].into_iter()).unwrap();
        let (mut normal, mut rate) = ([-5.0, 2e6, -3e6], [1.0, 2.0, 3.0]);
        floor.hold(&mut normal, &mut rate);
        assert_eq!((normal, rate), ([-5.0, 2e6, 1e6], [1.0, 2.0, 0.0]));
        assert!(Floor::new([None, None].into_iter()).is_none());
    }
}
