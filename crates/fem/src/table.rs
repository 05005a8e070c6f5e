//! Piecewise linear functions of time, and functions of them.

use serde::{Deserialize, Serialize};

/// A function of a piecewise linear table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Function {
    /// The table itself.
    #[default]
    Linear,
    /// Sine of an angle.
    Sine,
    /// Cosine of an angle, minus one.
    CosineLessOne,
}

impl Function {
    fn value(self, x: f64) -> f64 {
        match self {
            Self::Linear => x,
            Self::Sine => x.sin(),
            // Avoids the cancellation of cos x - 1 at small angles.
            Self::CosineLessOne => -2.0 * (0.5 * x).sin().powi(2),
        }
    }

    fn slope(self, x: f64) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::Sine => x.cos(),
            Self::CosineLessOne => -x.sin(),
        }
    }

    fn curvature(self, x: f64) -> f64 {
        match self {
            Self::Linear => 0.0,
            Self::Sine => -x.sin(),
            Self::CosineLessOne => -x.cos(),
        }
    }
}

/// A piecewise linear table, constant before its first and after its last time, or a function of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
    function: Function,
    /// Second derivative between two entries each; empty where all pieces are straight. Loads of faults, which are kept in files, are.
    #[serde(skip)]
    bends: Vec<f64>,
}

impl Table {
    /// A table through `(times, values)`; times ascend.
    #[must_use]
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Self {
        debug_assert!(times.len() == values.len() && times.windows(2).all(|w| w[0] < w[1]));
        Self { times, values, function: Function::Linear, bends: Vec::new() }
    }

    /// The integral from the first time on of a rate with these values at times, linear in between. Times do not decrease; two values
    /// at one time are a jump of the rate.
    #[must_use]
    pub fn from_rates(at: &[f64], rates: &[f64]) -> Self {
        let mut times: Vec<f64> = at.first().copied().into_iter().collect();
        let mut values = vec![0.0; times.len()];
        let (mut bends, mut sum) = (Vec::new(), 0.0);
        for (t, rate) in at.windows(2).zip(rates.windows(2)).filter(|(t, _)| t[1] > t[0]) {
            let (run, mean) = (t[1] - t[0], 0.5 * (rate[0] + rate[1]));
            sum += mean * run;
            times.push(t[1]);
            values.push(sum);
            bends.push((rate[1] - rate[0]) / run);
        }
        if bends.iter().all(|&bend| bend == 0.0) {
            bends.clear();
        }
        Self { bends, ..Self::new(times, values) }
    }

    /// `function` of the values of this table.
    #[must_use]
    pub fn through(self, function: Function) -> Self {
        Self { function, ..self }
    }

    /// A table with the same value at all times.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self::new(vec![0.0], vec![value])
    }

    /// This table less its value at `time`; a function of a table must be zero there already.
    #[must_use]
    pub fn since(mut self, time: f64) -> Self {
        debug_assert!(
            self.function == Function::Linear || self.value(time) == 0.0,
            "only tables are shifted"
        );
        let then = self.value(time);
        if self.function == Function::Linear {
            self.values.iter_mut().for_each(|value| *value -= then);
        }
        self
    }

    /// True if the value is zero at all times.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.values.iter().all(|&value| self.function.value(value) == 0.0)
    }

    /// Times of the entries, ascending.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values of the entries.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Slope at `time`, which must not be that of an entry; 0 before the first and after the last.
    #[must_use]
    pub fn slope(&self, time: f64) -> f64 {
        let k = self.times.partition_point(|&t| t <= time);
        if k == 0 || k == self.times.len() {
            return 0.0;
        }
        let slope = (self.values[k] - self.values[k - 1]) / (self.times[k] - self.times[k - 1]);
        let slope = self.bends.get(k - 1).map_or(slope, |bend| slope + bend * (time - self.middle(k)));
        slope * self.function.slope(self.linear(time))
    }

    /// First and second derivative at `time`, on the piece of the table that contains `during` \[1/s, 1/s²\]. `during` tells the
    /// two sides of an entry apart.
    #[must_use]
    pub fn derivatives(&self, time: f64, during: f64) -> [f64; 2] {
        let k = self.times.partition_point(|&t| t <= during);
        if k == 0 || k == self.times.len() {
            return [0.0; 2];
        }
        let rate = (self.values[k] - self.values[k - 1]) / (self.times[k] - self.times[k - 1]);
        if let Some(bend) = self.bends.get(k - 1) {
            return [rate + bend * (time - self.middle(k)), *bend];
        }
        let x = self.linear(time);
        [self.function.slope(x) * rate, self.function.curvature(x) * rate * rate]
    }

    /// Middle of the piece that ends with entry `k`.
    fn middle(&self, k: usize) -> f64 {
        0.5 * (self.times[k - 1] + self.times[k])
    }

    /// Value at `time`. Between two entries the form `(1-s) a + s b` is exact at both ends.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        self.function.value(self.linear(time))
    }

    fn linear(&self, time: f64) -> f64 {
        let k = self.times.partition_point(|&t| t <= time);
        if k == 0 {
            return self.values[0];
        }
        if k == self.times.len() {
            return self.values[k - 1];
        }
        let s = (time - self.times[k - 1]) / (self.times[k] - self.times[k - 1]);
        let chord = (1.0 - s) * self.values[k - 1] + s * self.values[k];
        // A parabola of this second derivative, zero at both ends.
        let bent = |bend: &f64| chord + 0.5 * bend * (time - self.times[k - 1]) * (time - self.times[k]);
        self.bends.get(k - 1).map_or(chord, bent)
    }
}

