//! Conditions on the sides of a fault: the node of each point that is replaced by its jump, and the conditions that are
//! impossible.

use super::place::Place;
use super::point::Point;
use super::refusal::Refusal;
use asperity_fem::dof::Channel;
use asperity_fem::jump::{Jump, Jumps};

/// True for the components of a node that are prescribed; `fixed` is sorted.
fn held<const C: usize>(node: usize, fixed: &[usize]) -> [bool; C] {
    std::array::from_fn(|c| fixed.binary_search(&(C * node + c)).is_ok())
}

/// Jumps of the points of faults.
pub(super) struct PointJumps<'a, const D: usize, const C: usize> {
    pub points: &'a [Point<D>],
    /// Axes of the jump of each point: slip along the tangents first, the opening last.
    pub frames: Vec<[[f64; C]; C]>,
    /// First degree of freedom of the jump of each point.
    pub first: Vec<usize>,
    pub jumps: Jumps<C>,
    /// Number of directions along which points slide.
    pub tangents: usize,
}

impl<'a, const D: usize, const C: usize> PointJumps<'a, D, C> {
    /// The jumps between sides with `fixed` degrees of freedom. Nodes that a spring loads, according to `drawn`, are not replaced.
    pub fn new(
        points: &'a [Point<D>],
        tangents: usize,
        frame: impl Fn(&Place<D>) -> [[f64; C]; C],
        fixed: &[usize],
        drawn: impl Fn(usize) -> bool,
    ) -> Self {
        let frames: Vec<[[f64; C]; C]> = points.iter().map(|p| frame(&p.place)).collect();
        let list: Vec<Jump<C>> =
            points.iter().zip(&frames).map(|(p, frame)| jump(p, *frame, fixed, &drawn)).collect();
        Self {
            points,
            frames,
            first: list.iter().map(|j| j.plus).collect(),
            jumps: Jumps::new(list),
            tangents,
        }
    }
}

/// The jump of a point. It replaces the node with fewer conditions: a condition on one side alone leaves the jump free.
/// A node that a spring loads, according to `drawn`, is not replaced.
fn jump<const D: usize, const C: usize>(
    point: &Point<D>,
    frame: [[f64; C]; C],
    fixed: &[usize],
    drawn: impl Fn(usize) -> bool,
) -> Jump<C> {
    let [minus, plus] = [point.place.minus, point.place.plus];
    let (on_minus, on_plus): ([bool; C], [bool; C]) = (held(minus, fixed), held(plus, fixed));
    let within = |a: &[bool; C], b: &[bool; C]| a.iter().zip(b).all(|(a, b)| !a || *b);
    let swap = drawn(plus) || (!drawn(minus) && !within(&on_plus, &on_minus) && within(&on_minus, &on_plus));
    if swap {
        // Exchanging the sides changes the sign of the jump.
        return Jump { minus: C * plus, plus: C * minus, frame: frame.map(|axis| axis.map(|c| -c)) };
    }
    Jump { minus: C * minus, plus: C * plus, frame }
}

/// The largest component of an axis.
pub(super) fn most<const C: usize>(axis: &[f64; C]) -> usize {
    let larger = |&a: &usize, &b: &usize| axis[a].abs().total_cmp(&axis[b].abs());
    (0..C).max_by(larger).unwrap_or(0)
}

/// Relative difference up to which two motions are equal: the rounding of rates and durations.
const AGREES: f64 = 1e-9;

/// Rates of creep \[m/s\] by degree of freedom until `end`. Jumps that conditions already prescribe, given by `fixed`, are left
/// out.
///
/// # Errors
/// A [`Refusal`] where conditions on both sides of a creeping point contradict its creep, or move its sides apart.
pub(super) fn creep<const D: usize, const C: usize>(
    PointJumps { points, frames, first, tangents, .. }: &PointJumps<'_, D, C>,
    fixed: &[usize],
    channels: &[Channel],
    end: f64,
) -> Result<Vec<(usize, f64)>, Refusal> {
    let value = |channel: &Channel, dof: usize| {
        channel.prescribed.iter().find(|(d, _)| *d == dof).map_or(0.0, |(_, value)| *value)
    };
    let moved = |dof: usize, time: f64| -> f64 {
        channels.iter().map(|c| value(c, dof) * c.amplitude.value(time)).sum()
    };
    let mut times: Vec<f64> = channels.iter().flat_map(|c| c.amplitude.times().iter().copied()).collect();
    times.retain(|t| *t < end);
    times.push(end);
    let farthest = |c: &Channel| {
        c.prescribed.iter().fold(0.0_f64, |m, (_, v)| m.max((v * c.amplitude.value(end)).abs()))
    };
    let travel = channels.iter().map(farthest).fold(0.0, f64::max);
    let mut rates = Vec::new();
    for (k, (point, &dof)) in points.iter().zip(first).enumerate() {
        let Some(creep) = point.creep else { continue };
        // Components that are held have no creep, and creep opens nothing.
        let along = creep.into_iter().take(*tangents).chain(std::iter::repeat(0.0));
        for (c, rate) in along.take(C).enumerate() {
            if fixed.binary_search(&(dof + c)).is_err() {
                rates.extend((rate != 0.0).then_some((dof + c, rate)));
                continue;
            }
            let scale = travel.max((rate * end).abs());
            let differs = |t: &&f64| (moved(dof + c, **t) - rate * **t).abs() > AGREES * scale;
            if let Some(&t) = times.iter().find(differs) {
                return Err(Refusal::Moved {
                    point: k,
                    component: most(&frames[k][c]),
                    rate: (c < *tangents).then_some(rate),
                    way: moved(dof + c, t),
                    time: t,
                });
            }
        }
    }
    Ok(rates)
}
