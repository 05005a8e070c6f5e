//! Spacing of the points of a fault, compared with the cohesive zone and the nucleation length of its friction.
//!
//! Let `w = Σ b_i/L_i` be the weakening of the coefficient per slip just behind a rupture front, f_n the normal traction, and G' a modulus (G in
//! antiplane motion and in 3D, where this gives the shorter length of both modes, and G/(1 - ν) in plane strain):
//!
//! * the cohesive zone of a slow front is `L_b = G'/(f_n w)`, which is G' L/(b f_n) for one state: J. R. Rice, "Spatio-temporal complexity
//!   of slip on a fault", JGR 98 (1993), 9885-9907; the SEAS benchmarks use it;
//! * with the ageing law, slip nucleates over `2 L_b/[π (1 - a/b)²]`, and in 2D over 2.75 L_b for small a/b: A. M. Rubin, J.-P. Ampuero,
//!   "Earthquake nucleation on (aging) rate and state faults", JGR 110 (2005), B11312; in 3D over π²/4 times as much: T. Chen, N. Lapusta,
//!   JGR 114 (2009), B01311;
//! * with linear slip weakening, w = (μ_s - μ_k)/d_c, a front at rest loses its strength over `9π/32 G'/(f_n w)`: A. C. Palmer, J. R. Rice,
//!   Proc. R. Soc. A 332 (1973), 527-548, as given by S. M. Day et al., JGR 110 (2005), B12307; its slip nucleates over 1.158 G'/(f_n w):
//!   K. Uenishi, J. R. Rice, JGR 108 (2003), 2042;
//! * with laws that do not age, the nucleation length is half the critical wavelength `π G' b/(f_n w (b - a))` of linear stability: J. R. Rice,
//!   A. L. Ruina, "Stability of steady frictional slipping", J. Appl. Mech. 50 (1983), 343-349.
//!
//! Only points that weaken, b > a, are considered. f_n is the initial normal traction.

use super::{Coarsest, ENOUGH, FEW, Resolution, TOO_FEW};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, UnderResolution};
use crate::shared::model::Model;
use crate::shared::words::length;
use asperity_cycles::medium::Place;
use asperity_fem::element::FaceKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::{MeshFace, Side};
use asperity_friction::evolution::{self, Front};
use asperity_friction::kind::{self, Weakening};
use asperity_run::Warning;
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// Half the nucleation length over L_b for small a/b (Rubin and Ampuero 2005).
const SMALL_RATIO: f64 = 1.3774;
/// Length at the tip of a front at rest over which linear slip weakening loses its strength, over G'/(f_n w): 9π/32.
const BREAKDOWN: f64 = 9.0 * PI / 32.0;
/// Nucleation length of linear slip weakening, over G'/(f_n w) (Uenishi and Rice 2003).
const UNSTABLE: f64 = 1.158;
/// Least factor by which a front of the slip law, or of flash weakening, is narrower than L_b. Its strength falls over L whatever the drop, so that
/// the zone narrows with the logarithm of the rise of V. With BP1, 4.4 points per L_b give events in the afterslip that 8.8 do not (case
/// `seas_bp1_16mm`).
const NARROWS: f64 = 2.0;

/// Friction, normal traction and elasticity at a point.
#[derive(Clone, Copy, Debug)]
pub struct Ground<'a> {
    /// Friction law.
    pub law: &'a LawChoice,
    /// Normal traction \[Pa\].
    pub normal: f64,
    /// Modulus G' \[Pa\].
    pub modulus: f64,
    /// True if the fault is a surface in 3D.
    pub in_space: bool,
}

impl Ground<'_> {
    /// Cohesive zone and nucleation length \[m\]; `None` if friction does not weaken.
    #[must_use]
    pub fn lengths(&self) -> Option<[f64; 2]> {
        if let LawChoice::Yielding { kind, own, .. } = self.law {
            let Weakening::Linear { drop, length } = kind::weakening(kind, own) else { return None };
            let length = self.modulus * length / (self.normal * drop);
            return Some([BREAKDOWN * length, UNSTABLE * length]);
        }
        let LawChoice::RateAndState { strength, evolution, states, .. } = self.law else { return None };
        let a = strength.a;
        let mut b: f64 = states.iter().map(|s| s.b).sum();
        let mut weakening: f64 = states.iter().map(|s| s.b / s.l).sum();
        let (ages, narrows) = match evolution::definition(evolution.name)?.front {
            Front::Ageing => (true, 1.0),
            Front::Slip { weakened } => {
                if let Some(weakened) = weakened.and_then(|k| evolution.own.get(k).copied().flatten()) {
                    // Weakening at high rates reduces friction to the weakened coefficient.
                    let drop = (strength.mu0 - weakened).max(0.0);
                    b += drop;
                    weakening += states.iter().map(|s| drop / s.l).fold(0.0, f64::max);
                }
                (false, NARROWS)
            }
        };
        if !(b > a && weakening > 0.0) {
            return None;
        }
        let zone = self.modulus / (self.normal * weakening);
        let nucleation = if ages {
            let half = (PI * (1.0 - a / b).powi(2)).recip();
            // In 3D the estimate given with the benchmarks has no separate branch for small a/b.
            2.0 * zone * if self.in_space { 0.25 * PI * PI * half } else { half.max(SMALL_RATIO) }
        } else {
            0.5 * PI * zone * b / (b - a)
        };
        Some([zone / narrows, nucleation])
    }
}

