//! Axes: ranges, ticks, and their frame.

use super::colour::{GRID, INK};
use super::figure::{Anchor, Figure, Point};
use super::width::within;

/// Em size of tick labels.
const TICK_TEXT: f64 = 13.0;
/// Em size of axis labels.
pub(super) const LABEL_TEXT: f64 = 14.5;

/// An axis in its own unit.
#[derive(Clone, Debug)]
pub(super) struct Axis {
    /// Values at the ends, or their decadic logarithms.
    pub range: (f64, f64),
    /// True if the axis is logarithmic.
    pub log: bool,
    /// Label with unit.
    pub label: String,
    /// Ticks of an axis along which the labelled values are not spread evenly: relative positions and texts. Empty for usual ticks.
    pub own: Vec<(f64, String)>,
}

impl Axis {
    /// Linear axis around `values`, which may be non-finite or all equal. It starts at zero if positive values come near zero.
    /// `margin` is the relative room left at the ends.
    pub(super) fn linear(values: impl Iterator<Item = f64>, margin: f64, label: String) -> Self {
        let (lo, hi) = bounds(values).unwrap_or((0.0, 1.0));
        let range = if hi - lo <= FLAT * lo.abs().max(hi.abs()) {
            let room = if lo == 0.0 { 1.0 } else { 0.1 * lo.abs() };
            (lo - room, hi + room)
        } else {
            let room = margin * (hi - lo);
            // Below a ratio of 0.3 the empty part of the axis is a smaller cost than a missing zero, which misleads.
            (if lo >= 0.0 && lo < 0.3 * hi { 0.0 } else { lo - room }, hi + room)
        };
        Self { range, log: false, label, own: Vec::new() }
    }

    /// Linear axis with exactly this range.
    pub(super) fn exact(range: [f64; 2], label: String) -> Self {
        Self { range: range.into(), log: false, label, own: Vec::new() }
    }

    /// Logarithmic axis over whole decades around the positive values, at most `decades` below the top.
    pub(super) fn logarithmic(values: impl Iterator<Item = f64>, decades: f64, label: String) -> Self {
        let (lo, hi) = bounds(values.filter(|v| *v > 0.0)).unwrap_or((1.0, 10.0));
        let hi = hi.log10().ceil();
        let lo = lo.log10().floor().max(hi - decades).min(hi - 1.0);
        Self { range: (lo, hi), log: true, label, own: Vec::new() }
    }

    /// An axis of a quantity over time: logarithmic over at most `decades`, if they are given, otherwise linear.
    pub(super) fn over_time(values: impl Iterator<Item = f64>, decades: Option<f64>, label: String) -> Self {
        match decades {
            Some(decades) => Self::logarithmic(values, decades, label),
            None => Self::linear(values, 0.08, label),
        }
    }

    /// A logarithmic axis around the positive values, with a margin that is a fraction of their range.
    pub(super) fn around(values: impl Iterator<Item = f64>, margin: f64, label: String) -> Self {
        let (lo, hi) = bounds(values.filter(|v| *v > 0.0)).unwrap_or((1.0, 10.0));
        let (lo, hi) = (lo.log10(), hi.log10());
        // A single value still needs a range: a factor of two to either side.
        let room = if hi - lo > FLAT { margin * (hi - lo) } else { 2.0_f64.log10() };
        Self { range: (lo - room, hi + room), log: true, label, own: Vec::new() }
    }

    /// Relative position of a value along the axis, 0..=1 inside. On a logarithmic axis smaller values are placed at its start.
    pub(super) fn place(&self, value: f64) -> f64 {
        let (lo, hi) = self.range;
        let value = if self.log { if value > 0.0 { value.log10().max(lo) } else { lo } } else { value };
        (value - lo) / (hi - lo)
    }

