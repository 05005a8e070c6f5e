//! Styles of curves: colours that readers with any sight tell apart, each with a dash and a marker of its own.

use super::colour::Rgb;
use super::figure::{Dash, Figure, Point};

/// Number of styles before colours come again.
pub const STYLES: usize = 10;

/// Colours: the seven of Okabe and Ito (2008) without yellow, and three chosen to stay apart from them for any sight.
const COLOURS: [Rgb; STYLES] = [
    [0, 114, 178],
    [213, 94, 0],
    [0, 158, 115],
    [34, 34, 34],
    [204, 121, 167],
    [230, 159, 0],
    [86, 180, 233],
    [136, 0, 238],
    [102, 68, 34],
    [153, 204, 119],
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
    pub(super) fn from_curve(curve: usize) -> Self {
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
    use super::{COLOURS, STYLES, Style};
    use crate::figures::colour::Rgb;

    /// Linear light as readers see it of whom no, the long, the middle or the short cones are missing (Machado, Oliveira and
    /// Fernandes 2009, severity 1).
    const SIGHTS: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
    ];

    /// Linear light of a value of sRGB.
    fn linear(value: u8) -> f64 {
        let share = f64::from(value) / 255.0;
        if share <= 0.04045 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
    }

    /// Coordinates in the space CIELAB, in which equal distances look alike.
    fn lab(colour: Rgb, sight: &[[f64; 3]; 3]) -> [f64; 3] {
        let light = colour.map(linear);
        let [r, g, b] =
            sight.map(|row| row.iter().zip(light).map(|(m, v)| m * v).sum::<f64>().clamp(0.0, 1.0));
        let over = [
            (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047,
            0.2126 * r + 0.7152 * g + 0.0722 * b,
            (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883,
        ];
        let [x, y, z] = over.map(|t| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// Least distance in CIELAB at which colours of lines are distinguished without holding them side by side: several just
    /// noticeable differences, each of about 2.3.
    const APART: f64 = 15.0;

    #[test]
    fn readers_with_any_sight_tell_all_colours_apart() {
        for sight in &SIGHTS {
            for (i, one) in COLOURS.iter().enumerate() {
                for other in &COLOURS[..i] {
                    let (a, b) = (lab(*one, sight), lab(*other, sight));
                    let apart = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
                    assert!(apart >= APART, "{one:?} and {other:?}: {apart}");
                }
            }
        }
    }

    #[test]
    fn the_first_fifty_curves_have_different_styles_and_neighbours_different_dashes() {
        let styles: Vec<Style> = (0..5 * STYLES).map(Style::from_curve).collect();
        for (i, one) in styles.iter().enumerate() {
            assert!(styles[..i].iter().all(|other| other != one), "{i}");
        }
        assert!(styles.windows(2).all(|pair| pair[0].dash != pair[1].dash));
    }
}
