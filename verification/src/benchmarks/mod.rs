//! Benchmarks for other programs: origin of their reference values, and the entries of this program and of the independent ones.
//!
//! The program `asperity-benchmarks` writes them to `docs/src/benchmarks`. Reference values are closed forms, or limits of the
//! independent programs of `verification/independent`; no value of this program is a reference.

mod bend;
mod block;
mod bp1;
mod contact;
mod entry;
mod independent;
pub mod limit;
pub mod pages;
mod parts;
mod rounding;
mod sandwich;

use crate::CaseError;
pub use entry::Entry;
pub use parts::ComputedBenchmark;

/// A benchmark and the function that computes it.
pub struct Maker {
    /// Name with version.
    pub name: &'static str,
    /// Computes the benchmark; runs scenes for about a minute.
    pub make: fn() -> Result<ComputedBenchmark, CaseError>,
}

/// All benchmarks.
pub const ALL: &[Maker] = &[
    Maker { name: "sandwich/v1", make: sandwich::make },
    Maker { name: "sandwich-state/v1", make: block::make },
    Maker { name: "fault-bend/v1", make: bend::make },
    Maker { name: "hertz/v1", make: contact::hertz },
    Maker { name: "partial-slip/v1", make: contact::partial_slip },
    Maker { name: "seas-bp1-quick/v1", make: bp1::make },
];
