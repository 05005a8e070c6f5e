//! Displacements and velocities of positions in homogeneous rock, from slip of the faults in closed form.

use asperity_cycles::Moment;
use asperity_output::seismogram;

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
    pub(super) fn caused(&self, slips: impl Iterator<Item = f64>) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (slip, per) in slips.zip(&self.per_slip) {
            sum.iter_mut().zip(per).for_each(|(sum, per)| *sum += slip * per);
        }
        sum
    }

    /// Displacement \[m\] and velocity \[m/s\] at a moment, with the motion of the plates.
    fn moves(&self, rates: &[f64], now: &Moment<'_>) -> [[f64; 3]; 2] {
        let time = now.at.seconds();
        let slip = now.slip();
        let behind = slip.all().iter().zip(rates).map(|(slip, rate)| slip - rate * time);
        let slower = now.rate.all().iter().zip(rates).map(|(now, rate)| now - rate);
        let (displacement, velocity) = (self.caused(behind), self.caused(slower));
        [
            std::array::from_fn(|c| displacement[c] + self.plates[c] * time),
            std::array::from_fn(|c| velocity[c] + self.plates[c]),
        ]
    }
}

/// Names of the files, with their headers.
pub(super) fn heads(receivers: &Receivers) -> Vec<(String, String)> {
    let head = seismogram::header(&receivers.axes);
    receivers.all.iter().map(|r| (format!("receivers/{}.csv", r.name), head.clone())).collect()
}

/// Row of a receiver.
pub(super) fn row(receivers: &Receivers, number: usize, now: &Moment<'_>) -> String {
    let [displacement, velocity] = receivers.all[number].moves(&receivers.rates, now);
    let along = |v: [f64; 3]| receivers.axes.iter().map(|&axis| v[axis]).collect::<Vec<f64>>();
    seismogram::row(now.at.seconds(), &along(velocity), &along(displacement))
}
