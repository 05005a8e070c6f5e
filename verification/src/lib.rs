//! The verification suite: cases that make claims, the harness that judges them, and the report.
//!
//! * [`claim`]: claims and their assessment; [`order`] assesses convergence orders.
//! * [`ledger`]: record of the claims, plots, tables and notes of a case.
//! * [`case`]: a case and its execution, isolated so that its failure does not stop the suite.
//! * [`suite`]: selection of cases and outcome of the suite; [`pool`] runs them, each with a limit.
//! * [`supervise`]: the suite in a process of its own, so that a case that ends it has a name.
//! * [`report`]: `report.json` and the HTML pages.
//! * [`numbers`]: numbers that users read in files, and the claims about them.
//! * [`cases`]: the list of cases.
//! * [`benchmarks`]: reference values and entries of the benchmarks for other programs.

pub mod benchmarks;
pub mod capability;
pub mod case;
pub mod claim;
pub mod cost;
pub mod glob;
pub mod ledger;
pub mod numbers;
pub mod order;
pub mod pool;
pub mod readme;
pub mod report;
pub mod sketches;
pub mod suite;
pub mod supervise;

#[path = "../cases/mod.rs"]
pub mod cases;

pub use asperity_output::figures::{Diagram as Plot, Scale as Axis, Series, Slope};
pub use capability::Capability;
pub use case::{Case, CaseError};
pub use claim::{Evidence, Verdict};
pub use cost::Cost;
pub use ledger::Ledger;
pub use order::{Floor, Level};
