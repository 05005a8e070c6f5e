//! Coordinates of a file, and those of the points of a surface.
//!
//! Each coordinate is a linear function of the position in the scene, or the distance along a line in the plane. Three scattered
//! coordinates are projected to the plane that fits the points best. Longitudes and latitudes are distances east and north of the
//! origin at scattered positions, and degrees on a grid.

use super::region::{Region, Spot};
use crate::reading::columns::Wrong;
use crate::reading::scene::model::Scene;
use crate::shared::place;
use crate::shared::place::{Frame, Map};
use asperity_fem::mesh::sheet::ScatterError;
use nalgebra::{Matrix3, Vector3};

/// Names of coordinates, in the order in which they are taken.
pub(super) const NAMES: [&str; 7] = ["distance", "longitude", "latitude", "x", "y", "z", "depth"];

/// Sets of coordinates that a file may have.
const SETS: &str = "`distance` on a fault in the plane; one, two or three of `x`, `y` and `z`; `depth`; or `longitude` and `latitude`, with or without `depth`";

/// Share of the widest spread of points below which they lie across an axis rather than along it.
const FLAT: f64 = 0.01;

/// Coordinate of a file.
#[derive(Clone, Debug)]
enum Axis<const D: usize> {
    /// Distance along a line in the plane.
    Along,
    /// Sum of the products with the coordinates of the scene, and a constant \[m\].
    Linear([f64; D], f64),
}

/// Coordinates of a file.
pub(super) struct Axes<const D: usize> {
    names: Vec<&'static str>,
    axes: Vec<Axis<D>>,
    /// Directions of the plane of the points in three scattered coordinates.
    plane: Option<[Vector3<f64>; 2]>,
    /// Projection by which the first two coordinates are degrees, on a grid.
    degrees: Option<Map>,
    /// Least and largest coordinate of each axis.
    ranges: Vec<[f64; 2]>,
}

/// Coordinates of positions, one list per name.
pub(super) type Lists = Vec<Vec<f64>>;

