//! Homogeneous rock without bodies, and the geometry of faults in it.

use super::Checker;
use crate::model::{
    DepthTriangles, Fault, FaultLine, FaultRectangle, FaultTriangles, Kinematics, Medium, MediumKind,
    SpacingSpec, Spanned,
};
use crate::suggestions::suggest;
use std::f64::consts::FRAC_PI_2;

/// Largest number of cells of a rectangle: the operator of more exceeds any memory.
const MOST_CELLS: f64 = 1e6;
/// Excess of an angle over a right one, relative, that is rounding of degrees.
const ROUNDING: f64 = 1e-12;

impl Checker<'_> {
    /// Checks the geometry of a fault: sides of bodies, or a line, a rectangle or triangles in a medium.
    pub(super) fn geometry(&mut self, name: &str, fault: &Fault) {
        let Some(medium) = &self.scene.medium else {
            self.sides_of(name, fault);
            return;
        };
        let in_space = *self.scene.kinematics.get_ref() == Kinematics::ThreeD;
        let (wanted, example) = if in_space {
            (
                "`rectangle` or `triangles`",
                "such as `rectangle = { from = [\"0 km\", \"0 km\", \"-50 km\"], to = [\"0 km\", \"0 km\", \"50 km\"], width = \"40 km\", size = \"1 km\" }`",
            )
        } else {
            (
                "`line`",
                "such as `line = { trace = [[\"0 km\", \"0 km\"], [\"0 km\", \"-40 km\"]], spacing = \"100 m\" }`",
            )
        };
        match (&fault.line, &fault.rectangle, &fault.triangles) {
            (Some(line), None, None) if !in_space => self.line(line, medium),
            (None, Some(rectangle), None) if in_space => self.rectangle(rectangle, medium),
            (None, None, Some(triangles)) if in_space => self.triangles(triangles),
            _ => self.error(
                fault.span(),
                format!("fault `{name}` needs {wanted} alone in {}", self.idealisation()),
                example,
            ),
        }
    }

    fn sides_of(&mut self, name: &str, fault: &Fault) {
        // Geometry of a medium is refused as such.
        if fault.line.is_some() || fault.rectangle.is_some() || fault.triangles.is_some() {
            return;
        }
        for (key, set) in [("minus", &fault.minus), ("plus", &fault.plus)] {
            if set.get_ref().is_empty() {
                self.error(
                    fault.law.span(),
                    format!("fault `{name}` has no side `{key}`"),
                    format!("add `{key} = \"BODY.SIDE\"`"),
                );
            } else {
                self.set(set);
            }
        }
    }

    /// Checks the medium and what a scene with a medium cannot have.
    pub(super) fn medium(&mut self) {
        let Some(medium) = &self.scene.medium else { return };
        let scene = self.scene;
        let material = medium.material.get_ref();
        match scene.materials.get(material) {
            None => {
                let known = scene.materials.keys().map(String::as_str);
                self.error(
                    medium.material.span(),
                    format!("there is no material `{material}`"),
                    suggest(material, "materials", known),
                );
            }
            Some(found) if !found.is_elastic() => self.error(
                medium.material.span(),
                format!("a medium is elastic, and the material `{material}` is not"),
                "plastic and viscous rock needs bodies",
            ),
            Some(_) => {}
        }
        if scene.faults.is_empty() {
            self.error(medium.kind.span(), "a medium without a fault", "add `[faults.NAME]`");
        }
    }

    fn line(&mut self, line: &FaultLine, medium: &Medium) {
        let trace = line.trace.get_ref();
        if trace.len() < 2 {
            self.error(line.trace.span(), "a line needs two vertices or more", "one for each tip");
        }
        let sizes = match line.spacing.get_ref() {
            SpacingSpec::Constant(size) => vec![size.0],
            SpacingSpec::Zone(zone) => vec![zone.size.0],
            SpacingSpec::Graded(table) => table.iter().map(|[_, size]| size.0).collect(),
        };
        if !sizes.iter().all(|size| *size > 0.0 && size.is_finite()) {
            self.error(
                line.spacing.span(),
                "the size of cells along the fault must be positive",
                "such as `spacing = \"100 m\"`",
            );
        }
        let highest = trace.iter().map(|vertex| vertex[1].0).fold(f64::NEG_INFINITY, f64::max);
        self.below_surface(&line.trace, highest, medium);
        self.corners(&line.trace, line.interpolation);
    }

    /// Refuses a fault above the surface of a half-space.
    fn below_surface<T>(&mut self, place: &Spanned<T>, highest: f64, medium: &Medium) {
        if *medium.kind.get_ref() == MediumKind::HalfSpace && highest > 0.0 {
            self.conflict(
                &place.span(),
                format!("the fault reaches y = {highest} m, above the surface y = 0 of the half-space"),
                "y points up: depths are negative",
                (&medium.kind.span(), "the half-space"),
            );
        }
    }

    /// Checks what a scene says of a file of triangles; the planner reads the file.
    fn triangles(&mut self, triangles: &FaultTriangles) {
        self.unit_of_file(triangles.unit());
        if let FaultTriangles::Depths(depths) = triangles {
            self.depths(depths);
        }
        if let Some(groups) = triangles.groups().filter(|g| g.get_ref().is_empty()) {
            self.error(
                groups.span(),
                "a fault of no triangles",
                "name groups of triangles, or leave the key out for all",
            );
        }
    }

    /// Checks a surface that is given by depths on a map.
    fn depths(&mut self, depths: &DepthTriangles) {
        let [top, bottom, size] = [&depths.top, &depths.bottom, &depths.size].map(|l| l.get_ref().0);
        if !(top < bottom && top >= 0.0 && bottom.is_finite()) {
            self.conflict(
                &depths.bottom.span(),
                format!("`bottom`, {bottom} m, is not below `top`, {top} m"),
                "depths increase downwards, such as `top = \"10 km\", bottom = \"40 km\"`",
                (&depths.top.span(), "the upper edge"),
            );
        }
        if !(size > 0.0 && size.is_finite()) {
            self.error(depths.size.span(), "`size` must be positive", "such as `size = \"5 km\"`");
        }
        if self.scene.place.is_none() {
            self.error(
                depths.file.span(),
                "depths on a map need a `[place]`",
                "the origin and the axes of the map: `[place]` with `latitude`, `longitude`, `strike = \"0 deg\"`, `up = [0, 1, 0]` and `along = [0, 0, -1]`, for x to the east and z to the south",
            );
        }
    }

    fn rectangle(&mut self, rectangle: &FaultRectangle, medium: &Medium) {
        let (from, to) = (rectangle.from.get_ref(), rectangle.to.get_ref());
        if from[1].0 != to[1].0 {
            self.error(
                rectangle.to.span(),
                format!(
                    "the upper edge is not horizontal: its ends lie at y = {} m and {} m",
                    from[1].0, to[1].0
                ),
                "`from` and `to` have the same y, which points up",
            );
        }
        let length = (to[0].0 - from[0].0).hypot(to[2].0 - from[2].0);
        let (width, size) = (rectangle.width.get_ref().0, rectangle.size.get_ref().0);
        let positive = |x: f64| x > 0.0 && x.is_finite();
        for (value, place, what) in [
            (length, rectangle.to.span(), "the upper edge must have a length"),
            (width, rectangle.width.span(), "`width` must be positive"),
            (size, rectangle.size.span(), "`size` must be positive"),
        ] {
            if !positive(value) {
                self.error(place, what, "a length such as \"40 km\"");
                return;
            }
        }
        if size > length.min(width) {
            self.error(rectangle.size.span(), "a cell is larger than the fault", "a smaller `size`");
        }
        if length * width / size.powi(2) > MOST_CELLS {
            self.error(
                rectangle.size.span(),
                format!("the fault would have {:.0} cells", length * width / size.powi(2)),
                "a larger `size`",
            );
        }
        if let Some(dip) = &rectangle.dip
            && !(dip.get_ref().0 > 0.0 && dip.get_ref().0 <= FRAC_PI_2 * (1.0 + ROUNDING))
        {
            self.error(
                dip.span(),
                "`dip` must lie above 0 and be at most 90 degrees",
                "such as `dip = \"30 deg\"`; exchange `from` and `to` for a fault that dips to the other side",
            );
        }
        self.below_surface(&rectangle.from, from[1].0, medium);
    }
}
