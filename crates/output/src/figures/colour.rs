//! Colours: a perceptually uniform map and the greys of frames.

use std::sync::OnceLock;

/// Red, green, blue.
pub(super) type Rgb = [u8; 3];

/// Colour of text and frames.
pub(super) const INK: Rgb = [34, 34, 34];
/// Colour of grid lines.
pub(super) const GRID: Rgb = [228, 228, 228];
/// Colour of stage marks.
pub(super) const MARK: Rgb = [130, 130, 130];
/// Background colour.
pub(super) const PAPER: Rgb = [255, 255, 255];

/// Viridis (Smith and van der Walt 2015, CC0) at 17 equidistant values.
const VIRIDIS: [Rgb; 17] = [
    [68, 1, 84],
    [72, 24, 106],
    [71, 45, 123],
    [66, 64, 134],
    [59, 82, 139],
    [51, 99, 141],
    [44, 114, 142],
    [38, 130, 142],
    [33, 145, 140],
    [31, 160, 136],
    [40, 174, 128],
    [63, 188, 115],
    [94, 201, 98],
    [132, 212, 75],
    [173, 220, 48],
    [216, 226, 25],
    [253, 231, 37],
];

/// One of 256 colours for `value` in 0..=1. Values outside take the colour of the nearer end; NaN is light grey.
pub(super) fn viridis(value: f64) -> Rgb {
    static COLOURS: OnceLock<[Rgb; 256]> = OnceLock::new();
    if value.is_nan() {
        return [200, 200, 200];
    }
    let colours = COLOURS.get_or_init(|| std::array::from_fn(|k| between(k as f64 / 255.0)));
    colours[(value.clamp(0.0, 1.0) * 255.0 + 0.5) as usize]
}

/// Colours of the ends and the middle of a map for values of either sign.
const DIVERGING: [Rgb; 3] = [[32, 84, 160], [247, 247, 247], [170, 36, 44]];

/// A colour for `value` in 0..=1 whose middle is nearly white, from blue to red. See [`viridis`].
pub(super) fn diverging(value: f64) -> Rgb {
    if value.is_nan() {
        return [200, 200, 200];
    }
    let place = 2.0 * value.clamp(0.0, 1.0);
    let below = usize::from(place >= 1.0);
    let part = place - below as f64;
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(DIVERGING[below][c]), f64::from(DIVERGING[below + 1][c]));
        (a + part * (b - a)).round() as u8
    })
}

/// Colour interpolated between the given ones.
fn between(value: f64) -> Rgb {
    let place = value * (VIRIDIS.len() - 1) as f64;
    let below = (place as usize).min(VIRIDIS.len() - 2);
    let part = place - below as f64;
    std::array::from_fn(|c| {
        let (a, b) = (f64::from(VIRIDIS[below][c]), f64::from(VIRIDIS[below + 1][c]));
        (a + part * (b - a)).round() as u8
    })
}

/// Colour of curve `i` of `n`. The palest end of the map is omitted because it is hard to see on white.
pub(super) fn curve_colour(i: usize, n: usize) -> Rgb {
    let last = n.saturating_sub(1).max(1) as f64;
    viridis(0.9 * i as f64 / last)
}
