//! A point that slides over the triangles of a pyramid, across each edge of each, and off its rim.

use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_contact::measure::node_to_point::finite::NodeToPointMeasure;
use asperity_contact::measure::{Geometry, Measure as _};
use asperity_contact::search::surface::Surface;
use asperity_contact::{Segment, SegmentKind, SlavePoint, SurfaceNode};
use std::f64::consts::TAU;

/// See the README.
pub const CASE: Case = Case {
    name: "contact_pairing",
    readme: include_str!("README.md"),
    covers: &[Capability::PenaltyContact3d, Capability::FiniteSliding, Capability::Triangles],
    quick: true,
    run,
};

/// Corners of the rim.
const SIDES: usize = 6;
/// Height of the apex over the radius of the rim, 1.
const HEIGHT: f64 = 0.3;
/// Height of the point above the pyramid.
const ABOVE: f64 = 2e-3;
/// Steps of a turn.
const STEPS: usize = 480;
/// Distance from the axis.
const RADIUS: f64 = 0.5;

fn corner(k: usize) -> [f64; 3] {
    let (sine, cosine) = (TAU * k as f64 / SIDES as f64).sin_cos();
    [cosine, sine, 0.0]
}

/// Nodes: the apex, the rim, and the slave.
fn nodes() -> Vec<[f64; 3]> {
    let rim = (0..SIDES).map(corner);
    std::iter::once([0.0, 0.0, HEIGHT]).chain(rim).chain(std::iter::once(path(0.0, RADIUS))).collect()
}

/// Faces; `first` is the local number of the apex, which differs from face to face.
fn faces() -> Vec<Segment> {
    let of = |k: usize| {
        let mut nodes = vec![0, 1 + k, 1 + (k + 1) % SIDES];
        nodes.rotate_right(k % 3);
        Segment { kind: SegmentKind::Tri3, nodes }
    };
    (0..SIDES).map(of).collect()
}

/// Distance of the sides of the rim from the axis.
fn inner() -> f64 {
    (0.5 * TAU / SIDES as f64).cos()
}

/// Slope of the faces.
fn slope() -> f64 {
    HEIGHT / inner()
}

/// Height of the plane of a face at a position. Face k faces the middle between corners k and k + 1.
fn plane(face: usize, [x, y]: [f64; 2]) -> f64 {
    let (sine, cosine) = (TAU * (face as f64 + 0.5) / SIDES as f64).sin_cos();
    HEIGHT - slope() * (x * cosine + y * sine)
}

/// A position at an angle and a distance from the axis, above the face that is lowest there.
fn path(angle: f64, radius: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let (x, y) = (radius * cosine, radius * sine);
    let below = (0..SIDES).map(|k| plane(k, [x, y])).fold(f64::INFINITY, f64::min);
    [x, y, below + ABOVE]
}

/// Distance from the plane below.
fn exact() -> f64 {
    ABOVE / (1.0 + slope() * slope()).sqrt()
}

/// A measure with the slave at the start of a path.
fn measure() -> NodeToPointMeasure<3> {
    let positions = nodes();
    let node =
        |(label, position): (usize, &[f64; 3])| SurfaceNode { position: *position, dof: 3 * label, label };
    let all: Vec<SurfaceNode<3>> = positions.iter().enumerate().map(node).collect();
    let slave = [SlavePoint { node: positions.len() - 1, area: 1.0 }];
    NodeToPointMeasure::new(&all, &slave, Surface::new(faces(), &positions)).0
}

/// Gaps, and the limits of forward steps, along a path.
struct PathRecord {
    gaps: Vec<f64>,
    /// Exits from triangles: differences in angle from the edges, in faces.
    exits: Vec<f64>,
}

