//! Cost of a run, as far as it is known in advance.

use super::rates::words;
use schemars::JsonSchema;
use serde::Serialize;

/// Estimated cost of a run. What a run decides by itself is absent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Cost {
    /// Memory \[bytes\].
    pub memory_bytes: Option<usize>,
    /// Steps; absent where their lengths follow from errors.
    pub steps: Option<usize>,
    /// Time of a step on one core of a server of 2023; absent where it is not known in advance \[s\].
    pub step_seconds: Option<f64>,
    /// Times at which fields are written.
    pub fields: Option<usize>,
    /// Size of the fields at one time, in memory \[bytes\].
    pub field_bytes: Option<usize>,
    /// Times at which profiles are written.
    pub profiles: Option<usize>,
    /// Rows of the tables.
    pub rows: Option<usize>,
    /// Largest size of a table that grows with events \[bytes\].
    pub largest_file: Option<u64>,
}

/// Size in the unit that fits.
fn bytes(n: f64) -> String {
    match n {
        n if n >= 1e9 => format!("{:.1} GB", n / 1e9),
        n if n >= 1e6 => format!("{:.0} MB", n / 1e6),
        n => format!("{:.0} kB", n / 1e3),
    }
}

/// Number of times at which something is written.
fn outputs(n: usize) -> String {
    if n == 1 { "1 output".into() } else { format!("{n} outputs") }
}

impl Cost {
    /// Description for the plan.
    pub(super) fn words(&self) -> Vec<String> {
        let memory = self.memory_bytes.map_or("unknown".into(), |n| format!("about {}", bytes(n as f64)));
        let steps = self.steps.map_or("unknown, since errors decide them".into(), |n| n.to_string());
        vec![format!("memory {memory}; steps {steps}; {}", self.time()), format!("files: {}", self.files())]
    }

    /// Time of a step and of all, or of a thousand where their number is unknown.
    fn time(&self) -> String {
        match (self.step_seconds, self.steps) {
            (None, _) => "time unknown until the run shows its progress".into(),
            (Some(each), None) => {
                format!("time about {} a step, {} per 1000 steps", words(each), words(1000.0 * each))
            }
            (Some(each), Some(steps)) => {
                format!("time about {} a step, {} in all", words(each), words(steps as f64 * each))
            }
        }
    }

    fn files(&self) -> String {
        let mut parts = Vec::new();
        if let Some(n) = self.fields {
            let each = self.field_bytes.map_or(String::new(), |size| {
                format!(" up to {} large, {} in all", bytes(size as f64), bytes((n * size) as f64))
            });
            parts.push(format!("{} of fields{each}", outputs(n)));
        }
        parts.extend(self.profiles.map(|n| format!("{} of profiles", outputs(n))));
        parts.extend(self.rows.map(|n| format!("tables of {n} rows")));
        parts.extend(
            self.largest_file
                .map(|n| format!("each table that grows with events at most {}", bytes(n as f64))),
        );
        if parts.is_empty() { "unknown, since steps decide the rows".into() } else { parts.join("; ") }
    }
}
