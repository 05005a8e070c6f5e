//! Slave points on planes of symmetry.
//!
//! Of such a point only the facets on one side of the plane are modelled. Those on the other side, their image, would contribute the
//! image of every integral: sums along the plane double, and sums across it vanish. Averages over one side alone have a part across, so that a
//! point that sticks would bear a traction across the plane, which grows with the penalty. Normals are therefore projected onto the
//! plane, and tangents across it are left out.

use crate::vector::cross;

/// Axes normal to planes of symmetry through a slave point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Mirror(pub [bool; 3]);

impl Mirror {
    /// True if there is such a plane.
    pub(super) fn any(self) -> bool {
        self.0.contains(&true)
    }

    /// A vector without its components across the planes.
    pub(super) fn flattened<const D: usize>(self, mut v: [f64; D]) -> [f64; D] {
        v.iter_mut().zip(self.0).filter(|(_, across)| *across).for_each(|(v, _)| *v = 0.0);
        v
    }

    /// Frame of a unit normal that lies in the planes: `n × e` along the only plane of a point in space, whose normal is e, and no
    /// tangent otherwise. It is linear in n, and so also gives the change of the frame for that of n.
    pub(super) fn frame<const D: usize>(self, n: &[f64; D]) -> [[f64; D]; 2] {
        let mut planes = (0..D).filter(|&axis| self.0[axis]);
        let (Some(axis), None, 3) = (planes.next(), planes.next(), D) else { return [[0.0; D]; 2] };
        let mut across = [0.0; D];
        across[axis] = 1.0;
        [cross(n, &across), [0.0; D]]
    }
}
