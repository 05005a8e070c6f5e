//! Checks of meshes before they are generated or read.

use super::{AXES, Checker};
use crate::lengths::show;
use crate::model::{
    BlockMesh, Body, FaultMesh, Kinematics, MeshSource, QuadrilateralMesh, SpacingSpec, Spanned,
};
use crate::names::ELEMENTS;
use crate::suggestions::suggest;
use crate::units::{self, Dimension, Length};
use std::collections::BTreeMap;
use std::ops::Range;

/// Admissible relative distance of edge over size from a whole number. It allows for rounding of decimal input, and is less than
/// any intended difference.
const WHOLE: f64 = 1e-9;
/// Range around the nearest number of elements in which to search for a size that divides all edges.
const SEARCH: usize = 1000;
/// Largest number of elements. More are a typing error: their stiffness alone would take 50 GB.
const MOST_ELEMENTS: f64 = 1e8;

impl Checker<'_> {
    /// Checks the mesh of a body.
    pub(super) fn mesh(&mut self, name: &str, body: &Body) {
        self.layers(name, body);
        match &body.mesh {
            MeshSource::Block(block) => self.block(name, block),
            MeshSource::Quadrilateral(patch) => {
                self.flat(name, body, &patch.element);
                self.quadrilateral(name, patch);
            }
            MeshSource::Fault(fault) => {
                self.flat(name, body, &fault.element);
                self.fault(fault);
                self.corners(&fault.trace, fault.interpolation);
            }
            MeshSource::Gmsh(file) => {
                self.file(file.unit.as_ref(), file.groups.as_ref(), &file.split);
                self.plus(body, &file.split, &file.plus);
            }
            MeshSource::Abaqus(file) => {
                self.file(file.unit.as_ref(), file.elsets.as_ref(), &file.split);
                self.plus(body, &file.split, &file.plus);
            }
        }
    }

    /// Checks the coordinates of the layers of an extrusion.
    fn layers(&mut self, name: &str, body: &Body) {
        let Some(layers) = &body.extrude else { return };
        if matches!(body.mesh, MeshSource::Block(_)) {
            let help = "remove `extrude`: `min` and `max` have three coordinates";
            self.error(
                layers.span(),
                format!("the block of body `{name}` is three-dimensional itself"),
                help,
            );
        }
        let z = layers.get_ref();
        if z.len() < 2 || z.windows(2).any(|w| w[1].0 <= w[0].0) {
            self.error(
                layers.span(),
                "`extrude` needs at least two heights, and they ascend",
                "such as `extrude = [\"0 m\", \"1 m\", \"2 m\"]`",
            );
        }
    }

    /// Checks the element of a plane mesh, which in three dimensions needs layers.
    fn flat(&mut self, name: &str, body: &Body, element: &Spanned<String>) {
        if self.dimension() == 3 && body.extrude.is_none() {
            self.error(
                element.span(),
                format!("the mesh of body `{name}` is plane"),
                "in three dimensions add `extrude = [..]` to the body, the heights of its layers",
            );
        } else {
            self.element(element, 2);
        }
    }

    fn quadrilateral(&mut self, name: &str, patch: &QuadrilateralMesh) {
        let divisions = patch.divisions.get_ref();
        if divisions.contains(&0) {
            self.error(patch.divisions.span(), "`divisions` must be positive", "at least 1 along each side");
        }
        self.too_many_elements(divisions.iter().map(|&n| n as f64).product(), patch.divisions.span());
        if let Some(grading) = patch.grading.as_ref().filter(|g| g.get_ref().iter().any(|g| !positive(*g))) {
            self.bad_grading(grading.span());
        }
        let x = patch.corners.get_ref().map(|p| p.map(|c| c.0));
        let turn = |k: usize| {
            let (a, b, c) = (x[k], x[(k + 1) % 4], x[(k + 2) % 4]);
            (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])
        };
        if (0..4).any(|k| turn(k) <= 0.0) {
            self.error(
                patch.corners.span(),
                format!("the corners of body `{name}` do not go round a convex quadrilateral anticlockwise"),
                "begin at the lower left corner, then lower right, upper right, upper left",
            );
        }
        self.radius(patch.corners.span(), x.iter().map(|p| p[0]));
    }

    /// Checks that x is not negative in axial symmetry, where it is the radius.
    fn radius(&mut self, place: Range<usize>, x: impl Iterator<Item = f64>) {
        let axial = *self.scene.kinematics.get_ref() == Kinematics::Axisymmetric;
        if let Some(least) = x.reduce(f64::min).filter(|x| axial && *x < 0.0) {
            self.error(
                place,
                format!("the body reaches to x = {}, beyond the axis of revolution", show(least)),
                "in an axisymmetric scene x is the radius, 0 or more",
            );
        }
    }

    fn fault(&mut self, fault: &FaultMesh) {
        let growth = *fault.growth.get_ref();
        if !(growth >= 1.0 && growth.is_finite()) {
            self.error(
                fault.growth.span(),
                format!("`growth` must be at least 1, found {growth:?}"),
                "the largest ratio of neighbouring sizes away from the fault, such as `growth = 1.2`",
            );
        }
        if let Some(thickness) = fault.thickness.as_ref().filter(|t| t.get_ref().0 <= 0.0) {
            self.error(thickness.span(), "`thickness` must be positive", "such as `thickness = \"25 m\"`");
        }
        let sizes = match fault.spacing.get_ref() {
            SpacingSpec::Constant(size) => vec![size.0],
            SpacingSpec::Zone(zone) => vec![zone.size.0],
            SpacingSpec::Graded(table) => table.iter().map(|[_, size]| size.0).collect(),
        };
        if !sizes.into_iter().all(positive) {
            self.error(
                fault.spacing.span(),
                "the size of cells along the fault must be positive",
                "such as `spacing = \"25 m\"`",
            );
        }
        self.radius(fault.min.span(), std::iter::once(fault.min.get_ref()[0].0));
    }

    /// Checks the unit, groups and surfaces of a mesh file.
    fn file(
        &mut self,
        unit: Option<&Spanned<String>>,
        groups: Option<&Spanned<Vec<Spanned<String>>>>,
        surfaces: &[Spanned<String>],
    ) {
        self.unit_of_file(unit);
        if let Some(groups) = groups.filter(|g| g.get_ref().is_empty()) {
            self.error(
                groups.span(),
                "a body of no cells",
                "name groups of cells, or leave the key out for all",
            );
        }
        for (k, surface) in surfaces.iter().enumerate() {
            if let Some(first) = surfaces[..k].iter().find(|s| s.get_ref() == surface.get_ref()) {
                let message = format!("`{}` is split twice", surface.get_ref());
                self.conflict(&surface.span(), message, "remove one of the two", (&first.span(), "and here"));
            }
        }
    }

    /// Checks the directions to the plus sides of surfaces.
    fn plus(
        &mut self,
        body: &Body,
        surfaces: &[Spanned<String>],
        directions: &BTreeMap<String, Spanned<Vec<f64>>>,
    ) {
        // The mesh of an extruded body is plane.
        let axes: &[usize] =
            if self.dimension() == 2 || body.extrude.is_some() { &[0, 1] } else { &[0, 1, 2] };
        for (name, direction) in directions {
            let known = || surfaces.iter().map(|surface| surface.get_ref().as_str());
            if !known().any(|surface| surface == name) {
                self.error(
                    direction.span(),
                    format!("`plus` has a direction for `{name}`, along which the body is not split"),
                    suggest(name, "surfaces in `split`", known()),
                );
                continue;
            }
            let given = direction.get_ref();
            let points = given.iter().all(|c| c.is_finite()) && given.iter().any(|c| *c != 0.0);
            if self.count(direction, &format!("plus.{name}"), axes) && !points {
                self.error(direction.span(), format!("`plus.{name}` has no direction"), "such as `[1, 0]`");
            }
        }
    }

    /// Checks the unit of a mesh file.
    pub(super) fn unit_of_file(&mut self, unit: Option<&Spanned<String>>) {
        if let Some(unit) = unit
            && units::parse(&format!("1 {}", unit.get_ref()), Dimension::Length).is_err()
        {
            self.error(
                unit.span(),
                format!("there is no unit of length `{}`", unit.get_ref()),
                "units of length are nm, um, mm, cm, m, km",
            );
        }
    }

    fn bad_grading(&mut self, place: Range<usize>) {
        self.error(
            place,
            "`grading` must be positive",
            "the size of the last element over that of the first along each axis; 1 is uniform",
        );
    }

    /// Checks that a vector has one entry for each of these axes.
    pub(super) fn count<T>(&mut self, values: &Spanned<Vec<T>>, what: &str, axes: &[usize]) -> bool {
        let (found, wanted) = (values.get_ref().len(), axes.len());
        if found != wanted {
            let names: Vec<&str> = axes.iter().map(|&a| AXES[a]).collect();
            self.error(
                values.span(),
                format!("`{what}` has {found} entries, expected {wanted} in {}", self.idealisation()),
                format!("one for each of {}", names.join(", ")),
            );
        }
        found == wanted
    }

    fn block(&mut self, name: &str, block: &BlockMesh) {
        let d = self.dimension();
        self.element(&block.element, d);
        let axes: Vec<usize> = (0..d).collect();
        let corners = [self.count(&block.min, "min", &axes), self.count(&block.max, "max", &axes)];
        self.radius(block.min.span(), block.min.get_ref().first().map(|x| x.0).into_iter());
        let edges = corners.iter().all(|&c| c).then(|| self.edges(name, block)).flatten();
        self.spacing(name, block, &axes);
        match (&block.size, &block.divisions) {
            _ if block.spacing.is_some() => {}
            (None, None) => self.error(
                block.element.span(),
                format!("the block of body `{name}` has none of `size`, `divisions` and `spacing`"),
                "give one, such as `size = \"1 mm\"`",
            ),
            (Some(size), Some(divisions)) => self.conflict(
                &divisions.span(),
                format!("the block of body `{name}` has both `size` and `divisions`"),
                "give one of them",
                (&size.span(), "and here"),
            ),
            (None, Some(divisions)) => {
                self.count(divisions, "divisions", &axes);
                if divisions.get_ref().contains(&0) {
                    self.error(
                        divisions.span(),
                        "`divisions` must be positive",
                        "at least 1 along each axis",
                    );
                }
                let elements = divisions.get_ref().iter().map(|&n| n as f64).product();
                self.too_many_elements(elements, divisions.span());
            }
            (Some(size), None) => self.size(size, edges.as_deref()),
        }
        if let Some(grading) = &block.grading {
            self.count(grading, "grading", &axes);
            if grading.get_ref().iter().any(|g| !positive(*g)) {
                self.bad_grading(grading.span());
            }
        }
    }

    /// Checks the sizes along the axes of a block, which replace `size`, `divisions` and `grading`.
    fn spacing(&mut self, name: &str, block: &BlockMesh, axes: &[usize]) {
        let Some(spacing) = &block.spacing else { return };
        self.count(spacing, "spacing", axes);
        let others = [
            ("size", block.size.as_ref().map(Spanned::span)),
            ("divisions", block.divisions.as_ref().map(Spanned::span)),
            ("grading", block.grading.as_ref().map(Spanned::span)),
        ];
        for (key, place) in others.iter().filter_map(|(key, place)| Some((key, place.as_ref()?))) {
            let message = format!("the block of body `{name}` has both `spacing` and `{key}`");
            self.conflict(place, message, "give one of them", (&spacing.span(), "and here"));
        }
    }

    fn too_many_elements(&mut self, elements: f64, place: Range<usize>) -> bool {
        let many = elements > MOST_ELEMENTS;
        if many {
            self.error(
                place,
                format!("the block would have {elements:.1e} elements, more than any memory holds"),
                format!("at most {MOST_ELEMENTS:e}; is the unit right?"),
            );
        }
        many
    }

    fn element(&mut self, element: &Spanned<String>, dimension: usize) {
        let name = element.get_ref();
        let fitting = || ELEMENTS.iter().filter(|e| e.1 == dimension).map(|e| e.0);
        match ELEMENTS.iter().find(|e| e.0 == name) {
            None => {
                self.error(
                    element.span(),
                    format!("there is no element `{name}`"),
                    suggest(name, &format!("elements for {}", self.idealisation()), fitting()),
                );
            }
            Some((_, own)) if *own != dimension => {
                let list = fitting().collect::<Vec<_>>().join(", ");
                self.error(
                    element.span(),
                    format!(
                        "`{name}` is a {}-dimensional element",
                        if dimension == 2 { "three" } else { "two" }
                    ),
                    format!("the elements for {} are {list}", self.idealisation()),
                );
            }
            Some(_) => {}
        }
    }

    /// Lengths of the edges \[m\]. An error is reported unless all are positive.
    fn edges(&mut self, name: &str, block: &BlockMesh) -> Option<Vec<f64>> {
        let pairs = block.min.get_ref().iter().zip(block.max.get_ref());
        let edges: Vec<f64> = pairs.map(|(a, b)| b.0 - a.0).collect();
        let empty: Vec<&str> = edges.iter().zip(AXES).filter(|(e, _)| **e <= 0.0).map(|(_, a)| a).collect();
        if empty.is_empty() {
            return Some(edges);
        }
        self.error(
            block.max.span(),
            format!("`max` of body `{name}` is not above `min` in {}", empty.join(" and ")),
            "`min` is the lower corner of the block and `max` the upper",
        );
        None
    }

    fn size(&mut self, size: &Spanned<Length>, edges: Option<&[f64]>) {
        let h = size.get_ref().0;
        if h <= 0.0 {
            self.error(size.span(), "`size` must be positive", "such as `size = \"1 mm\"`");
            return;
        }
        let Some(edges) = edges else { return };
        let elements = edges.iter().map(|e| e / h).product();
        if self.too_many_elements(elements, size.span()) {
            return;
        }
        let Some((edge, axis)) = edges.iter().zip(AXES).find(|(e, _)| !divides(h, **e)) else { return };
        let message =
            format!("the size {} does not divide the edge of {} along {axis}", show(h), show(*edge));
        let help = match fitting_divisions(h, edges) {
            Some(n) => {
                let fitting = edges[0] / n[0] as f64;
                let rounded: f64 = format!("{fitting:.5e}").parse().unwrap_or(fitting);
                if edges.iter().all(|e| divides(rounded, *e)) {
                    format!(
                        "the nearest size that divides all edges is {}, or give `divisions = {n:?}`",
                        show(rounded)
                    )
                } else {
                    format!("the nearest that fits all edges is `divisions = {n:?}`")
                }
            }
            None => "no size near this one divides all edges: give `divisions`".to_string(),
        };
        self.error(size.span(), message, help);
    }
}

