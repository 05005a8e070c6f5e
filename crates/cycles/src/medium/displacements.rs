//! Displacements that uniform slip of patches causes in homogeneous rock, from dislocations in closed form.

use super::patches::{Patches, from_kernel, to_kernel};
use asperity_fem::material::elastic::Elastic;
use rayon::prelude::*;

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

    /// Displacements at positions by slips of all patches, component by component: for each position, one per slip \[m\]. See
    /// [`Self::displacements`].
    #[must_use]
    pub fn caused(&self, positions: &[[f64; 3]], slips: &[&[f64]], rock: &Elastic) -> Vec<Vec<[f64; 3]>> {
        summed(positions, slips, self.count(), |at, component| self.displacements(at, component, rock))
    }
}

/// Sums of what slips of `count` patches cause, component by component: for each position, one per slip. `per_slip` has that of
/// unit slip of each patch in a component.
pub(super) fn summed<const N: usize>(
    positions: &[[f64; 3]],
    slips: &[&[f64]],
    count: usize,
    per_slip: impl Fn(&[f64; 3], usize) -> Vec<[f64; N]> + Sync,
) -> Vec<Vec<[f64; N]>> {
    let tangents = slips.iter().map(|slip| slip.len() / count.max(1)).max().unwrap_or(0);
    let of = |at: &[f64; 3]| {
        let per_slip: Vec<[f64; N]> = (0..tangents).flat_map(|component| per_slip(at, component)).collect();
        let sum = |slip: &&[f64]| {
            slip.iter()
                .zip(&per_slip)
                .fold([0.0; N], |sum: [f64; N], (slip, per)| std::array::from_fn(|c| sum[c] + slip * per[c]))
        };
        slips.iter().map(sum).collect()
    };
    positions.par_iter().map(of).collect()
}
