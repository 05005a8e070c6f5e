//! Points and sets whose values a scene requests, located in the bodies.

use super::{self as model, Model};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{PointSpec, Scene, Spanned};
use asperity_fem::mesh::locate;
use asperity_mechanics::coordinates::in_words;
use asperity_mechanics::{ForceSet, Point, SampleRequest};

/// Locates the points and sets of a scene.
///
/// # Errors
/// [`Diagnostic`] for a point outside its body or a set that does not exist.
pub fn find<const D: usize>(scene: &Scene, model: &Model<D>) -> Result<SampleRequest, Diagnostic> {
    let points = scene.output.points.iter().map(|(name, spec)| point(model, name, spec));
    let forces = scene.output.forces.iter().map(|(name, spec)| {
        let set = &spec.get_ref().set;
        Ok::<_, Diagnostic>(ForceSet::new(model, name, set.get_ref(), model::nodes(model, set)?))
    });
    Ok(SampleRequest { points: points.collect::<Result<_, _>>()?, forces: forces.collect::<Result<_, _>>()? })
}

fn point<const D: usize>(
    model: &Model<D>,
    name: &str,
    spec: &Spanned<PointSpec>,
) -> Result<Point, Diagnostic> {
    let (given, at) = (&spec.get_ref().body, &spec.get_ref().at);
    let refuse =
        |place: std::ops::Range<usize>, message: String, help: String| Diagnostic::at(place, message, help);
    let body = model.bodies.iter().find(|b| b.name == *given.get_ref()).ok_or_else(|| {
        refuse(
            given.span(),
            format!("there is no body `{}`", given.get_ref()),
            "name a body of the scene".into(),
        )
    })?;
    let position: Vec<f64> = at.get_ref().iter().map(|x| x.0).collect();
    let x = <[f64; D]>::try_from(position.clone()).map_err(|_| {
        refuse(at.span(), format!("the point `{name}` is not a place"), format!("give {D} lengths"))
    })?;
    let found = locate(&model.mesh, body.blocks.clone(), &x).ok_or_else(|| {
        let nodes = &model.mesh.nodes[body.nodes.clone()];
        let (min, max) = super::bounds(nodes);
        refuse(
            at.span(),
            format!("the point `{name}` at {} lies outside body `{}`", in_words(&x), body.name),
            format!("the body lies between {} and {}", in_words(&min), in_words(&max)),
        )
    })?;
    Ok(Point::new(model, name, &body.name, position, &found))
}
