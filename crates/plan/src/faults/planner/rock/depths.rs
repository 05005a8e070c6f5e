//! Faults in space that are given by depths on a map, such as the interface of two plates.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{DepthTriangles, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::surfaces;
use crate::shared::place::{self, Frame};
use asperity_fem::mesh::netcdf;
use asperity_fem::mesh::sheet::{self, Depths, Sheet, SheetError};
use asperity_fem::mesh::triangles::Triangles;

/// Farthest position from the origin that is projected: lengths are 1 % too large there \[m\].
const FARTHEST: f64 = 900e3;

/// Triangles of the part of a surface between two depths, in the axes of the scene, and a note about them.
///
/// # Errors
/// [`Diagnostic`] at the file or the depths, if the surface is not one sheet there.
pub(super) fn triangles(
    scene: &Scene,
    Entry { name, spec }: Entry<'_, DepthTriangles>,
    bytes: &[u8],
) -> Result<(Triangles, String), Diagnostic> {
    let Some(frame) = place::frame(scene, true)? else {
        return Err(Diagnostic::at(spec.file.span(), "depths on a map need a `[place]`", PLACE));
    };
    let refuse = |error: SheetError| refused(spec, &error);
    let unit = surfaces::unit(Some(&spec.unit))?;
    let mut rows = rows(spec, bytes)?;
    let heights = turn_heights(&mut rows);
    let depths = Depths::new(&samples(spec, &frame, rows, unit)?).map_err(refuse)?;
    let [top, bottom, size] = [&spec.top, &spec.bottom, &spec.size].map(|length| length.get_ref().0);
    let sheet = sheet::triangles(&depths, [top, bottom], size).map_err(refuse)?;
    let note = format!(
        "fault `{name}` is divided at {} contours between depths of {top} and {bottom} m; angles of its triangles are at least {:.0} degrees{}",
        sheet.rows.len(),
        sheet.least_angle().to_degrees(),
        if heights {
            "; its file has heights, with no depth above zero, which count as depths below"
        } else {
            ""
        },
    );
    let count = sheet.corners.len();
    let Sheet { nodes, corners, .. } = sheet;
    let nodes = nodes.into_iter().map(|[x, y, up]| frame.position([x, y], -up)).collect();
    let elements = (1..=count as u64).collect();
    Ok((Triangles { nodes, corners, elements, pieces: vec![(0..count).collect()], turned: 0 }, note))
}

/// Positions on the map and depths \[m\], from longitudes, latitudes and depths in this unit \[m\].
fn samples(
    spec: &DepthTriangles,
    frame: &Frame,
    rows: Vec<[f64; 3]>,
    unit: f64,
) -> Result<Vec<[f64; 3]>, Diagnostic> {
    let map = frame.map();
    let sample = |[longitude, latitude, depth]: [f64; 3]| {
        let near = |x: &[f64; 2]| x[0].hypot(x[1]) < FARTHEST;
        let at = map.metres(longitude, latitude).filter(near);
        let [x, y] = at.ok_or_else(|| far(spec, [longitude, latitude]))?;
        Ok([x, y, depth * unit])
    };
    rows.into_iter().map(sample).collect()
}

/// Longitudes, latitudes and depths of a file: a grid in netCDF, or text. Positions without a depth are left out.
fn rows(spec: &DepthTriangles, bytes: &[u8]) -> Result<Vec<[f64; 3]>, Diagnostic> {
    if !netcdf::is_netcdf(bytes) {
        return sheet::rows(&String::from_utf8_lossy(bytes)).map_err(|error| refused(spec, &error));
    }
    let mut rows = netcdf::rows(bytes).map_err(|error| {
        let message = format!("file `{}`: {error}", spec.file.get_ref());
        Diagnostic::at(spec.file.span(), message, GRID)
    })?;
    rows.retain(|row| row[2].is_finite());
    Ok(rows)
}

/// Turns heights, such as those of Slab2, into depths; true if the file has heights: none above zero, and some below.
fn turn_heights(rows: &mut [[f64; 3]]) -> bool {
    let heights = rows.iter().all(|row| row[2] <= 0.0) && rows.iter().any(|row| row[2] < 0.0);
    if heights {
        rows.iter_mut().for_each(|row| row[2] = -row[2]);
    }
    heights
}

/// Help for a grid that is not read.
const GRID: &str = "a grid has one variable of depths over longitude and latitude, such as `z(lat, lon)`, in the classic format or netCDF-4; `nccopy -k classic a.nc b.nc` writes the classic format";

const PLACE: &str = "the origin and the axes of the map: such as `[place]` with `latitude`, `longitude`, `strike = \"0 deg\"`, `up = [0, 1, 0]` and `along = [0, 0, -1]`, for x to the east and z to the south";

fn far(spec: &DepthTriangles, [longitude, latitude]: [f64; 2]) -> Diagnostic {
    Diagnostic::at(
        spec.file.span(),
        format!(
            "file `{}` has a position at longitude {longitude} and latitude {latitude}, which is not within {} km of the origin",
            spec.file.get_ref(),
            FARTHEST / 1e3
        ),
        "columns are longitude, latitude and depth; `[place]` has the longitude and latitude of the origin",
    )
}

fn refused(spec: &DepthTriangles, error: &SheetError) -> Diagnostic {
    let message = format!("file `{}`: {error}", spec.file.get_ref());
    let (top, bottom) = (spec.top.get_ref().0, spec.bottom.get_ref().0);
    let (span, help) = match error {
        SheetError::Line { .. } => {
            (spec.file.span(), "a line is such as `134.5 33.2 12.5`; comments begin with `#` or `>`")
        }
        SheetError::Few { .. } => (spec.file.span(), "rows whose depth is NaN do not count"),
        SheetError::Twice { .. } => (spec.file.span(), "a surface has one depth at each position"),
        SheetError::Outside { depth, .. } => {
            let span = if *depth == top { spec.top.span() } else { spec.bottom.span() };
            (span, "depths increase downwards, and `unit` is that of the depths in the file")
        }
        SheetError::Ends { .. } => (spec.bottom.span(), "a smaller `bottom`, or data that reach farther"),
        SheetError::Left { .. } => (spec.top.span(), "another `top`, or data without gaps there"),
        SheetError::Parts { depth, .. }
        | SheetError::Closed { depth, .. }
        | SheetError::Short { depth, .. } => {
            let nearer_top = (depth - top).abs() < (depth - bottom).abs();
            let span = if nearer_top { spec.top.span() } else { spec.bottom.span() };
            (span, "between `top` and `bottom`, contours must run from one end of the data to the other")
        }
        SheetError::Many { .. } => (spec.size.span(), "a larger `size`"),
    };
    Diagnostic::at(span, message, help)
}
