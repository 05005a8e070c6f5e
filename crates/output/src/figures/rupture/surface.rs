//! Points on a surface, seen along its normal.

use crate::figures::axes::{Axis, Frame};
use crate::figures::colour::PAPER;
use crate::figures::field::{Colours, FINE, Vertex, fill};
use crate::figures::figure::{Image, Point};
use crate::units::{LENGTH, NUMBER};
use serde::{Deserialize, Serialize};

/// Points on a surface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Surface {
    /// Coordinates of the points in the surface, to the right and up \[m\].
    pub places: Vec<(f64, f64)>,
    /// Faces by their points: corners first, then midside points.
    pub faces: Vec<Vec<usize>>,
    /// Names of the coordinates.
    pub labels: [String; 2],
    /// True if the coordinates are longitude and latitude \[degrees\].
    #[serde(default)]
    pub geographic: bool,
}

impl Surface {
    /// Lower left and upper right corner; `None` without an extent.
    fn extent(&self) -> Option<(Point, Point)> {
        let start = ((f64::INFINITY, f64::INFINITY), (f64::NEG_INFINITY, f64::NEG_INFINITY));
        let (lo, hi) = self
            .places
            .iter()
            .fold(start, |(lo, hi), &(x, y)| ((lo.0.min(x), lo.1.min(y)), (hi.0.max(x), hi.1.max(y))));
        (hi.0 > lo.0 && hi.1 > lo.1).then_some((lo, hi))
    }

    /// Frame around the surface at one scale in both directions, within `room`.
    pub(super) fn frame(&self, at: Point, room: Point) -> Option<Frame> {
        let (lo, hi) = self.extent()?;
        let (factor, unit) = if self.geographic {
            (1.0, "°")
        } else {
            let largest = [lo.0, lo.1, hi.0, hi.1].iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            let unit = LENGTH.choose(largest);
            (unit.factor, unit.name)
        };
        // A degree of longitude is shorter than one of latitude.
        let narrow = if self.geographic { (0.5 * (lo.1 + hi.1)).to_radians().cos() } else { 1.0 };
        let (width, height) = ((hi.0 - lo.0) * narrow, hi.1 - lo.1);
        let scale = (room.0 / width).min(room.1 / height);
        let axis = |from: f64, to: f64, name: &str| {
            Axis::exact([from / factor, to / factor], format!("{name} [{unit}]"))
        };
        let (x, y) = (axis(lo.0, hi.0, &self.labels[0]), axis(lo.1, hi.1, &self.labels[1]));
        Some(Frame { at, size: (width * scale, height * scale), x, y })
    }

    /// Map from points of the surface to positions in a figure. The extent is found once, for all points.
    pub(super) fn onto(&self, frame: &Frame) -> impl Fn(Point) -> Point {
        let ((left, below), (right, above)) = self.extent().unwrap_or(((0.0, 0.0), (1.0, 1.0)));
        let (at, size) = (frame.at, frame.size);
        move |(x, y)| {
            let (along, up) = ((x - left) / (right - left), (y - below) / (above - below));
            (at.0 + along * size.0, at.1 + (1.0 - up) * size.1)
        }
    }

    /// Triangles that cover the faces, about their centres, with corners as the mean of some points.
    pub(super) fn triangles(&self) -> Vec<[Vec<usize>; 3]> {
        self.faces.iter().flat_map(|face| parts(face)).collect()
    }

    /// Position and value of a corner.
    pub(super) fn corner(&self, points: &[usize], values: &[f64]) -> (Point, f64) {
        let mean = |read: &dyn Fn(usize) -> f64| mean(points, read);
        ((mean(&|p| self.places[p].0), mean(&|p| self.places[p].1)), mean(&|p| values[p]))
    }

    /// True if values are those of faces, each of which has one, and not of points.
    pub(super) fn by_face(&self, values: &[f64]) -> bool {
        values.len() == self.faces.len() && values.len() != self.places.len()
    }

