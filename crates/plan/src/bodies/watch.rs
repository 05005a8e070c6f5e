//! Limits on the steps of an interface, derived from its law, the adjacent bodies and the loads.

use super::surfaces::FacingSurfaces;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::{Evolution, LawChoice, State};
use crate::reading::scene::model::Scene;
use crate::shared::model::Model;
use crate::shared::{impedance, rate_bound};
use asperity_contact::{Course, RateLimit, Watch};
use asperity_fem::mesh::Side;
use asperity_friction::evolution::{self, Front};
use asperity_friction::kind::{self, Weakening};
use asperity_mechanics::LOADING;

/// Density used if a scene declares none \[kg/m³\]; crustal rock has 2500 to 3000.
const ROCK: f64 = 2700.0;
/// Largest slip of an implicit step over the weakening length of a law, as in limit r8.
const ZETA: f64 = 0.1;
/// Largest slip of a step over L, in units of a/b. Up to about a L/b the equations of a step have a unique solution.
const UNIQUE: f64 = 0.5;

/// Resistance to slip on an interface.
#[derive(Clone, Copy)]
pub struct Resistance<'a> {
    /// Law of all points, or laws of each.
    pub laws: &'a [LawChoice],
    /// Radiation damping, if there is some \[Pa s/m\].
    pub damping: Option<f64>,
}

/// Limits on the steps of an interface between these surfaces; `loading` is the largest prescribed rate \[m/s\].
///
/// # Errors
/// [`Diagnostic`] if a body has no material.
pub fn limits<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    surfaces: &FacingSurfaces<'_, D>,
    Resistance { laws, damping }: Resistance<'_>,
    loading: f64,
) -> Result<Watch, Diagnostic> {
    let (slave, master) = (surfaces.slave.sides, &surfaces.master_sides()[..]);
    let speeds = [slave, master].map(|side| impedance::speeds(scene, model, side));
    let [of_slave, of_master] = speeds;
    let bound = rate_bound::bound(of_slave?.into_iter().chain(of_master?));
    // Under a law of a yield surface a slip rate in equilibrium is slip over the length of a step, however short.
    let waves: Option<f64> = (least_effect(laws).is_some() || scene.inertia().is_some()).then_some(bound);
    if scene.inertia().is_some() {
        // While a wave crosses the cells at the surface, their mass resists slip at least by their impedance.
        let carried = impedance::radiated(least(scene, model, slave)?, least(scene, model, master)?);
        let course = with_inertia(course_of(laws, Some(damping.unwrap_or(0.0) + carried)));
        return Ok(Watch { rate: None, course, coarse_beyond: None, waves });
    }
    let rate = match (least_effect(laws), &scene.time.slip_rate_limit) {
        (None, _) => None,
        (Some(_), Some(stated)) => Some(RateLimit::Stated(stated.get_ref().0)),
        // Damping lets states exist at every slip rate.
        (Some(_), None) if damping.is_some() => None,
        (Some(a), None) => {
            let damping = impedance::radiated(largest(scene, model, slave)?, largest(scene, model, master)?);
            Some(RateLimit::Damped { per_traction: a / damping, least: LOADING * loading })
        }
    };
    Ok(Watch { rate, course: course_of(laws, damping), coarse_beyond: None, waves })
}

/// Course that the steps of bodies with inertia follow: these pass through instabilities, and a drop of friction is one.
fn with_inertia(course: Course) -> Course {
    match course {
        Course::Drop => Course::Steady,
        other => other,
    }
}

/// Direct effect a of a law that depends on the slip rate.
fn direct_effect(law: &LawChoice) -> Option<f64> {
    match law {
        LawChoice::Rate { strength, .. } | LawChoice::RateAndState { strength, .. } => Some(strength.a),
        LawChoice::Yielding { .. } => None,
    }
}

/// Least direct effect a of laws that depend on the slip rate.
fn least_effect(laws: &[LawChoice]) -> Option<f64> {
    laws.iter().filter_map(direct_effect).reduce(f64::min)
}

/// Course that steps of all points may follow.
fn course_of(laws: &[LawChoice], damping: Option<f64>) -> Course {
    laws.iter().map(|law| course(law, damping)).reduce(stricter).unwrap_or_default()
}

/// Course with the shorter steps of two. A point that weakens with slip does so until it has slipped by the longer of both lengths.
fn stricter(one: Course, other: Course) -> Course {
    match (one, other) {
        (Course::Steady, course) | (course, Course::Steady) => course,
        (Course::State { most: a, damped: b }, Course::State { most: c, damped: d }) => {
            Course::State { most: a.min(c), damped: b.min(d) }
        }
        (Course::Branch { most: a, length: b }, Course::Branch { most: c, length: d }) => {
            Course::Branch { most: a.min(c), length: b.max(d) }
        }
        (Course::Drop, _) | (_, Course::Drop) => Course::Drop,
        // Laws of one kind have no courses of two kinds.
        (course, _) => course,
    }
}

/// Course of weakening of a law with this radiation damping \[Pa s/m\].
fn course(law: &LawChoice, damping: Option<f64>) -> Course {
    match law {
        LawChoice::Rate { .. } => Course::Steady,
        LawChoice::Yielding { kind, own, .. } => match kind::weakening(kind, own) {
            Weakening::None => Course::Steady,
            Weakening::Drop => Course::Drop,
            Weakening::Linear { length, .. } => Course::Branch { most: ZETA * length, length },
        },
        LawChoice::RateAndState { strength, evolution, states, .. } => {
            by_state(strength.a, evolution, states, damping.unwrap_or(0.0))
        }
    }
}

fn by_state(a: f64, evolution: &Evolution, states: &[State], damping: f64) -> Course {
    let b: f64 = states.iter().map(|s| s.b).sum();
    let length = states.iter().map(|s| s.l).fold(f64::INFINITY, f64::min);
    // Weakening at high rates beyond the steady state, such as by flash heating, is not included in b.
    let front = evolution::definition(evolution.name).map(|row| row.front);
    let weakened = matches!(front, Some(Front::Slip { weakened: Some(_) }));
    if (b > a || weakened) && length.is_finite() {
        Course::State { most: ZETA.min(UNIQUE * a / b) * length, damped: damping / a }
    } else {
        Course::Steady
    }
}

/// Smallest impedance √(Gρ) of the cells behind some faces \[Pa s/m\].
fn least<const D: usize>(scene: &Scene, model: &Model<D>, sides: &[Side]) -> Result<f64, Diagnostic> {
    let all = impedance::behind(scene, model, sides, Some(ROCK))?;
    Ok(all.into_iter().flatten().fold(f64::INFINITY, f64::min))
}

/// Largest impedance √(Gρ) of the cells behind some faces \[Pa s/m\].
fn largest<const D: usize>(scene: &Scene, model: &Model<D>, sides: &[Side]) -> Result<f64, Diagnostic> {
    let all = impedance::behind(scene, model, sides, Some(ROCK))?;
    Ok(all.into_iter().flatten().fold(0.0, f64::max))
}
