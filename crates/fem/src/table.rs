//! Piecewise linear functions of time, and functions of them.

/// A function of a piecewise linear table.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
}

/// A piecewise linear table, constant before its first and after its last time, or a function of one.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
    function: Function,
}

impl Table {
    /// A table through `(times, values)`; times ascend.
    #[must_use]
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Self {
        debug_assert!(times.len() == values.len() && times.windows(2).all(|w| w[0] < w[1]));
        Self { times, values, function: Function::Linear }
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

    /// Times of the entries, ascending.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Slope at `time`, which must not be that of an entry; 0 before the first and after the last.
    #[must_use]
    pub fn slope(&self, time: f64) -> f64 {
        let k = self.times.partition_point(|&t| t <= time);
        if k == 0 || k == self.times.len() {
            return 0.0;
        }
        let slope = (self.values[k] - self.values[k - 1]) / (self.times[k] - self.times[k - 1]);
        slope * self.function.slope(self.linear(time))
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
        (1.0 - s) * self.values[k - 1] + s * self.values[k]
    }
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
    fn functions_of_a_table_keep_their_digits_and_have_their_slopes() {
        let angle = Table::new(vec![0.0, 2.0], vec![0.0, 1.0]);
        let (sine, cosine) = (angle.clone().through(Function::Sine), angle.through(Function::CosineLessOne));
        approx::assert_relative_eq!(sine.value(1.0), 0.5_f64.sin(), max_relative = 1e-15);
        approx::assert_relative_eq!(sine.slope(1.0), 0.5 * 0.5_f64.cos(), max_relative = 1e-15);
        approx::assert_relative_eq!(cosine.value(2e-8), -5e-17, max_relative = 1e-15);
        approx::assert_relative_eq!(cosine.slope(1.0), -0.5 * 0.5_f64.sin(), max_relative = 1e-15);
    }
}
