//! One state variable of a law: its evolution and its memory of normal traction.

use crate::Failure;
use crate::evolution::Evolution;

/// A state variable with its memory.
///
/// The law keeps not s but `s + (α ln(f_n/f_ref) + c μ) ∂s/∂φ`, which does not change in a sudden change of f_n or V. With the
/// memory of Linker & Dieterich (1992), `dφ = -α df_n/f_n` at constant V and without ageing. The memory of shear traction is
/// that of evolutions that have one (see [`crate::evolution::nagata`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Component<E> {
    pub(crate) evolution: E,
    /// α ∂s/∂φ.
    pub(crate) normal_memory: f64,
    /// c ∂s/∂φ.
    pub(crate) shear_memory: f64,
}

impl<E: Evolution> Component<E> {
    /// A state variable with α ≥ 0 \[-\].
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(evolution: E, alpha: f64) -> Result<Self, Failure> {
        if !(alpha >= 0.0 && alpha.is_finite()) {
            return Err(Failure::Parameter { name: "alpha", value: alpha, admissible: "0 <= alpha, finite" });
        }
        let scaled = |memory: f64| if memory == 0.0 { 0.0 } else { memory * evolution.per_phi() };
        let (normal_memory, shear_memory) = (scaled(alpha), scaled(evolution.shear_memory()));
        for (name, value) in [("alpha", normal_memory), ("c", shear_memory)] {
            if !value.is_finite() {
                let admissible = "0 where b = 0: the memory acts through the state";
                return Err(Failure::Parameter { name, value, admissible });
            }
        }
        Ok(Self { evolution, normal_memory, shear_memory })
    }
}
