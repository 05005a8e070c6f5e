//! Bodies condensed onto the jumps of their faults: the tractions that slip and loads cause.

use super::bodies::Bodies;
use super::loads::Loads;
use super::machine::Machine;
use super::mirror::Mirror;
use super::place::{Place, across};
use super::point::{Initial, Point};
use super::point_jumps::{self, PointJumps};
use super::refusal::Refusal;
use crate::operator::{Bearing, Forces, Matrix, PointComponent};
use crate::problem::Loading;
use crate::processes::Opening;
use asperity_fem::FemError;
use asperity_fem::condense::{Condensation, CondensedBody, Interior, LoadedBody, Remainder, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::jump::{Jumps, ObliqueConstraint};
use asperity_fem::multifrontal::{DirectError, Triangle};
use asperity_fem::table::Table;
use asperity_fem::vector::tangent;

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
    let n = [place.normal[0], place.normal[1]];
    [tangent(&n), n]
}

/// Axes of a jump in space: along the rake, across it, and from minus to plus.
pub(super) fn in_space<const D: usize>(place: &Place<D>) -> [[f64; 3]; 3] {
    let vector = |v: &[f64; D]| std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0));
    let (s, n) = (vector(&place.rake), vector(&place.normal));
    [s, across(&n, &s), n]
}

fn with_components<const D: usize, const C: usize>(
    bodies: Stiffness,
    loads: &Loads,
    points: &[Point<D>],
    (conditions, sides): (Conditions, Sides),
    frame: impl Fn(&Place<D>) -> [[f64; C]; C],
) -> Result<Surroundings, Refusal> {
    let (machine, tangents) = (Machine::new(&loads.springs), conditions.tangents);
    let drawn = |node: usize| (C * node..C * (node + 1)).any(|d| machine.draws(d));
    let both = |p: &Point<D>| drawn(p.place.minus) && drawn(p.place.plus);
    if let Some(point) = points.iter().position(both) {
        return Err(Refusal::Drawn { point });
    }
    let at = PointJumps::new(points, tangents, frame, &loads.constraints.fixed, drawn);
    let free = (0..points.len()).filter(|&k| points[k].creep.is_none()).collect();
    let fault = CondensedFault { at, sides, free };
    let across = fault.at.jumps.stiffness(&bodies);
    drop(bodies);
    fault.condense(machine.stiffness(across), loads, &machine, conditions)
}

/// Points of faults onto whose jumps bodies are condensed.
struct CondensedFault<'a, const D: usize, const C: usize> {
    at: PointJumps<'a, D, C>,
    sides: Sides,
    /// Points that slide freely.
    free: Vec<usize>,
}

/// Conditions and loads on bodies and jumps.
struct Boundary {
    /// Degrees of freedom that are held or prescribed, sorted.
    fixed: Vec<usize>,
    channels: Vec<Channel>,
    /// Number of the channel of creep.
    creep: Option<usize>,
    /// True if the last channel is the weight of the bodies.
    weighs: bool,
    /// True for each free point between whose sides supports hold the opening.
    supported: Vec<bool>,
}

