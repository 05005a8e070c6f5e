//! Bodies condensed onto the jumps of their faults: the tractions that slip and loads cause.

use super::bodies::Bodies;
use super::held;
use super::machine::{Machine, Spring};
use super::place::{Place, across};
use super::point::{Initial, Point};
use super::refusal::Refusal;
use crate::loading::Loading;
use crate::opening::Opening;
use crate::operator::Dense;
use asperity_fem::FemError;
use asperity_fem::condense::{Condensation, Condensed, Loaded, Remainder, Stiffness};
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::jump::{Jump, Jumps, ObliqueConstraint};
use asperity_fem::multifrontal::DirectError;
use asperity_fem::table::Table;

/// Tractions caused by slip, component by component.
#[derive(Debug)]
pub enum Tractions {
    /// Slip along one direction.
    One(Dense),
    /// Slip along two directions: the operators of each component on itself, and those between the components where
    /// slip in one loads the other.
    Two {
        /// Operators of each component on itself, with normal tractions.
        along: Box<[Dense; 2]>,
        /// Operators of the second component on the first and of the first on the second, without normal tractions.
        across: Option<Box<[Dense; 2]>>,
    },
}

/// Condensed bodies.
#[derive(Debug)]
pub struct Surroundings {
    /// Tractions that slip causes.
    pub operator: Tractions,
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
    /// The bodies, if they are kept.
    pub bodies: Option<Bodies>,
}

/// Ratio of the change of normal traction, or of shear traction across slip, to that along slip, below which it is
/// taken as zero. It is above the rounding of the condensation, and far below any effect of geometry.
const UNCOUPLED: f64 = 1e-9;

/// Loads and supports of the bodies.
#[derive(Clone, Debug)]
pub struct Loads {
    /// Prescribed motions and loads.
    pub constraints: Constraints,
    /// Boundaries that a spring moves as one.
    pub springs: Vec<Spring>,
    /// Nodal forces of the weight of the bodies, which acts before the start.
    pub weight: Vec<(usize, f64)>,
    /// End of the run \[s\].
    pub end: f64,
}

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

