//! Bodies condensed onto the jumps of their faults: the tractions that slip and loads cause.

use super::bodies::Bodies;
use super::held;
use super::loads::Loads;
use super::machine::Machine;
use super::mirror::Mirror;
use super::place::{Place, across};
use super::point::{Initial, Point};
use super::refusal::Refusal;
use crate::operator::{Bearing, Forces, Matrix};
use crate::problem::Loading;
use crate::processes::Opening;
use asperity_fem::FemError;
use asperity_fem::condense::{Condensation, CondensedBody, Interior, LoadedBody, Remainder, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::jump::{Jump, Jumps, ObliqueConstraint};
use asperity_fem::multifrontal::{DirectError, Triangle};
use asperity_fem::table::Table;

/// Condensed bodies.
#[derive(Debug)]
pub struct Surroundings {
    /// Forces that slip causes.
    pub forces: Forces,
    /// Tractions that openings cause, where points may open.
    pub opening: Option<Opening>,
    /// Tractions that loads and creep cause.
    pub loading: Loading,
    /// The part of them caused by creep: rates of shear tractions, component by component \[Pa/s\].
    pub creep: Option<Vec<f64>>,
    /// Tractions caused by their weight, if they have any.
    pub weight: Option<Initial>,
    /// Peak memory of the condensation \[bytes\].
    pub bytes: usize,
    /// True if one of two bodies that mirror each other was condensed for both.
    pub mirrored: bool,
    /// The bodies, if they are kept.
    pub bodies: Option<Bodies>,
}

/// Ratio of the change of normal traction, or of shear traction across slip, to that along slip, below which it is
/// taken as zero. It is above the rounding of the condensation, and far below any effect of geometry.
const UNCOUPLED: f64 = 1e-9;

/// Copies of the operator while it is made: its blocks one by one, and joined.
const PARTS: usize = 2;

/// Options of the condensation.
#[derive(Clone, Copy, Debug)]
pub struct Conditions {
    /// Components of displacement.
    pub components: usize,
    /// Number of directions along which points slide freely.
    pub tangents: usize,
    /// Memory that the condensation may use \[bytes\].
    pub memory: usize,
    /// True if the bodies are kept for their displacements.
    pub keep: bool,
}

/// Unknowns of the points, and the effect of slip.
#[derive(Clone, Copy, Debug)]
struct Sides {
    /// True if both sides of the fault are condensed. Their relative motion across the fault is then held, where it is that of
    /// one side otherwise, and free.
    both: bool,
    /// Slip of the condensed bodies over that of the fault.
    share: f64,
}

/// Condenses bodies of this stiffness onto the points that slide freely. Tractions are nodal forces divided by
/// tributary areas, so the interface mass matrix is lumped. In a mirror whose conditions hold, one body is condensed.
///
/// # Errors
/// A [`Refusal`] if the bodies need more than `memory` bytes, if nothing holds them, or if a support is not compatible
/// with the fault.
pub fn condense<const D: usize>(
    bodies: Stiffness,
    loads: &Loads,
    points: &[Point<D>],
    conditions: Conditions,
    mirror: Option<&Mirror>,
) -> Result<Surroundings, Refusal> {
    let both = (conditions, Sides { both: true, share: 1.0 });
    match (conditions.components, mirror) {
        (1, _) => with_components::<D, 1>(bodies, loads, points, both, |_| [[1.0]]),
        (2, _) => with_components::<D, 2>(bodies, loads, points, both, in_plane),
        (_, Some(mirror)) if !conditions.keep && mirror.holds(&bodies, loads, points) => {
            let (body, loads, points) = mirror.half(bodies, loads, points);
            let one = (conditions, Sides { both: false, share: 0.5 });
            // The minus side moves against the slip.
            let frame = |place: &Place<D>| in_space(place).map(|axis| axis.map(|c| -c));
            with_components::<D, 3>(body, &loads, &points, one, frame)
        }
        _ => with_components::<D, 3>(bodies, loads, points, both, in_space),
    }
}

/// Axes of a jump in the plane: along slip, and from minus to plus.
pub(super) fn in_plane<const D: usize>(place: &Place<D>) -> [[f64; 2]; 2] {
    let n = &place.normal;
    [[-n[1], n[0]], [n[0], n[1]]]
}

/// Axes of a jump in space: along the rake, across it, and from minus to plus.
pub(super) fn in_space<const D: usize>(place: &Place<D>) -> [[f64; 3]; 3] {
    let vector = |v: &[f64; D]| std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0));
    let (s, n) = (vector(&place.rake), vector(&place.normal));
    [s, across(&n, &s), n]
}