/// Returns the smooth step `G = exp((t - T)²/(t (t - 2T)))` for 0 < t < T, 0 before and 1 after it, and dG/dt \[1/s\]; T is `rise` \[s\]. It is that of the
/// community's benchmarks of nucleation (Harris et al. 2009; Jiang et al. 2022).
#[must_use]
pub fn smooth_step(time: f64, rise: f64) -> (f64, f64) {
    if time <= 0.0 {
        return (0.0, 0.0);
    }
    if time >= rise {
        return (1.0, 0.0);
    }
    // With x = t/T: the exponent is -(1 - x)²/(x (2 - x)), and its derivative 2 (1 - x)/(x (2 - x))².
    let x = time / rise;
    let (rest, both) = (1.0 - x, x * (2.0 - x));
    let value = (-rest * rest / both).exp();
    // Far from the end of the step the value vanishes faster than any power of x grows.
    let slope = if value > 0.0 { 2.0 * value * rest / (both * both * rise) } else { 0.0 };
    (value, slope)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_exact_at_its_entries_and_constant_beyond() {
        let table = Table::new(vec![1.0, 3.0], vec![0.1, 0.7]);
        for (time, value) in [(0.0, 0.1), (1.0, 0.1), (2.0, 0.4), (3.0, 0.7), (9.0, 0.7)] {
            approx::assert_relative_eq!(table.value(time), value, max_relative = 1e-15);
        }
        for (time, slope) in [(0.0, 0.0), (2.0, 0.3), (9.0, 0.0)] {
            approx::assert_relative_eq!(table.slope(time), slope, max_relative = 1e-15);
        }
    }

    #[test]
    fn a_table_since_a_time_is_zero_there_and_keeps_its_slopes() {
        let table = Table::new(vec![1.0, 3.0], vec![0.5, 2.5]).since(2.0);
        assert_eq!([1.0, 2.0, 9.0].map(|t| table.value(t)), [-1.0, 0.0, 1.0]);
        assert!(!table.is_zero() && Table::constant(7.0).since(4.0).is_zero());
    }

    #[test]
    fn functions_of_a_table_keep_their_digits_and_have_their_slopes() {
        let angle = Table::new(vec![0.0, 2.0], vec![0.0, 1.0]);
        let (sine, cosine) = (angle.clone().through(Function::Sine), angle.through(Function::CosineLessOne));
        approx::assert_relative_eq!(sine.value(1.0), 0.5_f64.sin(), max_relative = 1e-15);
        approx::assert_relative_eq!(sine.slope(1.0), 0.5 * 0.5_f64.cos(), max_relative = 1e-15);
        approx::assert_relative_eq!(cosine.value(2e-8), -5e-17, max_relative = 1e-15);
        approx::assert_relative_eq!(cosine.slope(1.0), -0.5 * 0.5_f64.sin(), max_relative = 1e-15);
    }

    #[test]
    fn the_integral_of_a_rate_is_exact_within_ramps_and_over_jumps() {
        let table = Table::from_rates(&[1.0, 3.0, 3.0, 5.0], &[2.0, 2.0, -1.0, 3.0]);
        // 2 (t - 1), then 4 - s + s², with s = t - 3.
        for (time, value, rate) in [(2.0, 2.0, 2.0), (3.5, 3.75, 0.0), (4.0, 4.0, 1.0)] {
            approx::assert_relative_eq!(table.value(time), value, max_relative = 1e-15);
            approx::assert_abs_diff_eq!(table.slope(time), rate, epsilon = 1e-15);
        }
        assert_eq!((table.value(5.0), table.derivatives(5.0, 4.5)), (6.0, [3.0, 2.0]));
        assert!(Table::from_rates(&[0.0, 1.0, 1.0, 2.0], &[2.0, 2.0, 5.0, 5.0]).bends.is_empty());
    }

    #[test]
    fn derivatives_are_those_of_the_piece_that_is_named() {
        let angle = Table::new(vec![0.0, 1.0, 2.0], vec![0.0, 3.0, 4.0]);
        assert_eq!(angle.derivatives(1.0, 0.5), [3.0, 0.0]);
        assert_eq!(angle.derivatives(1.0, 1.0), [1.0, 0.0]);
        assert_eq!(angle.derivatives(2.0, 2.0), [0.0, 0.0]);
        for function in [Function::Sine, Function::CosineLessOne] {
            let table = angle.clone().through(function);
            let (t, h) = (0.3, 1e-4);
            let [rate, curvature] = table.derivatives(t, t);
            let (less, more) = (table.value(t - h), table.value(t + h));
            approx::assert_relative_eq!(rate, (more - less) / (2.0 * h), max_relative = 1e-6);
            let second = (more - 2.0 * table.value(t) + less) / (h * h);
            approx::assert_relative_eq!(curvature, second, max_relative = 1e-6);
        }
    }
}