    /// Image of values of the points over the frame, in the colours of a range, or of the faces, each in one colour: a mean over the
    /// faces around a point would hide their largest value.
    pub(super) fn image(&self, frame: &Frame, values: &[f64], lo: f64, hi: f64) -> Image {
        let by_face = self.by_face(values);
        let columns = (frame.size.0 * FINE).round().max(1.0) as usize;
        let rows = (frame.size.1 * FINE).round().max(1.0) as usize;
        let mut rgb = vec![PAPER; columns * rows];
        let colours = Colours { unit: NUMBER.choose(1.0), lo, hi, above: None };
        let (left, top) = frame.at;
        let onto = self.onto(frame);
        for (number, face) in self.faces.iter().enumerate() {
            let at = |nodes: &Vec<usize>| {
                let place = (mean(nodes, &|p| self.places[p].0), mean(nodes, &|p| self.places[p].1));
                let value = if by_face { values[number] } else { mean(nodes, &|p| values[p]) };
                let (x, y) = onto(place);
                let (x, y) =
                    ((x - left) / frame.size.0 * columns as f64, (y - top) / frame.size.1 * rows as f64);
                Vertex { x, y, value }
            };
            for triangle in parts(face) {
                fill(&mut rgb, columns, triangle.each_ref().map(at), &colours);
            }
        }
        Image { at: frame.at, size: frame.size, columns, rgb }
    }
}

/// Triangles that cover a face, about its centre, with corners as the mean of some points.
fn parts(face: &[usize]) -> Vec<[Vec<usize>; 3]> {
    let corners = if [3, 6].contains(&face.len()) { 3 } else { face.len().min(4) };
    let ring = &face[..corners];
    if corners == 3 {
        return vec![[vec![ring[0]], vec![ring[1]], vec![ring[2]]]];
    }
    let side = |k: usize| [vec![ring[k]], vec![ring[(k + 1) % corners]], ring.to_vec()];
    (0..corners).map(side).collect()
}

/// Mean over some points.
fn mean(points: &[usize], read: &dyn Fn(usize) -> f64) -> f64 {
    points.iter().map(|&p| read(p)).sum::<f64>() / points.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_have_one_scale_and_up_is_up() {
        let places = vec![(0.0, 0.0), (4e3, 0.0), (4e3, 1e3), (0.0, 1e3)];
        let surface = Surface {
            places,
            faces: vec![vec![0, 1, 2, 3]],
            labels: ["x".into(), "y".into()],
            geographic: false,
        };
        let frame = surface.frame((10.0, 20.0), (400.0, 400.0)).unwrap();
        assert_eq!(frame.size, (400.0, 100.0));
        assert_eq!(surface.onto(&frame)((0.0, 1e3)), (10.0, 20.0));
        // The upper side has the largest value, and the first row of the image is on top.
        let image = surface.image(&frame, &[0.0, 0.0, 1.0, 1.0], 0.0, 1.0);
        let (first, last) = (image.rgb[image.columns / 2], image.rgb[image.rgb.len() - image.columns / 2]);
        assert!(first[0] > last[0] && last[2] > first[2], "{first:?} {last:?}");
    }

    #[test]
    fn a_face_has_the_colour_of_its_value_and_not_of_a_mean() {
        let places = vec![(0.0, 0.0), (1e3, 0.0), (1e3, 1e3), (0.0, 1e3)];
        let faces = vec![vec![0, 1, 2], vec![0, 2, 3]];
        let surface = Surface { places, faces, labels: ["x".into(), "y".into()], geographic: false };
        let frame = surface.frame((0.0, 0.0), (100.0, 100.0)).unwrap();
        let image = surface.image(&frame, &[1.0, 0.0], 0.0, 1.0);
        let most = crate::figures::colour::viridis(1.0);
        // Half of the square lies below its diagonal.
        let share =
            image.rgb.iter().filter(|colour| **colour == most).count() as f64 / image.rgb.len() as f64;
        assert!((share - 0.5).abs() < 0.02, "{share}");
    }

    #[test]
    fn degrees_of_longitude_are_narrower_away_from_the_equator() {
        let places = vec![(10.0, 59.0), (12.0, 59.0), (12.0, 61.0), (10.0, 61.0)];
        let labels = ["Longitude".into(), "Latitude".into()];
        let surface = Surface { places, faces: vec![vec![0, 1, 2, 3]], labels, geographic: true };
        let frame = surface.frame((0.0, 0.0), (400.0, 400.0)).unwrap();
        assert!((frame.size.0 - 200.0).abs() < 1e-9 && frame.size.1 == 400.0, "{:?}", frame.size);
        assert_eq!(frame.x.label, "Longitude [°]");
    }
}
