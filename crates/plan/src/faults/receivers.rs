//! Displacements and velocities of positions in rock or bodies: from slip of the faults, in closed form or by weights of the
//! condensed bodies, and from loads.

use asperity_cycles::Moment;
use asperity_fem::table::Table;

/// A position whose motion is written.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver {
    /// Name in the scene.
    pub name: String,
    /// Position \[m\].
    pub at: [f64; 3],
    /// Displacement per slip of each point, component by component \[-\].
    pub per_slip: Vec<[f64; 3]>,
    /// Velocity of the plates, if all faults with creep slipped at its rate everywhere \[m/s\].
    pub plates: [f64; 3],
    /// Loads of bodies: amplitude in time, and displacement at its unit \[m\].
    pub loads: Vec<(Table, [f64; 3])>,
}

/// Positions, and what they all need.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Receivers {
    /// The positions.
    pub all: Vec<Receiver>,
    /// Rates of the plates at the points of the faults, component by component: slip lags behind them \[m/s\].
    pub rates: Vec<f64>,
    /// Axes along which points move.
    pub axes: Vec<usize>,
}

impl Receiver {
    /// Motion caused by these slips or slip rates of all points.
    #[must_use]
    pub fn caused(&self, slips: impl Iterator<Item = f64>) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (slip, per) in slips.zip(&self.per_slip) {
            sum.iter_mut().zip(per).for_each(|(sum, per)| *sum += slip * per);
        }
        sum
    }

    /// Displacement \[m\] and velocity \[m/s\] at a moment, with the motion of the plates, whose rates at the points are `rates`.
    #[must_use]
    pub fn moves(&self, rates: &[f64], now: &Moment<'_>) -> [[f64; 3]; 2] {
        let time = now.at.seconds();
        let slip = now.slip();
        let behind = slip.all().iter().zip(rates).map(|(slip, rate)| slip - rate * time);
        let slower = now.rate.all().iter().zip(rates).map(|(now, rate)| now - rate);
        let (displacement, velocity) = (self.caused(behind), self.caused(slower));
        let [loaded, faster] = self.loaded(time);
        [
            std::array::from_fn(|c| displacement[c] + self.plates[c] * time + loaded[c]),
            std::array::from_fn(|c| velocity[c] + self.plates[c] + faster[c]),
        ]
    }

    /// Displacement \[m\] and velocity \[m/s\] by loads at a time; where their rates change, the velocity before.
    fn loaded(&self, time: f64) -> [[f64; 3]; 2] {
        let before = time.next_down().max(0.0);
        let mut sum = [[0.0; 3]; 2];
        for (amplitude, unit) in &self.loads {
            let [rate, _] = amplitude.derivatives(time, before);
            for (sum, factor) in sum.iter_mut().zip([amplitude.value(time), rate]) {
                sum.iter_mut().zip(unit).for_each(|(sum, unit)| *sum += factor * unit);
            }
        }
        sum
    }
}