    /// Ticks: relative position along the axis, and text.
    pub(super) fn ticks(&self, about: usize) -> Vec<(f64, String)> {
        if !self.own.is_empty() {
            return self.own.clone();
        }
        let (lo, hi) = self.range;
        if hi < lo {
            // A falling axis, for example of depth.
            let back = Self { range: (hi, lo), ..self.clone() };
            return back.ticks(about).into_iter().map(|(place, text)| (1.0 - place, text)).collect();
        }
        let span = hi - lo;
        if self.log {
            return logarithmic_ticks((lo, hi), about);
        }
        let step = nice_step(span / about as f64);
        let decimals = (-step.log10().floor()).max(0.0) as usize + usize::from(is_quarter(step));
        let first = (lo / step - FLAT).ceil() as i64;
        let last = (hi / step + FLAT).floor() as i64;
        if last <= first && about < MOST_ASKED {
            // One number alone says nothing about the scale.
            return self.ticks(about + 1);
        }
        (first..=last)
            .map(|k| {
                // Adding zero turns -0 into 0.
                let value = k as f64 * step + 0.0;
                ((value - lo) / span, format!("{value:.decimals$}").replace('-', "−"))
            })
            .collect()
    }
}

/// Number of ticks beyond which no axis is asked for more.
const MOST_ASKED: usize = 6;

/// Whole powers of ten, at most about this many; on an axis with less than two decades multiples of them, too.
fn logarithmic_ticks((lo, hi): (f64, f64), about: usize) -> Vec<(f64, String)> {
    let place = |exponent: f64| (exponent - lo) / (hi - lo);
    let (first, last) = ((lo - FLAT).ceil() as i32, (hi + FLAT).floor() as i32);
    if last - first >= 2 {
        let stride = ((f64::from(last - first) / about as f64).ceil() as usize).max(1);
        return (first..=last).step_by(stride).map(|k| (place(f64::from(k)), power_of_ten(k))).collect();
    }
    let sets: [&[u8]; 4] = [&[1, 3], &[1, 2, 5], &[1, 2, 3, 4, 6, 8], &[1, 2, 3, 4, 5, 6, 7, 8, 9]];
    let of = |set: &[u8]| -> Vec<(f64, String)> {
        let all = (first - 1..=last).flat_map(|k| set.iter().map(move |&m| (f64::from(m), k)));
        let ticks = all.map(|(m, k)| (m.log10() + f64::from(k), multiple_of_power(m, k)));
        ticks.filter(|(at, _)| (lo - FLAT..=hi + FLAT).contains(at)).map(|(at, t)| (place(at), t)).collect()
    };
    // Three ticks let a reader see that the axis is logarithmic.
    if let Some(ticks) = sets.into_iter().map(of).find(|ticks| ticks.len() >= 3) {
        return ticks;
    }
    let linear = Axis::exact([10.0_f64.powf(lo), 10.0_f64.powf(hi)], String::new());
    let (start, end) = linear.range;
    let ticks = linear.ticks(about.min(4)).into_iter();
    ticks.map(|(part, text)| (place((start + part * (end - start)).log10()), text)).collect()
}

/// A digit times a power of ten: a plain number where that is short.
fn multiple_of_power(digit: f64, exponent: i32) -> String {
    match exponent {
        -3..=3 => {
            let decimals = (-exponent).max(0) as usize;
            format!("{:.decimals$}", digit * 10.0_f64.powi(exponent))
        }
        _ if digit == 1.0 => power_of_ten(exponent),
        _ => format!("{digit:.0}·{}", power_of_ten(exponent)),
    }
}

/// Values closer than this relative difference are the same on a plot.
const FLAT: f64 = 1e-9;

/// Smallest and largest finite value.
fn bounds(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|v| v.is_finite()).fold(None, |found, v| match found {
        None => Some((v, v)),
        Some((lo, hi)) => Some((lo.min(v), hi.max(v))),
    })
}

/// Smallest step of 1, 2, 2.5 or 5 times a power of ten that is not below `rough`.
fn nice_step(rough: f64) -> f64 {
    let power = 10.0_f64.powf(rough.log10().floor());
    let steps = [1.0, 2.0, 2.5, 5.0, 10.0];
    steps.iter().map(|s| s * power).find(|step| *step >= rough * (1.0 - FLAT)).unwrap_or(10.0 * power)
}

/// True if a step is 2.5 times a power of ten, which needs one more decimal.
fn is_quarter(step: f64) -> bool {
    let mantissa = step / 10.0_f64.powf(step.log10().floor());
    (mantissa - 2.5).abs() < 0.1 && step < 10.0
}

