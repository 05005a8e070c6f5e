//! Displacements that uniform slip of patches causes in homogeneous rock, from dislocations in closed form.

use super::patches::{Patches, from_kernel, to_kernel};
use asperity_fem::material::elastic::Elastic;

impl Patches {
    /// Displacement at a position, with y up, per unit slip of each patch in a component \[-\]. It is not a number at a position
    /// that lies above the surface of a half-space or on the edge of a patch.
    #[must_use]
    pub fn displacements(&self, at: &[f64; 3], component: usize, rock: &Elastic) -> Vec<[f64; 3]> {
        let in_the_plane = [at[0], at[1]];
        match self {
            Self::Antiplane(segments) => {
                segments.iter().map(|s| [0.0, 0.0, s.screw(in_the_plane, 1.0).displacement]).collect()
            }
            Self::Plane(segments) => {
                let of = |[x, y]: [f64; 2]| [x, y, 0.0];
                segments.iter().map(|s| of(s.edge(in_the_plane, [1.0, 0.0], rock).displacement)).collect()
            }
            Self::Space { tiles, .. } => {
                let at = to_kernel(at);
                let of = |slip: &[f64; 3], tile: &super::patches::Tile| {
                    from_kernel(&tile.shape.field(&at, &to_kernel(slip), rock.poisson()).displacement)
                };
                tiles.iter().map(|tile| of([&tile.rake, &tile.across][component], tile)).collect()
            }
        }
    }
}
