//! Positions in tables of events: those of the scene, and where they lie on Earth.

use super::receivers::STRIKE;
use crate::cases::run_files::WrittenRun;
use crate::{CaseError, Evidence, Ledger};

/// Latitude and longitude of the origin of the scenes \[degrees\].
pub(super) const ORIGIN: [f64; 2] = [10.0, 20.0];
/// Half of the last of the digits of an angle that are compared \[rad\].
const DIGITS: f64 = 1e-11;

/// Radii of curvature M and N of WGS84, along the meridian and across it, at a latitude \[m\].
fn radii(latitude: f64) -> [f64; 2] {
    let (major, squared) = (6_378_137.0, 6.694_379_990_141e-3);
    let root = (1.0 - squared * latitude.sin().powi(2)).sqrt();
    [major * (1.0 - squared) / root.powi(3), major / root]
}

/// Latitude and longitude \[rad\] of a way to the north and east of the origin \[m\], to second order of the transverse Mercator
/// projection.
fn travelled(north: f64, east: f64) -> [f64; 2] {
    let [latitude, longitude] = ORIGIN.map(f64::to_radians);
    let half = latitude + 0.5 * north / radii(latitude)[0];
    let foot = latitude + north / radii(half)[0];
    let [along, across] = radii(foot);
    [foot - east * east * foot.tan() / (2.0 * along * across), longitude + east / (across * foot.cos())]
}

/// Largest errors of positions \[m\], of longitudes and latitudes over the third power of the arc from the origin, and of depths
/// \[m\], in the columns of these six.
fn errors(columns: &[Vec<f64>], wanted: &[[f64; 3]]) -> [f64; 3] {
    let (sine, cosine) = STRIKE.to_radians().sin_cos();
    let mut worst = [0.0_f64; 3];
    for (k, &[x, y, z]) in wanted.iter().enumerate() {
        let row = |c: usize| columns[c].get(k).copied().unwrap_or(f64::INFINITY);
        // x points to the right of the strike, and -z along it.
        let [north, east] = [-z * cosine - x * sine, -z * sine + x * cosine];
        let [latitude, longitude] = travelled(north, east);
        let off = [row(4).to_radians() - latitude, (row(3).to_radians() - longitude) * latitude.cos()];
        let arc = north.hypot(east) / radii(latitude)[0];
        let errors = [
            (row(0) - x).abs().max((row(1) - y).abs()).max((row(2) - z).abs()),
            off[0].hypot(off[1]) / (arc.powi(3) + DIGITS),
            (row(5) + y).abs(),
        ];
        worst = std::array::from_fn(|c| worst[c].max(errors[c]));
    }
    worst
}

/// Claims the positions in a table of an event, and their longitudes, latitudes and depths.
///
/// # Errors
/// If the table has not these columns, or other rows.
pub(super) fn claims(
    ledger: &mut Ledger,
    done: &WrittenRun,
    file: &str,
    wanted: &[[f64; 3]],
) -> Result<(), CaseError> {
    let table = done.files.table(file)?;
    let columns = ["x", "y", "z", "longitude", "latitude", "depth"].map(|name| table.column(name));
    let all: Vec<Vec<f64>> = columns.into_iter().collect::<Result<_, _>>()?;
    if all[0].len() != wanted.len() {
        return Err(format!("{file} has {} rows, and not {}", all[0].len(), wanted.len()).into());
    }
    let worst = errors(&all, wanted);
    for (what, unit, value, bound, source, because) in [
        ("x, y and z", "m", worst[0], 1e-6, "positions of the scene", "rounding of kilometres"),
        (
            "longitude and latitude, over the third power of the arc from the origin",
            "-",
            worst[1],
            1.0,
            "Snyder (1987), transverse Mercator projection, equations 8-17 and 8-18, to second order",
            "third order has the factor (1 + 2 tan^2)/6 at most, 0.2 at a latitude of 10 degrees, and radii change by 0.3 % of the arc within it",
        ),
        (
            "depth",
            "m",
            worst[2],
            1e-6,
            "-y of the scene, whose origin lies at the surface",
            "rounding of kilometres",
        ),
    ] {
        ledger
            .claim(format!("positions in {file}: {what}, largest error"))
            .unit(unit)
            .value(value)
            .at_most(bound)
            .evidence(Evidence::Exact, source)
            .because(because)
            .why_not_tighter("rounding and terms of third order depend on the place; an axis that is exchanged or reversed is off by kilometres")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}
