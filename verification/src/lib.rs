//! The verification suite: cases that make claims, the harness that judges them, and the report.
//!
//! * [`claim`]: what a claim states and how it is judged; [`order`] judges convergence orders.
//! * [`ledger`]: what a case writes its claims, plots, tables and notes into.
//! * [`case`]: a case, and how it is run without ever taking the suite down with it.
//! * [`suite`]: which cases run, and the outcome of the whole.
//! * [`report`]: `report.json` and the HTML pages.
//! * [`cases`]: the one list of cases.
//! * [`benchmarks`]: reference values and entries of the benchmarks that others can enter.

pub mod benchmarks;
pub mod capability;
pub mod case;
pub mod claim;
pub mod cost;
pub mod glob;
pub mod ledger;
pub mod order;
pub mod readme;
pub mod report;
pub mod sketches;
pub mod suite;

#[path = "../cases/mod.rs"]
pub mod cases;

pub use asperity_output::plots::{Diagram as Plot, Scale as Axis, Series, Slope};
pub use capability::Capability;
pub use case::{Case, CaseError};
pub use claim::{Evidence, Verdict};
pub use cost::Cost;
pub use ledger::Ledger;
pub use order::{Floor, Level};
