//! Energy budget of bodies with mass.

use crate::{CellBlock, PlannedInterface, SpringState};
use asperity_contact::{Interface, PointFields};
use asperity_fem::dof::Channel;
use asperity_run::Energies;
use serde::{Deserialize, Serialize};

/// Energy budget since the start \[J, or J/m of thickness in plane strain and antiplane motion\]:
///
/// ```text
/// kinetic + strain + contact + springs + plastic + viscous + friction + numerical + handover = start + loads + motions
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Energy {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy of the bodies.
    pub strain: f64,
    /// Elastic energy of the penalties of the interfaces.
    pub contact: f64,
    /// Elastic energy of the springs of load points.
    pub springs: f64,
    /// Energy dissipated by plastic flow.
    pub plastic: f64,
    /// Energy dissipated by viscous flow.
    pub viscous: f64,
    /// Energy dissipated by friction.
    pub friction: f64,
    /// Energy dissipated by the time integration.
    pub numerical: f64,
    /// Energy lost where bodies gain and lose their inertia.
    pub handover: f64,
    /// Kinetic and elastic energy at the start.
    pub start: f64,
    /// Work of loads, weight and the initial stress of linear bodies.
    pub loads: f64,
    /// Work of prescribed motions and of load points.
    pub motions: f64,
}

impl Energy {
    /// The budget by the names of its parts.
    #[must_use]
    pub fn energies(&self) -> Energies {
        Energies {
            given: vec![("start", self.start), ("loads", self.loads), ("motions", self.motions)],
            kept: vec![
                ("kinetic", self.kinetic),
                ("elastic", self.strain),
                ("contact", self.contact),
                ("springs", self.springs),
            ],
            lost: vec![
                ("plastic", self.plastic),
                ("viscous", self.viscous),
                ("friction", self.friction),
                ("numerical", self.numerical),
                ("handover", self.handover),
            ],
            exchanged: 0.0,
        }
    }
}

/// Elastic energy of the bodies, and what plastic flow has dissipated \[J\].
#[must_use]
pub fn body_energy<const D: usize>(blocks: &[CellBlock<D>], u: &[f64]) -> [f64; 2] {
    let mut sum = [0.0; 2];
    for block in blocks {
        let [stored, lost] = match block {
            CellBlock::Linear(block) => [block.strain_energy(u), 0.0],
            CellBlock::Nonlinear(block) => [block.strain_energy(), block.plastic_work()],
        };
        sum = [sum[0] + stored, sum[1] + lost];
    }
    sum
}

/// Rate at which viscous flow dissipates energy \[W\].
#[must_use]
pub fn viscous_rate<const D: usize>(blocks: &[CellBlock<D>]) -> f64 {
    let of = |block: &CellBlock<D>| match block {
        CellBlock::Linear(_) => 0.0,
        CellBlock::Nonlinear(block) => block.viscous_rate(),
    };
    blocks.iter().map(of).sum()
}

/// Elastic energy of the penalties, `A (f_n²/2E_n + t²/2E_t)` at each point \[J\].
#[must_use]
pub fn contact_energy<const D: usize>(planned: &[PlannedInterface], interfaces: &[Interface<D>]) -> f64 {
    let half = |traction2: f64, penalty: f64| if penalty > 0.0 { 0.5 * traction2 / penalty } else { 0.0 };
    let of = |(planned, interface): (&PlannedInterface, &Interface<D>)| -> f64 {
        let f = interface.points();
        let point = |p: usize| {
            let shear: f64 = f.shear[p].iter().map(|t| t * t).sum();
            let normal = half(f.normal_traction[p].powi(2), planned.normal_penalty);
            f.area[p] * (normal + half(shear, planned.tangential_penalty))
        };
        (0..f.area.len()).map(point).sum()
    };
    planned.iter().zip(interfaces).map(of).sum()
}

/// Shear tractions of all interfaces \[Pa\].
pub type Shears<const D: usize> = Vec<Vec<[f64; D]>>;

/// Present shear tractions of all interfaces.
#[must_use]
pub fn shears<const D: usize>(interfaces: &[Interface<D>]) -> Shears<D> {
    interfaces.iter().map(|i| i.points().shear.clone()).collect()
}

/// Energy that friction dissipated in the last step: the mean of the shear tractions before and after times slip \[J\].
#[must_use]
pub fn by_friction<const D: usize>(before: &Shears<D>, interfaces: &[Interface<D>]) -> f64 {
    let of = |(before, f): (&Vec<[f64; D]>, &PointFields<D>)| -> f64 {
        let point = |p: usize| -> f64 {
            let mean = before[p].iter().zip(&f.shear[p]).map(|(a, b)| 0.5 * (a + b));
            f.area[p] * mean.zip(&f.slip_increment[p]).map(|(t, s)| t * s).sum::<f64>()
        };
        (0..f.area.len()).map(point).sum()
    };
    before.iter().zip(interfaces.iter().map(Interface::points)).map(of).sum()
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