/// True if a number is positive and finite.
fn positive(value: f64) -> bool {
    value > 0.0 && value.is_finite()
}

fn divides(size: f64, edge: f64) -> bool {
    let ratio = edge / size;
    let whole = ratio.round();
    whole >= 1.0 && (ratio - whole).abs() <= WHOLE * whole
}

/// Divisions of all edges by a common size, the one nearest to `size`.
fn fitting_divisions(size: f64, edges: &[f64]) -> Option<Vec<usize>> {
    let near = ((edges[0] / size).round() as usize).max(1);
    let candidates = (near.saturating_sub(SEARCH).max(1)..=near.saturating_add(SEARCH)).filter_map(|n| {
        let fitting = edges[0] / n as f64;
        edges.iter().all(|e| divides(fitting, *e)).then_some(fitting)
    });
    let best = candidates.min_by(|a, b| (a - size).abs().total_cmp(&(b - size).abs()))?;
    Some(edges.iter().map(|e| (e / best).round() as usize).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_size_that_divides_all_edges_is_found() {
        assert_eq!(fitting_divisions(1.3, &[25.0, 50.0]), Some(vec![19, 38]));
        assert_eq!(fitting_divisions(0.0013, &[0.025, 0.07]), Some(vec![20, 56]));
        assert_eq!(fitting_divisions(1.0, &[1.0, 2.0_f64.sqrt()]), None);
    }
}