/// Distance of each node of a side from the farthest of its neighbours along the edges of its faces \[m\].
pub fn spacings<const D: usize>(model: &Model<D>, sides: &[Side]) -> BTreeMap<usize, f64> {
    let mut largest: BTreeMap<usize, f64> = BTreeMap::new();
    for side in sides {
        let MeshFace { kind, nodes } = MeshFace::new(&model.mesh, side);
        for (i, j) in links(kind) {
            let (a, b) = (nodes[i], nodes[j]);
            let (x, y) = (&model.mesh.nodes[a], &model.mesh.nodes[b]);
            let square: f64 = x.iter().zip(y).map(|(x, y)| (x - y).powi(2)).sum();
            for node in [a, b] {
                let distance = largest.entry(node).or_insert(0.0);
                *distance = distance.max(square.sqrt());
            }
        }
    }
    largest
}

/// Pairs of neighbouring nodes of a face. Nodes are ordered as corners, midside nodes, middle node.
pub fn links(kind: FaceKind) -> Vec<(usize, usize)> {
    let (nodes, corners) = (kind.nodes(), kind.corners());
    // A line has one edge; other faces have as many edges as corners.
    let count = if corners == 2 { 1 } else { corners };
    let edges = (0..count).map(|k| (k, (k + 1) % corners));
    if nodes == corners {
        return edges.collect();
    }
    let halves = edges.flat_map(|(k, next)| [(k, corners + k), (corners + k, next)]);
    let middle = (corners + count..nodes).flat_map(|m| (corners..corners + count).map(move |k| (m, k)));
    halves.chain(middle).collect()
}

/// A freely sliding point of a fault.
pub struct GroundPoint<'a, const D: usize> {
    /// Its position.
    pub place: &'a Place<D>,
    /// Friction and rock there.
    pub ground: Ground<'a>,
    /// Distance to the farthest neighbour \[m\].
    pub spacing: f64,
}

/// Resolution of a fault from its freely sliding points; `None` if friction weakens nowhere.
#[must_use]
pub fn from_points<'a, const D: usize>(
    fault: &str,
    points: impl Iterator<Item = GroundPoint<'a, D>>,
) -> Option<Resolution> {
    let mut worst: [Option<Coarsest>; 2] = [None; 2];
    for GroundPoint { place, ground, spacing } in points {
        let Some(lengths) = ground.lengths() else { continue };
        for (worst, length) in worst.iter_mut().zip(lengths) {
            let here = Coarsest {
                length,
                spacing,
                points: length / spacing,
                at: std::array::from_fn(|c| place.at.get(c).copied().unwrap_or(0.0)),
                along: place.along,
            };
            if worst.is_none_or(|w| here.points < w.points) {
                *worst = Some(here);
            }
        }
    }
    let [Some(cohesive_zone), Some(nucleation)] = worst else { return None };
    Some(Resolution { fault: fault.to_string(), cohesive_zone, nucleation })
}

/// Modulus G' of a side \[Pa\]: G/(1 - ν) if slip is in the plane of a 2D model, otherwise G.
#[must_use]
pub fn modulus(idealisation: Idealisation, shear: f64, poisson: f64) -> f64 {
    if idealisation.dimension() == 2 && idealisation.components() == 2 {
        shear / (1.0 - poisson)
    } else {
        shear
    }
}

/// Warning if the points are few.
///
/// # Errors
/// [`Diagnostic`] if they are too few and the scene does not allow it.
pub(crate) fn check(found: &Resolution, spec: &Spec, in_space: bool) -> Result<Option<Warning>, Diagnostic> {
    let zone = &found.cohesive_zone;
    if zone.points >= FEW {
        return Ok(None);
    }
    let message = format!(
        "fault `{}` has {:.2} points to the cohesive zone, which is {} long at {}. Points are {} apart",
        found.fault,
        zone.points,
        length(zone.length),
        zone.place(in_space),
        length(zone.spacing)
    );
    let cells = if spec.has_sides() { ", with elements of second order cells of twice that" } else { "" };
    let enough = format!(
        "{} give three{cells}; a larger `l` or a smaller `normal` makes the zone longer",
        length(zone.length / ENOUGH)
    );
    let place = spec.law.span();
    let allowed = spec.under_resolved.as_ref().map(|u| *u.get_ref()) == Some(UnderResolution::Allow);
    if zone.points < TOO_FEW && !allowed {
        let message = format!("{message}, so that each fails independently: events are those of the mesh");
        let help = format!("{enough}; or `under_resolved = \"allow\"` at the fault");
        return Err(Diagnostic::at(place, message, help));
    }
    Ok(Some(Warning::at(place, format!("{message}, so that fronts follow the mesh"), enough)))
}