pub(super) fn power_of_ten(exponent: i32) -> String {
    let digits = exponent.unsigned_abs().to_string();
    let raised =
        digits.bytes().map(|d| ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][usize::from(d - b'0')]);
    format!("10{}{}", if exponent < 0 { "⁻" } else { "" }, raised.collect::<String>())
}

/// A framed plot area.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Upper left corner.
    pub at: Point,
    /// Width and height.
    pub size: Point,
    pub x: Axis,
    pub y: Axis,
}

impl Frame {
    /// Position of a pair of values in the figure.
    pub(super) fn point(&self, x: f64, y: f64) -> Point {
        (self.at.0 + self.x.place(x) * self.size.0, self.at.1 + (1.0 - self.y.place(y)) * self.size.1)
    }

    /// Draws light lines at the ticks. Called before the data are drawn.
    pub(super) fn grid(&self, figure: &mut Figure) {
        let ((left, top), (width, height)) = (self.at, self.size);
        for (place, _) in self.x.ticks(fitting(width, X_ROOM, X_TICKS)) {
            let x = left + place * width;
            figure.line(vec![(x, top), (x, top + height)], 0.8, GRID);
        }
        for (place, _) in self.y.ticks(fitting(height, Y_ROOM, Y_TICKS)) {
            let y = top + (1.0 - place) * height;
            figure.line(vec![(left, y), (left + width, y)], 0.8, GRID);
        }
    }

    /// Draws frame, ticks and labels. Called after the data are drawn.
    pub(super) fn draw(&self, figure: &mut Figure) {
        self.draw_part(figure, true);
        self.draw_label(figure);
    }

    /// Draws frame and ticks of one of several frames above each other, of which only the last has numbers along x.
    pub(super) fn draw_part(&self, figure: &mut Figure, last: bool) {
        let ((left, top), (width, height)) = (self.at, self.size);
        let (right, bottom) = (left + width, top + height);
        figure.line(vec![(left, top), (right, top), (right, bottom), (left, bottom), (left, top)], 1.0, INK);
        for (place, text) in self.x.ticks(fitting(width, X_ROOM, X_TICKS)).into_iter().filter(|_| last) {
            let x = left + place * width;
            figure.line(vec![(x, bottom), (x, bottom + 5.0)], 1.0, INK);
            figure.text((x, bottom + 16.0), text, TICK_TEXT, Anchor::Middle, INK);
        }
        for (place, text) in self.y.ticks(fitting(height, Y_ROOM, Y_TICKS)) {
            let y = top + (1.0 - place) * height;
            figure.line(vec![(left - 5.0, y), (left, y)], 1.0, INK);
            figure.text((left - 9.0, y), text, TICK_TEXT, Anchor::End, INK);
        }
    }

    /// Draws the labels of the axes.
    pub(super) fn draw_label(&self, figure: &mut Figure) {
        let ((left, top), (width, height)) = (self.at, self.size);
        let size = within(&self.x.label, width + 80.0, LABEL_TEXT);
        figure.text((left + width / 2.0, top + height + 40.0), &self.x.label, size, Anchor::Middle, INK);
        let room = self.y.widest_tick(height);
        let size = within(&self.y.label, height + 80.0, LABEL_TEXT);
        figure.vertical_text((left - room - 16.0, top + height / 2.0), &self.y.label, size, INK);
    }
}

impl Axis {
    /// Room that the tick labels of an upright axis of this length take beside it.
    pub(super) fn widest_tick(&self, length: f64) -> f64 {
        let ticks = self.ticks(fitting(length, Y_ROOM, Y_TICKS));
        let widest = ticks.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
        // Digits are .64 em wide.
        9.0 + 0.64 * TICK_TEXT * widest as f64
    }
}

/// Room per tick label along x.
const X_ROOM: f64 = 60.0;
/// Room per tick label along y.
const Y_ROOM: f64 = 26.0;

/// Approximate number of intervals along an axis of this length: `most`, or fewer if their labels would overlap.
fn fitting(length: f64, room: f64, most: usize) -> usize {
    ((length / room) as usize).clamp(1, most)
}

