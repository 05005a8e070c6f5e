//! Bodies condensed onto the jumps of their faults: what slip and loads do to tractions.

use super::loading::Loading;
use super::machine::Machine;
use super::operator::Dense;
use super::place::{Place, unit};
use crate::loading::Stage;
use crate::model::Model;
use crate::rigid;
use asperity_fem::FemError;
use asperity_fem::condense::{Loaded, Remainder, Stiffness};
use asperity_fem::dof::Channel;
use asperity_fem::jump::{Jump, Jumps};
use asperity_fem::table::Table;

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

/// Condenses the bodies of `model`, whose stiffness `bodies` is, onto the points that slide freely. Tractions are nodal forces over tributary areas: the
/// interface mass is lumped.
///
/// # Errors
/// A message where the bodies need more than `memory` bytes, are not held, or a support does not agree with the fault.
pub fn condense<const D: usize>(
    model: &Model<D>,
    bodies: Stiffness,
    stage: &Stage,
    points: &[Point<D>],
    memory: usize,
) -> Result<Surroundings, String> {
    match model.idealisation.components() {
        1 => with_components::<D, 1>(model, bodies, stage, points, memory, |_| [[1.0]]),
        2 => with_components::<D, 2>(model, bodies, stage, points, memory, |p| {
            let n = &p.normal;
            [[-n[1], n[0]], [n[0], n[1]]]
        }),
        _ => with_components::<D, 3>(model, bodies, stage, points, memory, |p| {
            let (s, n) = (in_space(&p.rake), in_space(&p.normal));
            let cross = |c: usize| {
                let (i, j) = ((c + 1) % 3, (c + 2) % 3);
                n[i] * s[j] - n[j] * s[i]
            };
            [s, unit([cross(0), cross(1), cross(2)]), n]
        }),
    }
}

/// Components x, y, z.
fn in_space<const D: usize>(v: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| v.get(c).copied().unwrap_or(0.0))
}

/// Components of a jump that are retained, from the first of a point on: slip, and the opening, which is the last. In space slip
/// across the rake stands between them, held at zero.
fn kept<const C: usize>() -> impl Iterator<Item = usize> {
    (0..C).filter(|&c| c == 0 || c == C - 1)
}

/// Components that are held at zero.
fn held<const C: usize>() -> impl Iterator<Item = usize> {
    1..C.saturating_sub(1).max(1)
}

fn with_components<const D: usize, const C: usize>(
    model: &Model<D>,
    bodies: Stiffness,
    stage: &Stage,
    points: &[Point<D>],
    memory: usize,
    frame: impl Fn(&Place<D>) -> [[f64; C]; C],
) -> Result<Surroundings, String> {
    let constraints = stage.constraints(&vec![0.0; model.dofs()]);
    let machine = Machine::new(stage);
    let drawn = |node: usize| (C * node..C * (node + 1)).any(|d| machine.draws(d));
    if let Some(p) = points.iter().find(|p| drawn(p.place.minus) && drawn(p.place.plus)) {
        return Err(format!(
            "a spring draws both sides of a fault as one at {}, which could not slip there: let it draw a side that ends at the fault",
            rigid::place(&p.place.at)
        ));
    }
    let jump = |p: &Point<D>| {
        let frame = frame(&p.place);
        let (minus, plus) = (C * p.place.minus, C * p.place.plus);
        // The node whose displacement gives way to the jump must not be tied to others.
        if drawn(p.place.plus) {
            return Jump { minus: plus, plus: minus, frame: frame.map(|axis| axis.map(|c| -c)) };
        }
        Jump { minus, plus, frame }
    };
    let list: Vec<Jump<C>> = points.iter().map(jump).collect();
    // The opening is the last component; where it may change normal tractions it is retained, at zero.
    let slip: Vec<usize> = list.iter().map(|j| j.plus).collect();
    let jumps = Jumps::new(list);
    let across = jumps.stiffness(&bodies);
    drop(bodies);
    let body = machine.stiffness(across);
    let oblique = |e: asperity_fem::jump::ObliqueConstraint| e.to_string();
    let free: Vec<usize> = (0..points.len()).filter(|&k| points[k].creep.is_none()).collect();
    let mut retained: Vec<usize> =
        free.iter().flat_map(|&k| kept::<C>().map(move |c| (k, c))).map(|(k, c)| slip[k] + c).collect();
    retained.sort_unstable();
    let mut fixed = jumps.fixed(&constraints.fixed).map_err(oblique)?;
    let is_fixed = |dof: usize| fixed.binary_search(&dof).is_ok();
    if let Some(&k) = free.iter().find(|&&k| is_fixed(slip[k])) {
        return Err(format!(
            "conditions prescribe the motion of both sides of a fault along its slip at {}, where it is to slide: let it creep there, or leave \
             that component of the conditions out",
            rigid::place(&points[k].place.at)
        ));
    }
    let supported: Vec<bool> = free.iter().map(|&k| C > 1 && is_fixed(slip[k] + C - 1)).collect();
    for (point, &dof) in points.iter().zip(&slip) {
        if point.creep.is_some() {
            fixed.extend(dof..dof + C);
        } else {
            fixed.extend(held::<C>().map(|c| dof + c));
        }
    }
    fixed.extend(machine.tied());
    fixed.sort_unstable();
    fixed.dedup();
    let mut channels = Vec::new();
    for channel in &constraints.channels {
        channels.push(machine.channel(&jumps.channel(channel, &constraints.fixed).map_err(oblique)?)?);
    }
    let creeping = points.iter().zip(&slip).filter_map(|(p, &d)| p.creep.map(|rate| (d, rate)));
    let prescribed: Vec<(usize, f64)> = creeping.collect();
    if !prescribed.is_empty() {
        let amplitude = Table::new(vec![0.0, stage.end], vec![0.0, stage.end]);
        channels.push(Channel { prescribed, forces: Vec::new(), amplitude });
    }
    channels.extend(machine.pulls(stage.end));
    let analysis = Loaded::analyse(body, &retained, &fixed, channels).map_err(|e| e.to_string())?;
    let bytes = analysis.bytes();
    let left = analysis.eliminate(memory).map_err(|e| in_words(model, &jumps, e))?;
    let rows: Vec<usize> = free.iter().map(|&k| retained.partition_point(|&d| d < slip[k])).collect();
    let area = |(&k, &supported): (&usize, &bool)| Bearing { area: points[k].place.area, supported };
    let bearings: Vec<Bearing> = free.iter().zip(&supported).map(area).collect();
    Ok(Surroundings { bytes, ..tractions::<C>(&left, &rows, &bearings) })
}