/// Components of a jump that are retained, relative to the first: slip along the tangents, and between both sides the opening,
/// which is the last.
fn kept<const C: usize>(tangents: usize, sides: Sides) -> impl Iterator<Item = usize> {
    (0..C).filter(move |&c| c < tangents || (sides.both && c == C - 1))
}

/// Components held at zero: in space, slip across the rake where its direction is fixed.
fn held<const C: usize>(tangents: usize) -> impl Iterator<Item = usize> {
    tangents..C.saturating_sub(1).max(tangents)
}

fn with_components<const D: usize, const C: usize>(
    bodies: Stiffness,
    loads: &Loads,
    points: &[Point<D>],
    (Conditions { tangents, memory, keep, .. }, sides): (Conditions, Sides),
    frame: impl Fn(&Place<D>) -> [[f64; C]; C],
) -> Result<Surroundings, Refusal> {
    let (constraints, end) = (&loads.constraints, loads.end);
    let machine = Machine::new(&loads.springs);
    let drawn = |node: usize| (C * node..C * (node + 1)).any(|d| machine.draws(d));
    let both = |p: &Point<D>| drawn(p.place.minus) && drawn(p.place.plus);
    if let Some(point) = points.iter().position(both) {
        return Err(Refusal::Drawn { point });
    }
    let jump = |p: &Point<D>| held::jump(p, frame(&p.place), &constraints.fixed, drawn);
    let list: Vec<Jump<C>> = points.iter().map(jump).collect();
    // The opening is the last component; where it may change normal tractions it is retained, at zero.
    let slip: Vec<usize> = list.iter().map(|j| j.plus).collect();
    let jumps = Jumps::new(list);
    let across = jumps.stiffness(&bodies);
    drop(bodies);
    let body = machine.stiffness(across);
    let oblique = |e: ObliqueConstraint| Refusal::Oblique { dof: e.plus };
    let free: Vec<usize> = (0..points.len()).filter(|&k| points[k].creep.is_none()).collect();
    let mut retained: Vec<usize> = free
        .iter()
        .flat_map(|&k| kept::<C>(tangents, sides).map(move |c| (k, c)))
        .map(|(k, c)| slip[k] + c)
        .collect();
    retained.sort_unstable();
    let mut fixed = jumps.fixed(&constraints.fixed).map_err(oblique)?;
    let is_fixed = |dof: usize| fixed.binary_search(&dof).is_ok();
    let along_slip = |&k: &usize| (0..tangents).find(|c| is_fixed(slip[k] + c)).map(|c| (k, c));
    if let Some((k, c)) = free.iter().find_map(along_slip) {
        let component = held::most(&frame(&points[k].place)[c]);
        return Err(Refusal::AlongSlip { point: k, component });
    }
    let mut channels = Vec::new();
    for channel in &constraints.channels {
        let own = jumps.channel(channel, &constraints.fixed).map_err(oblique)?;
        channels.push(machine.channel(&own).map_err(|e| e.to_string())?);
    }
    let creeping = held::creep((points, &slip), &fixed, &channels, (tangents, end), &frame)?;
    let supported: Vec<bool> = free.iter().map(|&k| C > 1 && is_fixed(slip[k] + C - 1)).collect();
    for (point, &dof) in points.iter().zip(&slip) {
        if point.creep.is_some() {
            fixed.extend(dof..dof + if sides.both { C } else { C - 1 });
        } else {
            fixed.extend(held::<C>(tangents).map(|c| dof + c));
        }
    }
    fixed.extend(machine.tied());
    fixed.sort_unstable();
    fixed.dedup();
    let creep = (!creeping.is_empty()).then_some(channels.len());
    if creep.is_some() {
        let amplitude = Table::new(vec![0.0, end], vec![0.0, end]);
        channels.push(Channel { prescribed: creeping, forces: Vec::new(), amplitude });
    }
    channels.extend(machine.pulls());
    let weighs = C > 1 && !loads.weight.is_empty();
    if weighs {
        let own = jumps.channel(&weight(loads), &constraints.fixed).map_err(oblique)?;
        channels.push(machine.channel(&own).map_err(|e| e.to_string())?);
    }
    let rows: Vec<usize> = free.iter().map(|&k| retained.partition_point(|&d| d < slip[k])).collect();
    let keeps = |k: usize, supported: bool| supported || !points[k].normal_changes;
    let bearing = |(&k, &s): (&usize, &bool)| Bearing {
        area: points[k].place.area,
        keeps: keeps(k, s),
        opens: points[k].opens && !keeps(k, s),
    };
    let bearings: Vec<Bearing> = free.iter().zip(&supported).map(bearing).collect();
    let opens = bearings.iter().filter(|b| b.opens).count();
    let across = if sides.both { C } else { 1 };
    let operator =
        Forces::operator_bytes(across, tangents, free.len()) + Opening::memory(opens, free.len(), tangents);
    let (left, bytes) =
        CondensedPart::condense(body, (&retained, &fixed), channels, (memory, operator), keep)
            .map_err(|e| refused(&jumps, &e))?;
    let loads = Channels { all: left.channels(), creep, weighs };
    let (matrix, interior) = left.parted();
    let ties = machine.ties().clone();
    let bodies = interior.map(|interior| Bodies::new(interior, jumps, ties, rows.clone()));
    let share = sides.share;
    let forces = Forces { matrix, share, rows, bearings, tangents, presses: Vec::new(), across: false };
    let found = if sides.both { tractions::<C>(forces, loads) } else { tractions::<1>(forces, loads) };
    Ok(Surroundings { bytes, bodies, mirrored: !sides.both, ..found })
}

