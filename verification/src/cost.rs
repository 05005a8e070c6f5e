//! Cost of a result: wall time, which differs from machine to machine, and work counts, which do not.

use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::time::Instant;

/// The cost of the run behind a claim.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Cost {
    /// Wall time \[s\], if it was measured. Reported only under `run`.
    #[serde(skip)]
    pub wall: Option<f64>,
    /// Work counts by name: steps, factorisations, solves, residuals ...
    pub work: BTreeMap<String, f64>,
}

impl Cost {
    /// Runs `work`, measuring its wall time.
    pub fn measure<T>(work: impl FnOnce() -> T) -> (T, Cost) {
        let start = Instant::now();
        let result = work();
        let cost = Cost { wall: Some(start.elapsed().as_secs_f64()), ..Cost::default() };
        (result, cost)
    }

    /// A cost with a wall time \[s\] measured elsewhere.
    pub fn wall(seconds: f64) -> Cost {
        Cost { wall: Some(seconds), ..Cost::default() }
    }

    /// Adds one count of work.
    #[must_use]
    pub fn count(mut self, name: &str, number: impl Into<f64>) -> Cost {
        self.work.insert(name.to_owned(), number.into());
        self
    }

    /// Adds every numeric field of a structure of counts that is not zero (such as `Counts` of a run), under its name.
    #[must_use]
    pub fn counts(mut self, counts: &impl Serialize) -> Cost {
        if let Ok(serde_json::Value::Object(fields)) = serde_json::to_value(counts) {
            let numbers = fields.into_iter().filter_map(|(name, value)| Some((name, value.as_f64()?)));
            self.work.extend(numbers.filter(|(_, number)| *number != 0.0));
        }
        self
    }
}
