//! Focal spheres: the lower hemisphere in the equal-area projection, with compressional first motions shaded.

use super::colour::{INK, PAPER, Rgb};
use super::figure::{Figure, Point};
use crate::formats::catalogues::Tensor;
use std::f64::consts::TAU;

/// Number of strips of which the shaded part consists.
const STRIPS: usize = 48;
/// Overlap of strips, so that no background shows between them, as a share of their height.
const OVERLAP: f64 = 0.3;
/// Number of positions at which the sign is taken along a strip.
const ALONG: usize = 96;
/// Number of corners of the outline.
const CORNERS: usize = 48;

/// Draws the focal sphere of a tensor around a point.
pub(super) fn ball(figure: &mut Figure, tensor: &Tensor, at: Point, radius: f64, shade: Rgb) {
    let outline: Vec<Point> = (0..=CORNERS)
        .map(|k| TAU * k as f64 / CORNERS as f64)
        .map(|angle| (at.0 + radius * angle.cos(), at.1 + radius * angle.sin()))
        .collect();
    figure.area(outline.clone(), PAPER);
    for (north, spans) in shaded(tensor) {
        let half = (0.5 + OVERLAP) / STRIPS as f64 * 2.0;
        for (from, to) in spans {
            let corner = |east: f64, north: f64| (at.0 + radius * east, at.1 - radius * north);
            let corners =
                [(from, north - half), (to, north - half), (to, north + half), (from, north + half)];
            figure.area(corners.into_iter().map(|(e, n)| corner(e, n)).collect(), shade);
        }
    }
    figure.line(outline, 1.0, INK);
}

/// Strips of the unit disc: their middle to the north, and the ranges to the east in which first motions are compressional.
fn shaded(tensor: &Tensor) -> Vec<(f64, Vec<(f64, f64)>)> {
    let strip = |k: usize| {
        let north = (2.0 * (k as f64 + 0.5) / STRIPS as f64) - 1.0;
        let reach = (1.0 - north * north).sqrt();
        let width = 2.0 * reach / ALONG as f64;
        let mut spans: Vec<(f64, f64)> = Vec::new();
        for i in 0..ALONG {
            let (from, to) = (i as f64 * width - reach, (i as f64 + 1.0) * width - reach);
            if amplitude(tensor, 0.5 * (from + to), north) > 0.0 {
                match spans.last_mut() {
                    Some(last) if (last.1 - from).abs() < 0.5 * width => last.1 = to,
                    _ => spans.push((from, to)),
                }
            }
        }
        (north, spans)
    };
    (0..STRIPS).map(strip).collect()
}

/// Amplitude of P waves that leave through a position of the unit disc, dᵀ M d for the direction d (Aki and Richards 2002,
/// section 4.3).
fn amplitude(Tensor([rr, tt, pp, rt, rp, tp]): &Tensor, east: f64, north: f64) -> f64 {
    let squared = east * east + north * north;
    let level = (2.0 - squared).max(0.0).sqrt();
    let [r, t, p] = [squared - 1.0, -level * north, level * east];
    rr * r * r + tt * t * t + pp * p * p + 2.0 * (rt * r * t + rp * r * p + tp * t * p)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formats::catalogues::Plane;

    fn tensor(strike: f64, dip: f64, rake: f64) -> Tensor {
        Tensor::from_plane(&Plane { strike, dip, rake }, 1.0)
    }

    #[test]
    fn quadrants_of_strike_slip_and_halves_of_dip_slip_are_shaded_as_they_move() {
        // Right-lateral along north: the eastern side moves south.
        let right = tensor(0.0, 90.0, 180.0);
        let at = |t: &Tensor, east: f64, north: f64| amplitude(t, east, north) > 0.0;
        assert!(!at(&right, 0.5, 0.5) && !at(&right, -0.5, -0.5));
        assert!(at(&right, 0.5, -0.5) && at(&right, -0.5, 0.5));
        // A thrust pushes down and up: its middle is compressional; a normal fault's is not.
        assert!(at(&tensor(0.0, 45.0, 90.0), 0.0, 0.0) && !at(&tensor(0.0, 45.0, -90.0), 0.0, 0.0));
    }

    #[test]
    fn amplitudes_vanish_on_nodal_planes_and_are_the_moment_along_the_axes() {
        // Down dip of the plane, and along its strike.
        let t = tensor(90.0, 30.0, 90.0);
        let (dip, disc) = (30.0_f64.to_radians(), |down: f64| (1.0 - down).sqrt());
        // The strike is east, so the plane dips to the south.
        assert!(amplitude(&t, 0.0, -disc(dip.sin())).abs() < 1e-14);
        assert!(amplitude(&t, 1.0, 0.0).abs() < 1e-14);
        // The axis of tension of a thrust is steep; that of one which dips 30 degrees plunges 75 degrees the way it dips.
        let plunge = 75.0_f64.to_radians();
        assert!((amplitude(&t, 0.0, -disc(plunge.sin())) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn half_of_the_sphere_of_a_double_couple_is_shaded() {
        // The projection keeps areas: 2π of 4π of a double couple are compressional, and so are π of the 2π below.
        for (strike, dip, rake) in
            [(0.0, 90.0, 0.0), (20.0, 90.0, 180.0), (77.0, 33.0, 90.0), (200.0, 60.0, -30.0)]
        {
            let strips = shaded(&tensor(strike, dip, rake));
            let area: f64 = strips.iter().flat_map(|s| &s.1).map(|(from, to)| to - from).sum();
            let share = area * 2.0 / STRIPS as f64 / std::f64::consts::PI;
            assert!((share - 0.5).abs() < 0.01, "{strike} {dip} {rake}: {share}");
        }
    }
}
