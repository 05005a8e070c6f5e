//! Checks of a specification and construction of its measure.

use crate::error::ContactError;
use crate::measure::node_to_point::finite::NodeToPointMeasure;
use crate::measure::node_to_point::small::small;
use crate::measure::{Measure, mortar};
use crate::search::surface::Surface;
use crate::spec::{InterfaceSpec, MeasureKind, Segment, Sliding, Smoothing, SurfaceNode};
use crate::vector::{norm, sub};
use asperity_fem::origin;
use std::any::Any;

/// Checks that a specification is consistent.
pub(crate) fn check<const D: usize>(spec: &InterfaceSpec<D>) -> Result<(), ContactError> {
    let name = || spec.name.clone();
    for (side, empty) in [("slave", spec.slave.is_empty()), ("master", spec.master.is_empty())] {
        if empty {
            return Err(ContactError::EmptySide { name: name(), side });
        }
    }
    let nodes = spec.nodes.len();
    for s in &spec.slave {
        if s.node >= nodes {
            return Err(ContactError::BadNode { name: name(), side: "slave", index: s.node, nodes });
        }
        if s.area.is_nan() || s.area <= 0.0 {
            return Err(ContactError::BadArea {
                name: name(),
                label: spec.nodes[s.node].label,
                area: s.area,
            });
        }
    }
    check_segments(spec, "master", &spec.master)?;
    if let MeasureKind::Mortar { faces, .. } = &spec.measure {
        check_segments(spec, "slave", faces)?;
        let mut faced = vec![false; nodes];
        faces.iter().flat_map(|f| &f.nodes).for_each(|&n| faced[n] = true);
        if let Some(s) = spec.slave.iter().find(|s| !faced[s.node]) {
            return Err(ContactError::NoFace { name: name(), label: spec.nodes[s.node].label });
        }
    }
    check_numbers(spec)
}

fn check_segments<const D: usize>(
    spec: &InterfaceSpec<D>,
    side: &'static str,
    segments: &[Segment],
) -> Result<(), ContactError> {
    let name = || spec.name.clone();
    for (segment, s) in segments.iter().enumerate() {
        if s.kind.space() != D || s.kind.nodes() != s.nodes.len() {
            let (kind, nodes) = (s.kind, s.nodes.len());
            return Err(ContactError::BadSegment { name: name(), side, segment, kind, nodes, dimension: D });
        }
        let nodes = spec.nodes.len();
        if let Some(&index) = s.nodes.iter().find(|n| **n >= nodes) {
            return Err(ContactError::BadNode { name: name(), side, index, nodes });
        }
        if s.kind.first_order() {
            continue;
        }
        if spec.smoothing.is_some() {
            return Err(ContactError::SmoothingOnSecondOrder { name: name(), kind: s.kind });
        }
    }
    Ok(())
}

fn check_numbers<const D: usize>(spec: &InterfaceSpec<D>) -> Result<(), ContactError> {
    let mut quantities = vec![("the normal penalty", spec.normal_penalty), ("the scene size", spec.scale)];
    if spec.law.is_some() {
        quantities.push(("the tangential penalty", spec.tangential_penalty));
    }
    for (what, value) in quantities {
        if !(value.is_finite() && value > 0.0) {
            return Err(ContactError::NotPositive { name: spec.name.clone(), what, value });
        }
    }
    if let Some(Smoothing { crease: angle }) = spec.smoothing {
        let name = spec.name.clone();
        if spec.measure != MeasureKind::NodeToPoint {
            return Err(ContactError::SmoothingOfMortar { name });
        }
        if !(angle > 0.0 && angle < std::f64::consts::PI) {
            return Err(ContactError::BadCrease { name, angle });
        }
    }
    match spec.fixed_normal {
        Some(n) if spec.sliding == Sliding::Finite || !norm(&n).is_normal() => {
            Err(ContactError::BadNormal { name: spec.name.clone() })
        }
        _ => Ok(()),
    }
}

/// Nodes of a specification with positions relative to a point nearby. Gaps and slip are differences of positions, which do not
/// depend on it; their rounding does. A radius is kept, since areas depend on it.
fn relative<const D: usize>(spec: &InterfaceSpec<D>) -> Vec<SurfaceNode<D>> {
    let mut origin = origin::near(spec.nodes.iter().map(|n| &n.position));
    if matches!(spec.measure, MeasureKind::Mortar { axisymmetric: true, .. }) {
        origin[0] = 0.0;
    }
    spec.nodes.iter().map(|n| SurfaceNode { position: sub(&n.position, &origin), ..*n }).collect()
}

/// A measure, and the number of projections made to pair it.
type MeasureResult<const D: usize> = Result<(Box<dyn Measure<D>>, u64), ContactError>;

/// Builds the measure of a specification. Also returns the number of projections made to pair it.
///
/// The functions below it are not generic, so that measures, which are kernels, are compiled with this crate as one unit. Crates
/// that use generic code compile it themselves, in units whose functions do not see each other: 2 to 10 times slower.
pub(crate) fn build_measure<const D: usize>(spec: &InterfaceSpec<D>) -> MeasureResult<D> {
    let any = spec as &dyn Any;
    let plane = || any.downcast_ref().and_then(|spec| in_dimension(measure_in_plane(spec)));
    let space = || any.downcast_ref().and_then(|spec| in_dimension(measure_in_space(spec)));
    // Segments, whose kinds have been checked, exist in two and three dimensions.
    plane().or_else(space).expect("two or three dimensions")
}

fn measure_in_plane(spec: &InterfaceSpec<2>) -> MeasureResult<2> {
    measure(spec)
}

fn measure_in_space(spec: &InterfaceSpec<3>) -> MeasureResult<3> {
    measure(spec)
}

/// A measure in `E` dimensions as one in `D`, which are the same.
fn in_dimension<const E: usize, const D: usize>(built: MeasureResult<E>) -> Option<MeasureResult<D>> {
    let any: Box<dyn Any> = Box::new(built);
    any.downcast().ok().map(|built| *built)
}

fn measure<const D: usize>(spec: &InterfaceSpec<D>) -> MeasureResult<D> {
    let nodes = relative(spec);
    let positions: Vec<[f64; D]> = nodes.iter().map(|n| n.position).collect();
    let surface = match spec.smoothing {
        Some(smoothing) => Surface::smoothed(&spec.name, spec.master.clone(), &positions, smoothing)?,
        None => Surface::new(spec.master.clone(), &positions),
    };
    Ok(match (&spec.measure, spec.sliding) {
        (MeasureKind::Mortar { faces, axisymmetric, mirrors }, sliding) => {
            let surfaces = mortar::Surfaces {
                slave: &spec.slave,
                faces,
                master: &spec.master,
                axisymmetric: *axisymmetric,
                mirrors,
            };
            if sliding == Sliding::Finite {
                return Ok(mortar::finite(&nodes, surfaces));
            }
            let (measure, examined) = mortar::small(&nodes, surfaces, spec.fixed_normal);
            (Box::new(measure), examined)
        }
        (MeasureKind::NodeToPoint, Sliding::Small) => {
            let (measure, projections) = small(&nodes, &spec.slave, &surface, spec.fixed_normal);
            (Box::new(measure), projections)
        }
        (MeasureKind::NodeToPoint, Sliding::Finite) => {
            let (measure, projections) = NodeToPointMeasure::new(&nodes, &spec.slave, surface);
            (Box::new(measure), projections)
        }
    })
}
