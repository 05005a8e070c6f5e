//! A law without friction coefficient: behind two fronts that run from the origin nothing resists, ahead of them nothing slips.

use asperity_friction::Failure;
use asperity_friction::inertial::{InertialFault, PointBalance, Push, Sliding};

/// Both fronts, at ±v t. Its state is the time.
#[derive(Debug)]
pub(super) struct Front {
    /// Positions of the points \[m\].
    pub at: Vec<f64>,
    /// v \[m/s\].
    pub speed: f64,
    /// Length along the crack that a point represents \[m\].
    pub spacing: f64,
}

impl Front {
    /// Share of the length around a point that the front has passed.
    fn passed(&self, point: usize, time: f64) -> f64 {
        ((self.speed * time - self.at[point].abs()) / self.spacing + 0.5).clamp(0.0, 1.0)
    }
}

impl InertialFault for Front {
    fn points(&self) -> usize {
        self.at.len()
    }

    fn states(&self) -> usize {
        1
    }

    fn has_elastic_domain(&self) -> bool {
        true
    }

    fn start(&self, _point: usize, _sliding: Option<Sliding>, states: &mut [f64]) -> Result<(), Failure> {
        states[0] = 0.0;
        Ok(())
    }

    /// A point that the front has passed in part keeps the other part of the traction that holds it.
    fn push(&self, point: usize, push: &Push, time: &mut [f64]) -> Result<PointBalance, Failure> {
        let released = self.passed(point, time[0]) * push.trial;
        time[0] += push.dt;
        Ok(PointBalance { traction: push.trial - released, rate: released / push.impedance })
    }
}