/// What forces of a point act on.
#[derive(Clone, Copy, Debug)]
struct Bearing {
    /// Tributary area \[m²; m per metre of thickness\].
    area: f64,
    /// Whether supports hold both sides against the opening: they take what changes of its force then, not the contact.
    supported: bool,
}

impl Bearing {
    /// Traction per force: of the slip (0), which the bodies drive with the opposite of what holds it, and of the opening (1).
    fn per_force(&self, shift: usize) -> f64 {
        match (shift, self.supported) {
            (0, _) => -1.0 / self.area,
            (_, true) => 0.0,
            (_, false) => 1.0 / self.area,
        }
    }
}

/// An error of the condensation with the place in the bodies.
fn in_words<const D: usize, const C: usize>(model: &Model<D>, jumps: &Jumps<C>, error: FemError) -> String {
    let Some(pivot) = error.pivot() else { return error.to_string() };
    // A jump stands at the degrees of freedom of one of its nodes.
    let node = pivot.equation / C;
    let component = match jumps.list().iter().any(|j| j.plus / C == node) {
        true => "slips or opens there",
        false => "can move there",
    };
    let body = model.bodies.iter().find(|b| b.dofs.contains(&pivot.equation)).map_or("", |b| b.name.as_str());
    format!(
        "the bodies around the faults are not held: body `{body}` {component} without resistance, found at {}; prescribe motions of sides that hold \
         each side of a fault",
        rigid::place(&model.mesh.nodes[node])
    )
}

/// Tractions from the condensed forces; `rows` are those of the slip of each point, in motion of more than one component its opening stands next to it. A force
/// is what must act on a jump to hold it there: the bodies drive slip with its opposite, and where it holds the sides apart they
/// press on each other, in compression.
fn tractions<const C: usize>(left: &Remainder, rows: &[usize], bearings: &[Bearing]) -> Surroundings {
    let n = rows.len();
    let part = |shift: usize| -> Vec<f64> {
        let mut matrix = Vec::with_capacity(n * n);
        for (&row, bearing) in rows.iter().zip(bearings) {
            let (per_area, forces) = (bearing.per_force(shift), left.row(row + shift));
            matrix.extend(rows.iter().map(|&column| per_area * forces[column]));
        }
        matrix
    };
    let shear = part(0);
    let largest = |m: &[f64]| m.iter().fold(0.0, |l: f64, v| l.max(v.abs()));
    let over_area = |forces: &[f64], shift: usize| -> Vec<f64> {
        rows.iter().zip(bearings).map(|(&r, b)| b.per_force(shift) * forces[r + shift]).collect()
    };
    // Loads may change normal tractions where slip does not.
    let loads_normal = |shear_load: f64| {
        C > 1 && left.channels().any(|(_, f)| largest(&over_area(f, 1)) > UNCOUPLED * shear_load)
    };
    let shear_load = left.channels().map(|(_, f)| largest(&over_area(f, 0))).fold(0.0, f64::max);
    let normal = if C == 1 { None } else { Some(part(1)) };
    let normal = normal.filter(|m| largest(m) > UNCOUPLED * largest(&shear) || loads_normal(shear_load));
    let mut loading = Loading::default();
    for (amplitude, forces) in left.channels() {
        let change = if C == 1 { Vec::new() } else { over_area(forces, 1) };
        loading.add(amplitude.clone(), over_area(forces, 0), change);
    }
    Surroundings { operator: Dense::new(n, shear, normal), loading, bytes: 0 }
}