/// Approximate number of intervals along x.
const X_TICKS: usize = 7;
/// Approximate number of intervals along y.
pub(super) const Y_TICKS: usize = 7;

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis) -> Vec<String> {
        axis.ticks(6).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn ticks_are_round_numbers_inside_the_range() {
        assert_eq!(texts(&Axis::exact([0.0, 59.66], String::new())), ["0", "10", "20", "30", "40", "50"]);
        assert_eq!(
            texts(&Axis::exact([-0.25, 1.0], String::new())),
            ["−0.25", "0.00", "0.25", "0.50", "0.75", "1.00"]
        );
        let axis = Axis::logarithmic([1e-3, 2.0, 0.0].into_iter(), 14.0, String::new());
        assert_eq!(texts(&axis), ["10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹"]);
    }

    #[test]
    fn an_axis_with_room_for_few_ticks_has_two() {
        let texts: Vec<String> =
            Axis::exact([-9.0, 9.0], String::new()).ticks(1).into_iter().map(|tick| tick.1).collect();
        assert_eq!(texts, ["−5", "0", "5"]);
    }

    #[test]
    fn a_short_logarithmic_axis_has_ticks_between_the_powers_of_ten() {
        let around = |lo: f64, hi: f64| texts(&Axis::around([lo, hi].into_iter(), 0.0, String::new()));
        assert_eq!(around(0.02, 0.3), ["0.03", "0.1", "0.3"]);
        assert_eq!(around(0.11, 0.6), ["0.2", "0.3", "0.4", "0.6"]);
        assert_eq!(around(2.0e-6, 3.1e-5), ["3·10⁻⁶", "10⁻⁵", "3·10⁻⁵"]);
        assert_eq!(around(1.0, 1e4), ["10⁰", "10¹", "10²", "10³", "10⁴"]);
        assert!(around(1.01, 1.04).len() >= 3);
    }

    #[test]
    fn ranges_survive_constant_empty_and_non_finite_values() {
        let cases: [&[f64]; 6] =
            [&[], &[0.0], &[0.6, 0.6], &[f64::NAN], &[f64::INFINITY, -3.0], &[-1e-300, 1e-300]];
        for values in cases {
            for axis in [
                Axis::linear(values.iter().copied(), 0.05, String::new()),
                Axis::logarithmic(values.iter().copied(), 14.0, String::new()),
                Axis::around(values.iter().copied(), 0.05, String::new()),
            ] {
                assert!(axis.range.0 < axis.range.1, "{values:?}");
                assert!(!axis.ticks(6).is_empty(), "{values:?}");
                assert!(axis.ticks(6).iter().all(|(place, _)| place.is_finite()), "{values:?}");
            }
        }
    }

    #[test]
    fn an_axis_that_falls_has_the_ticks_of_one_that_rises_at_the_other_end() {
        let falling = Axis::exact([40.0, 0.0], String::new());
        let ticks = falling.ticks(4);
        assert_eq!(ticks.iter().map(|t| t.1.as_str()).collect::<Vec<_>>(), ["0", "10", "20", "30", "40"]);
        assert_eq!((ticks[0].0, ticks[4].0), (1.0, 0.0));
        assert_eq!((falling.place(0.0), falling.place(30.0)), (1.0, 0.25));
    }

    #[test]
    fn a_short_axis_has_fewer_ticks() {
        assert_eq!(fitting(560.0, X_ROOM, X_TICKS), X_TICKS);
        assert_eq!(fitting(56.0, Y_ROOM, Y_TICKS), 2);
        assert_eq!(fitting(5.0, Y_ROOM, Y_TICKS), 1);
    }

    #[test]
    fn values_stand_in_proportion_to_the_range() {
        let axis = Axis::exact([-10.0, 60.0], String::new());
        assert_eq!((axis.place(-10.0), axis.place(25.0), axis.place(60.0)), (0.0, 0.5, 1.0));
        let axis = Axis::logarithmic([1.0, 100.0].into_iter(), 14.0, String::new());
        assert_eq!((axis.place(0.0), axis.place(10.0)), (0.0, 0.5));
    }
}
