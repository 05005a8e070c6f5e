//! Parameters of a fault from files, at its points.

use super::placed_point::PlacedPoint;
use super::remarks::Remarks;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Fault as Spec, Scene, field_dimension};
use crate::shared::entry::Entry;
use crate::shared::field::{Bound, Field, Files, Parameter, Region, Spot};
use asperity_cycles::medium::Place;
use asperity_laws::Theta;

/// Number of parameters that files may give.
pub(super) const PARAMETERS: usize = 9;

/// Parameters of a fault from files, in the order of the fields of the scene.
pub(super) struct Fields<const D: usize> {
    all: [Option<Field<D>>; PARAMETERS],
    region: String,
}

impl<const D: usize> Fields<D> {
    /// Reads the files of a fault with points at these places.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file that cannot be used.
    pub fn read(
        scene: &Scene,
        Entry { name, spec }: Entry<'_, Spec>,
        base: &LawChoice,
        places: &[Place<D>],
    ) -> Result<Self, Diagnostic> {
        let theta = Theta::from_law(base).is_some();
        let name = format!("fault `{name}`");
        let spots: Vec<Spot<D>> = places.iter().map(spot).collect();
        let region = Region { scene, spots: &spots, name: &name };
        let mut files = Files::default();
        let mut all = [const { None }; PARAMETERS];
        for (slot, (key, given)) in all.iter_mut().zip(spec.fields.all()) {
            let Some(given) = given else { continue };
            let parameter = Parameter {
                key,
                dimension: if key == "state" && !theta { None } else { field_dimension(key) },
                bound: match (key, spec.rate.get_ref().0) {
                    ("shear", 0.0) | ("a_minus_b", _) => Bound::Free,
                    ("shear" | "rate", rate) => Bound::Signed(rate.signum()),
                    ("cohesion", _) => Bound::NotNegative,
                    ("state", _) if !theta => Bound::Free,
                    _ => Bound::Positive,
                },
            };
            *slot = Some(Field::read(&mut files, &region, given, &parameter)?);
        }
        Ok(Self { all, region: name })
    }

    /// Parameters at a point; `None` for those without a file.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file that has no value at the point.
    pub fn at(&self, place: &Place<D>) -> Result<[Option<f64>; PARAMETERS], Diagnostic> {
        let mut values = [None; PARAMETERS];
        for (value, field) in values.iter_mut().zip(&self.all) {
            *value = field.as_ref().map(|field| field.at(&self.region, &spot(place))).transpose()?;
        }
        Ok(values)
    }

    /// Adds warnings of files that reach too far, and notes on what they give to the points that slide.
    pub fn describe(&self, placed: &[PlacedPoint<D>], remarks: &mut Remarks) {
        let sliding = placed.iter().filter(|p| p.point.creep.is_none());
        let spots: Vec<Spot<D>> = sliding.map(|p| spot(&p.point.place)).collect();
        for field in self.all.iter().flatten() {
            remarks.warnings.extend(field.doubts(&self.region, &spots));
            remarks.notes.push(field.note(&self.region, spots.iter()));
        }
    }
}

/// Position of a point of a fault.
fn spot<const D: usize>(place: &Place<D>) -> Spot<D> {
    Spot { at: place.at, along: Some(place.along) }
}
