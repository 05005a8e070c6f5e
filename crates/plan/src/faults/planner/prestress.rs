//! Initial tractions on a fault due to an initial stress of the bodies.
//!
//! With the stress σ (tension positive), the normal n from minus to plus and the direction s of slip of the plus side, `f_n = -n·σn` and `τ_0 =
//! s·σn`. The bodies are assumed to be in equilibrium under this stress at the start, whatever holds it at their outer faces. Changes due to loads
//! and slip are added to it.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Body, Fault as Spec, Scene, SlipSpec};
use crate::shared::entry::Entry;
use crate::shared::initial_stress;
use crate::shared::model::Model;
use asperity_cycles::medium::{Place, across};
use asperity_fem::vector::tangent;
use asperity_mechanics::coordinates;
use std::ops::Range;

/// Largest relative difference of the tractions on both sides that count as balanced: rounding of stresses given in the scene.
const BALANCED: f64 = 1e-6;
/// Largest component of the shear traction perpendicular to the rake, relative to that along it, if slip is a vector: a twentieth of a degree.
const ALONG: f64 = 1e-3;

/// Initial stress of the bodies on both sides of a fault.
#[derive(Debug)]
pub struct Prestress<'a> {
    name: &'a str,
    /// Stress of each side: xx, yy, zz, xy, yz, zx \[Pa\].
    sides: [[f64; 6]; 2],
    /// True if the stress has in-plane components.
    presses: bool,
    place: Range<usize>,
    spec: &'a Spec,
}

/// Tractions at a point \[Pa\].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ResolvedTractions {
    /// f_n, if the stress has in-plane components.
    pub normal: Option<f64>,
    /// τ_0.
    pub shear: f64,
    /// Shear traction perpendicular to τ_0.
    pub across: f64,
}

impl<'a> Prestress<'a> {
    /// Initial stress at a fault, if a body beside it has one.
    pub fn new(scene: &'a Scene, Entry { name, spec }: Entry<'a, Spec>) -> Option<Self> {
        let bodies = [&spec.minus, &spec.plus].map(|side| scene.body_of(side));
        let given = bodies.iter().flatten().find_map(|b| b.initial_stress.as_ref())?;
        let stress = |body: &Option<&Body>| body.and_then(initial_stress::uniform).unwrap_or([0.0; 6]);
        let sides = [stress(&bodies[0]), stress(&bodies[1])];
        Some(Self { name, sides, presses: given.get_ref().presses(), place: given.span(), spec })
    }

    /// Tractions at a freely sliding point. If weight acts as well, only the sum is checked, and not here.
    ///
    /// # Errors
    /// [`Diagnostic`] if both sides are not in balance; see also [`Self::admit`].
    pub fn start<const D: usize>(
        &self,
        model: &Model<D>,
        place: &Place<D>,
        weighs: bool,
    ) -> Result<ResolvedTractions, Diagnostic> {
        let found = self.at(model, place)?;
        if !weighs {
            self.admit(place, &found)?;
        }
        Ok(found)
    }

    /// Tractions of the stress at a point.
    ///
    /// # Errors
    /// [`Diagnostic`] if both sides are not in balance.
    fn at<const D: usize>(
        &self,
        model: &Model<D>,
        place: &Place<D>,
    ) -> Result<ResolvedTractions, Diagnostic> {
        let n = in_space(&place.normal);
        let slides = match model.idealisation.components() {
            1 => [0.0, 0.0, 1.0],
            2 => tangent(&n),
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
        Ok(ResolvedTractions { normal, shear: dot(&minus, &slides), across })
    }

    /// Refuses tractions at a point under which the fault would not slip as requested, if they are due to the initial
    /// stress alone.
    ///
    /// # Errors
    /// [`Diagnostic`] if the fault is not pressed, or if friction would not resist its motion.
    fn admit<const D: usize>(&self, place: &Place<D>, found: &ResolvedTractions) -> Result<(), Diagnostic> {
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

/// True if friction under this shear traction \[Pa\] would not resist the initial motion.
pub(super) fn against(spec: &Spec, shear: f64) -> bool {
    shear * spec.rate.get_ref().0.signum() <= 0.0
}

/// True if vector slip would not start along the rake.
pub(super) fn strays(spec: &Spec, found: &ResolvedTractions) -> bool {
    let free = spec.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
    free && found.across.abs() > ALONG * found.shear.abs()
}

fn in_space<const D: usize>(v: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Traction σ n.
fn traction([xx, yy, zz, xy, yz, zx]: &[f64; 6], n: &[f64; 3]) -> [f64; 3] {
    [dot(&[*xx, *xy, *zx], n), dot(&[*xy, *yy, *yz], n), dot(&[*zx, *yz, *zz], n)]
}
