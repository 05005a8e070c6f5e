//! Slopes of a surface at scattered samples.

use nalgebra::{DMatrix, DVector};
use std::collections::BTreeSet;

/// Neighbours from which the five coefficients of a quadratic surface follow with some certainty.
const ENOUGH: usize = 8;
/// Rings of neighbours at most, where samples are few.
const RINGS: usize = 4;
/// Singular values over the largest that count as zero: directions in which neighbours do not determine the surface.
const NEGLIGIBLE: f64 = 1e-6;

/// Slopes to the east and north at each sample: those of the quadratic surface through it that fits its neighbours best, weighted by
/// their inverse distances.
pub(super) fn slopes<'a>(samples: &[[f64; 3]], faces: impl Iterator<Item = &'a [usize; 3]>) -> Vec<[f64; 2]> {
    let mut beside = vec![BTreeSet::new(); samples.len()];
    for corners in faces {
        for &a in corners {
            beside[a].extend(corners.iter().copied().filter(|&b| b != a));
        }
    }
    (0..samples.len()).map(|n| slope(samples, n, &around(&beside, n))).collect()
}

/// Neighbours of a sample, by whole rings: two of them, and more if these are few.
fn around(beside: &[BTreeSet<usize>], n: usize) -> BTreeSet<usize> {
    let mut found = beside[n].clone();
    for ring in 1..RINGS {
        if ring >= 2 && found.len() >= ENOUGH {
            break;
        }
        let next: Vec<usize> = found.iter().flat_map(|&a| beside[a].iter().copied()).collect();
        found.extend(next);
        found.remove(&n);
    }
    found
}

fn slope(samples: &[[f64; 3]], n: usize, neighbours: &BTreeSet<usize>) -> [f64; 2] {
    let ways: Vec<[f64; 3]> =
        neighbours.iter().map(|&a| std::array::from_fn(|c| samples[a][c] - samples[n][c])).collect();
    let Some(scale) = ways.iter().map(|way| way[0].hypot(way[1])).max_by(f64::total_cmp) else {
        return [0.0; 2];
    };
    let weight = |way: &[f64; 3]| scale / way[0].hypot(way[1]);
    let row = |way: &[f64; 3]| {
        let (x, y) = (way[0] / scale, way[1] / scale);
        [x, y, x * x, x * y, y * y].map(|v| weight(way) * v)
    };
    let matrix = DMatrix::from_row_iterator(ways.len(), 5, ways.iter().flat_map(row));
    let values = DVector::from_iterator(ways.len(), ways.iter().map(|way| weight(way) * way[2] / scale));
    let split = matrix.svd(true, true);
    let least = NEGLIGIBLE * split.singular_values.max();
    split.solve(&values, least).map_or([0.0; 2], |fit| [fit[0], fit[1]])
}
