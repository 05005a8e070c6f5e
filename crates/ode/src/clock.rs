//! Time that resolves 1e-9 s at 1e9 s.

use serde::{Deserialize, Serialize};

/// A time: a base \[s\] of twice the usual precision, and a local part \[s\] counted from the last restart.
///
/// A double at 1e9 s has a resolution of 1e-7 s. The local part is small where steps are short, so that steps and differences
/// of times keep the precision of the local part.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clock {
    /// Leading part of the base \[s\].
    pub base: f64,
    /// Part of the base that its leading part cannot hold \[s\]: below half a unit in the last place.
    carry: f64,
    /// Seconds since the base.
    pub local: f64,
}

impl Clock {
    /// The time `base + local` \[s\].
    #[must_use]
    pub const fn new(base: f64, local: f64) -> Self {
        Self { base, carry: 0.0, local }
    }

    /// The time as a single rounded number \[s\].
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.base + (self.carry + self.local)
    }

    /// Seconds since `earlier`, with the precision of the local parts where the bases are close.
    #[must_use]
    pub fn since(&self, earlier: &Self) -> f64 {
        let (base, lost) = two_sum(self.base, -earlier.base);
        let (local, lost_local) = two_sum(self.local, -earlier.local);
        let (sum, lost_sum) = two_sum(base, local);
        sum + (lost_sum + lost_local + lost + (self.carry - earlier.carry))
    }

    /// The time `seconds` later, with the same base.
    #[must_use]
    pub fn later(&self, seconds: f64) -> Self {
        Self { local: self.local + seconds, ..*self }
    }

    /// The time `local` seconds after the base.
    #[must_use]
    pub fn with_local(&self, local: f64) -> Self {
        Self { local, ..*self }
    }

    /// The same time with the local part moved into the base: the relative error is about 1e-32.
    #[must_use]
    pub fn rebased(&self) -> Self {
        let (sum, lost) = two_sum(self.base, self.local);
        let (base, carry) = two_sum(sum, lost + self.carry);
        Self { base, carry, local: 0.0 }
    }
}

/// The rounded sum and its rounding error: D. E. Knuth, "The Art of Computer Programming" 2, section 4.2.2.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
