//! Positions on the free surface whose displacement over each event is written.

use super::receivers::Receivers;
use asperity_cycles::medium::patches::Patches;
use asperity_fem::material::elastic::Elastic;
use asperity_output::formats::grd::Axis;

/// Positions on the free surface whose displacement is written for each event.
#[derive(Clone, Debug)]
pub struct FreeSurface {
    /// Positions \[m\]: in space row by row along the first axis.
    pub positions: Vec<[f64; 3]>,
    /// Coordinates: x in the plane, two in space, as they appear from above.
    pub axes: SurfaceAxes,
    /// The cells of the faults.
    pub patches: Patches,
    /// The rock.
    pub rock: Elastic,
    /// The positions with what moves them through time; none in space, or where the motion of the plates is not defined.
    pub through: Option<Receivers>,
}

/// Coordinates of the positions on the free surface.
#[derive(Clone, Debug, PartialEq)]
pub enum SurfaceAxes {
    /// x of a line \[m\].
    Line(Vec<f64>),
    /// z and x of a surface \[m\]: seen from above, x is up the page where z is to the right.
    Scene([Vec<f64>; 2]),
    /// Longitude and latitude \[degrees\].
    Earth([Vec<f64>; 2]),
}

impl SurfaceAxes {
    /// Axes of grids; `None` for a line.
    pub fn in_grids(&self) -> Option<[Axis<'_>; 2]> {
        match self {
            Self::Line(_) => None,
            Self::Scene([z, x]) => Some([
                Axis { name: "x", meaning: "z of the scene", unit: "m", values: z },
                Axis { name: "y", meaning: "x of the scene", unit: "m", values: x },
            ]),
            Self::Earth([longitude, latitude]) => Some([
                Axis { name: "lon", meaning: "longitude", unit: "degrees_east", values: longitude },
                Axis { name: "lat", meaning: "latitude", unit: "degrees_north", values: latitude },
            ]),
        }
    }
}
