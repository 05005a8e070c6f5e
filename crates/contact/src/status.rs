//! Status of a contact point.

use asperity_friction::law::Regime;

/// Share of the largest prescribed rate below which a point is labelled stick, under laws without an elastic domain.
const LABEL: f64 = 1e-6;

/// Status of a point. The numbers are those of output files.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u8)]
pub enum Status {
    /// No contact.
    #[default]
    Open = 0,
    /// Contact without slip.
    Stick = 1,
    /// Contact with slip; every closed point without friction.
    Slip = 2,
}

/// Label of a closed point under friction.
#[must_use]
pub fn label(regime: Regime, rate: f64, label_rate: Option<f64>) -> Status {
    match (regime, label_rate) {
        (Regime::Stick, _) => Status::Stick,
        (Regime::Slip, Some(largest)) if rate < LABEL * largest => Status::Stick,
        (Regime::Slip, _) => Status::Slip,
    }
}
