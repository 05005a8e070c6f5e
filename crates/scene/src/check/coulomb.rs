//! Planes on which changes of Coulomb stress are resolved.

use super::{AXES, Checker};
use crate::model::{CoulombSpec, Kinematics, MediumKind, Spanned};
use crate::units::{Angle, Length};
use std::ops::Range;

/// Admissible rounding of angles, which are read in radians \[deg\].
const ROUNDING: f64 = 1e-9;

impl Checker<'_> {
    /// Checks the planes of Coulomb stress of a scene.
    pub(super) fn coulomb(&mut self) {
        let Some(given) = &self.scene.output.coulomb else { return };
        let spec = given.get_ref();
        self.effective_friction(&spec.friction);
        self.plane(given.span(), spec);
        if self.scene.medium.is_some() {
            self.coulomb_in_rock(given.span(), spec);
        } else {
            self.coulomb_between_bodies(spec);
        }
        if self.scene.output.event_files.as_ref().is_some_and(|count| *count.get_ref() == 0) {
            self.warn(
                given.span(),
                "`coulomb` is written for events that have files, and `event_files` is 0",
                "a larger `event_files`, or no `coulomb`",
            );
        }
    }

    fn effective_friction(&mut self, friction: &Spanned<f64>) {
        let value = *friction.get_ref();
        if !(value >= 0.0 && value.is_finite()) {
            self.error(friction.span(), "`friction` must not be negative", "such as `friction = 0.4`");
        }
    }

    /// Checks the direction of the planes.
    fn plane(&mut self, place: Range<usize>, spec: &CoulombSpec) {
        let in_space = self.dimension() == 3;
        match &spec.strike {
            None if in_space => self.error(
                place,
                "planes in three dimensions have a `strike`",
                "such as `strike = \"30 deg\"`, clockwise from north or, without `[place]`, from x towards z",
            ),
            Some(strike) => self.within("strike", strike, (-360.0, 360.0)),
            None => {}
        }
        self.within("dip", &spec.dip, (0.0, if in_space { 90.0 } else { 180.0 }));
        self.within("rake", &spec.rake, (-180.0, 180.0));
        let rake = spec.rake.get_ref().0.to_degrees();
        let near = |angles: [f64; 3]| angles.iter().any(|angle| (rake - angle).abs() <= ROUNDING);
        let (allowed, words) = match self.scene.kinematics.get_ref() {
            Kinematics::Antiplane => {
                ([0.0, 180.0, -180.0], "0 or 180 degrees, left-lateral or right-lateral")
            }
            Kinematics::ThreeD => return,
            _ => ([90.0, -90.0, 90.0], "90 or -90 degrees, reverse or normal"),
        };
        if rake.abs() <= 180.0 + ROUNDING && !near(allowed) {
            self.error(
                spec.rake.span(),
                format!("in {} nothing slips with a `rake` of {rake:.6} degrees", self.idealisation()),
                words,
            );
        }
    }

    fn within(&mut self, name: &str, angle: &Spanned<Angle>, (least, most): (f64, f64)) {
        let degrees = angle.get_ref().0.to_degrees();
        if !(degrees >= least - ROUNDING && degrees <= most + ROUNDING) {
            self.error(
                angle.span(),
                format!("`{name}` must lie between {least} and {most} degrees, found {degrees:.6}"),
                format!("such as `{name} = \"45 deg\"`"),
            );
        }
    }

    /// Checks positions in a medium.
    fn coulomb_in_rock(&mut self, place: Range<usize>, spec: &CoulombSpec) {
        if spec.map.is_none() && spec.points.is_empty() && self.scene.faults.len() < 2 {
            self.error(
                place,
                "`coulomb` has no positions, and the scene has no other fault",
                "`map = { spacing = \"2 km\" }` with `depth = \"5 km\"`, or `points.NAME = [..]`",
            );
        }
        match (&spec.map, &spec.depth) {
            (Some(map), None) => self.error(
                map.span(),
                "the map of Coulomb stress has no `depth`",
                "such as `depth = \"5 km\"`, below y = 0",
            ),
            (None, Some(depth)) => {
                self.error(depth.span(), "`depth` is that of a `map`", "`map = { spacing = \"2 km\" }`");
            }
            _ => {}
        }
        if let Some(map) = &spec.map {
            self.map(map.get_ref());
        }
        let half = self.scene.medium.as_ref().is_some_and(|m| *m.kind.get_ref() == MediumKind::HalfSpace);
        if let Some(depth) = &spec.depth {
            let value = depth.get_ref().0;
            if !value.is_finite() || half && value < 0.0 {
                self.error(
                    depth.span(),
                    "`depth` lies above the free surface y = 0, or is not finite",
                    "depths are positive, such as `depth = \"5 km\"`",
                );
            }
        }
        for (name, at) in &spec.points {
            self.coulomb_point(name, at, half);
        }
    }

    fn coulomb_point(&mut self, name: &str, at: &Spanned<Vec<Length>>, half: bool) {
        self.name("a position", name, at.span());
        let axes: Vec<usize> = (0..self.dimension()).collect();
        if !self.count(at, "points", &axes) {
            return;
        }
        let values: Vec<f64> = at.get_ref().iter().map(|x| x.0).collect();
        if let Some(axis) = values.iter().position(|x| !x.is_finite()) {
            let message = format!("{} of position `{name}` must be finite", AXES[axis]);
            self.error(at.span(), message, "a position, such as [\"8 km\", \"-5 km\"]");
        } else if half && values.get(1).is_some_and(|y| *y > 0.0) {
            self.error(
                at.span(),
                format!("position `{name}` lies {} m above the free surface y = 0", values[1]),
                "y points up: depths are negative",
            );
        }
    }

    /// Checks that directions up and north are known.
    fn coulomb_between_bodies(&mut self, spec: &CoulombSpec) {
        let upright = self.scene.place.is_some() || self.dimension() < 3;
        if let Some(strike) = spec.strike.as_ref().filter(|_| !upright) {
            self.error(
                strike.span(),
                "`strike` of planes between bodies needs directions up and north",
                "`[place]` with `up`, `along` and `strike`",
            );
        }
    }
}
