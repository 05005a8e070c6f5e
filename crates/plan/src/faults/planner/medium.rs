//! Effective materials of the two bodies at a fault.
//!
//! Slip at its onset radiates shear waves to both sides. With impedances Z = √(G ρ) and side velocities `v± = ∓Δτ/Z±` the slip rate is `V = v⁺ - v⁻ =
//! -Δτ (1/Z⁺ + 1/Z⁻)`. Therefore `η = Z⁺ Z⁻/(Z⁺ + Z⁻)`, which is G/(2 c_s) between equal sides. Similarly, slip between half-spaces of moduli G±
//! causes the tractions, and from either side the displacements, of a uniform medium with `G = 2 G⁺ G⁻/(G⁺ + G⁻)` (exact in antiplane motion).
//! Moments use that G.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::impedance::{self, radiated};
use crate::shared::model::{self, Model};
use crate::shared::resolution;
use asperity_cycles::medium::Place;
use asperity_fem::mesh::Side;
use asperity_fem::surface;
use std::collections::BTreeMap;

/// Effective medium at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Shear modulus for moments, harmonic mean of the two sides \[Pa\].
    pub shear_modulus: f64,
    /// Modulus G' for the length scales of friction, averaged likewise \[Pa\].
    pub stiffness: f64,
    /// Radiation damping η \[Pa s/m\]; `None` if a density is unknown.
    pub radiation: Option<f64>,
    /// Difference of the shear moduli of both sides over their sum \[-\].
    pub contrast: f64,
    /// Speed of shear waves on the slower side \[m/s\]; `None` if a density is unknown.
    pub waves: Option<f64>,
}

/// Materials on both sides of a fault.
#[derive(Debug)]
pub(super) struct Media {
    minus: BTreeMap<usize, Share>,
    plus: BTreeMap<usize, Share>,
}

/// Sums over the faces of a side at a node, weighted by their contributions to its tributary area.
#[derive(Clone, Copy, Debug)]
struct Share {
    area: f64,
    shear: f64,
    stiffness: f64,
    impedance: Option<f64>,
}

impl Media {
    /// Materials behind the sides of a fault. If cells of several materials meet at a node of a side, their means weighted by area are used.
    ///
    /// # Errors
    /// [`Diagnostic`] if a block has no material.
    pub fn new<const D: usize>(scene: &Scene, model: &Model<D>, spec: &Spec) -> Result<Self, Diagnostic> {
        let side = |sides| shares(scene, model, sides);
        Ok(Self {
            minus: side(model::sides(model, &spec.minus)?)?,
            plus: side(model::sides(model, &spec.plus)?)?,
        })
    }

    /// Effective medium at a point of the fault.
    pub fn at<const D: usize>(&self, place: &Place<D>) -> Medium {
        let (minus, plus) = (&self.minus[&place.minus], &self.plus[&place.plus]);
        let contrast = |a: f64, b: f64| (a - b).abs() / (a + b);
        let parallel = |a: f64, b: f64| a * b / (a + b);
        let impedance = |share: &Share| share.impedance.map(|z| z / share.area);
        let waves = |share: &Share| share.impedance.map(|z| share.shear / z);
        Medium {
            shear_modulus: 2.0 * parallel(minus.shear / minus.area, plus.shear / plus.area),
            stiffness: 2.0 * parallel(minus.stiffness / minus.area, plus.stiffness / plus.area),
            radiation: impedance(minus).zip(impedance(plus)).map(|(a, b)| radiated(a, b)),
            contrast: contrast(minus.shear / minus.area, plus.shear / plus.area),
            waves: waves(minus).zip(waves(plus)).map(|(a, b)| a.min(b)),
        }
    }
}

fn shares<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    sides: &[Side],
) -> Result<BTreeMap<usize, Share>, Diagnostic> {
    let mut by_block: BTreeMap<usize, Vec<Side>> = BTreeMap::new();
    for side in sides {
        by_block.entry(side.block).or_default().push(*side);
    }
    let mut all: BTreeMap<usize, Share> = BTreeMap::new();
    for (block, sides) in by_block {
        let Some(body) = model.bodies.iter().find(|b| b.blocks.contains(&block)) else { continue };
        let (_, material) =
            model::material(&model.mesh, scene, Entry::new(&body.name, &scene.bodies[&body.name]), block)?;
        let elastic = &body.elastic[block - body.blocks.start];
        let shear = elastic.shear();
        let stiffness = resolution::modulus(model.idealisation, shear, elastic.poisson());
        let impedance = material.density.as_ref().map(|d| impedance::shear_impedance(shear, d.get_ref().0));
        for (node, area) in surface::areas(&model.mesh, &sides, model.idealisation) {
            let none = Share { area: 0.0, shear: 0.0, stiffness: 0.0, impedance: Some(0.0) };
            let sum = all.entry(node).or_insert(none);
            sum.area += area;
            sum.shear += area * shear;
            sum.stiffness += area * stiffness;
            sum.impedance = sum.impedance.zip(impedance).map(|(sum, z)| sum + area * z);
        }
    }
    Ok(all)
}
