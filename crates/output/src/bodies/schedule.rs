//! Schedule of fields and profiles.

/// Number of outputs of fields and profiles: equal intervals of each stage. The end of a stage is always included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FieldSchedule {
    /// Intervals per stage for body and interface fields (`.vtu`); 0: none.
    pub fields: usize,
    /// Intervals per stage for profiles (`.csv`); 0: none.
    pub profiles: usize,
}

impl Default for FieldSchedule {
    fn default() -> Self {
        Self { fields: 1, profiles: 10 }
    }
}

impl FieldSchedule {
    /// Due times of stages with these ends, ascending and without repetition \[s\]. Where steps end at them, outputs have these
    /// times; otherwise they follow at the first step past each.
    #[must_use]
    pub fn times(&self, ends: &[f64]) -> Vec<f64> {
        let mut times = Vec::new();
        let mut start = 0.0;
        for end in ends {
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

/// Relative tolerance within which a step counts as having reached a due time. The sum of many step lengths is off by a few units
/// in the last place.
const ROUNDING: f64 = 1e-9;

/// Tracks the intervals of each stage for which output has been written.
#[derive(Clone, Debug, Default)]
pub(crate) struct OutputIntervals {
    intervals: usize,
    /// Start and end of each stage \[s\].
    stages: Vec<(f64, f64)>,
    /// Number of intervals of each stage already passed.
    passed: Vec<usize>,
}

impl OutputIntervals {
    /// Intervals of stages with these ends \[s\].
    pub(crate) fn new(intervals: usize, ends: &[f64]) -> Self {
        let starts = std::iter::once(0.0).chain(ends.iter().copied());
        let spans: Vec<(f64, f64)> = starts.zip(ends.iter().copied()).collect();
        Self { intervals, passed: vec![0; spans.len()], stages: spans }
    }

    /// Number of intervals of each stage already passed.
    pub(crate) fn passed(&self) -> &[usize] {
        &self.passed
    }

    /// The same schedule with these numbers of intervals passed.
    pub(crate) fn from(self, passed: Vec<usize>) -> Self {
        Self { passed: if passed.len() == self.passed.len() { passed } else { self.passed }, ..self }
    }

    /// True if the step that ends at `time` passes a new due time, which is marked as passed.
    pub(crate) fn take(&mut self, stage: usize, time: f64, ends_stage: bool) -> bool {
        let Some(&(start, end)) = self.stages.get(stage) else { return self.intervals > 0 && ends_stage };
        let now = if ends_stage {
            self.intervals
        } else {
            let part = (time - start) / (end - start) * (1.0 + ROUNDING);
            // The last interval is reserved for the step flagged as the end of the stage.
            ((part * self.intervals as f64).max(0.0) as usize).min(self.intervals.saturating_sub(1))
        };
        let due = now > self.passed[stage];
        self.passed[stage] = self.passed[stage].max(now);
        due
    }
}
