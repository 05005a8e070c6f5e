//! A smooth curve through the vertices of a trace.
//!
//! Both coordinates are cubic splines of the chord length, with continuous curvature and without a knot at the second vertex from either end
//! ("not a knot"). Between samples of a smooth curve, the error decreases with the fourth power of their distance, including the ends (de Boor
//! 1978; for curves by chord length Floater 2006). Three vertices give a parabola. A trace whose vertices lie on a line remains that line.

use super::check;

/// Largest turn at a vertex for which it lies on the line of its neighbours: rounding of coordinates with six digits \[rad\].
const STRAIGHT: f64 = 1e-6;
/// Abscissa and weight of the outer points of Gauss's rule with three points on [-1, 1]; the middle has weight 8/9.
const GAUSS: [f64; 2] = [0.774_596_669_241_483_4, 5.0 / 9.0];
/// Pieces of a segment over which its length is integrated: errors decrease with the sixth power of their number.
const PIECES: usize = 32;
/// Number of halvings that exhaust the digits of a parameter.
const HALVINGS: usize = 54;
/// Number of points per segment at which its distance from the chord is evaluated.
const LOOKS: usize = 32;

/// A curve through points.
#[derive(Debug)]
pub(super) struct Curve {
    points: Vec<[f64; 2]>,
    /// Parameter at the points: the length of the preceding chords \[m\].
    at: Vec<f64>,
    /// Second derivatives there \[1/m\].
    second: Vec<[f64; 2]>,
    /// Arc length from the first point to each \[m\].
    lengths: Vec<f64>,
}

/// Departure of a curve from straight lines between its vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Departure {
    /// Largest distance \[m\].
    pub distance: f64,
    /// Position of the largest distance \[m\].
    pub at: [f64; 2],
}

impl Curve {
    /// The curve through these vertices; `None` if it is the line between them.
    pub(super) fn through(points: &[[f64; 2]]) -> Option<Self> {
        if points.len() < 3 || straight(points) {
            return None;
        }
        let at = check::distances(points);
        let second = second_derivatives(points, &at);
        let mut curve = Self { points: points.to_vec(), at, second, lengths: vec![0.0] };
        for k in 0..points.len() - 1 {
            let length = curve.length(k, 1.0);
            curve.lengths.push(curve.lengths[k] + length);
        }
        Some(curve)
    }

    /// Arc lengths from the first vertex to each \[m\].
    pub(super) fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// Position in segment `k` at a fraction `t` of its chord length.
    fn place(&self, k: usize, t: f64) -> [f64; 2] {
        let h = self.at[k + 1] - self.at[k];
        let (a, b) = (1.0 - t, t);
        std::array::from_fn(|c| {
            let cubic = (a * a * a - a) * self.second[k][c] + (b * b * b - b) * self.second[k + 1][c];
            a * self.points[k][c] + b * self.points[k + 1][c] + h * h / 6.0 * cubic
        })
    }

    /// Derivative of arc length with respect to `t` \[m\].
    fn speed(&self, k: usize, t: f64) -> f64 {
        let h = self.at[k + 1] - self.at[k];
        let (a, b) = (1.0 - t, t);
        let d: [f64; 2] = std::array::from_fn(|c| {
            let bend = (1.0 - 3.0 * a * a) * self.second[k][c] + (3.0 * b * b - 1.0) * self.second[k + 1][c];
            self.points[k + 1][c] - self.points[k][c] + h * h / 6.0 * bend
        });
        d[0].hypot(d[1])
    }

    /// Arc length of segment `k` up to `t` \[m\].
    fn length(&self, k: usize, t: f64) -> f64 {
        let half = 0.5 * t / PIECES as f64;
        let [x, w] = GAUSS;
        let piece = |j: usize| {
            let middle = (2 * j + 1) as f64 * half;
            let sides = self.speed(k, middle - x * half) + self.speed(k, middle + x * half);
            half * (8.0 / 9.0 * self.speed(k, middle) + w * sides)
        };
        (0..PIECES).map(piece).sum()
    }

