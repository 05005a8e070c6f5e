//! Place and time of the events of a scene.

use crate::units::{Angle, Length};
use serde::Deserialize;
use serde_spanned::Spanned;

/// Place and time, with which catalogues are written as those of real events.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// Time zero, with its offset from UTC, such as "2000-01-01T00:00:00Z".
    pub epoch: Spanned<String>,
    /// Of the origin of coordinates, north \[rad\].
    pub latitude: Spanned<Angle>,
    /// Of the origin of coordinates, east \[rad\].
    pub longitude: Spanned<Angle>,
    /// Of the origin of coordinates \[m\]; 0 where absent.
    pub depth: Option<Spanned<Length>>,
    /// Clockwise from north: in the plane, of the direction into the plane, with x to its right and y up; in space, of `along` \[rad\].
    pub strike: Spanned<Angle>,
    /// In space: the direction up, of any length; z where absent.
    #[serde(default, deserialize_with = "crate::exact::optional")]
    pub up: Option<Spanned<[f64; 3]>>,
    /// In space: the horizontal direction whose azimuth `strike` is, of any length; y where absent.
    #[serde(default, deserialize_with = "crate::exact::optional")]
    pub along: Option<Spanned<[f64; 3]>>,
    /// In the plane: length out of it, for moments and magnitudes \[m\].
    pub length: Option<Spanned<Length>>,
}

impl Place {
    /// In space: the directions up and along the strike, of any length.
    #[must_use]
    pub fn axes(&self) -> ([f64; 3], [f64; 3]) {
        let of = |given: &Option<Spanned<[f64; 3]>>, other| given.as_ref().map_or(other, |v| *v.get_ref());
        (of(&self.up, [0.0, 0.0, 1.0]), of(&self.along, [0.0, 1.0, 0.0]))
    }
}
