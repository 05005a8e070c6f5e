//! Places of the markers of a set.

use super::super::figure::Point;

/// Distance of the places considered along lines on the paper, over the extent of all.
const STEP: f64 = 1.0 / 400.0;

/// Up to `count` places at equal distances along lines, in the order in which they lie along the direction of the whole.
pub(super) fn along(lines: &[[Point; 2]], count: usize) -> Vec<Point> {
    let ends = || lines.iter().flatten();
    let (lo, hi) = ends().fold(((f64::MAX, f64::MAX), (f64::MIN, f64::MIN)), |(lo, hi), p| {
        ((lo.0.min(p.0), lo.1.min(p.1)), (hi.0.max(p.0), hi.1.max(p.1)))
    });
    let (width, height) = (hi.0 - lo.0, hi.1 - lo.1);
    let step = STEP * width.max(height);
    let mut places: Vec<(Point, f64)> = Vec::new();
    for [a, b] in lines {
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let pieces = if step > 0.0 { (length / step).ceil().max(1.0) as usize } else { 1 };
        let at = |k: usize| (k as f64 + 0.5) / pieces as f64;
        let place = |k: usize| (a.0 + at(k) * (b.0 - a.0), a.1 + at(k) * (b.1 - a.1));
        places.extend((0..pieces).map(|k| (place(k), length / pieces as f64)));
    }
    let position = |p: &Point| if width > height { p.0 } else { p.1 };
    places.sort_by(|a, b| position(&a.0).total_cmp(&position(&b.0)));
    let total: f64 = places.iter().map(|place| place.1).sum();
    let mut chosen = Vec::new();
    let mut passed = 0.0;
    for (place, length) in places {
        passed += length;
        if chosen.len() < count && passed >= total * (chosen.len() as f64 + 0.5) / count as f64 {
            chosen.push(place);
        }
    }
    chosen
}

/// Up to `count` of some points, far from each other: the one nearest to their middle first, and then each time the farthest from all before.
pub(super) fn spread(points: &[Point], count: usize) -> Vec<Point> {
    let n = points.len().max(1) as f64;
    let middle = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / n, m.1 + p.1 / n));
    let apart = |a: &Point, b: &Point| (a.0 - b.0).hypot(a.1 - b.1);
    let first = points.iter().min_by(|a, b| apart(a, &middle).total_cmp(&apart(b, &middle)));
    let mut chosen: Vec<Point> = first.copied().into_iter().collect();
    let mut distance: Vec<f64> = points.iter().map(|p| chosen.first().map_or(0.0, |c| apart(p, c))).collect();
    while chosen.len() < count.min(points.len()) {
        let far = (0..points.len()).max_by(|&a, &b| distance[a].total_cmp(&distance[b]).then(b.cmp(&a)));
        let Some(next) = far.map(|k| points[k]) else { break };
        distance.iter_mut().zip(points).for_each(|(d, p)| *d = d.min(apart(p, &next)));
        chosen.push(next);
    }
    chosen
}

#[cfg(test)]
mod tests {
    use super::{along, spread};

    #[test]
    fn markers_lie_at_equal_distances_whatever_the_cells() {
        let at = [0.0, 0.1, 0.2, 5.0, 10.0];
        let lines: Vec<_> = at.windows(2).map(|w| [(w[0], 0.0), (w[1], 0.0)]).collect();
        let found = along(&lines, 5);
        for (k, place) in found.iter().enumerate() {
            assert!((place.0 - (2.0 * k as f64 + 1.0)).abs() < 0.1, "{found:?}");
        }
        assert!(along(&[], 5).is_empty());
    }

    #[test]
    fn markers_keep_apart_on_a_surface() {
        let points: Vec<(f64, f64)> = [0.0, 0.1, 0.2, 5.0, 10.0].map(|x| (x, 0.0)).into();
        assert_eq!(spread(&points, 3), [(5.0, 0.0), (0.0, 0.0), (10.0, 0.0)]);
    }
}