impl<const D: usize> Axes<D> {
    /// Axes of coordinates with these names.
    ///
    /// # Errors
    /// [`Wrong`] for coordinates that do not fit the scene.
    fn named(region: &Region<'_, D>, names: &[&'static str]) -> Result<Self, Wrong> {
        let scene = region.scene;
        fit(region, names)?;
        let mut axes = Vec::new();
        for &name in names {
            axes.push(match name {
                "distance" => Axis::Along,
                "depth" => down(scene)?,
                "longitude" | "latitude" => {
                    let ways = framed::<D>(scene)?.horizontal();
                    let way = ways[usize::from(name == "latitude")];
                    Axis::Linear(std::array::from_fn(|c| way[c]), 0.0)
                }
                _ => {
                    let c = ["x", "y", "z"].iter().position(|axis| *axis == name).unwrap_or_default();
                    Axis::Linear(std::array::from_fn(|k| if k == c { 1.0 } else { 0.0 }), 0.0)
                }
            });
        }
        Ok(Self { names: names.to_vec(), axes, plane: None, degrees: None, ranges: Vec::new() })
    }

    /// True if one of the coordinates is a length.
    pub fn has_lengths(&self) -> bool {
        self.names.iter().any(|name| !["longitude", "latitude"].contains(name))
    }

    /// Axes of scattered positions for points at these spots, and the positions in one or two coordinates. `lists` has metres, and
    /// radians of longitude and latitude; `row` names a row of them.
    ///
    /// # Errors
    /// [`Wrong`] for coordinates that do not fit the scene.
    pub fn scattered(
        region: &Region<'_, D>,
        names: &[&'static str],
        lists: Lists,
        row: &dyn Fn(usize) -> String,
    ) -> Result<(Self, Vec<Vec<f64>>), Wrong> {
        let (mut all, rows) = Self::from_rows(region, names, lists, row)?;
        if names.len() < 3 {
            return Ok((all, rows));
        }
        let plane = plane(region.spots.iter().map(|spot| all.raw(spot)));
        let positions = rows.iter().map(|x| projected(&plane, x)).collect();
        all.plane = Some(plane);
        Ok((all, positions))
    }

    /// Axes of positions in all their coordinates, and these.
    ///
    /// # Errors
    /// [`Wrong`] for coordinates that do not fit the scene.
    pub fn from_rows(
        region: &Region<'_, D>,
        names: &[&'static str],
        mut lists: Lists,
        row: &dyn Fn(usize) -> String,
    ) -> Result<(Self, Vec<Vec<f64>>), Wrong> {
        let mut all = Self::named(region, names)?;
        if names.contains(&"longitude") {
            let map = framed::<D>(region.scene)?.map();
            for k in 0..lists[0].len() {
                let at = map.metres(lists[0][k].to_degrees(), lists[1][k].to_degrees());
                let at = at.ok_or_else(|| unplaced(format!("{} is not near the origin", row(k))))?;
                (lists[0][k], lists[1][k]) = (at[0], at[1]);
            }
        }
        all.ranges = lists.iter().map(|list| range(list)).collect();
        let count = lists.first().map_or(0, Vec::len);
        let rows = (0..count).map(|k| lists.iter().map(|list| list[k]).collect()).collect();
        Ok((all, rows))
    }

    /// Axes of a grid; `lists` has metres, and degrees of longitude and latitude.
    ///
    /// # Errors
    /// [`Wrong`] for coordinates that do not fit the scene.
    pub fn from_grid(region: &Region<'_, D>, names: &[&'static str], lists: &Lists) -> Result<Self, Wrong> {
        let mut all = Self::named(region, names)?;
        if names.contains(&"longitude") {
            all.degrees = Some(framed::<D>(region.scene)?.map());
        }
        all.ranges = lists.iter().map(|list| range(list)).collect();
        Ok(all)
    }

    /// Coordinates of a point, comparable with positions.
    pub fn coordinates(&self, spot: &Spot<D>) -> Vec<f64> {
        let all = self.placed(spot);
        self.plane.as_ref().map_or_else(|| all.clone(), |plane| projected(plane, &all))
    }

    /// All coordinates of a point.
    fn placed(&self, spot: &Spot<D>) -> Vec<f64> {
        let mut raw = self.raw(spot);
        if let Some(map) = &self.degrees {
            (raw[0], raw[1]) = map.degrees([raw[0], raw[1]]);
        }
        raw
    }

    fn raw(&self, spot: &Spot<D>) -> Vec<f64> {
        let of = |axis: &Axis<D>| match axis {
            Axis::Along => spot.along.unwrap_or(f64::NAN),
            Axis::Linear(way, from) => from + way.iter().zip(&spot.at).map(|(w, x)| w * x).sum::<f64>(),
        };
        self.axes.iter().map(of).collect()
    }

    /// Smallest share of the extent of the file over which some points spread, and its coordinate: a unit may be wrong in one of them.
    /// Coordinates along which the points hardly spread count only if there are no others.
    pub fn share(&self, spots: &[Spot<D>]) -> (f64, &'static str) {
        let placed: Vec<Vec<f64>> = spots.iter().map(|spot| self.placed(spot)).collect();
        // In metres on all axes.
        let raw: Vec<Vec<f64>> = spots.iter().map(|spot| self.raw(spot)).collect();
        let spread = |all: &[Vec<f64>], c: usize| {
            let [from, to] = range(&all.iter().map(|x| x[c]).collect::<Vec<_>>());
            to - from
        };
        let widest = (0..self.names.len()).map(|c| spread(&raw, c)).fold(0.0, f64::max);
        let shares =
            self.ranges.iter().zip(&self.names).enumerate().filter_map(|(c, ([low, high], name))| {
                let share = spread(&placed, c) / (high - low);
                (share.is_finite() && spread(&raw, c) > FLAT * widest).then_some((share, *name))
            });
        shares.reduce(|a, b| if b.0 < a.0 { b } else { a }).unwrap_or((0.0, self.names[0]))
    }

    /// Names of the coordinates.
    pub fn words(&self) -> String {
        self.names.join(", ")
    }

    /// Extent of the file in its coordinates.
    pub fn extent(&self) -> String {
        let on_map = self.names.contains(&"longitude");
        let of = |(axis, [low, high]): (&&'static str, &[f64; 2])| match *axis {
            "longitude" | "latitude" if self.degrees.is_some() => {
                format!("from {low} to {high} degrees of {axis}")
            }
            "longitude" => format!("from {low} to {high} m east of the origin"),
            "latitude" => format!("from {low} to {high} m north of the origin"),
            name if on_map => format!("from {low} to {high} m {name}"),
            name => format!("from {low} to {high} m along {name}"),
        };
        self.names.iter().zip(&self.ranges).map(of).collect::<Vec<_>>().join(", ")
    }

    /// Reason why positions are no samples of this fault.
    pub fn explain(&self, error: &ScatterError) -> Wrong {
        let message = match error {
            ScatterError::Few { positions: 1 } if self.names.len() == 1 => {
                format!("by {}, it has one position", self.words())
            }
            _ => format!("by {}, {error}", self.words()),
        };
        let help = match error {
            ScatterError::Few { .. } if self.names.len() > 1 => {
                "give one coordinate alone where values vary along a line; `coordinates` names those that count"
            }
            ScatterError::Few { .. } => "two positions or more",
            ScatterError::Twice { .. } => "one value at each position",
        };
        Wrong { message, help: help.into() }
    }
}

