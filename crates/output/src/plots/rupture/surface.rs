//! Points on a surface, seen along its normal.

use crate::plots::axes::{Axis, Frame};
use crate::plots::colour::PAPER;
use crate::plots::field::{Colours, FINE, fill};
use crate::plots::figure::{Image, Point};
use crate::plots::units::{LENGTH, NUMBER};
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
        let scale = (room.0 / (hi.0 - lo.0)).min(room.1 / (hi.1 - lo.1));
        let unit = LENGTH.of([lo.0, lo.1, hi.0, hi.1].iter().fold(0.0, |most, v| most.max(v.abs())));
        let axis = |from: f64, to: f64, name: &str| {
            Axis::exact((from / unit.factor, to / unit.factor), format!("{name} [{}]", unit.name))
        };
        let (x, y) = (axis(lo.0, hi.0, &self.labels[0]), axis(lo.1, hi.1, &self.labels[1]));
        Some(Frame { at, size: ((hi.0 - lo.0) * scale, (hi.1 - lo.1) * scale), x, y })
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
        let of = |face: &Vec<usize>| -> Vec<[Vec<usize>; 3]> {
            let corners = if [3, 6].contains(&face.len()) { 3 } else { face.len().min(4) };
            let ring = &face[..corners];
            if corners == 3 {
                return vec![[vec![ring[0]], vec![ring[1]], vec![ring[2]]]];
            }
            let side = |k: usize| [vec![ring[k]], vec![ring[(k + 1) % corners]], ring.to_vec()];
            (0..corners).map(side).collect()
        };
        self.faces.iter().flat_map(of).collect()
    }

    /// Position and value of a corner.
    pub(super) fn corner(&self, points: &[usize], values: &[f64]) -> (Point, f64) {
        let mean =
            |read: &dyn Fn(usize) -> f64| points.iter().map(|&p| read(p)).sum::<f64>() / points.len() as f64;
        ((mean(&|p| self.places[p].0), mean(&|p| self.places[p].1)), mean(&|p| values[p]))
    }

    /// Image of values over the frame, in the colours of a range.
    pub(super) fn image(&self, frame: &Frame, values: &[f64], (lo, hi): (f64, f64)) -> Image {
        let columns = (frame.size.0 * FINE).round().max(1.0) as usize;
        let rows = (frame.size.1 * FINE).round().max(1.0) as usize;
        let mut rgb = vec![PAPER; columns * rows];
        let colours = Colours { unit: NUMBER.of(1.0), lo, hi, above: None };
        let (left, top) = frame.at;
        let onto = self.onto(frame);
        let at = |nodes: &Vec<usize>| {
            let (place, value) = self.corner(nodes, values);
            let (x, y) = onto(place);
            ((x - left) / frame.size.0 * columns as f64, (y - top) / frame.size.1 * rows as f64, value)
        };
        for triangle in self.triangles() {
            fill(&mut rgb, columns, triangle.each_ref().map(at), &colours);
        }
        Image { at: frame.at, size: frame.size, columns, rgb }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_have_one_scale_and_up_is_up() {
        let places = vec![(0.0, 0.0), (4e3, 0.0), (4e3, 1e3), (0.0, 1e3)];
        let surface = Surface { places, faces: vec![vec![0, 1, 2, 3]], labels: ["x".into(), "y".into()] };
        let frame = surface.frame((10.0, 20.0), (400.0, 400.0)).unwrap();
        assert_eq!(frame.size, (400.0, 100.0));
        assert_eq!(surface.onto(&frame)((0.0, 1e3)), (10.0, 20.0));
        // The upper side has the largest value, and the first row of the image is on top.
        let image = surface.image(&frame, &[0.0, 0.0, 1.0, 1.0], (0.0, 1.0));
        let (first, last) = (image.rgb[image.columns / 2], image.rgb[image.rgb.len() - image.columns / 2]);
        assert!(first[0] > last[0] && last[2] > first[2], "{first:?} {last:?}");
    }
}
