//! Times of fields and profiles.

/// Frequency of fields and profiles: equal intervals of each stage; the end of a stage always counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldSchedule {
    /// Intervals per stage for body and interface fields (`.vtu`); 0 = none.
    pub fields: usize,
    /// Intervals per stage for profiles (`.csv`); 0 = none.
    pub profiles: usize,
}

impl Default for FieldSchedule {
    fn default() -> Self {
        Self { fields: 1, profiles: 10 }
    }
}

impl FieldSchedule {
    /// The times at which something is due, ascending and without repetition \[s\]: a stepper that lands on them makes
    /// the outputs fall on round times, one that does not gets them at the first step past each.
    #[must_use]
    pub fn times(&self, stages: &[(String, f64)]) -> Vec<f64> {
        let mut times = Vec::new();
        let mut start = 0.0;
        for (_, end) in stages {
            for n in [self.fields, self.profiles] {
                times.extend(
                    (1..=n).map(|k| if k == n { *end } else { start + (end - start) * k as f64 / n as f64 }),
                );
            }
            start = *end;
        }
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| (*a - *b).abs() <= ROUNDING * b.abs());
        times
    }
}

/// Relative slack within which a step counts as having reached a due time: the sum of many step lengths misses it by a
/// few units in the last place.
const ROUNDING: f64 = 1e-9;

/// Tracks which intervals of each stage have been written.
#[derive(Clone, Debug, Default)]
pub(super) struct Due {
    intervals: usize,
    /// Start and end of each stage \[s\].
    stages: Vec<(f64, f64)>,
    /// Intervals of each stage already passed.
    passed: Vec<usize>,
}

impl Due {
    pub(super) fn new(intervals: usize, stages: &[(String, f64)]) -> Self {
        let mut start = 0.0;
        let mut spans = Vec::with_capacity(stages.len());
        for (_, end) in stages {
            spans.push((start, *end));
            start = *end;
        }
        Self { intervals, passed: vec![0; spans.len()], stages: spans }
    }

    /// Intervals of each stage already passed.
    pub(super) fn passed(&self) -> &[usize] {
        &self.passed
    }

    /// The same with so many intervals of each stage passed.
    pub(super) fn from(self, passed: Vec<usize>) -> Self {
        Self { passed: if passed.len() == self.passed.len() { passed } else { self.passed }, ..self }
    }

    /// True if the step that ends at `time` passes a due time not yet passed.
    pub(super) fn take(&mut self, stage: usize, time: f64, ends_stage: bool) -> bool {
        let Some(&(start, end)) = self.stages.get(stage) else { return self.intervals > 0 && ends_stage };
        let now = if ends_stage {
            self.intervals
        } else {
            let part = (time - start) / (end - start) * (1.0 + ROUNDING);
            // The end of the stage is kept for the step that says so.
            ((part * self.intervals as f64).max(0.0) as usize).min(self.intervals.saturating_sub(1))
        };
        let due = now > self.passed[stage];
        self.passed[stage] = self.passed[stage].max(now);
        due
    }
}
