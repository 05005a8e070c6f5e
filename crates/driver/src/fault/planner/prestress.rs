//! Tractions that an initial stress of the bodies exerts on a fault at the start.
//!
//! With the stress σ (tension positive), the normal n from minus to plus and the direction s of slip of plus, `f_n = -n·σn` and
//! `τ_0 = s·σn`. The bodies are taken to be in equilibrium under it at the start, whatever holds it at their outer faces: what loads and slip change comes on top.

use crate::diagnostic::Diagnostic;
use crate::initial_stress;
use crate::model::Model;
use crate::scene::model::{Body, Fault as Spec, Scene, SlipSpec};
use asperity_cycles::medium::{Place, across};
use asperity_mechanics::coordinates;
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
    /// True if it has components in the plane.
    presses: bool,
    place: Range<usize>,
    spec: &'a Spec,
}

/// Tractions at a place \[Pa\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resolved {
    /// f_n, where the stress has components in the plane.
    pub normal: Option<f64>,
    /// τ_0.
    pub shear: f64,
    /// The shear traction across that.
    pub across: f64,
}

impl<'a> Prestress<'a> {
    /// Stress of a fault, where a body beside it has an initial stress.
    pub fn new(scene: &'a Scene, (name, spec): (&'a str, &'a Spec)) -> Option<Self> {
        let bodies = [&spec.minus, &spec.plus].map(|side| scene.body_of(side));
        let given = bodies.iter().flatten().find_map(|b| b.initial_stress.as_ref())?;
        let stress = |body: &Option<&Body>| body.and_then(initial_stress::uniform).unwrap_or([0.0; 6]);
        let sides = [stress(&bodies[0]), stress(&bodies[1])];
        Some(Self { name, sides, presses: given.get_ref().presses(), place: given.span(), spec })
    }

    /// Tractions at a place where the fault slides freely. Where weight acts as well, only their sum is judged.
    ///
    /// # Errors
    /// [`Diagnostic`] where both sides are not in balance, and see [`Self::admit`].
    pub fn start<const D: usize>(
        &self,
        model: &Model<D>,
        place: &Place<D>,
        weighs: bool,
    ) -> Result<Resolved, Diagnostic> {
        let found = self.at(model, place)?;
        if !weighs {
            self.admit(place, &found)?;
        }
        Ok(found)
    }

    /// Tractions of the stress at a place.
    ///
    /// # Errors
    /// [`Diagnostic`] where both sides are not in balance.
    fn at<const D: usize>(&self, model: &Model<D>, place: &Place<D>) -> Result<Resolved, Diagnostic> {
        let n = in_space(&place.normal);
        let slides = match model.idealisation.components() {
            1 => [0.0, 0.0, 1.0],
            2 => [-n[1], n[0], 0.0],
            _ => in_space(&place.rake),
        };
        let [minus, plus] = self.sides.map(|s| traction(&s, &n));
        let largest = self.sides.iter().flatten().fold(0.0_f64, |l, v| l.max(v.abs()));
        if minus.iter().zip(&plus).any(|(a, b)| (a - b).abs() > BALANCED * largest) {
            let message = format!(
                "the initial stress exerts {minus:?} Pa on one side and {plus:?} Pa on the other side of fault `{}` at {}",
                self.name,
                coordinates::in_words(&place.at)
            );
            let help = "bodies on both sides of a fault need the same traction there: give both the same `initial_stress`";
            return Err(Diagnostic::at(self.place.clone(), message, help));
        }
        let across = if D == 3 { dot(&minus, &across(&n, &slides)) } else { 0.0 };
        let normal = self.presses.then_some(-dot(&minus, &n));
        Ok(Resolved { normal, shear: dot(&minus, &slides), across })
    }

    /// Refuses tractions at a place under which a fault does not slip as it is to, where the stress is all there is.
    ///
    /// # Errors
    /// [`Diagnostic`] where the fault is not pressed, or friction would not resist its motion.
    fn admit<const D: usize>(&self, place: &Place<D>, found: &Resolved) -> Result<(), Diagnostic> {
        let refuse = |what: String, help: &str| {
            let message = format!(
                "the initial stress {what} fault `{}` at {}",
                self.name,
                coordinates::in_words(&place.at)
            );
            Err(Diagnostic::at(self.place.clone(), message, help))
        };
        if let Some(pressed) = found.normal.filter(|f| *f <= 0.0) {
            return refuse(
                format!("does not press, with {pressed:e} Pa,"),
                "compression is negative in `initial_stress`, such as [\"-50 MPa\", \"-80 MPa\", \"10 MPa\"]",
            );
        }
        if against(self.spec, found.shear) {
            return refuse(
                format!(
                    "exerts a shear traction of {:e} Pa, which is not of the sign of `rate`, on",
                    found.shear
                ),
                "friction resists the motion: change the sign of `rate`, or the stress",
            );
        }
        if strays(self.spec, found) {
            return refuse(
                "exerts a shear traction across `rake` on".into(),
                "slip that may turn starts along `rake`: let it point along the shear traction",
            );
        }
        Ok(())
    }
}

/// True if friction under this shear traction \[Pa\] would not resist the motion at the start.
pub(super) fn against(spec: &Spec, shear: f64) -> bool {
    shear * spec.rate.get_ref().0.signum() <= 0.0
}

/// True if slip that may turn would not start along the rake.
pub(super) fn strays(spec: &Spec, found: &Resolved) -> bool {
    let free = spec.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
    free && found.across.abs() > ALONG * found.shear.abs()
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
