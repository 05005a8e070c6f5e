//! Sites on Earth as receivers in the free surface.

use crate::reading::columns::file::{read, refused};
use crate::reading::columns::{Columns, Wrong};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Scene;
use crate::reading::scene::units::Dimension;
use crate::shared::place;
use crate::shared::place::Frame;
use std::collections::BTreeSet;
use std::ops::Range;

/// Name, place in the scene, and position of a receiver \[m\].
pub(super) type ReceiverPosition = (String, Range<usize>, [f64; 3]);

/// Farthest position from the origin that is projected: lengths are 1 % too large there \[m\].
const FARTHEST: f64 = 900e3;

/// Sites of a scene, and then those of its file.
///
/// # Errors
/// [`Diagnostic`] at a site that is far from the origin, or at a file that cannot be read.
pub(super) fn positions(scene: &Scene, in_space: bool) -> Result<Vec<ReceiverPosition>, Diagnostic> {
    let Some(frame) = place::frame(scene, in_space)? else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for (name, site) in &scene.output.sites {
        let [longitude, latitude] =
            [&site.get_ref().longitude, &site.get_ref().latitude].map(|a| a.get_ref().0);
        all.push(given(&frame, name, site.span(), [longitude, latitude])?);
    }
    let Some(file) = &scene.output.site_file else { return Ok(all) };
    let columns = read(&scene.folder, file)?;
    let wrong = |wrong: Wrong| refused(file, file.span(), wrong);
    let names = columns.texts("name").map_err(wrong)?;
    let [longitude, latitude] =
        [["longitude", "lon"], ["latitude", "lat"]].map(|both| degrees(&columns, both).map_err(wrong));
    let (longitude, latitude) = (longitude?, latitude?);
    let mut taken: BTreeSet<String> =
        scene.output.sites.keys().chain(scene.output.receivers.keys()).cloned().collect();
    for (row, name) in names.into_iter().enumerate() {
        let at = |message: String, help: &str| {
            wrong(Wrong::new(format!("line {}: {message}", columns.line(row)), help))
        };
        if name.is_empty() || !name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-') {
            return Err(at(
                format!("`{name}` cannot be the name of a site"),
                "names consist of letters, digits, `_` and `-`",
            ));
        }
        if !taken.insert(name.clone()) {
            return Err(at(format!("there is another receiver `{name}`"), "one name for each"));
        }
        let position = [longitude[row], latitude[row]];
        if !(position[0].abs() <= std::f64::consts::TAU && position[1].abs() <= std::f64::consts::FRAC_PI_2) {
            return Err(at(
                "no longitude and latitude in degrees".into(),
                "longitudes lie between -180 and 360 degrees, latitudes between -90 and 90",
            ));
        }
        all.push(given(&frame, &name, file.span(), position)?);
    }
    Ok(all)
}

/// Angles of a column with one of two names, in degrees where it has no unit \[rad\].
fn degrees(columns: &Columns, [long, short]: [&str; 2]) -> Result<Vec<f64>, Wrong> {
    let name = if columns.names().any(|name| name == short) { short } else { long };
    columns.numbers_in(name, Some(Dimension::Angle), (!columns.has_unit(name)).then_some("deg"))
}

/// Receiver in the free surface y = 0 at a longitude and latitude \[rad\].
fn given(
    frame: &Frame,
    name: &str,
    span: Range<usize>,
    at: [f64; 2],
) -> Result<ReceiverPosition, Diagnostic> {
    let [longitude, latitude] = at.map(f64::to_degrees);
    let near = |x: &[f64; 2]| x[0].hypot(x[1]) < FARTHEST;
    let Some(offset) = frame.map().metres(longitude, latitude).filter(near) else {
        return Err(Diagnostic::at(
            span,
            format!(
                "site `{name}` at longitude {longitude:.6} and latitude {latitude:.6} is not within {} km of the origin",
                FARTHEST / 1e3
            ),
            "longitudes, east positive, and latitudes around those of `[place]`",
        ));
    };
    let [x, _, z] = frame.level(offset);
    Ok((name.to_string(), span, [x, 0.0, z]))
}
