//! All combinations of `contact_combinations`.

use super::contact_combinations::everything;
use crate::{Capability, Case};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_combinations_all",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::Implicit],
    quick: false,
    run: everything,
};
