//! Styles of curves: colours that readers with any sight tell apart, each with a dash and a marker of its own.

use super::colour::Rgb;
use super::figure::{Dash, Figure, Point};

/// Number of styles before colours come again.
pub const STYLES: usize = 10;

/// Colours: the seven of Okabe and Ito (2008) without yellow, and three that stay apart from them.
const COLOURS: [Rgb; STYLES] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [34, 34, 34],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [110, 60, 160],
    [140, 86, 75],
    [120, 130, 30],
];

/// Dashes: neighbours in the list of colours never share one.
const DASHES: [Dash; 5] =
    [&[], &[8.0, 4.0], &[2.0, 3.0], &[9.0, 3.0, 2.0, 3.0], &[14.0, 4.0, 2.0, 3.0, 2.0, 4.0]];

/// Markers around the origin, each of about the area of a circle of radius 1.
const MARKERS: [&[Point]; 5] = [
    &[
        (1.0, 0.0),
        (0.87, 0.5),
        (0.5, 0.87),
        (0.0, 1.0),
        (-0.5, 0.87),
        (-0.87, 0.5),
        (-1.0, 0.0),
        (-0.87, -0.5),
        (-0.5, -0.87),
        (0.0, -1.0),
        (0.5, -0.87),
        (0.87, -0.5),
    ],
    &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
    &[(0.0, -1.3), (1.15, 0.8), (-1.15, 0.8)],
    &[(0.0, -1.35), (1.1, 0.0), (0.0, 1.35), (-1.1, 0.0)],
    &[(0.0, 1.3), (1.15, -0.8), (-1.15, -0.8)],
];

/// Style of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Style {
    pub colour: Rgb,
    pub dash: Dash,
    marker: &'static [Point],
}

impl Style {
    /// The style of a curve. Beyond [`STYLES`] curves colours come again with other dashes and markers.
    pub(super) fn of(curve: usize) -> Self {
        let shape = curve + curve / STYLES;
        Self {
            colour: COLOURS[curve % STYLES],
            dash: DASHES[shape % DASHES.len()],
            marker: MARKERS[shape % MARKERS.len()],
        }
    }

    /// Draws its marker of a radius at a point.
    pub(super) fn mark(&self, figure: &mut Figure, at: Point, radius: f64) {
        self.marker_in(figure, at, radius, self.colour);
    }

    /// Draws its marker of a radius at a point in another colour.
    pub(super) fn marker_in(&self, figure: &mut Figure, at: Point, radius: f64, colour: Rgb) {
        let corners = self.marker.iter().map(|(x, y)| (at.0 + radius * x, at.1 + radius * y));
        figure.area(corners.collect(), colour);
    }
}

#[cfg(test)]
mod tests {
    use super::{STYLES, Style};

    #[test]
    fn the_first_fifty_curves_have_different_styles_and_neighbours_different_dashes() {
        let styles: Vec<Style> = (0..5 * STYLES).map(Style::of).collect();
        for (i, one) in styles.iter().enumerate() {
            assert!(styles[..i].iter().all(|other| other != one), "{i}");
        }
        assert!(styles.windows(2).all(|pair| pair[0].dash != pair[1].dash));
    }
}
