//! Materials.

pub mod constitutive;
pub mod elastic;
pub mod hardening;
pub mod j2;
pub mod maxwell;
pub mod plane_stress;