impl<const D: usize, const C: usize> CondensedFault<'_, D, C> {
    /// Condenses a body that has the stiffness of jumps and springs.
    fn condense(
        self,
        body: Stiffness,
        loads: &Loads,
        machine: &Machine<'_>,
        conditions: Conditions,
    ) -> Result<Surroundings, Refusal> {
        let (sides, tangents) = (self.sides, conditions.tangents);
        let boundary = self.boundary(loads, machine)?;
        let retained = self.retained();
        let bearings = self.bearings(&boundary.supported);
        let limits = Limits { memory: conditions.memory, operator: self.operator_bytes(&bearings) };
        let dofs = (retained.as_slice(), boundary.fixed.as_slice());
        let (left, bytes) = CondensedPart::condense(body, dofs, boundary.channels, limits, conditions.keep)
            .map_err(|e| refused(&self.at.jumps, &e))?;
        let loads = Channels { all: left.channels(), creep: boundary.creep, weighs: boundary.weighs };
        let (matrix, interior) = left.parted();
        let rows = self.rows(&retained);
        let bodies = interior
            .map(|interior| Bodies::new(interior, self.at.jumps, machine.ties().clone(), rows.clone()));
        let forces = Forces {
            matrix,
            share: sides.share,
            rows,
            bearings,
            tangents,
            presses: Vec::new(),
            across: false,
        };
        let found = if sides.both { tractions::<C>(forces, loads) } else { tractions::<1>(forces, loads) };
        Ok(Surroundings { bytes, bodies, mirrored: !sides.both, ..found })
    }

    /// Degrees of freedom that are retained: slip of free points along the tangents, and between both sides the opening, which is
    /// the last component; where it may change normal tractions it is retained, at zero.
    fn retained(&self) -> Vec<usize> {
        let kept = |c: &usize| *c < self.at.tangents || (self.sides.both && *c == C - 1);
        let of_point = |&k: &usize| (0..C).filter(kept).map(move |c| self.at.first[k] + c);
        let mut retained: Vec<usize> = self.free.iter().flat_map(of_point).collect();
        retained.sort_unstable();
        retained
    }

    /// Row of the first retained component of each free point.
    fn rows(&self, retained: &[usize]) -> Vec<usize> {
        self.free.iter().map(|&k| retained.partition_point(|&d| d < self.at.first[k])).collect()
    }

    fn boundary(&self, loads: &Loads, machine: &Machine<'_>) -> Result<Boundary, Refusal> {
        let (constraints, end) = (&loads.constraints, loads.end);
        let PointJumps { jumps, first, .. } = &self.at;
        let oblique = |e: ObliqueConstraint| Refusal::Oblique { dof: e.plus };
        let on_jumps = |channel: &Channel| {
            let own = jumps.channel(channel, &constraints.fixed).map_err(oblique)?;
            machine.channel(&own).map_err(|e| Refusal::Other(e.to_string()))
        };
        let mut fixed = jumps.fixed(&constraints.fixed).map_err(oblique)?;
        self.free_along_slip(&fixed)?;
        let mut channels = constraints.channels.iter().map(on_jumps).collect::<Result<Vec<_>, _>>()?;
        let creeping = point_jumps::creep(&self.at, &fixed, &channels, end)?;
        let opening_held = |&k: &usize| C > 1 && fixed.binary_search(&(first[k] + C - 1)).is_ok();
        let supported = self.free.iter().map(opening_held).collect();
        fixed.extend(self.held());
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
            channels.push(on_jumps(&weight(loads))?);
        }
        Ok(Boundary { fixed, channels, creep, weighs, supported })
    }

    /// Refuses conditions that hold the slip of a free point.
    fn free_along_slip(&self, fixed: &[usize]) -> Result<(), Refusal> {
        let PointJumps { first, frames, tangents, .. } = &self.at;
        for &point in &self.free {
            if let Some(c) = (0..*tangents).find(|c| fixed.binary_search(&(first[point] + c)).is_ok()) {
                return Err(Refusal::AlongSlip { point, component: point_jumps::most(&frames[point][c]) });
            }
        }
        Ok(())
    }

    /// Degrees of freedom of jumps that are prescribed, those of creeping points, or held at zero: in space, slip across the rake
    /// where its direction is fixed.
    fn held(&self) -> impl Iterator<Item = usize> {
        let tangents = self.at.tangents;
        self.at.points.iter().zip(&self.at.first).flat_map(move |(point, &dof)| {
            let held = if point.creep.is_none() {
                tangents..C.saturating_sub(1).max(tangents)
            } else {
                0..if self.sides.both { C } else { C - 1 }
            };
            held.map(move |c| dof + c)
        })
    }

    /// Tractions that the free points bear; `supported` says which of them hold without their neighbours.
    fn bearings(&self, supported: &[bool]) -> Vec<Bearing> {
        let bearing = |(&k, &supported): (&usize, &bool)| {
            let point = &self.at.points[k];
            let keeps = supported || !point.normal_changes;
            Bearing { area: point.place.area, keeps, opens: point.opens && !keeps }
        };
        self.free.iter().zip(supported).map(bearing).collect()
    }

    /// Memory of the forces between jumps \[bytes\].
    fn operator_bytes(&self, bearings: &[Bearing]) -> usize {
        let (tangents, points) = (self.at.tangents, self.free.len());
        let opens = bearings.iter().filter(|b| b.opens).count();
        let across = if self.sides.both { C } else { 1 };
        Forces::operator_bytes(across, tangents, points) + Opening::memory(opens, points, tangents)
    }
}

