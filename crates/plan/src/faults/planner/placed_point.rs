//! A point of a fault during planning.

use super::medium::Medium;
use super::prestress::ResolvedTractions;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Along, Profile};
use crate::shared::field::samples::between;
use asperity_cycles::medium::{Place, Point, across};
use asperity_fem::vector::tangent;

/// A point with its fault and its law.
pub(crate) struct PlacedPoint<const D: usize> {
    pub point: Point<D>,
    pub fault: usize,
    /// Normal traction at the start \[Pa\].
    pub normal: f64,
    pub medium: Medium,
    pub damping: f64,
    /// Distance to the farthest neighbour \[m\].
    pub spacing: f64,
    /// Least normal traction that friction uses \[Pa\].
    pub floor: Option<f64>,
    /// Initial shear traction, if given \[Pa\].
    pub shear: Option<f64>,
    /// Initial shear traction, along slip and across it, of a point whose bodies have been pressed: its slip rate follows from
    /// friction \[Pa\].
    pub pressed_shear: Option<[f64; 2]>,
    /// Initial slip rate \[m/s\].
    pub rate: f64,
    /// Initial state variable, if a file gives it: the shear traction follows from it and the slip rate.
    pub state: Option<f64>,
    /// Initial tractions from the stress in the bodies.
    pub prestress: ResolvedTractions,
    pub law: LawChoice,
    /// Creep rate, if any \[m/s\].
    pub creep: Option<f64>,
    /// Number of displacement components of the bodies.
    pub components: usize,
}

/// Points of faults that slide by their law, and those that creep.
#[derive(Clone, Copy)]
pub(super) struct FaultPoints<'a, const D: usize> {
    pub sliding: &'a [PlacedPoint<D>],
    pub creeping: &'a [PlacedPoint<D>],
}

impl<const D: usize> PlacedPoint<D> {
    /// Recomputes the creep components after the directions of the point have changed.
    pub fn redirect(&mut self) {
        self.point.creep = self.creep.map(|rate| components(&self.point.place, rate));
    }
}

impl<const D: usize> PlacedPoint<D> {
    /// Initial f_n as used by friction \[Pa\].
    pub fn pressed(&self) -> f64 {
        self.floor.map_or(self.normal, |floor| self.normal.max(floor))
    }
}

/// Coordinate of a point along which a profile is given.
pub(super) fn along<const D: usize>(profile: &Profile, place: &Place<D>) -> f64 {
    match profile.along.get_ref() {
        Along::X => place.at[0],
        Along::Y => place.at[1],
        // The scene check refuses it in 2D.
        Along::Z => place.at[D - 1],
        Along::Distance => place.along,
    }
}

/// Value of a profile at a point: linear between its nodes, constant beyond them.
pub(super) fn at<const D: usize>(profile: &Profile, place: &Place<D>) -> f64 {
    let points = profile.points.get_ref();
    between(points.len(), |k| (points[k].0.0, points[k].1), along(profile, place))
}

/// Direction of motion of the plus side for positive slip: out of the plane, along the fault in the plane, or along the
/// rake.
pub(crate) fn slides<const D: usize>(placed: &PlacedPoint<D>) -> [f64; 3] {
    let normal = in_space(&placed.point.place.normal);
    match placed.components {
        1 => [0.0, 0.0, 1.0],
        2 => tangent(&normal),
        _ => in_space(&placed.point.place.rake),
    }
}

/// Components of a creep rate along and across the rake.
pub(super) fn components<const D: usize>(place: &Place<D>, rate: f64) -> [f64; 2] {
    if place.creeps == place.rake {
        return [rate, 0.0];
    }
    let (rake, creeps) = (in_space(&place.rake), in_space(&place.creeps));
    let axes = [rake, across(&in_space(&place.normal), &rake)];
    axes.map(|axis| rate * axis.iter().zip(&creeps).map(|(a, b)| a * b).sum::<f64>())
}

pub(crate) fn in_space<const D: usize>(at: &[f64; D]) -> [f64; 3] {
    std::array::from_fn(|c| if c < D { at[c] } else { 0.0 })
}