/// Refuses sets of coordinates that mean no positions of the scene.
fn fit<const D: usize>(region: &Region<'_, D>, names: &[&str]) -> Result<(), Wrong> {
    let wrong = |message: String| Err(Wrong { message, help: SETS.into() });
    let has = |name: &str| names.contains(&name);
    let geographic = has("longitude") || has("latitude");
    if names.is_empty() {
        return wrong("it has no coordinates that are known".into());
    }
    if has("distance") && D == 3 {
        return wrong("there is no `distance` along a fault in three dimensions".into());
    }
    if has("distance") && region.spots.iter().any(|spot| spot.along.is_none()) {
        return wrong(format!("there is no `distance` along {}", region.name));
    }
    if has("z") && D == 2 {
        return wrong("there is no coordinate `z` in the plane".into());
    }
    let mixed = (has("distance") && names.len() > 1)
        || (geographic && ["x", "y", "z"].iter().any(|name| has(name)))
        || (geographic && !(has("longitude") && has("latitude")))
        || (!geographic && has("depth") && names.len() > 1);
    if mixed || (geographic && D == 2) {
        return wrong(format!("its coordinates {} are no position here", names.join(", ")));
    }
    Ok(())
}

/// Depth as a function of the position in the scene.
fn down<const D: usize>(scene: &Scene) -> Result<Axis<D>, Wrong> {
    let up = if D == 2 { Some([0.0, 1.0, 0.0]) } else { place::up(scene) };
    let up = up.ok_or_else(|| Wrong {
        message: "its column `depth` needs a direction down".into(),
        help: "add `[place]` with `up`, or give `y` or `z`".into(),
    })?;
    let length = up.iter().map(|c| c * c).sum::<f64>().sqrt();
    let from = scene.place.as_ref().and_then(|p| p.depth.as_ref()).map_or(0.0, |d| d.get_ref().0);
    Ok(Axis::Linear(std::array::from_fn(|c| -up[c] / length), from))
}

/// Geographic frame of the scene.
fn framed<const D: usize>(scene: &Scene) -> Result<Frame, Wrong> {
    let frame = place::frame(scene, D == 3).map_err(|e| unplaced(e.to_string()))?;
    frame.ok_or_else(|| unplaced("its longitudes need a `[place]`".into()))
}

fn unplaced(message: String) -> Wrong {
    Wrong { message, help: "`[place]` with the longitude and latitude of the origin".into() }
}

/// Directions of the plane that fits some positions best: the two along which they vary most.
fn plane(positions: impl Iterator<Item = Vec<f64>>) -> [Vector3<f64>; 2] {
    let all: Vec<Vector3<f64>> = positions.map(|x| Vector3::new(x[0], x[1], x[2])).collect();
    let middle = all.iter().sum::<Vector3<f64>>() / all.len().max(1) as f64;
    let spread: Matrix3<f64> = all.iter().map(|x| (x - middle) * (x - middle).transpose()).sum();
    let split = spread.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| split.eigenvalues[j].total_cmp(&split.eigenvalues[i]));
    [order[0], order[1]].map(|k| split.eigenvectors.column(k).into_owned())
}

fn projected(plane: &[Vector3<f64>; 2], x: &[f64]) -> Vec<f64> {
    let x = Vector3::new(x[0], x[1], x[2]);
    plane.iter().map(|way| way.dot(&x)).collect()
}

fn range(values: &[f64]) -> [f64; 2] {
    values
        .iter()
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &v| [low.min(v + 0.0), high.max(v + 0.0)])
}
