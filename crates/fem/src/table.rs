//! Piecewise linear functions of time.

/// A piecewise linear table, constant before its first and after its last time.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    times: Vec<f64>,
    values: Vec<f64>,
}

impl Table {
    /// A table through `(times, values)`; times ascend.
    #[must_use]
    pub fn new(times: Vec<f64>, values: Vec<f64>) -> Self {
        debug_assert!(times.len() == values.len() && times.windows(2).all(|w| w[0] < w[1]));
        Self { times, values }
    }

    /// The same value at all times.
    #[must_use]
    pub fn constant(value: f64) -> Self {
        Self { times: vec![0.0], values: vec![value] }
    }

    /// Times of the entries, ascending.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Slope at `time`, which is not that of an entry; 0 before the first and after the last.
    #[must_use]
    pub fn slope(&self, time: f64) -> f64 {
        let k = self.times.partition_point(|&t| t <= time);
        if k == 0 || k == self.times.len() {
            return 0.0;
        }
        (self.values[k] - self.values[k - 1]) / (self.times[k] - self.times[k - 1])
    }

    /// Value at `time`. Between two entries the form `(1-s) a + s b` is exact at both ends.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
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
}