/// Load of the weight of the bodies. Its effect is part of the initial state, so its amplitude is zero during the run.
fn weight(loads: &Loads) -> Channel {
    Channel { prescribed: Vec::new(), forces: loads.weight.clone(), amplitude: Table::constant(0.0) }
}

/// Memory that a condensation may use, and that of the operator made from it \[bytes\].
#[derive(Clone, Copy)]
struct Limits {
    memory: usize,
    operator: usize,
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
        Limits { memory, operator }: Limits,
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
    let tangents = forces.tangents;
    let weight = all.pop_if(|_| weighs).map(|(_, held)| Initial {
        shear: shear(&forces, &held),
        normal: forces.rows.iter().zip(&forces.bearings).map(|(&r, b)| held[r + tangents] / b.area).collect(),
    });
    let creep = creep.map(|c| shear(&forces, &all[c].1));
    let presses = presses::<C>(&forces, &all);
    let across = tangents > 1 && {
        let least = UNCOUPLED * forces.largest(0, 0);
        forces.largest(0, 1) > least || forces.largest(1, 0) > least
    };
    let opening = if C > 1 { opening(&forces) } else { None };
    let mut loading = Loading::new(tangents);
    for (amplitude, held) in all {
        let change = if C == 1 { Vec::new() } else { over_area(&forces, &held, tangents) };
        loading.add(amplitude, shear(&forces, &held), change);
    }
    (forces.presses, forces.across) = (presses, across);
    Surroundings { forces, opening, loading, creep, weight, bytes: 0, mirrored: false, bodies: None }
}

/// Tractions of a component at all points that forces on the retained degrees of freedom hold.
fn over_area(Forces { rows, bearings, tangents, .. }: &Forces, held: &[f64], component: usize) -> Vec<f64> {
    let per_force = |b: &Bearing| b.per_force(component == *tangents);
    rows.iter().zip(bearings).map(|(&r, b)| per_force(b) * held[r + component]).collect()
}

/// Shear tractions of these forces, component by component.
fn shear(forces: &Forces, held: &[f64]) -> Vec<f64> {
    (0..forces.tangents).flat_map(|c| over_area(forces, held, c)).collect()
}

/// Largest magnitude.
fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |l: f64, v| l.max(v.abs()))
}

/// True for the components of slip that change normal tractions; for all where loads do, which may change them where slip does not.
fn presses<const C: usize>(forces: &Forces, loads: &[(Table, Vec<f64>)]) -> Vec<bool> {
    let tangents = forces.tangents;
    let shear_load = loads.iter().map(|(_, held)| largest(&shear(forces, held))).fold(0.0, f64::max);
    let changes = |held: &[f64]| largest(&over_area(forces, held, tangents)) > UNCOUPLED * shear_load;
    let loaded = C > 1 && loads.iter().any(|(_, held)| changes(held));
    let slip = |c: usize| forces.largest(tangents, c) > UNCOUPLED * forces.largest(c, c);
    (0..tangents).map(|c| C > 1 && (loaded || slip(c))).collect()
}

/// Effect of the openings of points that may open, if any may.
fn opening(forces: &Forces) -> Option<Opening> {
    let Forces { bearings, tangents, .. } = forces;
    let points: Vec<usize> = (0..bearings.len()).filter(|&p| bearings[p].opens).collect();
    if points.is_empty() {
        return None;
    }
    let caused = |c: usize, p: usize| forces.caused(c, PointComponent::new(*tangents, p));
    let normal: Vec<Vec<f64>> = points.iter().map(|&p| caused(*tangents, p).collect()).collect();
    let shear: Vec<Vec<f64>> =
        points.iter().map(|&p| (0..*tangents).flat_map(|c| caused(c, p)).collect()).collect();
    let shears = largest(shear.iter().flatten()) > UNCOUPLED * largest(normal.iter().flatten());
    let areas = points.iter().map(|&p| bearings[p].area).collect();
    Some(Opening::new(points, areas, normal, shears.then_some(shear)))
}
