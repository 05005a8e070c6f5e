//! Tractions that an initial stress of the bodies exerts on a fault at the start.
//!
//! With the stress σ (tension positive), the normal n from minus to plus and the direction s of slip of plus, `f_n = -n·σn` and
//! `τ_0 = s·σn`. The bodies are taken to be in equilibrium under it at the start, whatever holds it at their outer faces: what loads and slip change comes on top.

use super::place::{Place, across};
use crate::loading;
use crate::model::Model;
use crate::plan::PlanError;
use crate::rigid;
use crate::scene::model::{Body, Fault as Spec, Scene, SlipSpec, Spanned};
use std::ops::Range;

/// Difference of the tractions on both sides over their size up to which they balance: rounding of stresses given in the scene.
const BALANCED: f64 = 1e-6;
/// Share of the shear traction that may point across slip that may turn, which starts along the rake: a twentieth of a degree.
const ALONG: f64 = 1e-3;

/// The stress of the bodies on both sides of a fault.
#[derive(Debug)]
pub struct Prestress<'a> {
    name: &'a str,
    /// By side; xx, yy, zz, xy, yz, zx \[Pa\].
    sides: [[f64; 6]; 2],
    /// Whether it has components in the plane.
    presses: bool,
    place: Range<usize>,
    spec: &'a Spec,
}

/// Tractions at a place \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolved {
    /// f_n, where the stress has components in the plane.
    pub normal: Option<f64>,
    /// τ_0.
    pub shear: f64,
}

/// The body of a side by the name of the side.
pub(crate) fn body_of<'a>(scene: &'a Scene, side: &Spanned<String>) -> Option<&'a Body> {
    scene.bodies.get(side.get_ref().split('.').next()?)
}

/// Whether stress is given with its components in the plane.
pub(crate) fn presses(stress: &Spanned<Vec<crate::scene::units::Pressure>>) -> bool {
    stress.get_ref().len() > 2
}

impl<'a> Prestress<'a> {
    /// That of a fault, where a body beside it has an initial stress.
    pub fn new(scene: &'a Scene, (name, spec): (&'a str, &'a Spec)) -> Option<Self> {
        let bodies = [&spec.minus, &spec.plus].map(|side| body_of(scene, side));
        let given = bodies.iter().flatten().find_map(|b| b.initial_stress.as_ref())?;
        let stress = |body: &Option<&Body>| body.and_then(loading::initial_stress).unwrap_or([0.0; 6]);
        let sides = [stress(&bodies[0]), stress(&bodies[1])];
        Some(Self { name, sides, presses: presses(given), place: given.span(), spec })
    }

    /// Tractions at a place where the fault slides freely.
    ///
    /// # Errors
    /// [`PlanError`] where both sides are not in balance, the fault is not pressed, or friction would not resist its motion.
    pub fn at<const D: usize>(&self, model: &Model<D>, place: &Place<D>) -> Result<Resolved, PlanError> {
        let n = in_space(&place.normal);
        let slides = match model.idealisation.components() {
            1 => [0.0, 0.0, 1.0],
            2 => [-n[1], n[0], 0.0],
            _ => in_space(&place.rake),
        };
        let [minus, plus] = self.sides.map(|s| traction(&s, &n));
        let largest = self.sides.iter().flatten().fold(0.0_f64, |l, v| l.max(v.abs()));
        let refuse = |what: String, help: &str| {
            let message =
                format!("the initial stress {what} fault `{}` at {}", self.name, rigid::place(&place.at));
            PlanError::at(self.place.clone(), message, help.into())
        };
        if minus.iter().zip(&plus).any(|(a, b)| (a - b).abs() > BALANCED * largest) {
            return Err(refuse(
                format!("exerts {minus:?} Pa on one side and {plus:?} Pa on the other side of"),
                "bodies on both sides of a fault need the same traction there: give both the same `initial_stress`",
            ));
        }
        let (pressed, shear) = (-dot(&minus, &n), dot(&minus, &slides));
        if self.presses && pressed <= 0.0 {
            return Err(refuse(
                format!("does not press, with {pressed:e} Pa,"),
                "compression is negative in `initial_stress`, such as [\"-50 MPa\", \"-80 MPa\", \"10 MPa\"]",
            ));
        }
        if shear * self.spec.rate.get_ref().0.signum() <= 0.0 {
            return Err(refuse(
                format!("exerts a shear traction of {shear:e} Pa, which is not of the sign of `rate`, on"),
                "friction resists the motion: change the sign of `rate`, or the stress",
            ));
        }
        let free = self.spec.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
        if free && dot(&minus, &across(&n, &slides)).abs() > ALONG * shear.abs() {
            return Err(refuse(
                "exerts a shear traction across `rake` on".into(),
                "slip that may turn starts along `rake`: let it point along the shear traction",
            ));
        }
        Ok(Resolved { normal: self.presses.then_some(pressed), shear })
    }
}

fn in_space<const D: usize>(v: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// σ n.
fn traction([xx, yy, zz, xy, yz, zx]: &[f64; 6], n: &[f64; 3]) -> [f64; 3] {
    [dot(&[*xx, *xy, *zx], n), dot(&[*xy, *yy, *yz], n), dot(&[*zx, *yz, *zz], n)]
}
