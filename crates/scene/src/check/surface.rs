//! A map of the free surface.

use super::Checker;
use crate::model::{AngleExtent, Extent, MediumKind, Spanned, SurfaceSpec};

impl Checker<'_> {
    /// Checks the map of the free surface of a scene.
    pub(super) fn surface(&mut self) {
        let Some(map) = &self.scene.output.surface else { return };
        let kind = self.scene.medium.as_ref().map(|medium| *medium.kind.get_ref());
        if kind != Some(MediumKind::HalfSpace) {
            let found = if kind.is_some() { "a whole-space" } else { "a scene without `[medium]`" };
            self.error(
                map.span(),
                format!("`surface` is the free surface of a half-space, and {found} has none"),
                "`[medium]` with `kind = \"half-space\"`; in a whole-space, `receivers.NAME = [..]`; in bodies, `points.NAME = { body = \"..\", at = [..] }`",
            );
        }
        self.map(map.get_ref());
        if self.scene.output.event_files.as_ref().is_some_and(|count| *count.get_ref() == 0) {
            self.warn(
                map.span(),
                "`surface` is written for events that have files, and `event_files` is 0",
                "a larger `event_files`, or no `surface`",
            );
        }
    }

    /// Checks spacing, extents and axes of a map.
    pub(super) fn map(&mut self, spec: &SurfaceSpec) {
        let spacing = spec.spacing.get_ref().0;
        if !(spacing > 0.0 && spacing.is_finite()) {
            self.error(spec.spacing.span(), "`spacing` must be positive", "such as `spacing = \"2 km\"`");
        }
        for (axis, extent) in [("x", &spec.x), ("z", &spec.z)] {
            extent.iter().for_each(|extent| self.rises(axis, extent));
        }
        let angles = [("longitude", &spec.longitude, 360.0), ("latitude", &spec.latitude, 90.0)];
        for (name, extent, most) in angles {
            extent.iter().for_each(|extent| self.on_earth(name, extent, most));
        }
        self.axes_of(spec);
    }

    /// Refuses axes that the scene does not have.
    fn axes_of(&mut self, spec: &SurfaceSpec) {
        let on_earth = [&spec.longitude, &spec.latitude].into_iter().flatten().next().map(Spanned::span);
        let Some(place) = on_earth.filter(|_| self.in_space()) else { return };
        let level = [&spec.x, &spec.z].into_iter().flatten().next().map(Spanned::span);
        if self.scene.place.is_none() {
            let help = "`[place]` with the origin and the axes of the map, or `x` and `z`";
            self.error(place, "longitudes and latitudes need a `[place]`", help);
        } else if spec.longitude.is_none() || spec.latitude.is_none() {
            self.error(place, "a map on Earth has both `longitude` and `latitude`", "give both");
        } else if let Some(level) = level {
            let help = "give `longitude` and `latitude`, or `x` and `z`";
            self.conflict(
                &level,
                "a map has the axes of the scene or those of Earth",
                help,
                (&place, "Earth"),
            );
        }
    }

    fn rises(&mut self, axis: &str, extent: &Spanned<Extent>) {
        let Extent { from, to } = *extent.get_ref();
        let (Some(from), Some(to)) = (from, to) else {
            self.error(
                extent.span(),
                format!("`{axis}` of a map has both ends"),
                format!("`{axis} = {{ from = \"-50 km\", to = \"50 km\" }}`, or leave `{axis}` out"),
            );
            return;
        };
        if !(from.0.is_finite() && to.0.is_finite() && from.0 < to.0) {
            self.error(
                extent.span(),
                format!("`{axis}` runs from {} to {} m", from.0, to.0),
                "`from` is less than `to`, and both are finite",
            );
        }
    }

    fn on_earth(&mut self, name: &str, extent: &Spanned<AngleExtent>, most: f64) {
        let [from, to] = [extent.get_ref().from, extent.get_ref().to].map(|angle| angle.0.to_degrees());
        let within = |angle: f64| angle.abs() <= most + ROUNDING;
        if !(within(from) && within(to) && from < to) {
            self.error(
                extent.span(),
                format!("`{name}` runs from {from:.6} to {to:.6} degrees"),
                format!("`from` is less than `to`, and both lie between -{most} and {most} degrees"),
            );
        }
    }
}

/// Admissible rounding of angles, which are read in radians \[deg\].
const ROUNDING: f64 = 1e-9;
