//! Values of a parameter at positions in a file, evaluated at points of the scene: columns of text, grids in netCDF, files of VTK.

mod axes;
pub mod cells;
mod columns;
mod field_request;
mod files;
mod grid;
pub mod lattice;
mod region;
pub mod samples;
mod vtk;

pub(crate) use field_request::{Bound, Parameter};
pub(crate) use files::Files;
pub(crate) use region::{Region, Spot};

use crate::reading::columns::file::refused;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Field as Given;
use crate::reading::scene::plausibility;
use crate::reading::scene::units::Dimension;
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use axes::Axes;
use field_request::{FieldRequest, Source};
use files::Content;
use std::ops::Range;
use std::path::Path;

/// Share of the extent of a file below which its unit is doubtful: metres taken for kilometres leave a thousandth.
const LEAST_SHARE: f64 = 2e-3;

/// Values of a parameter in a file.
pub(crate) struct Field<const D: usize> {
    key: &'static str,
    file: String,
    /// Position of the name of the file in the scene.
    pub span: Range<usize>,
    /// Dimension of the parameter; none of a number.
    dimension: Option<Dimension>,
    axes: Axes<D>,
    source: Source,
}

impl<const D: usize> Field<D> {
    /// Reads a field.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file that cannot be used.
    pub fn read(
        files: &mut Files,
        region: &Region<'_, D>,
        given: &Given,
        parameter: &Parameter,
    ) -> Result<Self, Diagnostic> {
        let asked = FieldRequest {
            name: given.column.as_ref().map_or(parameter.key, |c| c.get_ref().as_str()),
            parameter,
            unit: given.unit.as_ref().map(|u| u.get_ref().as_str()),
            coordinate_unit: given.coordinate_unit.as_ref().map(|u| u.get_ref().as_str()),
            interpolation: given.interpolation.as_ref().map(|i| *i.get_ref()),
            given,
        };
        let read = match files.content(&region.scene.folder, &given.file)? {
            Content::Columns(columns) => columns::field(region, columns, &asked),
            Content::Netcdf(bytes) => grid::field(region, bytes, &asked),
            Content::Vtk(bytes) => vtk::field(region, bytes, &asked),
        };
        let (axes, source) = read.map_err(|wrong| refused(&given.file, given.file.span(), wrong))?;
        let (key, file) = (parameter.key, given.file.get_ref().clone());
        if let Some(unit) = given.coordinate_unit.as_ref().filter(|_| !axes.has_lengths()) {
            return Err(Diagnostic::at(
                unit.span(),
                format!(
                    "the coordinates of `{file}` are longitude and latitude, in degrees: none is a length"
                ),
                "remove `coordinate_unit`",
            ));
        }
        Ok(Self { key, file, span: given.file.span(), dimension: parameter.dimension, axes, source })
    }

    /// Value at a point; `None` outside, NaN where the file has none.
    fn found(&self, spot: &Spot<D>) -> Option<f64> {
        let at = self.axes.coordinates(spot);
        match &self.source {
            Source::Samples(samples) => samples.at(&at),
            Source::Lattice(lattice) => lattice.at(&at),
            Source::Cells(cells) => cells.at(&at),
        }
    }

    /// Value at a point of a region.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of a file that has no value there.
    pub fn at(&self, region: &str, spot: &Spot<D>) -> Result<f64, Diagnostic> {
        let place = coordinates::in_words(&spot.at);
        let value = self.found(spot).ok_or_else(|| {
            Diagnostic::at(
                self.span.clone(),
                format!(
                    "a point of {region} at {place} lies outside the positions of `{}`, which go {}",
                    self.file,
                    self.axes.extent(),
                ),
                format!("`{}` needs a value there; check signs and units", self.key),
            )
        })?;
        if value.is_finite() {
            return Ok(value);
        }
        Err(Diagnostic::at(
            self.span.clone(),
            format!("a point of {region} at {place} lies where `{}` has no value", self.file),
            format!("`{}` needs a value there, and the file has NaN", self.key),
        ))
    }

    /// Warnings of what the file gives to these points: values and positions whose unit must be wrong.
    pub fn doubts(&self, region: &str, spots: &[Spot<D>]) -> impl Iterator<Item = Warning> {
        let values = spots.iter().filter_map(|spot| self.found(spot));
        let unit = self.dimension.map_or("", Dimension::si);
        let implausible =
            plausibility::judge_file(&["faults", "fields", self.key], unit, values).map(|(message, help)| {
                let message = format!("`{}` of {region} from `{}`: {message}", self.key, self.file);
                Warning::at(self.span.clone(), message, help)
            });
        implausible.into_iter().chain(self.reach(region, spots))
    }

    /// Warning of a file that reaches so much farther than these points that a unit must be wrong.
    fn reach(&self, region: &str, spots: &[Spot<D>]) -> Option<Warning> {
        let (share, along) = self.axes.share(spots);
        (spots.len() > 1 && share < LEAST_SHARE).then(|| {
            let message = format!(
                "the points of {region} spread over {share:.1e} of the extent of `{}` along {along}, which goes {}",
                self.file,
                self.axes.extent()
            );
            Warning::at(self.span.clone(), message, "check the units of its coordinates")
        })
    }

    /// Name of the file without its folder, which is another one where the scene is run again beside its results.
    fn base_name(&self) -> String {
        Path::new(&self.file)
            .file_name()
            .map_or_else(|| self.file.clone(), |n| n.to_string_lossy().into_owned())
    }

    /// Note on what the file gives to these points.
    pub fn note<'a>(&self, region: &str, spots: impl Iterator<Item = &'a Spot<D>>) -> String {
        let values: Vec<f64> = spots.filter_map(|spot| self.found(spot)).collect();
        let (least, most) = values
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
        let (count, words) = match &self.source {
            Source::Samples(samples) => (samples.count(), samples.words()),
            Source::Lattice(lattice) => (lattice.count(), lattice.words()),
            Source::Cells(cells) => (cells.count(), cells.words()),
        };
        let range = if least == most { format!("{least:e}") } else { format!("from {least:e} to {most:e}") };
        let counted = if matches!(&self.source, Source::Cells(_)) { "values" } else { "positions" };
        format!(
            "{region}: `{}` from {count} {counted} of `{}`, {words} by {}; {range} at {} points",
            self.key,
            self.base_name(),
            self.axes.words(),
            values.len(),
        )
    }
}
