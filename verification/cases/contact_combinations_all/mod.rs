//! All combinations of `contact_combinations` in the plane and in axisymmetry.

use super::contact_combinations::{cell::Kinematics, everything};
use crate::{Capability, Case};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_combinations_all",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::Implicit],
    quick: false,
    run: |ledger| {
        everything(ledger, &[Kinematics::PlaneStrain, Kinematics::PlaneStress, Kinematics::Axisymmetric])
    },
};
