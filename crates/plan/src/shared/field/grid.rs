//! Fields on grids in netCDF.

use super::axes::{Axes, Lists};
use super::field_request::{FieldRequest, Source, checked};
use super::lattice::Lattice;
use super::region::Region;
use crate::reading::columns::unit::FilePart;
use crate::reading::columns::{Wrong, unit};
use crate::reading::scene::model::FieldInterpolation;
use crate::reading::scene::units::{self, Dimension};
use asperity_fem::mesh::netcdf::NetcdfError;
use asperity_fem::mesh::netcdf::gridded_variable::{self, Coordinate, GriddedVariable};
use asperity_scene::suggestions::suggest;

/// Help for a grid that is not read.
const FORM: &str = "a grid has a variable over one or two coordinates, such as `a(y, x)`, in the classic format or netCDF-4; `nccopy -k classic a.nc b.nc` writes the classic format";

/// Coordinates and values of a grid.
pub(super) fn field<const D: usize>(
    region: &Region<'_, D>,
    bytes: &[u8],
    asked: &FieldRequest<'_>,
) -> Result<(Axes<D>, Source), Wrong> {
    let grid = gridded_variable::variable(bytes, asked.name).map_err(|error| match &error {
        NetcdfError::NoVariable { name, names } => {
            Wrong::new(error.to_string(), suggest(name, "variables", names.iter().map(String::as_str)))
        }
        _ => Wrong::new(error.to_string(), FORM),
    })?;
    let factor = size_of("variable", asked.name, &grid.unit, asked.unit, asked.dimension())?;
    let own: Vec<&str> = grid.coordinates.iter().map(|c| c.name.as_str()).collect();
    if let Some((_, name)) =
        asked.given.coordinates.named().find(|(_, name)| !own.contains(&name.get_ref().as_str()))
    {
        let name = name.get_ref();
        let help = suggest(name, "coordinates", own.iter().copied());
        return Err(Wrong::new(format!("it has no coordinate `{name}`"), help));
    }
    let mut axes = Vec::new();
    for coordinate in &grid.coordinates {
        axes.push((meaning(coordinate, asked)?, scaled(coordinate, asked)?));
    }
    let mut values = asked.plain(grid.values.iter().map(|v| v * factor).collect());
    let place = |k: usize| at(&grid, k);
    checked(&values, asked, "variable", &place)?;
    if axes.len() == 2 && order(axes[0].0) > order(axes[1].0) {
        let [rows, columns] = [axes[0].1.len(), axes[1].1.len()];
        let turned = |k: usize| values[(k % rows) * columns + k / rows];
        values = (0..values.len()).map(turned).collect();
        axes.swap(0, 1);
    }
    let (names, lists): (Vec<&'static str>, Lists) = axes.into_iter().unzip();
    let all = Axes::from_grid(region, &names, &lists)?;
    let nearest = asked.interpolation == Some(FieldInterpolation::Nearest);
    Ok((all, Source::Lattice(Lattice::new(&lists, &names, values, nearest)?)))
}

/// Position of a coordinate in the order in which they are taken.
fn order(name: &str) -> usize {
    super::axes::NAMES.iter().position(|n| *n == name).unwrap_or_default()
}

/// Coordinate of the scene that one of a grid means: by its name in the scene, its unit or its own name.
fn meaning(coordinate: &Coordinate, asked: &FieldRequest<'_>) -> Result<&'static str, Wrong> {
    let name = coordinate.name.as_str();
    let mut named = asked.given.coordinates.named().peekable();
    let all = named.peek().is_some();
    let found = if all {
        named.find(|(_, own)| own.get_ref() == name).map(|(key, _)| key)
    } else if coordinate.unit.starts_with("degree") {
        let east = coordinate.unit.contains("east");
        let north = coordinate.unit.contains("north");
        if east { Some("longitude") } else { north.then_some("latitude") }
    } else {
        let long = match name {
            "lon" => "longitude",
            "lat" => "latitude",
            _ => name,
        };
        super::axes::NAMES.into_iter().find(|key| *key == long)
    };
    found.ok_or_else(|| {
        Wrong::new(
            format!("its coordinate `{name}` is not one that the scene knows"),
            format!("`coordinates` with the meaning of each, such as `coordinates = {{ x = \"{name}\" }}`"),
        )
    })
}

/// Values of a coordinate: metres, and degrees of longitude and latitude.
fn scaled(coordinate: &Coordinate, asked: &FieldRequest<'_>) -> Result<Vec<f64>, Wrong> {
    let Coordinate { name, unit, values } = coordinate;
    if matches!(meaning(coordinate, asked)?, "longitude" | "latitude") {
        return Ok(values.clone());
    }
    let factor = size_of("coordinate", name, unit, asked.coordinate_unit, Some(Dimension::Length))?;
    Ok(values.iter().map(|v| v * factor).collect())
}

/// Size of the unit of a variable in SI.
fn size_of(
    what: &str,
    name: &str,
    own: &str,
    stated: Option<&str>,
    dimension: Option<Dimension>,
) -> Result<f64, Wrong> {
    let own = plain(own.trim());
    let found = unit::chosen(FilePart::new(what, name), Some(own), stated, dimension).map_err(|wrong| {
        if !own.is_empty() {
            return wrong;
        }
        let key = if what == "coordinate" { "coordinate_unit" } else { "unit" };
        let si = dimension.map_or("1", Dimension::si);
        Wrong {
            help: format!("the attribute `units` of the file, or `{key} = \"{si}\"` in the scene"),
            ..wrong
        }
    })?;
    let (Some(found), Some(dimension)) = (found, dimension) else { return Ok(1.0) };
    units::parse(&format!("1 {found}"), dimension).map_err(|why| Wrong::new(why.to_string(), FORM))
}

/// Unit as scenes write it.
fn plain(unit: &str) -> &str {
    match unit {
        "meter" | "meters" | "metre" | "metres" => "m",
        "kilometer" | "kilometers" | "kilometre" | "kilometres" => "km",
        "pascal" | "pascals" | "Pascal" => "Pa",
        "dimensionless" | "none" => "1",
        "user_x_unit" | "user_y_unit" | "user_z_unit" | "unknown" => "",
        _ => unit,
    }
}

/// Place of a value of a grid as text.
fn at(grid: &GriddedVariable, k: usize) -> String {
    let mut rest = k;
    let mut parts = Vec::new();
    for coordinate in grid.coordinates.iter().rev() {
        let n = coordinate.values.len();
        parts.push(format!("{} = {}", coordinate.name, coordinate.values[rest % n]));
        rest /= n;
    }
    format!("at {}", parts.join(", "))
}