    /// Positions at ascending arc lengths \[m\]; exact at vertices.
    pub(super) fn places(&self, along: &[f64]) -> Vec<[f64; 2]> {
        let last = self.points.len() - 1;
        let close = check::ROUNDING * self.lengths[last];
        along
            .iter()
            .map(|&s| {
                let near = self.lengths.partition_point(|&l| l < s - close);
                if near <= last && (self.lengths[near] - s).abs() <= close {
                    return self.points[near];
                }
                let k = near.clamp(1, last) - 1;
                let (mut low, mut high) = (0.0, 1.0);
                for _ in 0..HALVINGS {
                    let middle = 0.5 * (low + high);
                    if self.lengths[k] + self.length(k, middle) < s { low = middle } else { high = middle }
                }
                self.place(k, 0.5 * (low + high))
            })
            .collect()
    }

    /// Largest departure from the lines between its vertices.
    pub(super) fn departure(&self) -> Departure {
        let mut most = Departure { distance: 0.0, at: self.points[0] };
        for (k, w) in self.points.windows(2).enumerate() {
            let chord = [w[1][0] - w[0][0], w[1][1] - w[0][1]];
            let length = chord[0].hypot(chord[1]);
            for j in 1..LOOKS {
                let at = self.place(k, j as f64 / LOOKS as f64);
                let across = (at[0] - w[0][0]) * chord[1] - (at[1] - w[0][1]) * chord[0];
                let distance = across.abs() / length;
                if distance > most.distance {
                    most = Departure { distance, at };
                }
            }
        }
        most
    }
}

/// True if no vertex turns.
fn straight(points: &[[f64; 2]]) -> bool {
    points.windows(3).all(|w| {
        let (a, b) = ([w[1][0] - w[0][0], w[1][1] - w[0][1]], [w[2][0] - w[1][0], w[2][1] - w[1][1]]);
        let turn = (a[0] * b[1] - a[1] * b[0]).atan2(a[0] * b[0] + a[1] * b[1]);
        turn.abs() <= STRAIGHT
    })
}

