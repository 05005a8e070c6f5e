//! Stresses that uniform slip of patches causes in homogeneous rock, from dislocations in closed form.

use super::displacements::summed;
use super::patches::{Patches, Tile, to_kernel};
use asperity_fem::material::elastic::Elastic;
use nalgebra::Matrix3;

/// Stress xx, yy, zz, xy, yz, zx \[Pa\], tension positive.
type Stress = [f64; 6];

impl Patches {
    /// Stress at a position, with y up, per unit slip of each patch in a component \[Pa/m\]. It is infinite or not a number on
    /// the edge of a patch, and not a number above the surface of a half-space.
    #[must_use]
    pub fn stresses(&self, at: &[f64; 3], component: usize, rock: &Elastic) -> Vec<Stress> {
        let in_the_plane = [at[0], at[1]];
        match self {
            Self::Antiplane(segments) => {
                let of = |[zx, yz]: [f64; 2]| [0.0, 0.0, 0.0, 0.0, yz, zx];
                segments.iter().map(|s| of(s.screw(in_the_plane, 1.0).stress(rock.shear()))).collect()
            }
            Self::Plane(segments) => {
                let of = |[xx, yy, xy]: [f64; 3]| [xx, yy, rock.poisson() * (xx + yy), xy, 0.0, 0.0];
                segments.iter().map(|s| of(s.edge(in_the_plane, [1.0, 0.0], rock).stress)).collect()
            }
            Self::Space { tiles, .. } => {
                let at = to_kernel(at);
                let of = |tile: &Tile| {
                    let slip = to_kernel([&tile.rake, &tile.across][component]);
                    in_scene(&tile.shape.field(&at, &slip, rock.poisson()).stress(rock))
                };
                tiles.iter().map(of).collect()
            }
        }
    }

    /// Stresses at positions by slips of all patches, component by component: for each position, one per slip \[Pa\]. See
    /// [`Self::stresses`].
    #[must_use]
    pub fn stressed(&self, positions: &[[f64; 3]], slips: &[&[f64]], rock: &Elastic) -> Vec<Vec<Stress>> {
        summed(positions, slips, self.count(), |at, component| self.stresses(at, component, rock))
    }
}

/// Stress in the axes of a kernel, whose x, y and z are z, x and y of positions.
fn in_scene(stress: &Matrix3<f64>) -> Stress {
    let of = |i: usize, j: usize| stress[(i, j)];
    [of(1, 1), of(2, 2), of(0, 0), of(1, 2), of(2, 0), of(0, 1)]
}
