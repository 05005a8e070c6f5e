//! Friction of an interface: the law of all its points, or laws of its points where files give parameters.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::{self, LawChoice};
use crate::reading::scene::model::{Interface, LawFields, LawSpec, Scene, Spanned, field_dimension};
use crate::shared::entry::Entry;
use crate::shared::field::{Bound, Field, Files, Parameter, Region, Spot};
use crate::shared::law_errors::refused;
use crate::shared::model::Model;
use asperity_friction::Failure;
use asperity_friction::law::Law;
use asperity_laws::{self as laws, Theta};
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use std::sync::Arc;

/// Friction of an interface, as chosen by the scene.
pub(super) struct Friction {
    /// Law of all slave points, or laws of each in their order.
    laws: Vec<LawChoice>,
    /// Notes on what files give.
    pub notes: Vec<String>,
    /// Warnings of files whose values or positions are doubtful.
    pub warnings: Vec<Warning>,
}

impl Friction {
    /// Friction of an interface with slave points at these nodes of the mesh; `None` if it has none.
    ///
    /// # Errors
    /// [`Diagnostic`] for a law that cannot be built, or a file that cannot be used.
    pub fn choose<const D: usize>(
        scene: &Scene,
        model: &Model<D>,
        Entry { name, spec }: Entry<'_, Interface>,
        nodes: &[usize],
    ) -> Result<Option<Self>, Diagnostic> {
        let Some(given) = &spec.law else { return Ok(None) };
        let base = chosen(given)?;
        if spec.fields.given().next().is_none() {
            return Ok(Some(Self { laws: vec![base], notes: Vec::new(), warnings: Vec::new() }));
        }
        let spots: Vec<Spot<D>> =
            nodes.iter().map(|&n| Spot { at: model.mesh.nodes[n], along: None }).collect();
        let name = format!("interface `{name}`");
        let region = Region { scene, spots: &spots, name: &name };
        let fields = read(&region, &spec.fields, &base)?;
        let laws =
            spots.iter().map(|spot| at(spot, &name, (given, &base), &fields)).collect::<Result<_, _>>()?;
        let mut all = Self { laws, notes: Vec::new(), warnings: Vec::new() };
        for (_, field) in &fields {
            all.warnings.extend(field.doubts(&name, &spots));
            all.notes.push(field.note(&name, spots.iter()));
        }
        Ok(Some(all))
    }

    /// Law of all points, or laws of each.
    pub fn laws(&self) -> &[LawChoice] {
        &self.laws
    }

    /// Law of a slave point.
    pub fn at(&self, point: usize) -> &LawChoice {
        self.laws.get(point).unwrap_or(&self.laws[0])
    }

    /// True if the law is the same at all points.
    pub fn is_uniform(&self) -> bool {
        self.laws.len() == 1
    }

    /// The state θ of all points, or of each; empty if the law has none.
    pub fn thetas(&self) -> Vec<Theta> {
        self.laws.iter().map(Theta::from_law).collect::<Option<_>>().unwrap_or_default()
    }

    /// Builds the law.
    ///
    /// # Errors
    /// [`Diagnostic`] at the parameter that causes it.
    pub fn build(&self, spec: &Spanned<LawSpec>) -> Result<Arc<dyn Law>, Diagnostic> {
        let built = match self.laws.as_slice() {
            [law] => laws::build(law),
            [first, rest @ ..] => laws::build_each(first, rest),
            [] => return Err(incomplete(spec)),
        };
        built.map_err(|failure| refused(spec, &failure))
    }
}

/// Law of a specification.
fn chosen(spec: &Spanned<LawSpec>) -> Result<LawChoice, Diagnostic> {
    laws::choose(spec).map_err(|errors| errors.into_iter().next().unwrap_or_else(|| incomplete(spec)))
}

fn incomplete(spec: &Spanned<LawSpec>) -> Diagnostic {
    Diagnostic::at(spec.span(), "the law is not complete", "see the laws of friction")
}

/// Fields of an interface, with the names of their parameters.
type Read<const D: usize> = Vec<(&'static str, Field<D>)>;

/// Reads the files of an interface.
fn read<const D: usize>(
    region: &Region<'_, D>,
    given: &LawFields,
    law: &LawChoice,
) -> Result<Read<D>, Diagnostic> {
    let mut files = Files::default();
    let mut fields = Vec::new();
    for (key, given) in given.given() {
        let bound = match law.varies(key, laws::known()) {
            Some(law::Bound::NotNegative | law::Bound::BelowReference) => Bound::NotNegative,
            Some(law::Bound::Finite) => Bound::Free,
            // The check of the scene has refused parameters that the law does not have.
            Some(law::Bound::Positive) | None => Bound::Positive,
        };
        let parameter = Parameter { key, dimension: field_dimension(key), bound };
        fields.push((key, Field::read(&mut files, region, given, &parameter)?));
    }
    Ok(fields)
}

/// Law of a point.
fn at<const D: usize>(
    spot: &Spot<D>,
    name: &str,
    (spec, base): (&Spanned<LawSpec>, &LawChoice),
    fields: &Read<D>,
) -> Result<LawChoice, Diagnostic> {
    let mut law = base.clone();
    for (key, field) in fields {
        let value = field.at(name, spot)?;
        law = law.clone().with(key, value, laws::known()).unwrap_or(law);
    }
    let Err(failure) = laws::build(&law) else { return Ok(law) };
    let error = refused(spec, &failure);
    let named = |key: &str| matches!(&failure, Failure::Parameter { name, .. } if *name == key);
    let field = fields.iter().find(|(key, _)| named(key)).or(fields.first());
    let place = field.map_or_else(|| spec.span(), |(_, field)| field.span.clone());
    let message = format!("at the point of {name} at {}, {}", coordinates::in_words(&spot.at), error.message);
    Err(Diagnostic::at(
        place,
        message,
        "parameters of a point must fit together: check the columns and the law",
    ))
}
