//! The points of a fault whose bodies are condensed onto it: the equations of a slider at every point, with parameters that may
//! vary from point to point, on slices.
//!
//! The unknowns of a point are m = μ/a and the state variables of its law, as in [`crate::slider`]: V follows from them without
//! iteration, and an error of m is one of ln V. The springs of a slider give way to the rate of the traction that the whole fault
//! exerts on the point.

use crate::Failure;
use crate::slider::{Forcing, Sliding};

/// What acts on a slice of points at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Drive<'a> {
    /// f_n > 0 \[Pa\].
    pub normal: &'a [f64],
    /// df_n/dt \[Pa/s\]; none where f_n does not change.
    pub normal_rate: Option<&'a [f64]>,
    /// dτ/dt of the driving shear traction \[Pa/s\].
    pub shear_rate: &'a [f64],
    /// η ≥ 0 \[Pa s/m\].
    pub damping: f64,
}

/// The laws of the points of a fault. Slices hold one entry for each point, states are point-major; `first` is the number of
/// the first point of the slices.
pub trait FaultLaw: Send + Sync + std::fmt::Debug {
    /// Number of points.
    fn points(&self) -> usize;

    /// State variables of a point.
    fn states(&self) -> usize;

    /// Signed slip rates V \[m/s\] from m and the states.
    fn slip_rates(&self, first: usize, m: &[f64], states: &[f64], rate: &mut [f64]);

    /// Rates of change of m and of the states \[1/s\].
    fn rates(
        &self,
        first: usize,
        drive: Drive<'_>,
        m: &[f64],
        states: &[f64],
        dm: &mut [f64],
        ds: &mut [f64],
    );

    /// a of a point \[-\]: μ = a m.
    fn scale(&self, point: usize) -> f64;

    /// What a change of ln V by one is in the state variables of a point, for error norms.
    fn state_scale(&self, point: usize) -> f64;

    /// Shortest characteristic slip L of a point \[m\], where there is one.
    fn length(&self, point: usize) -> Option<f64>;

    /// Writes the states of a point that are steady at ln V.
    fn steady(&self, point: usize, log_rate: f64, states: &mut [f64]);

    /// Changes the state of a point so that its friction coefficient at this slip rate \[m/s\] is `mu`.
    ///
    /// # Errors
    /// Those of [`Sliding::states_for`], naming the point.
    fn states_for(&self, point: usize, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure>;

    /// m of a point at a slip rate \[m/s\] of either sign.
    ///
    /// # Errors
    /// [`Failure::BareLogAtRest`] where the form has no value at this rate.
    fn at_rate(&self, point: usize, rate: f64, states: &[f64]) -> Result<f64, Failure>;
}

/// One law for each point, all of one kind.
#[derive(Clone, Debug)]
pub struct Points<L> {
    laws: Vec<L>,
}

impl<L: Sliding> Points<L> {
    /// The laws of the points; at least one, all with the same number of states.
    #[must_use]
    pub fn new(laws: Vec<L>) -> Self {
        debug_assert!(laws.windows(2).all(|w| w[0].states() == w[1].states()));
        Self { laws }
    }
}

/// Most unknowns of a point, m included: those of a slider.
const MOST: usize = 16;

impl<L: Sliding> FaultLaw for Points<L> {
    fn points(&self) -> usize {
        self.laws.len()
    }

    fn states(&self) -> usize {
        self.laws.first().map_or(0, |law| law.states())
    }

    fn slip_rates(&self, first: usize, m: &[f64], states: &[f64], rate: &mut [f64]) {
        let n = self.states();
        let mut y = [0.0; MOST];
        for (k, (law, rate)) in self.laws[first..].iter().zip(rate).enumerate() {
            y[0] = m[k];
            y[1..=n].copy_from_slice(&states[k * n..(k + 1) * n]);
            *rate = law.slip(&y[..=n]).0.rate;
        }
    }

    fn rates(
        &self,
        first: usize,
        drive: Drive<'_>,
        m: &[f64],
        states: &[f64],
        dm: &mut [f64],
        ds: &mut [f64],
    ) {
        let n = self.states();
        let (mut y, mut dy) = ([0.0; MOST], [0.0; MOST]);
        for (k, (law, dm)) in self.laws[first..].iter().zip(dm).enumerate() {
            y[0] = m[k];
            y[1..=n].copy_from_slice(&states[k * n..(k + 1) * n]);
            let forcing = Forcing {
                normal: drive.normal[k],
                normal_rate: drive.normal_rate.map_or(0.0, |r| r[k]),
                pull: drive.shear_rate[k],
                stiffness: 0.0,
                damping: drive.damping,
                mass: None,
            };
            law.equations(&forcing, &y[..=n], &mut dy[..=n]);
            *dm = dy[0];
            ds[k * n..(k + 1) * n].copy_from_slice(&dy[1..=n]);
        }
    }

    fn scale(&self, point: usize) -> f64 {
        self.laws[point].scale()
    }

    fn state_scale(&self, point: usize) -> f64 {
        self.laws[point].state_scale()
    }

    fn length(&self, point: usize) -> Option<f64> {
        self.laws[point].length()
    }

    fn steady(&self, point: usize, log_rate: f64, states: &mut [f64]) {
        self.laws[point].steady(log_rate, states);
    }

    fn states_for(&self, point: usize, rate: f64, mu: f64, states: &mut [f64]) -> Result<(), Failure> {
        self.laws[point].states_for(rate, mu, states).map_err(|f| f.at(point))
    }

    fn at_rate(&self, point: usize, rate: f64, states: &[f64]) -> Result<f64, Failure> {
        self.laws[point].at_rate(rate, states).map_err(|f| f.at(point))
    }
}
