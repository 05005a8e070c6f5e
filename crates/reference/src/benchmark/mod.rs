//! Benchmarks that other programs can enter: reference values, results in a table, and their judgement.
//!
//! A benchmark is a folder `docs/src/benchmarks/<name>/<version>` of the book. Its reference values are part of the program, so that a
//! result can be judged anywhere.

pub mod judgement;
pub mod overlay;
pub mod reference;
pub mod submission;
mod table;

pub use judgement::{Judgement, QuantityVerdict, Verdict};
pub use reference::{Along, Place, Quantity, Reference};
pub use submission::{Defect, Row, Submission};

use std::sync::LazyLock;

/// Text of the reference values of every benchmark.
pub const TEXTS: [&str; 6] = [
    include_str!("../../../../docs/src/benchmarks/sandwich/v1/reference.json"),
    include_str!("../../../../docs/src/benchmarks/sandwich-state/v1/reference.json"),
    include_str!("../../../../docs/src/benchmarks/fault-bend/v1/reference.json"),
    include_str!("../../../../docs/src/benchmarks/hertz/v1/reference.json"),
    include_str!("../../../../docs/src/benchmarks/partial-slip/v1/reference.json"),
    include_str!("../../../../docs/src/benchmarks/seas-bp1-quick/v1/reference.json"),
];

/// All benchmarks. A test reads each of them.
#[must_use]
pub fn all() -> &'static [Reference] {
    static ALL: LazyLock<Vec<Reference>> =
        LazyLock::new(|| TEXTS.iter().filter_map(|text| serde_json::from_str(text).ok()).collect());
    &ALL
}

/// The benchmark of this name, such as `sandwich/v1`.
#[must_use]
pub fn find(name: &str) -> Option<&'static Reference> {
    all().iter().find(|reference| reference.benchmark == name)
}
