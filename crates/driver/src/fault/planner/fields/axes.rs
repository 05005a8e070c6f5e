//! Coordinates of a file, and those of the points of a fault.
//!
//! Each coordinate is a linear function of the position in the scene, or the distance along a fault in the plane. Three coordinates are
//! projected to the plane that fits the points of the fault best.

use super::super::frame;
use crate::columns::{Columns, Wrong};
use crate::scene::model::Scene;
use crate::scene::units::Dimension;
use asperity_cycles::medium::Place;
use asperity_fem::mesh::sheet::ScatterError;
use nalgebra::{Matrix3, Vector3};

/// Names of coordinates, in the order in which they are taken.
const NAMES: [&str; 7] = ["distance", "longitude", "latitude", "x", "y", "z", "depth"];

/// Sets of coordinates that a file may have.
const SETS: &str = "`distance` on a fault in the plane; one, two or three of `x`, `y` and `z`; `depth`; or `longitude` and `latitude`, with or without `depth`";

/// Coordinate of a file.
#[derive(Clone, Debug)]
enum Axis<const D: usize> {
    /// Distance along a fault in the plane.
    Along,
    /// Sum of the products with the coordinates of the scene, and a constant \[m\].
    Linear([f64; D], f64),
}

/// Coordinates of a file.
pub(super) struct Axes<const D: usize> {
    names: Vec<&'static str>,
    axes: Vec<Axis<D>>,
    /// Directions of the plane of the fault in three coordinates.
    plane: Option<[Vector3<f64>; 2]>,
    /// Positions of the rows, in the plane if there are three coordinates.
    positions: Vec<Vec<f64>>,
    /// Least and largest coordinate of each axis.
    ranges: Vec<[f64; 2]>,
}

impl<const D: usize> Axes<D> {
    /// Coordinates that a file has, for a fault with points at these places.
    ///
    /// # Errors
    /// [`Wrong`] for a file without coordinates that fit the scene.
    pub fn of(scene: &Scene, columns: &Columns, places: &[Place<D>]) -> Result<Self, Wrong> {
        let names: Vec<&'static str> =
            NAMES.into_iter().filter(|name| columns.names().any(|column| column == *name)).collect();
        fit::<D>(&names)?;
        let on_map = names.contains(&"longitude");
        let (axes, rows) =
            if on_map { of_map(scene, &names, columns)? } else { of_scene(scene, &names, columns)? };
        let ranges = (0..names.len()).map(|c| range(rows.iter().map(|row| row[c]))).collect();
        let mut all = Self { names, axes, plane: None, positions: rows, ranges };
        if all.names.len() == 3 {
            let plane = plane(places.iter().map(|place| all.raw(place)));
            all.positions = all.positions.iter().map(|x| projected(&plane, x)).collect();
            all.plane = Some(plane);
        }
        Ok(all)
    }

    /// Positions of the rows.
    pub fn positions(&self) -> &[Vec<f64>] {
        &self.positions
    }

    /// Coordinates of a point, comparable with [`Self::positions`].
    pub fn coordinates(&self, place: &Place<D>) -> Vec<f64> {
        let raw = self.raw(place);
        self.plane.as_ref().map_or_else(|| raw.clone(), |plane| projected(plane, &raw))
    }

    fn raw(&self, place: &Place<D>) -> Vec<f64> {
        let of = |axis: &Axis<D>| match axis {
            Axis::Along => place.along,
            Axis::Linear(way, from) => from + way.iter().zip(&place.at).map(|(w, x)| w * x).sum::<f64>(),
        };
        self.axes.iter().map(of).collect()
    }

    /// Names of the coordinates.
    pub fn words(&self) -> String {
        self.names.join(", ")
    }

    /// Extent of the file in its coordinates.
    pub fn extent(&self) -> String {
        let on_map = self.names.contains(&"longitude");
        let name = |name: &&'static str| match *name {
            "longitude" => "east of the origin".to_string(),
            "latitude" => "north of the origin".to_string(),
            name if on_map => name.to_string(),
            name => format!("along {name}"),
        };
        let of = |(axis, [low, high]): (&&'static str, &[f64; 2])| {
            format!("from {low} to {high} m {}", name(axis))
        };
        self.names.iter().zip(&self.ranges).map(of).collect::<Vec<_>>().join(", ")
    }

    /// Reason why positions are no samples of this fault.
    pub fn explain(&self, error: &ScatterError) -> Wrong {
        let message = format!("by {}, {error}", self.words());
        let help = match error {
            ScatterError::Few { .. } if self.names.len() > 1 => {
                "give one coordinate alone where values vary along a line"
            }
            ScatterError::Few { .. } => "two positions or more",
            ScatterError::Twice { .. } => "one value at each position",
        };
        Wrong { message, help: help.into() }
    }
}

