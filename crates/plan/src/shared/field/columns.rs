//! Fields in columns of text.

use super::axes::Axes;
use super::field_request::{FieldRequest, Source, checked, coordinates_of};
use super::region::Region;
use super::samples::Samples;
use crate::reading::columns::{Columns, Wrong};
use crate::reading::scene::model::FieldInterpolation;
use crate::reading::scene::units::Dimension;

/// Coordinates and values of a file of columns.
pub(super) fn field<const D: usize>(
    region: &Region<'_, D>,
    columns: &Columns,
    asked: &FieldRequest<'_>,
) -> Result<(Axes<D>, Source), Wrong> {
    let known: Vec<&str> = columns.names().collect();
    let (mut names, mut lists) = (Vec::new(), Vec::new());
    for (name, column) in coordinates_of(asked, &known) {
        let list = match name {
            "longitude" | "latitude" => columns.numbers(column, Some(Dimension::Angle))?,
            _ => columns.numbers_in(column, Some(Dimension::Length), asked.coordinate_unit)?,
        };
        names.push(name);
        lists.push(list);
    }
    let line = |row: usize| format!("line {}", columns.line(row));
    let (axes, positions) = Axes::scattered(region, &names, lists, &line)?;
    let values = asked.plain(columns.numbers_in(asked.name, asked.dimension(), asked.unit)?);
    checked(&values, asked, "column", &line)?;
    let nearest = asked.interpolation == Some(FieldInterpolation::Nearest);
    let samples = Samples::new(&positions, &values, nearest).map_err(|why| axes.explain(&why))?;
    Ok((axes, Source::Samples(samples)))
}
