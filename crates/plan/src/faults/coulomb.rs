//! Changes of Coulomb stress over events, on planes of one direction and on the faults.

use super::free_surface::SurfaceAxes;
use asperity_cycles::medium::patches::{Patches, Slip};
use asperity_cycles::operator::{Form, Geometry, Operator};
use asperity_fem::material::elastic::Elastic;

/// Planes of one direction on which stress is resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReceiverPlane {
    /// Unit normal, from the footwall to the hanging wall.
    pub normal: [f64; 3],
    /// Unit direction in which the hanging wall slips.
    pub slip: [f64; 3],
    /// Effective friction coefficient.
    pub friction: f64,
}

/// Change of the stress on a plane \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Shear traction, positive where it drives the slip of the plane.
    pub shear: f64,
    /// Normal traction, compression positive.
    pub normal: f64,
    /// Coulomb stress Δτ - μ' Δf_n: an increase brings the plane closer to failure.
    pub coulomb: f64,
}

impl Change {
    /// Change under these tractions with an effective friction coefficient.
    pub(super) fn from_tractions([shear, normal]: [f64; 2], friction: f64) -> Self {
        Self { shear, normal, coulomb: shear - friction * normal }
    }
}

impl ReceiverPlane {
    /// Change of the tractions by a stress xx, yy, zz, xy, yz, zx, tension positive \[Pa\].
    #[must_use]
    pub fn resolve(&self, [xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> Change {
        let n = &self.normal;
        let traction = [
            xx * n[0] + xy * n[1] + zx * n[2],
            xy * n[0] + yy * n[1] + yz * n[2],
            zx * n[0] + yz * n[1] + zz * n[2],
        ];
        let along = |v: &[f64; 3]| traction.iter().zip(v).map(|(t, v)| t * v).sum::<f64>();
        Change::from_tractions([along(&self.slip), -along(n)], self.friction)
    }
}

/// Positions at one depth.
#[derive(Clone, Debug, PartialEq)]
pub struct CoulombMap {
    /// Positions \[m\]: in space row by row along the first axis.
    pub positions: Vec<[f64; 3]>,
    /// Coordinates.
    pub axes: SurfaceAxes,
    /// Depth below y = 0 \[m\].
    pub depth: f64,
}

/// Positions in homogeneous rock, and faults, at which changes of Coulomb stress are written.
#[derive(Clone, Debug)]
pub struct Coulomb {
    /// Direction of the planes.
    pub plane: ReceiverPlane,
    /// Positions at one depth.
    pub map: Option<CoulombMap>,
    /// Names and positions of points \[m\].
    pub points: Vec<(String, [f64; 3])>,
    /// True if changes on the points of the faults are written: with several faults.
    pub on_faults: bool,
    /// The cells of the faults.
    pub patches: Patches,
    /// The rock.
    pub rock: Elastic,
}

impl Coulomb {
    /// Changes at positions over events with these slips of all cells, component by component: for each position, stress
    /// \[Pa\] and change of each event.
    #[must_use]
    pub fn at(&self, positions: &[[f64; 3]], slips: &[&[f64]]) -> Vec<Vec<([f64; 6], Change)>> {
        let stresses = self.patches.stressed(positions, slips, &self.rock);
        let resolved = |all: Vec<[f64; 6]>| all.into_iter().map(|s| (s, self.plane.resolve(&s))).collect();
        stresses.into_iter().map(resolved).collect()
    }

    /// Description for the plan.
    pub(super) fn words(&self) -> String {
        let count = self.map.as_ref().map_or(0, |map| map.positions.len()) + self.points.len();
        let faults = if self.on_faults { " and on all faults" } else { "" };
        let friction = self.plane.friction;
        format!(
            "change of Coulomb stress at {count} positions{faults} over each event, effective friction {friction}"
        )
    }

    /// Changes on the cells of the faults along their rakes, event by event. Slip changes the normal tractions of all of them
    /// here, whatever their friction uses.
    pub fn on_cells(&self, slips: &[&[f64]], geometry: &Geometry<'_>) -> Vec<Vec<Change>> {
        let n = geometry.places.len();
        let tangents = slips.iter().map(|slip| slip.len() / n.max(1)).max().unwrap_or(1);
        let slip = Slip { tangents, changes: &vec![true; n] };
        let operator = self.patches.operator(&self.rock, slip, geometry, Form::Fitting);
        let of = |slip: &&[f64]| {
            let [shear, normal] = tractions(operator.as_ref(), slip);
            shear
                .into_iter()
                .zip(normal)
                .map(|(s, f)| Change::from_tractions([s, f], self.plane.friction))
                .collect()
        };
        slips.iter().map(of).collect()
    }
}

/// Shear tractions along the rakes and normal tractions of all points under a slip \[Pa\].
fn tractions(operator: &dyn Operator, slip: &[f64]) -> [Vec<f64>; 2] {
    let mut shear = operator.shear_of(slip);
    shear.truncate(operator.points());
    [shear, operator.normal_of(slip)]
}
