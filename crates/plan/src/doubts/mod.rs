//! Doubts that several kinds of runs share: each is one function of values, and every planner that has the values calls it. The
//! page `checks.md` of the book says which kind of run has which, and why the others have not.

mod damping;
mod fluid;
mod nucleation;
mod pulse;
mod rock_contrast;
mod thresholds;

pub use damping::damping;
pub use fluid::{Fluid, Spread, fluid, narrow};
pub use nucleation::nucleation;
pub use pulse::{PulsePoint, pulse};
pub use rock_contrast::unlike;
pub use thresholds::{idle_wait, thresholds};

use asperity_run::Warning;

/// Adds warnings, but those about a value about which something has been said: one warning per cause.
pub fn add(all: &mut Vec<Warning>, more: impl IntoIterator<Item = Warning>) {
    for warning in more {
        let said = |w: &Warning| !w.span.is_empty() && w.span == warning.span;
        if !all.iter().any(said) {
            all.push(warning);
        }
    }
}