/// Second derivatives of the spline at its points: h_{k-1} M_{k-1} + 2 (h_{k-1} + h_k) M_k + h_k M_{k+1} = 6 (d_k - d_{k-1}) with the slopes d of the
/// chords, and M linear over the first two and the last two segments.
fn second_derivatives(points: &[[f64; 2]], at: &[f64]) -> Vec<[f64; 2]> {
    let last = points.len() - 1;
    let h: Vec<f64> = at.windows(2).map(|w| w[1] - w[0]).collect();
    let slope = |k: usize, c: usize| (points[k + 1][c] - points[k][c]) / h[k];
    let jump = |k: usize| -> [f64; 2] { std::array::from_fn(|c| 6.0 * (slope(k, c) - slope(k - 1, c))) };
    if last == 2 {
        // A parabola.
        return vec![jump(1).map(|j| j / (3.0 * (h[0] + h[1]))); 3];
    }
    // M_0 = (1 + r) M_1 - r M_2 with r = h_0/h_1, and likewise at the other end.
    let ratios = [h[0] / h[1], h[last - 1] / h[last - 2]];
    let (mut diagonal, mut upper, mut right) = (vec![0.0; last], vec![0.0; last], vec![[0.0; 2]; last]);
    for k in 1..last {
        let (mut lower, mut middle, mut next) = (h[k - 1], 2.0 * (h[k - 1] + h[k]), h[k]);
        if k == 1 {
            middle += h[0] * (1.0 + ratios[0]);
            next -= h[0] * ratios[0];
            lower = 0.0;
        }
        if k == last - 1 {
            middle += h[k] * (1.0 + ratios[1]);
            lower -= h[k] * ratios[1];
            next = 0.0;
        }
        let factor = if k == 1 { 0.0 } else { lower / diagonal[k - 1] };
        diagonal[k] = middle - if k == 1 { 0.0 } else { factor * upper[k - 1] };
        upper[k] = next;
        let (own, before) = (jump(k), right[k - 1]);
        right[k] = std::array::from_fn(|c| own[c] - factor * before[c]);
    }
    let mut second = vec![[0.0; 2]; last + 1];
    for k in (1..last).rev() {
        let after = second[k + 1];
        second[k] = std::array::from_fn(|c| (right[k][c] - upper[k] * after[c]) / diagonal[k]);
    }
    let end =
        |near: [f64; 2], next: [f64; 2], r: f64| std::array::from_fn(|c| (1.0 + r) * near[c] - r * next[c]);
    second[0] = end(second[1], second[2], ratios[0]);
    second[last] = end(second[last - 1], second[last - 2], ratios[1]);
    second
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of the circle of radius 2 about (2, 0), from (0, 0) down, with `n` segments of unequal length.
    fn arc(n: usize) -> Vec<[f64; 2]> {
        let share = |k: usize| {
            let s = k as f64 / n as f64;
            s + 0.1 * (std::f64::consts::TAU * s).sin() / std::f64::consts::TAU
        };
        let angle = |k: usize| 0.5 * std::f64::consts::PI * share(k);
        (0..=n).map(|k| [2.0 - 2.0 * angle(k).cos(), -2.0 * angle(k).sin()]).collect()
    }

    #[test]
    fn the_error_on_a_circle_falls_with_the_fourth_power_at_its_ends_too() {
        let error = |n: usize| {
            let curve = Curve::through(&arc(n)).unwrap();
            let looks = (0..n).flat_map(|k| (0..10).map(move |j| (k, 0.1 * f64::from(j))));
            let off = looks.map(|(k, t)| {
                let x = curve.place(k, t);
                ((x[0] - 2.0).hypot(x[1]) - 2.0).abs()
            });
            let length = (curve.lengths()[n] - std::f64::consts::PI).abs();
            (off.fold(0.0, f64::max), length)
        };
        let errors: Vec<(f64, f64)> = [8, 16, 32].into_iter().map(error).collect();
        for w in errors.windows(2) {
            let order = (w[0].0 / w[1].0).log2();
            assert!((3.7..4.6).contains(&order), "{errors:?}");
            assert!(w[1].1 < w[0].1 / 11.0, "{errors:?}");
        }
    }

    #[test]
    fn parabolas_and_cubics_by_chord_length_are_met_exactly() {
        // Points on a line at unequal distances have zero second derivatives; those of a parabola have a single value.
        let line: Vec<[f64; 2]> = [0.0, 1.0, 4.0, 5.0, 9.0].iter().map(|s| [0.6 * s, 0.8 * s]).collect();
        let at = check::distances(&line);
        assert!(second_derivatives(&line, &at).iter().flatten().all(|m| m.abs() < 1e-13));
        // With the exact parameter, a cubic is reproduced: not a knot.
        let cubic = |t: f64| [t * t * t - t, 2.0 * t * t];
        let points: Vec<[f64; 2]> = at.iter().map(|&t| cubic(t)).collect();
        for (m, t) in second_derivatives(&points, &at).iter().zip(&at) {
            assert!((m[0] - 6.0 * t).abs() < 1e-10 && (m[1] - 4.0).abs() < 1e-10, "{m:?} at {t}");
        }
        let three = second_derivatives(&points[..3], &at[..3]);
        assert!(three.iter().all(|m| (m[1] - 4.0).abs() < 1e-12), "{three:?}");
    }

    #[test]
    fn places_lie_at_their_arc_lengths_and_vertices_are_exact() {
        let vertices = arc(6);
        let curve = Curve::through(&vertices).unwrap();
        let total = curve.lengths()[6];
        let along: Vec<f64> =
            (0..=50).map(|k| total * f64::from(k) / 50.0).chain([curve.lengths()[3]]).collect();
        let places = curve.places(&along);
        assert_eq!([places[0], places[50], places[51]], [vertices[0], vertices[6], vertices[3]]);
        for w in places[..51].windows(2) {
            // On the circle of radius 2 the chord of an arc s is 4 sin(s/4).
            let chord = (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            assert!((chord / (4.0 * (total / 200.0).sin()) - 1.0).abs() < 3e-3, "{chord}");
        }
        assert!(Curve::through(&[[0.0, 0.0], [0.0, -1.0], [0.0, -3.0]]).is_none());
        let departure = curve.departure();
        // The longest segment spans about 17 degrees: 2 (1 - cos 8.6).
        assert!((0.015..0.025).contains(&departure.distance), "{departure:?}");
    }
}
