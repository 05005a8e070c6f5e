//! Bodies condensed onto the jumps of their faults: what slip and loads do to tractions.

use super::loading::Loading;
use super::operator::Dense;
use super::place::Place;
use crate::model::Model;
use asperity_fem::condense::{Condensation, Condensed, Stiffness};
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::jump::{Jump, Jumps};
use asperity_fem::table::Table;
use asperity_fem::term::Pattern;

/// A point of a fault with what happens there.
#[derive(Clone, Debug)]
pub struct Point<const D: usize> {
    /// Where.
    pub place: Place<D>,
    /// Slip rate, where it is prescribed \[m/s\].
    pub creep: Option<f64>,
}

/// Bodies, condensed.
#[derive(Debug)]
pub struct Surroundings {
    /// Tractions that slip causes.
    pub operator: Dense,
    /// Tractions that loads and creep cause.
    pub loading: Loading,
    /// Memory of the condensation at its worst \[bytes\].
    pub bytes: usize,
}

/// Change of normal traction over that of shear traction below which slip does not change normal tractions: rounding of the
/// condensation, far above 1e-16 and far below any effect of geometry.
const UNCOUPLED: f64 = 1e-9;

/// Condenses the bodies of `model` onto the points that slide freely. Tractions are nodal forces over tributary areas: the
/// interface mass is lumped.
///
/// # Errors
/// A message where the bodies are not held, or a support does not agree with the fault.
pub fn condense<const D: usize>(
    model: &Model<D>,
    constraints: &Constraints,
    points: &[Point<D>],
    end: f64,
) -> Result<Surroundings, String> {
    match model.idealisation.components() {
        1 => with_components::<D, 1>(model, constraints, points, end, |_| [[1.0]]),
        2 => with_components::<D, 2>(model, constraints, points, end, |n| [[-n[1], n[0]], [n[0], n[1]]]),
        _ => Err("faults in three dimensions are not condensed yet".into()),
    }
}

fn with_components<const D: usize, const C: usize>(
    model: &Model<D>,
    constraints: &Constraints,
    points: &[Point<D>],
    end: f64,
    frame: impl Fn(&[f64; D]) -> [[f64; C]; C],
) -> Result<Surroundings, String> {
    let of = |p: &Point<D>| Jump {
        minus: C * p.place.minus,
        plus: C * p.place.plus,
        frame: frame(&p.place.normal),
    };
    let jumps = Jumps::new(points.iter().map(of).collect());
    let body = jumps.stiffness(&stiffness(model));
    let oblique = |e: asperity_fem::jump::ObliqueConstraint| e.to_string();
    // The opening is the last component; where it may change normal tractions it is retained, at zero.
    let slip: Vec<usize> = points.iter().map(|p| C * p.place.plus).collect();
    let free: Vec<usize> = (0..points.len()).filter(|&k| points[k].creep.is_none()).collect();
    let mut retained: Vec<usize> = free.iter().flat_map(|&k| slip[k]..slip[k] + C).collect();
    retained.sort_unstable();
    let mut fixed = jumps.fixed(&constraints.fixed).map_err(oblique)?;
    for (point, &dof) in points.iter().zip(&slip) {
        if point.creep.is_some() {
            fixed.extend(dof..dof + C);
        }
    }
    fixed.sort_unstable();
    fixed.dedup();
    let mut channels = Vec::new();
    for channel in &constraints.channels {
        channels.push(jumps.channel(channel, &constraints.fixed).map_err(oblique)?);
    }
    let creeping = points.iter().zip(&slip).filter_map(|(p, &d)| p.creep.map(|rate| (d, rate)));
    let prescribed: Vec<(usize, f64)> = creeping.collect();
    if !prescribed.is_empty() {
        let amplitude = Table::new(vec![0.0, end], vec![0.0, end]);
        channels.push(Channel { prescribed, forces: Vec::new(), amplitude });
    }
    let analysis = Condensation::analyse(&body, &retained, &fixed).map_err(|e| e.to_string())?;
    let bytes = analysis.bytes();
    let reduction = analysis.factor(usize::MAX).map_err(|e| e.to_string())?;
    let system: Vec<usize> = (0..retained.len()).collect();
    let mut condensed = Condensed::new("bodies".into(), reduction, &system);
    condensed.set_channels(channels);
    let rows: Vec<usize> = free.iter().map(|&k| retained.partition_point(|&d| d < slip[k])).collect();
    let areas: Vec<f64> = free.iter().map(|&k| points[k].place.area).collect();
    Ok(Surroundings { bytes, ..tractions::<C>(&condensed, &rows, &areas) })
}

/// Tractions from the condensed forces; `rows` are those of the slip of each point, its opening stands `C - 1` further on. A force
/// is what must act on a jump to hold it there: the bodies drive slip with its opposite, and where it holds the sides apart they
/// press on each other, in compression.
fn tractions<const C: usize>(condensed: &Condensed, rows: &[usize], areas: &[f64]) -> Surroundings {
    let (schur, width, n) =
        (condensed.reduction().schur(), condensed.reduction().retained().len(), rows.len());
    let sign = |shift: usize| if shift == 0 { -1.0 } else { 1.0 };
    let part = |shift: usize| -> Vec<f64> {
        let mut matrix = Vec::with_capacity(n * n);
        for (&row, area) in rows.iter().zip(areas) {
            let per_area = sign(shift) / area;
            matrix.extend(rows.iter().map(|&column| per_area * schur[(row + shift) * width + column]));
        }
        matrix
    };
    let shear = part(0);
    let largest = |m: &[f64]| m.iter().fold(0.0, |l: f64, v| l.max(v.abs()));
    let over_area = |forces: &[f64], shift: usize| -> Vec<f64> {
        rows.iter().zip(areas).map(|(&r, a)| sign(shift) * forces[r + shift] / a).collect()
    };
    // Loads may change normal tractions where slip does not.
    let loads_normal = |shear_load: f64| {
        C > 1 && condensed.channels().any(|(_, f)| largest(&over_area(f, C - 1)) > UNCOUPLED * shear_load)
    };
    let shear_load = condensed.channels().map(|(_, f)| largest(&over_area(f, 0))).fold(0.0, f64::max);
    let normal = if C == 1 { None } else { Some(part(C - 1)) };
    let normal = normal.filter(|m| largest(m) > UNCOUPLED * largest(&shear) || loads_normal(shear_load));
    let mut loading = Loading::default();
    for (amplitude, forces) in condensed.channels() {
        let change = if C == 1 { Vec::new() } else { over_area(forces, C - 1) };
        loading.add(amplitude.clone(), over_area(forces, 0), change);
    }
    Surroundings { operator: Dense::new(n, shear, normal), loading, bytes: 0 }
}

/// Stiffness of all bodies in the numbering of the model.
fn stiffness<const D: usize>(model: &Model<D>) -> Stiffness {
    let mut all = Stiffness {
        pattern: Pattern { dofs: Vec::new(), starts: vec![0], version: 0 },
        values: Vec::new(),
        dofs: model.dofs(),
    };
    for body in &model.bodies {
        let own = model.stiffness(body);
        let (first, offset) = (body.dofs.start, all.pattern.dofs.len());
        all.pattern.dofs.extend(own.pattern.dofs.iter().map(|d| d + first));
        all.pattern.starts.extend(own.pattern.starts[1..].iter().map(|s| s + offset));
        all.values.extend_from_slice(&own.values);
    }
    all
}