/// Load of the weight of the bodies. Its effect is part of the initial state, so its amplitude is zero during the run.
fn weight(loads: &Loads) -> Channel {
    Channel { prescribed: Vec::new(), forces: loads.weight.clone(), amplitude: Table::constant(0.0) }
}

/// Result of the elimination of the bodies.
enum CondensedPart {
    /// Condensed forces only.
    Alone(Remainder),
    /// With the factor, for displacements.
    Kept(Box<CondensedBody>),
}

impl CondensedPart {
    /// Condenses a body onto the `retained` degrees of freedom, with others `fixed`; also the memory it takes
    /// \[bytes\]. The condensed matrix and the operator made from it exist side by side for a while.
    fn condense(
        body: Stiffness,
        (retained, fixed): (&[usize], &[usize]),
        channels: Vec<Channel>,
        (memory, operator): (usize, usize),
        keep: bool,
    ) -> Result<(Self, usize), FemError> {
        if !keep {
            let rows = retained.len() + channels.len();
            let analysis = LoadedBody::analyse(body, retained, fixed, channels)?;
            let eliminating = analysis.bytes(analysis.threads(memory)?);
            let bytes = eliminating.max(Triangle::bytes(rows) + PARTS * operator);
            admit(bytes, memory, rows)?;
            return Ok((Self::Alone(analysis.eliminate(memory)?), bytes));
        }
        let analysis = Condensation::analyse(&body, retained, fixed)?;
        let bytes = analysis.bytes() + PARTS * operator;
        admit(bytes, memory, retained.len())?;
        let system: Vec<usize> = (0..retained.len()).collect();
        let mut condensed = CondensedBody::new("bodies".into(), analysis.factor(memory)?, &system);
        condensed.set_channels(channels);
        Ok((Self::Kept(Box::new(condensed)), bytes))
    }

    /// Amplitude of each load, and the forces it causes.
    fn channels(&self) -> Vec<(Table, Vec<f64>)> {
        match self {
            Self::Alone(remainder) => remainder.channels().map(|(a, f)| (a.clone(), f)).collect(),
            Self::Kept(condensed) => condensed.channels().map(|(a, f)| (a.clone(), f.to_vec())).collect(),
        }
    }

    /// The condensed matrix, and the bodies if they are kept.
    fn parted(self) -> (Matrix, Option<Interior>) {
        match self {
            Self::Alone(remainder) => (Matrix::Triangle(remainder), None),
            Self::Kept(condensed) => {
                let order = condensed.reduction().retained().len();
                let (whole, interior) = condensed.into_parts();
                (Matrix::Whole(whole, order), Some(interior))
            }
        }
    }
}

/// Refuses a condensation that needs more than `allowed` bytes.
fn admit(needed: usize, allowed: usize, equations: usize) -> Result<(), FemError> {
    if needed <= allowed { Ok(()) } else { Err(DirectError::Memory { needed, allowed, equations }.into()) }
}

/// Refusal for an error of the condensation.
pub(super) fn refused<const C: usize>(jumps: &Jumps<C>, error: &FemError) -> Refusal {
    if let FemError::Direct(DirectError::Memory { needed, allowed, .. }) = *error {
        return Refusal::Memory { needed, allowed, points: jumps.list().len() };
    }
    let Some(pivot) = error.pivot() else { return Refusal::Other(error.to_string()) };
    // A jump occupies the degrees of freedom of one of its nodes.
    let (dof, node) = (pivot.equation, pivot.equation / C);
    Refusal::Loose { dof, jumps: jumps.list().iter().any(|j| j.plus / C == node) }
}

