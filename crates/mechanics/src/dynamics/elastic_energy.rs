//! Elastic energy of linear cells whose forces contain those of damping, without a product of its own.
//!
//! Forces are f = K w at w = uⁿ + β (uⁿ - uⁿ⁻¹), since uⁿ - uⁿ⁻¹ = Δt vⁿ⁻¹ᐟ². With aⁿ = uⁿ·K uⁿ, c = uⁿ·K uⁿ⁻¹ and a symmetric K,
//!
//! ```text
//! uⁿ·f = (1 + β) aⁿ - β c,   (uⁿ - uⁿ⁻¹)·f = (1 + β) aⁿ - (1 + 2β) c + β aⁿ⁻¹,
//! ```
//!
//! from which c and aⁿ follow. Errors of rounding in aⁿ⁻¹ are reduced by (β/(1 + β))² in each step.

/// Powers of the forces of linear cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct Powers {
    /// uⁿ·f \[J\].
    pub displacement: f64,
    /// Δt vⁿ⁻¹ᐟ²·f \[J\].
    pub step: f64,
}

impl Powers {
    /// aⁿ from aⁿ⁻¹ \[J\]. At the `start` there are no displacements.
    pub fn stored(self, before: f64, viscosity: f64, start: bool) -> f64 {
        if start {
            return 0.0;
        }
        let mixed = (self.displacement - self.step + viscosity * before) / (1.0 + viscosity);
        (self.displacement + viscosity * mixed) / (1.0 + viscosity)
    }
}
