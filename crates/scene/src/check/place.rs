//! Geographical position and time of the events of a scene.

use super::Checker;
use crate::axes::{Axes, cross, size};
use crate::model::{FaultTriangles, MediumKind, Place, Spanned};
use crate::units::Angle;
use jiff::{SignedDuration, Timestamp};

impl Checker<'_> {
    pub(super) fn place(&mut self) {
        let Some(place) = &self.scene.place else { return };
        self.angle("latitude", &place.latitude, -90.0, 90.0);
        self.angle("longitude", &place.longitude, -180.0, 360.0);
        self.angle("strike", &place.strike, 0.0, 360.0);
        if let Some(depth) = place.depth.as_ref().filter(|d| !d.get_ref().0.is_finite()) {
            self.error(depth.span(), "`depth` must be finite", "such as `depth = \"5 km\"`");
        }
        if let Some(length) = &place.length {
            let value = length.get_ref().0;
            if !(value > 0.0 && value.is_finite()) {
                self.error(length.span(), "`length` must be positive", "such as `length = \"100 km\"`");
            }
        }
        self.axes(place);
        self.epoch(&place.epoch);
    }

    /// Checks the directions in space: up, and the horizontal direction whose azimuth is `strike`.
    fn axes(&mut self, place: &Place) {
        for (name, given) in [("up", &place.up), ("along", &place.along)] {
            let Some(given) = given else { continue };
            let size = given.get_ref().iter().map(|c| c * c).sum::<f64>();
            if !(size > 0.0 && size.is_finite()) {
                self.error(given.span(), format!("`{name}` has no direction"), "such as `[0, 1, 0]`");
            }
        }
        if self.in_space() {
            self.level(place);
            self.upright(place);
        }
    }

    /// Checks that `along` is horizontal.
    fn level(&mut self, place: &Place) {
        let Axes { up, along } = self.scene.axes();
        let dot: f64 = up.iter().zip(&along).map(|(a, b)| a * b).sum();
        let given = place.along.as_ref().or(place.up.as_ref());
        if let Some(given) = given.filter(|_| dot.abs() > LEVEL * size(&up) * size(&along)) {
            self.error(
                given.span(),
                "`along` is not horizontal: it must be normal to `up`",
                "with y up and the fault along z: `up = [0, 1, 0]` and `along = [0, 0, 1]`",
            );
        }
    }

    /// Checks that `up` is that of the free surface, of faults whose dip counts from y, and of gravity.
    fn upright(&mut self, place: &Place) {
        let Some(given) = &place.up else { return };
        let up = *given.get_ref();
        let off = |from: &[f64; 3]| {
            let dot: f64 = up.iter().zip(from).map(|(a, b)| a * b).sum();
            size(&cross(&up, from)).atan2(dot).to_degrees()
        };
        let scene = self.scene;
        let half = scene.medium.as_ref().is_some_and(|m| *m.kind.get_ref() == MediumKind::HalfSpace);
        let from_y = scene
            .faults
            .values()
            .any(|f| f.rectangle.is_some() || matches!(f.triangles, Some(FaultTriangles::Depths(_))));
        if scene.medium.is_some() && (half || from_y) && off(&[0.0, 1.0, 0.0]) > UPRIGHT {
            let why = if half { "the free surface of the half-space is y = 0" } else { "dips count from y" };
            self.error(
                given.span(),
                format!("`up` does not point along y, and {why}"),
                "`up = [0, 1, 0]`, or no `up`; with `along = [0, 0, -1]` and `strike = \"0 deg\"`, x points to the east and z to the south",
            );
        }
        let leaning = scene.lift().map(|lift| (lift, off(&lift)));
        if let Some((lift, angle)) = leaning.filter(|(_, angle)| *angle > LEANS) {
            self.error(
                given.span(),
                format!("`up` points {angle:.1} degrees away from the direction against `gravity`"),
                format!("`up = [{}, {}, {}]`, or no `up`", lift[0], lift[1], lift[2]),
            );
        }
    }

    pub(super) fn angle(&mut self, name: &str, angle: &Spanned<Angle>, least: f64, most: f64) {
        let degrees = angle.get_ref().0.to_degrees();
        // The conversion to radians and back is not exact.
        if !(degrees >= least - ROUNDING && degrees <= most + ROUNDING) {
            self.error(
                angle.span(),
                format!("`{name}` must lie between {least} and {most} degrees, found {degrees:.6}"),
                format!("such as `{name} = \"35 deg\"`"),
            );
        }
    }

    /// Checks that the calendar covers the time from the epoch to the end of the run.
    fn epoch(&mut self, epoch: &Spanned<String>) {
        let time = match epoch.get_ref().parse::<Timestamp>() {
            Ok(time) => time,
            Err(error) => {
                self.error(
                    epoch.span(),
                    format!("`epoch` is no time: {error}"),
                    "such as `epoch = \"2000-01-01T00:00:00Z\"`",
                );
                return;
            }
        };
        let duration: f64 = self.scene.stages.iter().map(|s| s.duration.get_ref().0).sum();
        let reached = SignedDuration::try_from_secs_f64(duration).and_then(|span| time.checked_add(span));
        if reached.is_err() {
            self.error(
                epoch.span(),
                "the calendar ends with the year 9999, before the run does",
                "an earlier `epoch`, or a shorter run",
            );
        }
    }
}

/// Largest admissible sine of the angle between `along` and the horizontal: rounding of components written with seven digits.
const LEVEL: f64 = 1e-6;
/// Angle between `up` and y beyond which they differ: rounding of components written with seven digits \[deg\].
const UPRIGHT: f64 = 1e-4;
/// Angle between `up` and the direction against gravity beyond which they differ: components may have two digits \[deg\].
const LEANS: f64 = 1.0;
/// Admissible rounding of angles \[deg\].
const ROUNDING: f64 = 1e-9;
