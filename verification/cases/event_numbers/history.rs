//! Histories of stations between their rows.

use crate::CaseError;
use crate::cases::run_files::Folder;

/// Rows that the interpolating polynomial passes through, half of them on either side.
const AROUND: usize = 6;

/// Rows of a station.
struct History {
    time: Vec<f64>,
    slip: Vec<f64>,
    rate: Vec<f64>,
    /// Frictional resistance \[Pa\].
    shear: Vec<f64>,
}

/// Rows of all stations.
pub struct Histories(Vec<History>);

impl Histories {
    /// Reads the files of these stations.
    ///
    /// # Errors
    /// If one of them cannot be read.
    pub fn read(files: &Folder, names: &[impl AsRef<str>]) -> Result<Self, CaseError> {
        let one = |name: &str| -> Result<History, CaseError> {
            let table = files.table(&format!("stations/{name}"))?;
            Ok(History {
                time: table.column("t")?,
                slip: table.column("slip")?,
                rate: table.column("slip_rate")?.into_iter().map(|v| 10f64.powf(v)).collect(),
                shear: table.column("shear_stress")?.into_iter().map(|t| 1e6 * t).collect(),
            })
        };
        Ok(Self(names.iter().map(|name| one(name.as_ref())).collect::<Result<_, _>>()?))
    }

    /// Slip of a station between two times \[m\].
    pub fn slipped(&self, station: usize, from: f64, to: f64) -> f64 {
        self.0[station].slip_at(to) - self.0[station].slip_at(from)
    }

    /// First time between two times at which the slip rate of a station reaches `rate` \[m/s\].
    pub fn first(&self, station: usize, rate: f64, from: f64, to: f64) -> Option<f64> {
        self.0[station].first(rate, from, to)
    }

    /// Largest slip rate of a station in the rows between two times \[m/s\].
    pub fn largest(&self, station: usize, from: f64, to: f64) -> f64 {
        let History { time, rate, .. } = &self.0[station];
        let within = time.iter().zip(rate).filter(|(t, _)| (from..=to).contains(*t));
        within.map(|(_, rate)| *rate).fold(0.0, f64::max)
    }

    /// Slip rate of a station at a time \[m/s\].
    pub fn rate(&self, station: usize, time: f64) -> f64 {
        self.0[station].rate_at(time)
    }

    /// Drop of the shear traction of a station between two times \[Pa\].
    pub fn fell(&self, station: usize, from: f64, to: f64) -> f64 {
        self.0[station].shear_at(from) - self.0[station].shear_at(to)
    }
}

impl History {
    /// First time between two times at which the slip rate, whose logarithm is linear between rows, reaches `rate`.
    fn first(&self, rate: f64, from: f64, to: f64) -> Option<f64> {
        let k =
            (1..self.time.len()).find(|&k| self.rate[k] >= rate && (from..=to).contains(&self.time[k]))?;
        let share = (rate / self.rate[k - 1]).ln() / (self.rate[k] / self.rate[k - 1]).ln();
        Some(self.time[k - 1] + share * (self.time[k] - self.time[k - 1]))
    }

    /// Row at the start of the interval that contains a time.
    fn before(&self, time: f64) -> usize {
        self.time.partition_point(|t| *t <= time).clamp(1, self.time.len() - 1) - 1
    }

    /// Slip at a time: the cubic through the slip and slip rates of the two adjacent rows.
    fn slip_at(&self, time: f64) -> f64 {
        let k = self.before(time);
        let step = self.time[k + 1] - self.time[k];
        let x = (time - self.time[k]) / step;
        let rise = self.slip[k + 1] - self.slip[k];
        let (first, last) = (self.rate[k] * step - rise, rise - self.rate[k + 1] * step);
        self.slip[k] + x * rise + x * (1.0 - x) * ((1.0 - x) * first + x * last)
    }

    /// Slip rate at a time: the derivative of the cubic of [`Self::slip_at`].
    fn rate_at(&self, time: f64) -> f64 {
        let k = self.before(time);
        let step = self.time[k + 1] - self.time[k];
        let x = (time - self.time[k]) / step;
        let rise = (self.slip[k + 1] - self.slip[k]) / step;
        let (first, last) = (self.rate[k] - rise, rise - self.rate[k + 1]);
        rise + (1.0 - x) * (1.0 - 3.0 * x) * first + x * (2.0 - 3.0 * x) * last
    }

    /// Shear traction at a time: the polynomial through the adjacent rows.
    fn shear_at(&self, time: f64) -> f64 {
        let most = self.time.len().saturating_sub(AROUND);
        let first = (self.before(time) + 1).saturating_sub(AROUND / 2).min(most);
        let rows = first..(first + AROUND).min(self.time.len());
        let weight = |i: usize| -> f64 {
            let others = rows.clone().filter(|j| *j != i);
            others.map(|j| (time - self.time[j]) / (self.time[i] - self.time[j])).product()
        };
        rows.clone().map(|i| weight(i) * self.shear[i]).sum()
    }
}