/// Refuses sets of coordinates that mean no positions of the scene.
fn fit<const D: usize>(names: &[&str]) -> Result<(), Wrong> {
    let wrong = |message: String| Err(Wrong { message, help: SETS.into() });
    let has = |name: &str| names.contains(&name);
    let geographic = has("longitude") || has("latitude");
    if names.is_empty() {
        return wrong("it has no column of coordinates".into());
    }
    if has("distance") && D == 3 {
        return wrong("there is no `distance` along a fault in three dimensions".into());
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

/// Axes of a file and the coordinates of its rows.
type Found<const D: usize> = (Vec<Axis<D>>, Vec<Vec<f64>>);

/// Coordinates in the axes of the scene.
fn of_scene<const D: usize>(scene: &Scene, names: &[&str], columns: &Columns) -> Result<Found<D>, Wrong> {
    let mut axes = Vec::new();
    let mut rows: Vec<Vec<f64>> = Vec::new();
    for &name in names {
        let values = columns.numbers(name, Some(Dimension::Length))?;
        rows.resize(values.len(), Vec::new());
        rows.iter_mut().zip(&values).for_each(|(row, v)| row.push(*v));
        axes.push(match name {
            "distance" => Axis::Along,
            "depth" => down(scene)?,
            _ => {
                let c = ["x", "y", "z"].iter().position(|axis| *axis == name).unwrap_or_default();
                Axis::Linear(std::array::from_fn(|k| if k == c { 1.0 } else { 0.0 }), 0.0)
            }
        });
    }
    Ok((axes, rows))
}

/// Depth as a function of the position in the scene.
fn down<const D: usize>(scene: &Scene) -> Result<Axis<D>, Wrong> {
    let up = if D == 2 { Some([0.0, 1.0, 0.0]) } else { frame::up(scene) };
    let up = up.ok_or_else(|| Wrong {
        message: "its column `depth` needs a direction down".into(),
        help: "add `[place]` with `up`, or give `y` or `z`".into(),
    })?;
    let length = up.iter().map(|c| c * c).sum::<f64>().sqrt();
    let from = scene.place.as_ref().and_then(|p| p.depth.as_ref()).map_or(0.0, |d| d.get_ref().0);
    Ok(Axis::Linear(std::array::from_fn(|c| -up[c] / length), from))
}

/// Longitude and latitude as distances east and north of the origin, and depth.
fn of_map<const D: usize>(scene: &Scene, names: &[&str], columns: &Columns) -> Result<Found<D>, Wrong> {
    let none = |why: String| Wrong {
        message: why,
        help: "`[place]` with the longitude and latitude of the origin".into(),
    };
    let frame = frame::of(scene, D == 3).map_err(|e| none(e.to_string()))?;
    let frame = frame.ok_or_else(|| none("its longitudes need a `[place]`".into()))?;
    let degrees = |name: &str| columns.numbers(name, Some(Dimension::Angle));
    let (longitudes, latitudes) = (degrees("longitude")?, degrees("latitude")?);
    let map = frame.map();
    let position = |(row, (x, y)): (usize, (&f64, &f64))| {
        let at = map.metres(x.to_degrees(), y.to_degrees());
        at.map(Vec::from).ok_or_else(|| none(format!("line {} is not near the origin", columns.line(row))))
    };
    let mut rows: Vec<Vec<f64>> =
        longitudes.iter().zip(&latitudes).enumerate().map(position).collect::<Result<_, _>>()?;
    let ways = frame.horizontal();
    let mut axes: Vec<Axis<D>> =
        ways.iter().map(|way| Axis::Linear(std::array::from_fn(|c| way[c]), 0.0)).collect();
    if names.contains(&"depth") {
        axes.push(down(scene)?);
        let depths = columns.numbers("depth", Some(Dimension::Length))?;
        rows.iter_mut().zip(&depths).for_each(|(row, depth)| row.push(*depth));
    }
    Ok((axes, rows))
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

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}
