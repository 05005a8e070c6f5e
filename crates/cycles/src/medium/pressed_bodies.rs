//! Bodies that are pressed before their faults slide: tractions and displacements in equilibrium, with the sides of every point
//! joined, or free to slide past each other without friction.

use super::condensed::{Conditions, in_plane, in_space, refused};
use super::place::Place;
use super::point::{Initial, Point};
use super::point_jumps::PointJumps;
use super::refusal::Refusal;
use asperity_fem::FemError;
use asperity_fem::condense::{Condensation, CondensedBody, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::jump::ObliqueConstraint;
use asperity_fem::table::Table;
use serde::{Deserialize, Serialize};

/// Loads and supports that press the bodies.
#[derive(Clone, Debug)]
pub struct Pressing {
    /// Prescribed degrees of freedom, sorted.
    pub fixed: Vec<usize>,
    /// Prescribed displacements and nodal forces; its amplitude is not used.
    pub load: Channel,
    /// True for each point whose sides slide past each other without friction.
    pub slides: Vec<bool>,
}

/// State of bodies that are pressed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PressedBodies {
    /// Tractions on the points.
    pub tractions: Initial,
    /// Displacements \[m\], node by node.
    pub displacement: Vec<f64>,
    /// Forces of supports on each degree of freedom \[N; N/m\]; both nodes of a point have those of both, as what its sides exert
    /// on each other cancels.
    pub supports: Vec<f64>,
}

/// Solves for the equilibrium of bodies of this stiffness that are pressed. Tractions are nodal forces divided by tributary areas.
///
/// # Errors
/// A [`Refusal`] if the bodies need more memory than is allowed, if nothing holds them, or if a support is not compatible with the
/// fault.
pub fn press<const D: usize>(
    bodies: &Stiffness,
    pressing: &Pressing,
    points: &[Point<D>],
    conditions: Conditions,
) -> Result<PressedBodies, Refusal> {
    match conditions.components {
        1 => with_components::<D, 1>(bodies, pressing, points, conditions, |_| [[1.0]]),
        2 => with_components::<D, 2>(bodies, pressing, points, conditions, in_plane),
        _ => with_components::<D, 3>(bodies, pressing, points, conditions, in_space),
    }
}

fn with_components<const D: usize, const C: usize>(
    bodies: &Stiffness,
    pressing: &Pressing,
    points: &[Point<D>],
    Conditions { tangents, memory, .. }: Conditions,
    frame: impl Fn(&Place<D>) -> [[f64; C]; C],
) -> Result<PressedBodies, Refusal> {
    let at = PointJumps::new(points, tangents, frame, &pressing.fixed, |_| false);
    let jumps = &at.jumps;
    let body = jumps.stiffness(bodies);
    let oblique = |e: ObliqueConstraint| Refusal::Oblique { dof: e.plus };
    let supports = jumps.fixed(&pressing.fixed).map_err(oblique)?;
    let load = jumps.channel(&pressing.load, &pressing.fixed).map_err(oblique)?;
    // The opening is the last component.
    let joined = at.first.iter().zip(&pressing.slides).flat_map(|(&dof, &slides)| {
        let from = if slides { C - 1 } else { 0 };
        dof + from..dof + C
    });
    let mut fixed: Vec<usize> = supports.iter().copied().chain(joined).collect();
    fixed.sort_unstable();
    fixed.dedup();
    let mut displacement = solve(&body, &fixed, &load, memory).map_err(|e| refused(jumps, &e))?;
    let tractions = tractions(&at, &supports, &unbalanced(&body, &displacement, &load));
    jumps.displacement(&mut displacement);
    let mut supports = unbalanced(bodies, &displacement, &pressing.load);
    for Place { minus, plus, .. } in points.iter().map(|p| &p.place) {
        for c in 0..C {
            let both = supports[C * minus + c] + supports[C * plus + c];
            [minus, plus].into_iter().for_each(|node| supports[C * node + c] = both);
        }
    }
    Ok(PressedBodies { tractions, displacement, supports })
}

/// Displacements, and jumps in their place, in equilibrium with a load.
fn solve(body: &Stiffness, fixed: &[usize], load: &Channel, memory: usize) -> Result<Vec<f64>, FemError> {
    let reduction = Condensation::analyse(body, &[], fixed)?.factor(memory)?;
    let mut condensed = CondensedBody::new("bodies".into(), reduction, &[]);
    condensed.set_channels(vec![Channel { amplitude: Table::constant(1.0), ..load.clone() }]);
    Ok(condensed.recover(&[], 0.0))
}

/// Tractions of forces that hold the jumps; zero across points whose opening supports hold. The bodies drive slip with the opposite
/// of the force that holds it; one that holds the sides apart is a compression.
fn tractions<const D: usize, const C: usize>(
    PointJumps { points, first, tangents, .. }: &PointJumps<'_, D, C>,
    supports: &[usize],
    forces: &[f64],
) -> Initial {
    let pairs = || points.iter().map(|p| p.place.area).zip(first);
    let along = |c: usize| pairs().map(move |(area, dof)| (dof + c, -area));
    let shear = (0..*tangents).flat_map(along).map(|(dof, area)| forces[dof] / area).collect();
    let across = |(area, dof): (f64, &usize)| {
        let opening = dof + C - 1;
        let keeps = C == 1 || supports.binary_search(&opening).is_ok();
        if keeps { 0.0 } else { forces[opening] / area }
    };
    Initial { shear, normal: pairs().map(across).collect() }
}

/// Internal forces less loads.
fn unbalanced(body: &Stiffness, u: &[f64], load: &Channel) -> Vec<f64> {
    let mut forces = body.forces(u);
    load.forces.iter().for_each(|&(dof, force)| forces[dof] -= force);
    forces
}
