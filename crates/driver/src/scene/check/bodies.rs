//! Materials, bodies and their meshes.

use super::{AXES, Checker, show};
use crate::scene::model::{BlockMesh, Body, MeshSource, Spanned};
use crate::scene::near::suggest;
use crate::scene::units::Length;
use asperity_fem::element::ElementKind;
use std::ops::Range;

/// How far an edge over a size may be from a whole number, relative to it: the rounding of decimal input with room to
/// spare, and less than any intended difference.
const WHOLE: f64 = 1e-9;
/// How far around the nearest number of elements a size that divides all edges is looked for.
const SEARCH: usize = 1000;
/// More elements than this are a slip of the keyboard: their stiffness alone would take 50 GB.
const MOST_ELEMENTS: f64 = 1e8;

impl Checker<'_> {
    pub(super) fn materials(&mut self) {
        for (name, material) in &self.scene.materials {
            let young = material.young.get_ref().0;
            if young <= 0.0 {
                self.error(
                    material.young.span(),
                    format!("Young's modulus of `{name}` must be positive, found {young:e} Pa"),
                    "such as `young = \"44.8 GPa\"`",
                );
            }
            let nu = *material.poisson.get_ref();
            if !(nu > -1.0 && nu < 0.5) {
                self.error(
                    material.poisson.span(),
                    format!("Poisson's ratio of `{name}` must lie between -1 and 0.5, both excluded, found {nu:?}"),
                    "such as `poisson = 0.25`; at 0.5 the material is incompressible, which these elements cannot be",
                );
            }
            if let Some(density) = material.density.as_ref().filter(|d| d.get_ref().0 <= 0.0) {
                self.error(
                    density.span(),
                    format!("the density of `{name}` must be positive"),
                    "such as `density = \"2700 kg/m^3\"`",
                );
            }
        }
    }

    pub(super) fn bodies(&mut self) {
        if self.scene.bodies.is_empty() {
            self.error(self.scene.kinematics.span(), "the scene has no body", "add a table `[bodies.A]`");
        }
        for (name, body) in &self.scene.bodies {
            self.name("a body", name, body.material.span());
            let material = body.material.get_ref();
            if !self.scene.materials.contains_key(material) {
                let known = self.scene.materials.keys().map(String::as_str);
                self.error(
                    body.material.span(),
                    format!("there is no material `{material}`"),
                    suggest(material, "materials", known),
                );
            }
            let MeshSource::Block(block) = &body.mesh;
            self.block(name, block);
            self.forces(name, body);
        }
    }

    fn forces(&mut self, name: &str, body: &Body) {
        if let Some(gravity) = &body.gravity {
            self.count(gravity, "gravity", self.dimension());
            if gravity.get_ref().iter().any(|g| !g.is_finite()) {
                self.error(
                    gravity.span(),
                    "gravity must be finite",
                    "in m/s^2, such as `gravity = [0, -9.81]`",
                );
            }
            let material = self.scene.materials.get(body.material.get_ref());
            if material.is_some_and(|m| m.density.is_none()) {
                self.error(
                    gravity.span(),
                    format!(
                        "gravity acts on body `{name}`, whose material `{}` has no density",
                        body.material.get_ref()
                    ),
                    "add `density = \"2700 kg/m^3\"` to the material",
                );
            }
        }
        if let Some(stress) = &body.initial_stress {
            let (given, plane) = (stress.get_ref().len(), self.dimension() == 2);
            if given != 6 && !(plane && given == 3) {
                let right = if plane {
                    "[xx, yy, xy] or [xx, yy, zz, xy, yz, zx]"
                } else {
                    "[xx, yy, zz, xy, yz, zx]"
                };
                self.error(
                    stress.span(),
                    format!("`initial_stress` has {given} components"),
                    format!("in {} give {right}", self.idealisation()),
                );
            }
        }
    }

    fn count<T>(&mut self, values: &Spanned<Vec<T>>, what: &str, wanted: usize) -> bool {
        let found = values.get_ref().len();
        if found != wanted {
            self.error(
                values.span(),
                format!("`{what}` has {found} entries, expected {wanted} in {}", self.idealisation()),
                format!("one for each of {}", AXES[..wanted].join(", ")),
            );
        }
        found == wanted
    }

    fn block(&mut self, name: &str, block: &BlockMesh) {
        let d = self.dimension();
        self.element(block);
        let corners = [self.count(&block.min, "min", d), self.count(&block.max, "max", d)];
        let edges = corners.iter().all(|&c| c).then(|| self.edges(name, block)).flatten();
        match (&block.size, &block.divisions) {
            (None, None) => self.error(
                block.element.span(),
                format!("the block of body `{name}` has neither `size` nor `divisions`"),
                "give one, such as `size = \"1 mm\"`",
            ),
            (Some(size), Some(divisions)) => self.conflict(
                &divisions.span(),
                format!("the block of body `{name}` has both `size` and `divisions`"),
                "give one of them",
                (&size.span(), "and here"),
            ),
            (None, Some(divisions)) => {
                self.count(divisions, "divisions", d);
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
            self.count(grading, "grading", d);
            if grading.get_ref().iter().any(|g| !(*g > 0.0 && g.is_finite())) {
                self.error(
                    grading.span(),
                    "`grading` must be positive",
                    "the size of the last element over that of the first along each axis; 1 is uniform",
                );
            }
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

    fn element(&mut self, block: &BlockMesh) {
        let name = block.element.get_ref();
        let dimension = self.dimension();
        let fitting =
            || ElementKind::ALL.into_iter().filter(|e| e.dimension() == dimension).map(ElementKind::name);
        match ElementKind::ALL.into_iter().find(|e| e.name() == name) {
            None => {
                self.error(
                    block.element.span(),
                    format!("there is no element `{name}`"),
                    suggest(name, &format!("elements for {}", self.idealisation()), fitting()),
                );
            }
            Some(kind) if kind.dimension() != dimension => {
                let list = fitting().collect::<Vec<_>>().join(", ");
                self.error(
                    block.element.span(),
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

    /// Lengths of the edges \[m\], where all are positive.
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

fn divides(size: f64, edge: f64) -> bool {
    let ratio = edge / size;
    let whole = ratio.round();
    whole >= 1.0 && (ratio - whole).abs() <= WHOLE * whole
}

/// Divisions of all edges by one size, that nearest to `size`.
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
