//! Prescribed histories: the rate of a load point, and normal traction.

use crate::Failure;
use std::f64::consts::TAU;

/// A quantity prescribed over time.
#[derive(Clone, Debug, PartialEq)]
pub enum History {
    /// A constant value.
    Constant(f64),
    /// Piecewise linear through (time \[s\], value), constant before and after; two entries at the same time are a jump.
    Table(Vec<[f64; 2]>),
    /// mean + amplitude sin(2π (t - start)/period).
    Sine {
        /// Mean.
        mean: f64,
        /// Amplitude.
        amplitude: f64,
        /// Period \[s\].
        period: f64,
        /// Time of the first rising crossing of the mean \[s\].
        start: f64,
    },
}

impl History {
    /// A table with times in order and finite values.
    ///
    /// # Errors
    /// [`Failure::Parameter`] with the first time that is out of order.
    pub fn table(entries: Vec<[f64; 2]>) -> Result<Self, Failure> {
        let refused = |value: f64, admissible| Err(Failure::Parameter { name: "table", value, admissible });
        if entries.is_empty() {
            return refused(0.0, "at least one entry");
        }
        if let Some(&[time, value]) = entries.iter().find(|[t, v]| !(t.is_finite() && v.is_finite())) {
            return refused(if time.is_finite() { value } else { time }, "finite times and values");
        }
        if let Some(w) = entries.windows(2).find(|w| w[1][0] < w[0][0]) {
            return refused(w[1][0], "times that do not decrease");
        }
        if let Some(w) = entries.windows(3).find(|w| w[2][0] == w[0][0]) {
            return refused(w[2][0], "at most two entries at one time");
        }
        Ok(Self::Table(entries))
    }

    /// A sine.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn sine(mean: f64, amplitude: f64, period: f64, start: f64) -> Result<Self, Failure> {
        Ok(Self::Sine {
            mean: crate::finite("mean", mean)?,
            amplitude: crate::finite("amplitude", amplitude)?,
            period: crate::positive("period", period)?,
            start: crate::finite("start", start)?,
        })
    }

    /// Times at which the history has a kink or a jump, in order \[s\].
    #[must_use]
    pub fn breaks(&self) -> Vec<f64> {
        match self {
            Self::Table(entries) => {
                let mut times: Vec<f64> = entries.iter().map(|e| e[0]).collect();
                times.dedup();
                times
            }
            Self::Constant(_) | Self::Sine { .. } => Vec::new(),
        }
    }

    /// The smooth piece that is valid around a time between two breaks.
    #[must_use]
    pub fn piece(&self, within: f64) -> Piece {
        match self {
            Self::Constant(value) => Piece::Line { from: 0.0, value: *value, slope: 0.0 },
            &Self::Sine { mean, amplitude, period, start } => {
                Piece::Sine { mean, amplitude, frequency: TAU / period, start }
            }
            Self::Table(entries) => {
                let after = entries.partition_point(|e| e[0] <= within);
                let constant = |[from, value]: [f64; 2]| Piece::Line { from, value, slope: 0.0 };
                match (after.checked_sub(1).map(|i| entries[i]), entries.get(after)) {
                    (None, Some(&first)) => constant(first),
                    (Some(last), None) => constant(last),
                    (Some([t0, v0]), Some(&[t1, v1])) => {
                        Piece::Line { from: t0, value: v0, slope: (v1 - v0) / (t1 - t0) }
                    }
                    // A table has an entry.
                    (None, None) => Piece::Line { from: 0.0, value: f64::NAN, slope: f64::NAN },
                }
            }
        }
    }

    /// Smallest value over all times.
    #[must_use]
    pub fn least(&self) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Table(entries) => entries.iter().map(|e| e[1]).fold(f64::INFINITY, f64::min),
            Self::Sine { mean, amplitude, .. } => mean - amplitude.abs(),
        }
    }
}

/// A smooth piece of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Piece {
    /// A straight line.
    Line {
        /// Time at which it has `value` \[s\].
        from: f64,
        /// Value there.
        value: f64,
        /// Slope \[1/s\].
        slope: f64,
    },
    /// A sine.
    Sine {
        /// Mean.
        mean: f64,
        /// Amplitude.
        amplitude: f64,
        /// Angular frequency \[1/s\].
        frequency: f64,
        /// Time of a rising crossing \[s\].
        start: f64,
    },
}

impl Piece {
    /// Value and slope at a time.
    #[must_use]
    #[inline]
    pub fn at(&self, time: f64) -> (f64, f64) {
        match *self {
            Self::Line { from, value, slope } => {
                (if slope == 0.0 { value } else { value + slope * (time - from) }, slope)
            }
            Self::Sine { mean, amplitude, frequency, start } => {
                let (sin, cos) = (frequency * (time - start)).sin_cos();
                (mean + amplitude * sin, amplitude * frequency * cos)
            }
        }
    }

    /// Integral from one time over a duration \[s\].
    #[must_use]
    pub fn integral(&self, from: f64, duration: f64) -> f64 {
        match *self {
            Self::Line { slope, .. } => duration * (self.at(from).0 + 0.5 * slope * duration),
            Self::Sine { mean, amplitude, frequency, start } => {
                // cos p - cos q = 2 sin((p+q)/2) sin((q-p)/2), without cancellation.
                let (middle, half) =
                    (frequency * (from + 0.5 * duration - start), 0.5 * frequency * duration);
                mean * duration + 2.0 * amplitude / frequency * middle.sin() * half.sin()
            }
        }
    }
}
