//! All combinations of `contact_combinations` in 3D.

use super::contact_combinations::{cell::Kinematics, everything};
use crate::{Capability, Case};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_combinations_space",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::Implicit],
    quick: false,
    run: |ledger| everything(ledger, &[Kinematics::Space]),
};
