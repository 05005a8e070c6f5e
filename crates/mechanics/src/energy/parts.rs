//! Energies of a state and works of a step, part by part.

use crate::{CellBlock, PlannedEnforcement, PlannedInterface, SpringState};
use asperity_contact::{Interface, PointFields};
use asperity_fem::dof::Channel;

/// Energies of the bodies in a state.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyEnergy {
    /// Elastic energy \[J\].
    pub stored: f64,
    /// Energy that plastic flow has dissipated \[J\].
    pub plastic: f64,
    /// Rate at which viscous flow dissipates energy \[W\].
    pub viscous_rate: f64,
}

/// Energies of the bodies with these displacements \[m\].
#[must_use]
pub fn body_energy<const D: usize>(blocks: &[CellBlock<D>], u: &[f64]) -> BodyEnergy {
    let mut sum = BodyEnergy::default();
    for block in blocks {
        match block {
            CellBlock::Linear(block) => sum.stored += block.strain_energy(u),
            CellBlock::Nonlinear(block) => {
                sum.stored += block.strain_energy();
                sum.plastic += block.plastic_work();
                sum.viscous_rate += block.viscous_rate();
            }
        }
    }
    sum
}

/// Elastic energy of the penalties of each interface, `A (f_n²/2E_n + t²/2E_t)` at each point \[J\]. Multipliers store none: they
/// hold gaps within a tolerance, whose work belongs to what a budget misses.
#[must_use]
pub fn contact_energies<const D: usize>(
    planned: &[PlannedInterface],
    interfaces: &[Interface<D>],
) -> Vec<f64> {
    let half = |traction2: f64, penalty: f64| if penalty > 0.0 { 0.5 * traction2 / penalty } else { 0.0 };
    let energy = |(planned, interface): (&PlannedInterface, &Interface<D>)| -> f64 {
        if planned.enforced != PlannedEnforcement::Penalty {
            return 0.0;
        }
        let f = interface.points();
        let point = |p: usize| {
            let shear: f64 = f.shear[p].iter().map(|t| t * t).sum();
            let normal = half(f.normal_traction[p].powi(2), planned.normal_penalty);
            f.area[p] * (normal + half(shear, planned.tangential_penalty))
        };
        (0..f.area.len()).map(point).sum()
    };
    planned.iter().zip(interfaces).map(energy).collect()
}

/// Shear tractions of all interfaces \[Pa\].
pub type Shears<const D: usize> = Vec<Vec<[f64; D]>>;

/// Present shear tractions of all interfaces.
#[must_use]
pub fn shears<const D: usize>(interfaces: &[Interface<D>]) -> Shears<D> {
    interfaces.iter().map(|i| i.points().shear.clone()).collect()
}

/// Energy per area that friction dissipated at each point in the last step: the mean of the shear tractions before and after
/// times slip \[J/m²\]. With radiation damping what is radiated is part of it.
#[must_use]
pub fn friction_per_area<const D: usize>(before: &[[f64; D]], f: &PointFields<D>) -> Vec<f64> {
    let point = |p: usize| {
        let mean = before[p].iter().zip(&f.shear[p]).map(|(a, b)| 0.5 * (a + b));
        mean.zip(&f.slip_increment[p]).map(|(t, s)| t * s).sum()
    };
    (0..f.area.len()).map(point).collect()
}

/// Sum of works per area over the present areas of the points \[J\].
#[must_use]
pub fn over_areas<const D: usize>(works: &[f64], f: &PointFields<D>) -> f64 {
    works.iter().zip(&f.area).map(|(work, area)| area * work).sum()
}

/// Elastic energy of springs \[J\].
#[must_use]
pub fn spring_energy(springs: &[SpringState]) -> f64 {
    springs.iter().map(|s| s.energy).sum()
}

/// Work of load points over a step: the mean of the forces before and after times their displacement \[J\].
#[must_use]
pub fn by_load_points(before: &[SpringState], after: &[SpringState]) -> f64 {
    let work =
        |(a, b): (&SpringState, &SpringState)| 0.5 * (a.force + b.force) * (b.load_point - a.load_point);
    before.iter().zip(after).map(work).sum()
}

/// Work of loads over a step from `time - dt` to `time` by the trapezoidal rule, with the displacement `moved` \[J\].
#[must_use]
pub fn by_loads(channels: &[Channel], time: f64, dt: f64, moved: &[f64]) -> f64 {
    let of = |channel: &Channel| {
        let mean = 0.5 * (channel.amplitude.value(time - dt) + channel.amplitude.value(time));
        mean * channel.forces.iter().map(|&(dof, force)| force * moved[dof]).sum::<f64>()
    };
    channels.iter().map(of).sum()
}

/// Internal forces of linear blocks, which alone can be condensed \[N\].
#[must_use]
pub fn linear_forces<const D: usize>(blocks: &[CellBlock<D>], u: &[f64]) -> Vec<f64> {
    let mut forces = vec![0.0; u.len()];
    blocks.iter().filter_map(CellBlock::linear).for_each(|block| block.add_forces(u, &mut forces));
    forces
}
