//! View of the surface of a fault in figures: with north up, with up up, or along its rake where no direction is known.

use asperity_cycles::medium;
use asperity_output::figures::Surface;
use asperity_plan::faults::PointView;
use asperity_plan::shared::place::Frame;
use nalgebra::Vector3;

/// Largest component of a unit vector across an axis: rounding.
const STRAIGHT: f64 = 1e-9;
/// Upward component of a normal above which a surface is seen from above, and not along its strike: a dip of 60 degrees.
const GENTLE: f64 = 0.5;
/// Names of the axes.
const NAMES: [&str; 3] = ["x", "y", "z"];

/// Known directions of a scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct Compass<'a> {
    /// Direction up.
    pub up: Option<[f64; 3]>,
    /// Geographic position.
    pub frame: Option<&'a Frame>,
}

/// View of a surface.
pub enum View<'a> {
    /// From above, with north up.
    Map(&'a Frame),
    /// Along directions to the right and up, with their names.
    Along([Vector3<f64>; 2], [String; 2]),
}

impl<'a> View<'a> {
    /// View of a fault. A surface of triangles that dips gently is seen from above; planes are seen along their normals.
    pub fn from_points(points: &[PointView], compass: &Compass<'a>, triangles: bool) -> Self {
        let sum: Vector3<f64> = points.iter().map(|p| p.area * Vector3::from(p.normal)).sum();
        let normal = sum.try_normalize(0.0).unwrap_or_else(Vector3::z);
        let across = (0..3).find(|&c| points.iter().all(|p| p.normal[c].abs() > 1.0 - STRAIGHT));
        let up = compass.up.and_then(|up| Vector3::from(up).try_normalize(0.0));
        match (up, across) {
            (Some(up), _) if normal.dot(&up).abs() > if triangles { GENTLE } else { 1.0 - STRAIGHT } => {
                compass.frame.map_or_else(|| from_above(&up), Self::Map)
            }
            (Some(up), Some(axis)) if up[axis].abs() < STRAIGHT => flat(axis),
            (Some(up), _) => along_strike(&normal, &up, compass.frame),
            (None, Some(axis)) => flat(axis),
            (None, None) => along_rake(points),
        }
    }

    /// Coordinates of a position.
    pub fn place(&self, at: &[f64; 3]) -> (f64, f64) {
        match self {
            Self::Map(frame) => {
                let spot = frame.spot(at);
                (spot.longitude, spot.latitude)
            }
            Self::Along([right, up], _) => {
                let at = Vector3::from(*at);
                (right.dot(&at), up.dot(&at))
            }
        }
    }

    /// A surface with points at these positions.
    pub fn surface<'p>(&self, at: impl Iterator<Item = &'p [f64; 3]>, faces: Vec<Vec<usize>>) -> Surface {
        let places = at.map(|at| self.place(at)).collect();
        let (labels, geographic) = match self {
            Self::Map(_) => (["Longitude".into(), "Latitude".into()], true),
            Self::Along(_, labels) => (labels.clone(), false),
        };
        Surface { places, faces, labels, geographic }
    }
}

/// Unit vector along an axis.
pub fn unit(axis: usize) -> Vector3<f64> {
    Vector3::from_fn(|c, _| f64::from(u8::from(c == axis)))
}

/// A plane across an axis: y points up where it lies in the plane.
fn flat<'a>(axis: usize) -> View<'a> {
    let axes = [[2, 1], [0, 2], [0, 1]][axis];
    View::Along(axes.map(unit), axes.map(|axis| NAMES[axis].into()))
}

/// A map in the axes of the scene: where y points up, x points up the page and z to the right, as in maps of the ground.
pub fn from_above<'a>(up: &Vector3<f64>) -> View<'a> {
    match (0..3).find(|&axis| up[axis] > 1.0 - STRAIGHT) {
        Some(axis) => {
            let axes = [(axis + 1) % 3, (axis + 2) % 3];
            View::Along(axes.map(unit), axes.map(|axis| NAMES[axis].into()))
        }
        None => {
            let least = unit(up.iamin());
            let right = up.cross(&least).normalize();
            View::Along([right, up.cross(&right)], ["Level".into(), "Level, across".into()])
        }
    }
}

/// A surface seen from its hanging wall: along strike to the right, and up dip.
pub fn along_strike<'a>(normal: &Vector3<f64>, up: &Vector3<f64>, frame: Option<&Frame>) -> View<'a> {
    let hanging = if normal.dot(up) < -STRAIGHT { -normal } else { *normal };
    let mut strike = up.cross(&hanging).normalize();
    let mut rises = hanging.cross(&strike);
    // A vertical plane has no hanging wall: its strike is towards the positive side of the axis it is closest to.
    if normal.dot(up).abs() <= STRAIGHT && strike[strike.iamax()] < 0.0 {
        strike = -strike;
        rises = *up;
    }
    let towards = frame.map_or(String::new(), |frame| {
        let [east, north] = frame.horizontal().map(|axis| Vector3::from(axis).dot(&strike));
        format!(", towards N {:.0}° E", east.atan2(north).to_degrees().rem_euclid(360.0))
    });
    View::Along([strike, rises], [format!("Along strike{towards}"), "Up dip".into()])
}

/// A surface in a scene without a direction up.
fn along_rake<'a>(points: &[PointView]) -> View<'a> {
    let Some(first) = points.first() else { return flat(2) };
    let across = first.across.unwrap_or_else(|| medium::across(&first.normal, &first.slides));
    let axes = [first.slides, across].map(Vector3::from);
    View::Along(axes, ["Along the rake".into(), "Across the rake".into()])
}
