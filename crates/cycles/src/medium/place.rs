//! Geometry of the points of a fault: pairs of nodes, one on each side, or centres of cells in homogeneous rock.

use asperity_fem::surface;

/// A point of a fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Place<const D: usize> {
    /// Node on the minus side; without bodies, the number of the cell.
    pub minus: usize,
    /// Node on the plus side; without bodies, the number of the cell.
    pub plus: usize,
    /// Position \[m\].
    pub at: [f64; D],
    /// Tributary area \[m², or m per metre of thickness\].
    pub area: f64,
    /// Unit normal from minus to plus.
    pub normal: [f64; D],
    /// In space: unit direction of slip, in the fault; elsewhere zero.
    pub rake: [f64; D],
    /// In space: unit direction of creep, in the fault; elsewhere zero.
    pub creeps: [f64; D],
    /// Distance along a plane fault from its upper end \[m\]; 0 in space.
    pub along: f64,
}

/// Size below which a component of a direction is rounding of coordinates. It is set to zero, so that directions along
/// an axis are exact, as supports along that axis need them.
const ROUNDING: f64 = 1e-12;

/// A vector divided by its length. Along an axis, the other components are exactly zero.
#[must_use]
pub fn unit<const D: usize>(v: [f64; D]) -> [f64; D] {
    let length = surface::length(&v);
    let v = v.map(|c| if c.abs() <= ROUNDING * length { 0.0 } else { c });
    let length = surface::length(&v);
    v.map(|c| c / length)
}

/// The unit vector across a direction `s` in a fault of normal `n`: n x s.
#[must_use]
pub fn across(n: &[f64; 3], s: &[f64; 3]) -> [f64; 3] {
    let cross = |c: usize| {
        let (i, j) = ((c + 1) % 3, (c + 2) % 3);
        n[i] * s[j] - n[j] * s[i]
    };
    unit([cross(0), cross(1), cross(2)])
}
