//! Explicit dynamics: bodies with lumped masses, absorbing sides, and faults at split nodes.
//!
//! Central differences. With M the lumped mass, f the internal forces and F all others, a step from tⁿ to tⁿ⁺¹ is
//!
//! ```text
//! aⁿ = M⁻¹ (F(tⁿ, vⁿ) - f(uⁿ + β Δt vⁿ⁻¹ᐟ²)),   vⁿ⁺¹ᐟ² = vⁿ⁻¹ᐟ² + Δt aⁿ,   uⁿ⁺¹ = uⁿ + Δt vⁿ⁺¹ᐟ²,
//! ```
//!
//! with vⁿ the mean of the two half steps, and β the viscosity of Kelvin-Voigt damping over the step. The scheme is of second order
//! and stable for Δt < 2/(ω √(1 + 2β)), ω the highest frequency ([`asperity_fem::matrix_free::highest_frequency`]).
//!
//! - [`Problem`] is what is computed, [`Explicit`] steps it.
//! - Tractions of faults follow from the momentum of both sides, without a penalty ([`Fault`]).
//! - Absorbing sides are dashpots ρ c_p and ρ c_s per area (Lysmer & Kuhlemeyer 1969).
//! - [`Budget`] is the energy, whose parts close to rounding.

mod absorbing;
mod budget;
mod elastic_energy;
mod explicit;
mod fault;
mod fault_state;
mod inelastic_cells;
mod loads;
mod motion;
mod nodes;
mod onset;
mod parts;
mod problem;
mod pulse;
mod room;
mod special_actions;
mod split;
mod springs;
mod stable_step;
mod sums;
mod surroundings;
mod ties;

pub use absorbing::{Dashpot, dashpots};
pub use budget::Budget;
pub use explicit::{Explicit, ExplicitState, Halt};
pub use fault::{Fault, ForcedWeakening, Regularisation};
pub use fault_state::FaultState;
pub use onset::Onset;
pub use problem::Problem;
pub use pulse::Pulse;
pub use split::SplitPoint;
pub use stable_step::{StableStep, stable};
pub use ties::Tie;

#[cfg(test)]
mod tests;
