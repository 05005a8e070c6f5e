//! Map of a quantity over a surface at one time.

use super::{AT, BELOW, ROOM, Surface, room};
use crate::figures::field::Bar;
use crate::figures::figure::Figure;
use crate::figures::paper::Paper;
use crate::figures::title::title;

/// Titles and colours of a map.
#[derive(Clone, Debug)]
pub(in crate::figures) struct StillMap {
    /// Title of the scene.
    pub title: String,
    /// Quantity, surface and time.
    pub what: String,
    /// Label of the colours.
    pub label: String,
    /// Values at the ends of the colours; whole numbers around the values where there are none.
    pub range: Option<(f64, f64)>,
    /// Largest difference of these whole numbers.
    pub span: Option<f64>,
}

impl StillMap {
    /// The figure from values of the points or of the faces; `None` without values that fit the surface.
    pub(in crate::figures) fn figure(
        &self,
        surface: &Surface,
        values: &[f64],
        paper: Paper,
    ) -> Option<Figure> {
        if values.len() != surface.places.len() && !surface.by_face(values) {
            return None;
        }
        let finite = || values.iter().copied().filter(|v| v.is_finite());
        let (least, most) = (finite().reduce(f64::min)?, finite().reduce(f64::max)?);
        let (lo, hi) = self.range.unwrap_or_else(|| {
            let hi = most.ceil().max(least.floor() + 1.0);
            (self.span.map_or(least.floor(), |span| least.floor().max(hi - span)), hi)
        });
        let frame = surface.frame(AT, room(paper))?;
        let mut figure =
            Figure::new(AT.0 + frame.size.0.max(200.0) + ROOM, AT.1 + frame.size.1.max(190.0) + BELOW[0]);
        title(&mut figure, &frame, &self.title, &self.what);
        figure.image(surface.image(&frame, values, lo, hi));
        frame.draw(&mut figure);
        Bar { range: (lo, hi), above: None, label: self.label.clone() }.draw(&mut figure, &frame);
        Some(figure)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_of_points_and_of_faces_have_a_map_and_others_none() {
        let places = vec![(0.0, 0.0), (4e3, 0.0), (4e3, 1e3), (0.0, 1e3)];
        let faces = vec![vec![0, 1, 2], vec![0, 2, 3]];
        let surface = Surface { places, faces, labels: ["x".into(), "y".into()], geographic: false };
        let map = StillMap {
            title: "t".into(),
            what: "w".into(),
            label: "l".into(),
            range: Some((0.0, 1.0)),
            span: None,
        };
        for values in [&[0.0; 4][..], &[1.0, f64::NAN]] {
            assert!(map.figure(&surface, values, Paper::default()).is_some());
        }
        for values in [&[0.0; 3][..], &[f64::NAN; 4], &[]] {
            assert!(map.figure(&surface, values, Paper::default()).is_none());
        }
    }
}