/// Lower bound of the memory of a condensation onto this many points, some of which may open, with `components` of
/// displacement \[bytes\]: the condensed matrix, and what openings cause.
#[must_use]
pub fn least_bytes(components: usize, tangents: usize, points: usize, opening: usize) -> usize {
    let rows = points * (tangents + usize::from(components > 1));
    Triangle::bytes(rows) + Opening::memory(opening, points, tangents)
}

/// Loads of the bodies, of which some are named.
struct Channels {
    all: Vec<(Table, Vec<f64>)>,
    /// Number of the load of creep.
    creep: Option<usize>,
    /// True if the last is the weight of the bodies.
    weighs: bool,
}

/// Tractions from the condensed forces. A force is what must act on a jump to hold it. The bodies therefore drive slip
/// with the opposite force, and a force that holds the sides apart is a compression.
fn tractions<const C: usize>(mut forces: Forces, channels: Channels) -> Surroundings {
    let Channels { mut all, creep, weighs } = channels;
    let Forces { rows, bearings, tangents, .. } = &forces;
    let (n, tangents) = (rows.len(), *tangents);
    let largest = |m: &[f64]| m.iter().fold(0.0, |l: f64, v| l.max(v.abs()));
    let over_area = |forces: &[f64], component: usize| -> Vec<f64> {
        let per_force = |b: &Bearing| b.per_force(component == tangents);
        rows.iter().zip(bearings).map(|(&r, b)| per_force(b) * forces[r + component]).collect()
    };
    let shear_of = |forces: &[f64]| (0..tangents).flat_map(|c| over_area(forces, c)).collect::<Vec<f64>>();
    let weight = all.pop_if(|_| weighs).map(|(_, forces)| Initial {
        shear: shear_of(&forces),
        normal: rows.iter().zip(bearings).map(|(&r, b)| forces[r + tangents] / b.area).collect(),
    });
    let creep = creep.map(|c| shear_of(&all[c].1));
    // Loads may change normal tractions where slip does not.
    let shear_load = all.iter().map(|(_, f)| largest(&shear_of(f))).fold(0.0, f64::max);
    let loaded = C > 1 && all.iter().any(|(_, f)| largest(&over_area(f, tangents)) > UNCOUPLED * shear_load);
    let along: Vec<f64> = (0..tangents).map(|c| forces.largest(c, c)).collect();
    let presses = |c: usize| C > 1 && (loaded || forces.largest(tangents, c) > UNCOUPLED * along[c]);
    let presses = (0..tangents).map(presses).collect();
    let least = UNCOUPLED * along[0];
    let across = tangents > 1 && (forces.largest(0, 1) > least || forces.largest(1, 0) > least);
    let opens: Vec<usize> = (0..n).filter(|&p| C > 1 && bearings[p].opens).collect();
    let normal = |&p: &usize| forces.caused(tangents, (tangents, p)).collect();
    let shear = |&p: &usize| (0..tangents).flat_map(|c| forces.caused(c, (tangents, p))).collect();
    let columns = [opens.iter().map(normal).collect(), opens.iter().map(shear).collect()];
    let opening = opening(opens, bearings, columns);
    let mut loading = Loading::new(tangents);
    for (amplitude, forces) in all {
        let change = if C == 1 { Vec::new() } else { over_area(&forces, tangents) };
        loading.add(amplitude, shear_of(&forces), change);
    }
    (forces.presses, forces.across) = (presses, across);
    Surroundings { forces, opening, loading, creep, weight, bytes: 0, mirrored: false, bodies: None }
}

/// Effect of the openings of these points, if any, from the normal and shear tractions of all points that each opening
/// causes.
fn opening(points: Vec<usize>, bearings: &[Bearing], [normal, shear]: [Vec<Vec<f64>>; 2]) -> Option<Opening> {
    if points.is_empty() {
        return None;
    }
    let largest = |columns: &[Vec<f64>]| columns.iter().flatten().fold(0.0_f64, |l, v| l.max(v.abs()));
    let shears = largest(&shear) > UNCOUPLED * largest(&normal);
    let areas = points.iter().map(|&p| bearings[p].area).collect();
    Some(Opening::new(points, areas, normal, shears.then_some(shear)))
}
