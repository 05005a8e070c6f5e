//! Positions in a medium or in bodies whose motion is written.

use super::{AXES, Checker};
use crate::model::{MediumKind, Spanned};

impl Checker<'_> {
    /// Checks the receivers of a scene.
    pub(super) fn receivers(&mut self) {
        let scene = self.scene;
        let axes: Vec<usize> = (0..self.dimension()).collect();
        for (name, at) in &scene.output.receivers {
            self.name("a receiver", name, at.span());
            if !self.count(at, "receivers", &axes) {
                continue;
            }
            let kind = scene.medium.as_ref().map(|medium| *medium.kind.get_ref());
            self.place_of(name, at, kind);
        }
    }

    /// Checks the sites of a scene, which are receivers at the free surface of a half-space.
    pub(super) fn sites(&mut self) {
        let scene = self.scene;
        let file = scene.output.site_file.as_ref().map(Spanned::span);
        let Some(first) = scene.output.sites.values().map(Spanned::span).next().or(file) else { return };
        let half = scene.medium.as_ref().is_some_and(|m| *m.kind.get_ref() == MediumKind::HalfSpace);
        if !half {
            self.error(
                first,
                "sites lie at the free surface of a half-space in space",
                "`kinematics = \"3d\"` and `[medium]` with `kind = \"half-space\"`; elsewhere, `receivers.NAME` has coordinates",
            );
            return;
        }
        if scene.place.is_none() {
            let help = "`[place]` with the longitude and latitude of the origin; or `receivers.NAME`, which has coordinates";
            self.error(first, "longitudes and latitudes need a `[place]`", help);
        }
        for (name, site) in &scene.output.sites {
            self.name("a site", name, site.span());
            self.angle("latitude", &site.get_ref().latitude, -90.0, 90.0);
            self.angle("longitude", &site.get_ref().longitude, -180.0, 360.0);
            if let Some(other) = scene.output.receivers.get(name) {
                let message = format!("`{name}` is a site and a receiver");
                self.conflict(
                    &site.span(),
                    message,
                    "another name for one of them",
                    (&other.span(), "the receiver"),
                );
            }
        }
    }

    /// Checks the coordinates of a receiver.
    fn place_of(&mut self, name: &str, at: &Spanned<Vec<crate::units::Length>>, kind: Option<MediumKind>) {
        let values: Vec<f64> = at.get_ref().iter().map(|x| x.0).collect();
        if let Some(axis) = values.iter().position(|x| !x.is_finite()) {
            self.error(
                at.span(),
                format!("{} of receiver `{name}` must be finite", AXES[axis]),
                "a position, such as [\"8 km\", \"0 km\"]",
            );
        } else if kind == Some(MediumKind::HalfSpace) && values.get(1).is_some_and(|y| *y > 0.0) {
            self.error(
                at.span(),
                format!("receiver `{name}` lies {} m above the free surface y = 0", values[1]),
                "y points up: depths are negative",
            );
        }
    }
}