/// Condenses bodies of this stiffness onto the points that slide freely. Tractions are nodal forces divided by
/// tributary areas, so the interface mass matrix is lumped.
///
/// # Errors
/// A [`Refusal`] if the bodies need more than `memory` bytes, if nothing holds them, or if a support is not compatible
/// with the fault.
pub fn condense<const D: usize>(
    bodies: Stiffness,
    loads: &Loads,
    points: &[Point<D>],
    conditions: Conditions,
) -> Result<Surroundings, Refusal> {
    match conditions.components {
        1 => with_components::<D, 1>(bodies, loads, points, conditions, |_| [[1.0]]),
        2 => with_components::<D, 2>(bodies, loads, points, conditions, in_plane),
        _ => with_components::<D, 3>(bodies, loads, points, conditions, in_space),
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

/// Components of a jump that are retained, relative to the first: slip along the tangents, and the opening, which is
/// the last.
fn kept<const C: usize>(tangents: usize) -> impl Iterator<Item = usize> {
    (0..C).filter(move |&c| c < tangents || c == C - 1)
}

/// Components held at zero: in space, slip across the rake where its direction is fixed.
fn held<const C: usize>(tangents: usize) -> impl Iterator<Item = usize> {
    tangents..C.saturating_sub(1).max(tangents)
}

fn with_components<const D: usize, const C: usize>(
    bodies: Stiffness,
    loads: &Loads,
    points: &[Point<D>],
    Conditions { tangents, memory, keep, .. }: Conditions,
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
        .flat_map(|&k| kept::<C>(tangents).map(move |c| (k, c)))
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
        channels.push(machine.channel(&jumps.channel(channel, &constraints.fixed).map_err(oblique)?)?);
    }
    let creeping = held::creep((points, &slip), &fixed, &channels, (tangents, end), &frame)?;
    let supported: Vec<bool> = free.iter().map(|&k| C > 1 && is_fixed(slip[k] + C - 1)).collect();
    for (point, &dof) in points.iter().zip(&slip) {
        if point.creep.is_some() {
            fixed.extend(dof..dof + C);
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
    channels.extend(machine.pulls(end));
    let weighs = C > 1 && !loads.weight.is_empty();
    if weighs {
        channels.push(machine.channel(&jumps.channel(&weight(loads), &constraints.fixed).map_err(oblique)?)?);
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
    let operator = operator_bytes::<C>(tangents, free.len()) + Opening::memory(opens, free.len(), tangents);
    let (left, bytes) = Left::of(body, (&retained, &fixed), channels, (memory, operator), keep)
        .map_err(|e| refused(&jumps, &e))?;
    let found = tractions::<C>(&left, tangents, &rows, &bearings, (creep, weighs));
    let ties = machine.ties().clone();
    let bodies = left.kept().map(|condensed| Bodies::new(condensed, jumps, ties, rows));
    Ok(Surroundings { bytes, bodies, ..found })
}

/// Load of the weight of the bodies. Its effect is part of the initial state, so its amplitude is zero during the run.
fn weight(loads: &Loads) -> Channel {
    Channel { prescribed: Vec::new(), forces: loads.weight.clone(), amplitude: Table::constant(0.0) }
}

/// Result of the elimination of the bodies.
enum Left {
    /// Condensed forces only.
    Alone(Remainder),
    /// With the factor, for displacements.
    Kept(Box<Condensed>),
}

impl Left {
    /// Condenses a body onto the `retained` degrees of freedom, with others `fixed`; also the memory it takes
    /// \[bytes\]. The condensed matrix and the operator made from it exist side by side for a while.
    fn of(
        body: Stiffness,
        (retained, fixed): (&[usize], &[usize]),
        channels: Vec<Channel>,
        (memory, operator): (usize, usize),
        keep: bool,
    ) -> Result<(Self, usize), FemError> {
        if !keep {
            let rows = retained.len() + channels.len();
            let analysis = Loaded::analyse(body, retained, fixed, channels)?;
            let eliminating = analysis.bytes(analysis.threads(memory)?);
            let bytes = eliminating.max(rows.pow(2) * size_of::<f64>() + operator);
            admit(bytes, memory, rows)?;
            return Ok((Self::Alone(analysis.eliminate(memory)?), bytes));
        }
        let analysis = Condensation::analyse(&body, retained, fixed)?;
        let bytes = analysis.bytes() + operator;
        admit(bytes, memory, retained.len())?;
        let system: Vec<usize> = (0..retained.len()).collect();
        let mut condensed = Condensed::new("bodies".into(), analysis.factor(memory)?, &system);
        condensed.set_channels(channels);
        Ok((Self::Kept(Box::new(condensed)), bytes))
    }

    /// Forces on the retained degrees of freedom due to displacement k. By symmetry they are also the forces on k.
    fn row(&self, k: usize) -> &[f64] {
        match self {
            Self::Alone(remainder) => remainder.row(k),
            Self::Kept(condensed) => {
                let reduction = condensed.reduction();
                let width = reduction.retained().len();
                &reduction.schur()[k * width..][..width]
            }
        }
    }

    /// Amplitude of each load, and the forces it causes.
    fn channels(&self) -> Vec<(&Table, &[f64])> {
        match self {
            Self::Alone(remainder) => remainder.channels().collect(),
            Self::Kept(condensed) => condensed.channels().collect(),
        }
    }

    /// The bodies, if they are kept.
    fn kept(self) -> Option<Condensed> {
        match self {
            Self::Alone(_) => None,
            Self::Kept(condensed) => Some(*condensed),
        }
    }
}

/// Memory of the dense operator \[bytes\]: for each direction of slip, its tractions along all directions and its
/// normal tractions.
fn operator_bytes<const C: usize>(tangents: usize, points: usize) -> usize {
    let normal = usize::from(C > 1);
    tangents * (tangents + normal) * points.pow(2) * size_of::<f64>()
}

/// Refuses a condensation that needs more than `allowed` bytes.
fn admit(needed: usize, allowed: usize, equations: usize) -> Result<(), FemError> {
    if needed <= allowed { Ok(()) } else { Err(DirectError::Memory { needed, allowed, equations }.into()) }
}

/// Conversion of the forces on a point to tractions.
#[derive(Clone, Copy, Debug)]
struct Bearing {
    /// Tributary area \[m²; m per metre of thickness\].
    area: f64,
    /// True if its normal traction is constant, either because supports on both sides take its change or because the
    /// scene says so.
    keeps: bool,
    /// True if it may open where its normal traction falls to zero.
    opens: bool,
}

impl Bearing {
    /// Traction per force, of slip or of the opening. The bodies drive slip with the opposite of the force that holds it.
    fn per_force(&self, opening: bool) -> f64 {
        match (opening, self.keeps) {
            (false, _) => -1.0 / self.area,
            (true, true) => 0.0,
            (true, false) => 1.0 / self.area,
        }
    }
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
/// displacement \[bytes\]: the condensed matrix and the operator made from it.
#[must_use]
pub fn least_bytes(components: usize, tangents: usize, points: usize, opening: usize) -> usize {
    let rows = points * (tangents + usize::from(components > 1));
    let operator = match components {
        1 => operator_bytes::<1>(tangents, points),
        _ => operator_bytes::<2>(tangents, points),
    };
    rows.pow(2) * size_of::<f64>() + operator + Opening::memory(opening, points, tangents)
}

/// Tractions from the condensed forces. `rows` are the rows of slip of each point; with more than one component of
/// displacement, its opening follows. A force is what must act on a jump to hold it. The bodies therefore drive slip
/// with the opposite force, and a force that holds the sides apart is a compression. `creep` is the number of the
/// channel of creep; the weight of the bodies, if any, is the last channel.
fn tractions<const C: usize>(
    left: &Left,
    tangents: usize,
    rows: &[usize],
    bearings: &[Bearing],
    (creep, weighs): (Option<usize>, bool),
) -> Surroundings {
    let n = rows.len();
    // Traction of a component caused by slip of a component; the opening comes after the tangents.
    let part = |component: usize, slip: usize| -> Vec<f64> {
        let mut matrix = Vec::with_capacity(n * n);
        for (&row, bearing) in rows.iter().zip(bearings) {
            let (per_area, forces) = (bearing.per_force(component == tangents), left.row(row + component));
            matrix.extend(rows.iter().map(|&c| per_area * forces[c + slip]));
        }
        matrix
    };
    let largest = |m: &[f64]| m.iter().fold(0.0, |l: f64, v| l.max(v.abs()));
    let over_area = |forces: &[f64], component: usize| -> Vec<f64> {
        let per_force = |b: &Bearing| b.per_force(component == tangents);
        rows.iter().zip(bearings).map(|(&r, b)| per_force(b) * forces[r + component]).collect()
    };
    let shear_of = |forces: &[f64]| (0..tangents).flat_map(|c| over_area(forces, c)).collect::<Vec<f64>>();
    // Loads may change normal tractions where slip does not.
    let mut channels = left.channels();
    let weight = channels.pop_if(|_| weighs).map(|(_, forces)| Initial {
        shear: shear_of(forces),
        normal: rows.iter().zip(bearings).map(|(&r, b)| forces[r + tangents] / b.area).collect(),
    });
    let creep = creep.map(|c| shear_of(channels[c].1));
    let shear_load = channels.iter().map(|(_, f)| largest(&shear_of(f))).fold(0.0, f64::max);
    let loaded =
        C > 1 && channels.iter().any(|(_, f)| largest(&over_area(f, tangents)) > UNCOUPLED * shear_load);
    let along = |c: usize| {
        let shear = part(c, c);
        let normal = if C == 1 { None } else { Some(part(tangents, c)) };
        let normal = normal.filter(|m| loaded || largest(m) > UNCOUPLED * largest(&shear));
        Dense::new(n, shear, normal)
    };
    let operator = if tangents == 1 {
        Tractions::One(along(0))
    } else {
        let along = Box::new([along(0), along(1)]);
        let least = UNCOUPLED * largest(along[0].matrix());
        let across = [part(0, 1), part(1, 0)];
        let loads = across.iter().any(|m| largest(m) > least);
        Tractions::Two {
            along,
            across: loads.then(|| Box::new(across.map(|shear| Dense::new(n, shear, None)))),
        }
    };
    let opens: Vec<usize> = (0..n).filter(|&p| C > 1 && bearings[p].opens).collect();
    let forces = |&p: &usize| left.row(rows[p] + tangents);
    let columns = [
        opens.iter().map(|p| over_area(forces(p), tangents)).collect(),
        opens.iter().map(|p| shear_of(forces(p))).collect(),
    ];
    let opening = opening(opens, bearings, columns);
    let mut loading = Loading::new(tangents);
    for (amplitude, forces) in channels {
        let change = if C == 1 { Vec::new() } else { over_area(forces, tangents) };
        loading.add(Table::clone(amplitude), shear_of(forces), change);
    }
    Surroundings { operator, opening, loading, creep, weight, bytes: 0, bodies: None }
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
