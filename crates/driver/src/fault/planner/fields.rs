//! Parameters of a fault from files, at its points.

mod axes;
pub mod samples;

use super::placed::Placed;
use crate::columns::file::{read, refused};
use crate::columns::{Columns, Wrong};
use crate::diagnostic::Diagnostic;
use crate::scene::model::{Fault as Spec, Field as Given, FieldInterpolation, Scene};
use crate::scene::units::Dimension;
use asperity_cycles::medium::Place;
use asperity_mechanics::coordinates;
use axes::Axes;
use samples::Samples;
use std::collections::BTreeMap;
use std::ops::Range;

/// Number of parameters that files may give.
pub(super) const PARAMETERS: usize = 5;

/// Parameters of a fault from files: a, b, L, normal and shear traction.
pub(super) struct Fields<const D: usize> {
    all: [Option<Field<D>>; PARAMETERS],
    fault: String,
}

/// One parameter.
struct Field<const D: usize> {
    key: &'static str,
    file: String,
    span: Range<usize>,
    axes: Axes<D>,
    samples: Samples,
}

impl<const D: usize> Fields<D> {
    /// Reads the files of a fault with points at these places.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file that cannot be used.
    pub fn read(scene: &Scene, (name, spec): (&str, &Spec), places: &[Place<D>]) -> Result<Self, Diagnostic> {
        let mut tables: BTreeMap<&str, Columns> = BTreeMap::new();
        let mut all = [const { None }; PARAMETERS];
        for (slot, (key, given)) in all.iter_mut().zip(spec.fields.all()) {
            let Some(given) = given else { continue };
            let file = given.file.get_ref().as_str();
            let refuse = |wrong: Wrong| refused(&given.file, given.file.span(), wrong);
            if !tables.contains_key(file) {
                tables.insert(file, read(&scene.folder, &given.file)?);
            }
            let columns = &tables[file];
            let axes = Axes::of(scene, columns, places).map_err(refuse)?;
            let values = values((key, given), columns, spec.rate.get_ref().0).map_err(refuse)?;
            let nearest =
                given.interpolation.as_ref().is_some_and(|i| *i.get_ref() == FieldInterpolation::Nearest);
            let samples =
                Samples::new(axes.positions(), &values, nearest).map_err(|why| refuse(axes.explain(&why)))?;
            *slot = Some(Field { key, file: file.to_string(), span: given.file.span(), axes, samples });
        }
        Ok(Self { all, fault: name.to_string() })
    }

    /// Parameters at a point; `None` for those without a file.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file whose positions do not surround the point.
    pub fn at(&self, place: &Place<D>) -> Result<[Option<f64>; PARAMETERS], Diagnostic> {
        let mut values = [None; PARAMETERS];
        for (value, field) in values.iter_mut().zip(&self.all) {
            let Some(field) = field else { continue };
            let at = field.axes.coordinates(place);
            *value = Some(field.samples.at(&at).ok_or_else(|| self.outside(field, place))?);
        }
        Ok(values)
    }

    fn outside(&self, field: &Field<D>, place: &Place<D>) -> Diagnostic {
        Diagnostic::at(
            field.span.clone(),
            format!(
                "a point of fault `{}` at {} lies outside the positions of `{}`, which go {}",
                self.fault,
                coordinates::in_words(&place.at),
                field.file,
                field.axes.extent(),
            ),
            format!(
                "`{}` needs values all over the sliding part of the fault; check signs and units",
                field.key
            ),
        )
    }

    /// Notes on what the files give to the points that slide.
    pub fn notes(&self, placed: &[Placed<D>]) -> Vec<String> {
        let fields = self.all.iter().flatten();
        let note = |field: &Field<D>| {
            let sliding = placed.iter().filter(|p| p.point.creep.is_none());
            let values = sliding.filter_map(|p| field.samples.at(&field.axes.coordinates(&p.point.place)));
            let (least, most) =
                values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
            format!(
                "fault `{}`: `{}` from {} positions of `{}`, {} by {}; from {least:e} to {most:e} at points",
                self.fault,
                field.key,
                field.samples.count(),
                field.file,
                field.samples.words(),
                field.axes.words(),
            )
        };
        fields.map(note).collect()
    }
}

/// Dimension of a parameter; none of a number.
fn dimension(key: &str) -> Option<Dimension> {
    match key {
        "l" => Some(Dimension::Length),
        "normal" | "shear" => Some(Dimension::Pressure),
        _ => None,
    }
}

/// Values of a parameter of a fault with this slip rate, in the order of the rows.
fn values((key, given): (&str, &Given), columns: &Columns, rate: f64) -> Result<Vec<f64>, Wrong> {
    let column = given.column.as_ref().map_or(key, |c| c.get_ref().as_str());
    let values = columns.numbers(column, dimension(key))?;
    let sign = match key {
        "shear" if rate == 0.0 => None,
        "shear" => Some(rate.signum()),
        _ => Some(1.0),
    };
    if let Some(row) = values.iter().position(|v| sign.is_some_and(|sign| v * sign <= 0.0)) {
        let what = if key == "shear" { "have the sign of `rate`" } else { "be positive" };
        return Err(Wrong {
            message: format!("line {}: `{column}` must {what}, found {:?}", columns.line(row), values[row]),
            help: "check its sign and its unit".into(),
        });
    }
    if values.iter().all(|v| *v == values[0]) {
        return Err(Wrong {
            message: format!("all values of its column `{column}` are {:?}", values[0]),
            help: format!("give the one value instead of a file, or name another `column` for `{key}`"),
        });
    }
    Ok(values)
}
