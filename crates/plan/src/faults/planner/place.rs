//! Points of a fault: pairs of nodes, one on each side, at the same position.

use super::cover::{self, FaultSides, TOGETHER};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, Spanned};
use crate::shared::entry::Entry;
use crate::shared::model::{self, Model};
use asperity_cycles::medium::{Place, unit};
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::{Side, face_nodes, nodes_of_sides};
use asperity_fem::{FemError, surface};
use asperity_mechanics::coordinates;
use asperity_run::Warning;
use std::collections::{BTreeMap, BTreeSet};

/// Points of a fault, on a plane one in order from its upper end, with a warning if its sides are doubtful.
///
/// # Errors
/// [`Diagnostic`] if the sides do not match node by node, if more than two sides meet, or if a point has no area.
pub fn places<const D: usize>(
    model: &Model<D>,
    fault: Entry<'_, Spec>,
) -> Result<(Vec<Place<D>>, Option<Warning>), Diagnostic> {
    let Entry { name, spec } = fault;
    let (minus, plus) = (model::sides(model, &spec.minus)?, model::sides(model, &spec.plus)?);
    let (pairs, doubtful) = pairs(&FaultSides { model, fault, minus, plus })?;
    let no_areas =
        |e: FemError| Diagnostic::at(spec.minus.span(), format!("fault `{name}`: {e}"), WITH_AREAS);
    let areas = model.tributary_areas(minus).map_err(no_areas)?;
    let normals = normals(model, minus);
    let along = if D == 2 { distances(model, minus) } else { BTreeMap::new() };
    let mut places = Vec::with_capacity(pairs.len());
    for (minus, plus) in pairs {
        let area = areas.get(&minus).copied().unwrap_or(0.0);
        if area <= 0.0 {
            return Err(Diagnostic::at(
                spec.minus.span(),
                format!(
                    "a node of fault `{name}` at {} has no positive area",
                    coordinates::in_words(&model.mesh.nodes[minus])
                ),
                WITH_AREAS,
            ));
        }
        let normal = unit(normals[&minus]);
        let at = model.mesh.nodes[minus];
        let [rake, creeps] = directions(fault, &at, &normal)?;
        places.push(Place {
            minus,
            plus,
            at,
            area,
            normal,
            rake,
            creeps,
            along: along.get(&minus).copied().unwrap_or(0.0),
        });
    }
    places.sort_by(|a, b| a.along.total_cmp(&b.along).then(a.minus.cmp(&b.minus)));
    Ok((places, doubtful))
}

/// Directions of slip and creep at a point of a fault.
///
/// # Errors
/// [`Diagnostic`] for a rake normal to the fault.
pub(super) fn directions<const D: usize>(
    Entry { name, spec }: Entry<'_, Spec>,
    at: &[f64; D],
    normal: &[f64; D],
) -> Result<[[f64; D]; 2], Diagnostic> {
    let within = |rake: &Spanned<[f64; 3]>| {
        along_rake(rake.get_ref(), normal).ok_or_else(|| {
            Diagnostic::at(
                rake.span(),
                format!("`rake` is normal to fault `{name}` at {}", coordinates::in_words(at)),
                "a direction along the fault",
            )
        })
    };
    let rake = spec.rake.as_ref().map_or(Ok([0.0; D]), &within)?;
    let creeps = spec.creep.as_ref().and_then(|c| c.rake.as_ref()).map_or(Ok(rake), &within)?;
    Ok([rake, creeps])
}

/// Elements that give every node of a fault a positive area.
const WITH_AREAS: &str = "use an element whose faces have positive nodal areas: quad4, quad8, quad9, tri3, tri6; hex8, hex27, wedge6, tet4";
/// Sine of the angle between rake and normal below which the rake defines no direction on the fault: a hundredth of a
/// degree.
const NORMAL_RAKE: f64 = 2e-4;

/// Unit vector of the part of a direction that is perpendicular to a normal; `None` if that part is negligible.
fn along_rake<const D: usize>(rake: &[f64; 3], normal: &[f64; D]) -> Option<[f64; D]> {
    let rake: [f64; D] = std::array::from_fn(|c| rake[c]);
    let across: f64 = rake.iter().zip(normal).map(|(r, n)| r * n).sum();
    let within: [f64; D] = std::array::from_fn(|c| rake[c] - across * normal[c]);
    (surface::length(&within) > NORMAL_RAKE * surface::length(&rake)).then(|| unit(within))
}

/// Pairs of nodes of both sides at the same position, without tips, where both sides are one node.
type Pairs = Vec<(usize, usize)>;

fn pairs<const D: usize>(sides: &FaultSides<'_, D>) -> Result<(Pairs, Option<Warning>), Diagnostic> {
    let Entry { name, spec } = sides.fault;
    let nodes = |side: &[Side]| nodes_of_sides(&sides.model.mesh, side);
    let on_plus = SortedNodes::new(sides.model, nodes(sides.plus));
    let mut partner: BTreeMap<usize, usize> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for m in nodes(sides.minus) {
        let at = &sides.model.mesh.nodes[m];
        match on_plus.near(at).as_slice() {
            [p] if taken.insert(*p) => partner.insert(m, *p),
            [] => {
                return Err(Diagnostic::at(
                    spec.plus.span(),
                    format!(
                        "the sides of fault `{name}` do not lie on each other: the node of the minus side at {} has none on the plus side",
                        coordinates::in_words(at)
                    ),
                    "both sides need the same nodes, as splitting a mesh along a surface makes them",
                ));
            }
            _ => return Err(branches(&format!("fault `{name}` branches"), at, spec)),
        };
    }
    cover::partners(sides, &on_plus.without(&taken))?;
    let doubtful = cover::same_faces(sides, |m| partner.get(&m).copied());
    let pairs: Pairs = partner.into_iter().filter(|(m, p)| m != p).collect();
    if pairs.is_empty() {
        return Err(Diagnostic::at(
            spec.plus.span(),
            format!("both sides of fault `{name}` are the same nodes: nothing can slide there"),
            "a fault lies between two sides that can separate: two bodies, or a mesh that is split along a surface, whose sides are \
             `body.SURFACE.minus` and `body.SURFACE.plus`",
        ));
    }
    Ok((pairs, doubtful))
}

