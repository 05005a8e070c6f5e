//! Segment-to-segment measures (mortar): the gap averaged to slave nodes over the overlap of the facets.
//!
//! Let ψ_A be the weighting of slave point A (a partition of unity, see `weighting` and, for small sliding, `dual`), and N_B
//! and N_γ the shape functions of slave and master faces. With integrals over the part of the slave surface that faces the
//! master,
//!
//! `a_A = ∫ψ_A`, `D_AB = ∫ψ_A N_B`, `M_Aγ = ∫ψ_A N_γ`, `d_A = (Σ_B D_AB x_B - Σ_γ M_Aγ x_γ)/a_A`, `g_A = n_A·d_A`,
//!
//! where n_A is minus the averaged normal of the slave faces at A (`normals`), so that it points outward from the master. The law of the
//! interface gives one traction f_A per point, and virtual work gives the nodal forces `D_AB f_A` on the slave and `-M_Aγ f_A`
//! on the master. Forces balance because `Σ_B D_AB = Σ_γ M_Aγ = a_A`. A uniform pressure loads either side with the integrals
//! of its own shape functions, so the contact patch test is passed.
//!
//! Every slave facet and its masters are projected along the facet's own normal onto its plane, where overlaps are exact
//! polygons (Puso and Laursen 2004). The averaged normals only set the direction of gap and pressure.
//!
//! Puso, M. A. and Laursen, T. A. (2004), A mortar segment-to-segment contact method for large deformation solid mechanics,
//! Computer Methods in Applied Mechanics and Engineering 193, 601-629.

mod blocks;
mod buffers;
mod cell;
mod centre;
mod clip;
mod dual;
mod facet;
mod finite;
mod local;
mod mirror;
mod normals;
mod order;
mod overlap;
mod pairing;
mod plane_face;
mod polygon;
mod rule;
mod scalar;
mod sides;
mod small;
mod state;
mod straight;
mod weighting;

pub use finite::finite;
pub use mirror::Mirror;
pub use sides::Surfaces;
pub use small::small;