/// Turns the slave about the axis.
fn around(backwards: bool) -> PathRecord {
    let mut measure = measure();
    let (mut geometry, start) = (Geometry::new(1), path(0.0, RADIUS));
    let (mut gaps, mut exits) = (Vec::new(), Vec::new());
    let count = nodes().len();
    let mut before = [0.0; 3];
    for step in 0..=STEPS {
        // Off the edges, which lie at whole numbers of eighty steps, and not in the middle of a step.
        let angle = TAU * (step as f64 + 0.3) / STEPS as f64 * if backwards { -1.0 } else { 1.0 };
        let p = path(angle, RADIUS);
        let moved: [f64; 3] = std::array::from_fn(|c| p[c] - start[c]);
        let mut u = vec![[0.0; 3]; count];
        u[count - 1] = moved;
        if step > 0 {
            let mut du = vec![[0.0; 3]; count];
            du[count - 1] = std::array::from_fn(|c| moved[c] - before[c]);
            if let Some(exit) = measure.exit(&du) {
                // The chord between two steps crosses an edge where the angle is a multiple of a sixth.
                let at: [f64; 3] =
                    std::array::from_fn(|c| start[c] + before[c] + exit.fraction * du[count - 1][c]);
                let turns = at[1].atan2(at[0]) / TAU * SIDES as f64;
                exits.push(turns - turns.round());
            }
        }
        measure.search(&u, &mut 0);
        measure.measure(&u, &mut geometry);
        gaps.push(geometry.gap[0]);
        measure.commit(&geometry, &mut |_, _| ());
        before = moved;
    }
    PathRecord { gaps, exits }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for backwards in [false, true] {
        turns(ledger, backwards);
    }
    rim(ledger);
    Ok(())
}

fn turns(ledger: &mut Ledger, backwards: bool) {
    let way = if backwards { "against" } else { "with" };
    let found = around(backwards);
    let off = found.gaps.iter().map(|gap| (gap - exact()).abs());
    ledger
        .claim(format!("gap of a point that turns about the apex of a pyramid, {way} the order of its faces"))
        .unit("m")
        .norm("largest error at all steps")
        .value(off.fold(0.0, |most, d| if d.is_nan() { f64::INFINITY } else { f64::max(most, d) }))
        .at_most(1e-12)
        .evidence(Evidence::Exact, "distance from the plane of the face below")
        .because("steps end 6e-4 of a turn or more from an edge, beyond the 1e-3 of a triangle by which it holds a point")
        .why_not_tighter("rounding of projections")
        .record();
    ledger
        .claim(format!("edges at which forward steps of that point end, {way} the order of the faces"))
        .count(found.exits.len() as u64, SIDES as u64)
        .evidence(Evidence::Exact, "a turn crosses each edge at the apex once")
        .because("a count")
        .record();
    let late = found.exits.iter().map(|off| off.abs()).fold(0.0, f64::max);
    ledger
        .claim(format!("distance of those ends from the edges, in faces, {way} the order of the faces"))
        .value(late)
        .at_most(2.0 * ABOVE * slope() * SIDES as f64 / (TAU * RADIUS))
        .evidence(Evidence::Exact, "the point moves along a chord, and its foot crosses an edge where the angle is a sixth of a turn")
        .because("the foot on a sloping face lies off the point by the gap times the slope; twice that for chords of a step, an eightieth of a face")
        .record();
}

/// A point that leaves over the rim, in the middle of each face.
fn rim(ledger: &mut Ledger) {
    let (mut lost, mut beyond) = (0, 0);
    let mut off = 0.0_f64;
    for face in 0..SIDES {
        let angle = TAU * (face as f64 + 0.5) / SIDES as f64;
        let (mut measure, mut geometry) = (measure(), Geometry::new(1));
        let (count, start) = (nodes().len(), path(0.0, RADIUS));
        for k in 0..=60 {
            let radius = 0.8 + 0.002 * f64::from(k);
            let p = path(angle, radius);
            let mut u = vec![[0.0; 3]; count];
            u[count - 1] = std::array::from_fn(|c| p[c] - start[c]);
            measure.search(&u, &mut 0);
            measure.measure(&u, &mut geometry);
            measure.commit(&geometry, &mut |_, _| ());
            let foot = radius - exact() * slope() / (1.0 + slope() * slope()).sqrt();
            // Faces are enlarged by a hundredth beyond the rim.
            if foot < 1.009 * inner() {
                off = off.max((geometry.gap[0] - exact()).abs());
            } else if foot > 1.011 * inner() {
                beyond += 1;
                lost += u64::from(!geometry.paired[0]);
            }
        }
    }
    ledger
        .claim("gap of a point that leaves a pyramid over each side of its rim, up to a hundredth of a face beyond it")
        .unit("m")
        .norm("largest error at all steps")
        .value(off)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "distance from the plane of the face")
        .because("rounding of projections; a point without a partner has an infinite gap")
        .why_not_tighter("rounding of projections")
        .record();
    ledger
        .claim("steps farther beyond the rim at which the point has no partner")
        .count(lost, beyond)
        .evidence(Evidence::Exact, "feet farther than a hundredth of a face beyond its rim")
        .because("a count")
        .record();
}