/// Nodes of a side, sorted along the longest side of their box, so that those near a position lie in a narrow band: on a plane
/// fault all nodes may share a coordinate.
struct SortedNodes<'m, const D: usize> {
    model: &'m Model<D>,
    nodes: Vec<usize>,
    axis: usize,
}

impl<'m, const D: usize> SortedNodes<'m, D> {
    fn new(model: &'m Model<D>, mut nodes: Vec<usize>) -> Self {
        let x = |n: &usize| model.mesh.nodes[*n];
        let (least, most) = model::bounds(&nodes.iter().map(x).collect::<Vec<_>>());
        let extent = |c: usize| most[c] - least[c];
        let axis = (0..D).fold(0, |best, c| if extent(c) > extent(best) { c } else { best });
        nodes.sort_by(|a, b| x(a)[axis].total_cmp(&x(b)[axis]));
        Self { model, nodes, axis }
    }

    /// Nodes at a position.
    fn near(&self, at: &[f64; D]) -> Vec<usize> {
        let Self { model, nodes, axis } = self;
        let close = TOGETHER * model.scale;
        let x = |n: &usize| &model.mesh.nodes[*n];
        let from = nodes.partition_point(|p| x(p)[*axis] < at[*axis] - close);
        let candidates = nodes[from..].iter().take_while(|p| x(p)[*axis] <= at[*axis] + close);
        candidates.filter(|p| (0..D).all(|c| (x(p)[c] - at[c]).abs() <= close)).copied().collect()
    }

    /// Those that are not taken, in the order of their first coordinates.
    fn without(&self, taken: &BTreeSet<usize>) -> Vec<usize> {
        let x = |n: &usize| self.model.mesh.nodes[*n][0];
        let mut rest: Vec<usize> = self.nodes.iter().copied().filter(|n| !taken.contains(n)).collect();
        rest.sort_by(|a, b| x(a).total_cmp(&x(b)).then(a.cmp(b)));
        rest
    }
}

/// Error for a position where more than two sides meet.
pub(super) fn branches<const D: usize>(what: &str, at: &[f64; D], spec: &Spec) -> Diagnostic {
    Diagnostic::at(
        spec.minus.span(),
        format!("{what} at {}: more than two sides meet there", coordinates::in_words(at)),
        "a point of a fault has two sides; leave the faces of a branch that touch the other fault out of its surface, so that it ends one cell away \
         from it, or leave the branch out",
    )
}

/// Integral of the outward normal of the minus side times the shape function of each node.
fn normals<const D: usize>(model: &Model<D>, sides: &[Side]) -> BTreeMap<usize, [f64; D]> {
    // One component per axis.
    let idealisation = Idealisation::from_dimension(D);
    let forces = surface::integrate(&model.mesh, sides, idealisation, |point, out| {
        out[..D].copy_from_slice(&point.normal);
    });
    let mut normals: BTreeMap<usize, [f64; D]> = BTreeMap::new();
    for (dof, value) in forces {
        normals.entry(dof / D).or_insert([0.0; D])[dof % D] = value;
    }
    normals
}

/// Distance of each node of a plane side from its upper end, along its faces; from the left one, if both are at the same height.
fn distances<const D: usize>(model: &Model<D>, sides: &[Side]) -> BTreeMap<usize, f64> {
    // Reorder from corners first, midside nodes last, to the order along the face.
    let ordered = |side: &Side| {
        let mut nodes = face_nodes(&model.mesh, side);
        nodes[1..].rotate_left(1);
        nodes
    };
    let mut links: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for side in sides {
        for w in ordered(side).windows(2) {
            links.entry(w[0]).or_default().push(w[1]);
            links.entry(w[1]).or_default().push(w[0]);
        }
    }
    let at = |n: &usize| model.mesh.nodes[*n];
    let ends = links.iter().filter(|(_, next)| next.len() == 1).map(|(n, _)| *n);
    // As on lines, the left end if both are at the same height; numbers of nodes do not decide.
    let above = |a: &usize, b: &usize| {
        let (a, b) = (at(a), at(b));
        let rise = a[D - 1] - b[D - 1];
        if rise.abs() > TOGETHER * model.scale { rise > 0.0 } else { a[0] < b[0] }
    };
    let mut result = BTreeMap::new();
    let Some(mut node) = ends.reduce(|a, b| if above(&b, &a) { b } else { a }) else { return result };
    let mut along = 0.0;
    result.insert(node, along);
    while let Some(&next) = links[&node].iter().find(|n| !result.contains_key(*n)) {
        let step: [f64; D] = std::array::from_fn(|c| model.mesh.nodes[next][c] - model.mesh.nodes[node][c]);
        along += surface::length(&step);
        result.insert(next, along);
        node = next;
    }
    result
}
