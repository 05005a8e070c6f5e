//! Film strips: slip rate, or the velocity of bodies, at successive times.

use super::space_time::{AT_REST, covered};
use super::strip::{self, Content, Strip};
use super::{FigureResult, Line, RupturedFault, Ruptures, Shape, Surface};
use crate::figures::axes::Axis;
use crate::figures::field::{Bar, VisibleMesh};
use crate::figures::figure::{Figure, Point};
use crate::figures::paper::Paper;
use crate::units::{TIME, VELOCITY};

/// Number of panels.
const PANELS: usize = 8;
/// Size of a panel of a line.
const CURVE: Point = (560.0, 62.0);
/// Largest size of a panel of a surface.
const MAP: Point = (420.0, 120.0);
/// Largest size of a panel of a body that is higher than wide, and number of such panels.
const TALL: Point = (420.0, 230.0);
/// See [`TALL`].
const FEW: usize = 4;
/// Width of a time in characters, so that times stand below each other.
const DIGITS: usize = 2;

/// Profiles at successive times.
struct SuccessiveProfiles {
    rows: Vec<(f64, Vec<f64>)>,
    most: f64,
}

impl Ruptures<'_> {
    /// Slip rates at successive times; `None` where nothing slips.
    pub(super) fn successive(&self, fault: &RupturedFault) -> FigureResult {
        let Some((count, _, last)) = self.span()? else { return Ok(None) };
        let wanted = chosen(count, strip::most(self.paper, PANELS));
        let (mut row, mut rows, mut most) = (0, Vec::new(), 0.0_f64);
        self.rates.each(&mut |time, rates| {
            if wanted.contains(&row) {
                let own: Vec<f64> = rates[fault.points.clone()].iter().map(|r| r.abs()).collect();
                most = own.iter().copied().filter(|r| r.is_finite()).fold(most, f64::max);
                rows.push((time, own));
            }
            row += 1;
        })?;
        if most <= AT_REST {
            return Ok(None);
        }
        let (part, shown) = (format!("slip rate of {}", fault.name), SuccessiveProfiles { rows, most });
        Ok(match &fault.shape {
            Shape::Line(line) => curves((&self.title, &part), line, (shown, last), self.paper),
            Shape::Surface(surface) => maps((&self.title, &part), surface, (shown, last), self.paper),
        })
    }
}

/// Evenly chosen rows of `count`, without the first, which is the state at the start.
fn chosen(count: usize, panels: usize) -> Vec<usize> {
    let panels = panels.min(count - 1);
    (1..=panels).map(|k| k * (count - 1) / panels).collect()
}

/// A time as text, in the unit of the last one.
pub(in crate::figures) fn moment(time: f64, last: f64) -> String {
    let unit = TIME.choose(last);
    format!("{:.DIGITS$} {}", time / unit.factor, unit.name)
}

fn curves(
    title: (&str, &str),
    line: &Line,
    (shown, last): (SuccessiveProfiles, f64),
    paper: Paper,
) -> Option<Figure> {
    let (x, scale) = line.axis(false)?;
    let unit = VELOCITY.choose(shown.most);
    let y =
        Axis::linear([0.0, shown.most / unit.factor].into_iter(), 0.08, format!("Slip rate [{}]", unit.name));
    let order = line.order();
    let panel = |(time, rates): (f64, Vec<f64>)| {
        let points = order.iter().map(|&p| (line.along[p] / scale, rates[p] / unit.factor)).collect();
        (moment(time, last), Content::Curve(points))
    };
    let size = strip::panel(paper, shown.rows.len(), CURVE, false);
    let panels = shown.rows.into_iter().map(panel).collect();
    Some(Strip { title, axes: (x, y), size, panels, bar: None }.draw())
}

fn maps(
    title: (&str, &str),
    surface: &Surface,
    (shown, last): (SuccessiveProfiles, f64),
    paper: Paper,
) -> Option<Figure> {
    let frame = surface.frame((0.0, 0.0), strip::panel(paper, shown.rows.len(), MAP, true))?;
    let all: Vec<f64> = shown.rows.iter().flat_map(|row| row.1.iter().copied()).collect();
    let (hi, most) = covered(&all)?;
    let unit = VELOCITY.choose(most);
    let panel = |(time, rates): &(f64, Vec<f64>)| {
        (moment(*time, last), Content::Map(surface.image(&frame, rates, 0.0, hi)))
    };
    let panels = shown.rows.iter().map(panel).collect();
    let above = (most > hi).then(|| format!("max {:.1}", most / unit.factor));
    let bar =
        Some(Bar { range: (0.0, hi / unit.factor), above, label: format!("Slip rate [{}]", unit.name) });
    Some(Strip { title, axes: (frame.x, frame.y), size: frame.size, panels, bar }.draw())
}

/// Velocities at the nodes of a mesh at a time.
#[derive(Clone, Copy)]
pub(in crate::figures) struct VelocityFrame<'a> {
    pub time: f64,
    pub values: &'a [f64],
}

/// Velocities of bodies at successive times, in common colours; `None` where nothing moves or can be drawn.
pub(in crate::figures) fn velocities(
    scene: &str,
    shown: &VisibleMesh,
    frames: &[VelocityFrame<'_>],
    paper: Paper,
) -> Option<Figure> {
    let last = frames.last()?.time;
    let all: Vec<f64> = frames.iter().flat_map(|frame| frame.values.iter().copied()).collect();
    let (hi, most) = covered(&all)?;
    let upright = shown.frame(MAP).is_some_and(|frame| frame.size.0 < frame.size.1);
    let (room, panels) = if upright { (TALL, FEW) } else { (MAP, PANELS) };
    let panels = strip::most(paper, panels);
    let chosen: Vec<usize> = chosen(frames.len().max(2), panels);
    let frame = shown.frame(strip::panel(paper, chosen.len(), room, true))?;
    let unit = VELOCITY.choose(most);
    let panel = |k: usize| {
        let VelocityFrame { time, values } = frames[k];
        (moment(time, last), Content::Map(shown.image(&frame, values, hi)))
    };
    let panels = chosen.into_iter().map(|k| panel(k.min(frames.len() - 1))).collect();
    let above = (most > hi).then(|| format!("max {:.1}", most / unit.factor));
    let bar = Some(Bar { range: (0.0, hi / unit.factor), above, label: format!("Velocity [{}]", unit.name) });
    let title = (scene, &*format!("particle velocity{}", shown.side()));
    Some(Strip { title, axes: (frame.x, frame.y), size: frame.size, panels, bar }.draw())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{line, pulse};
    use super::*;

    #[test]
    fn panels_are_spread_over_the_run_and_end_with_it() {
        assert_eq!(chosen(21, 8), [2, 5, 7, 10, 12, 15, 17, 20]);
        assert_eq!(chosen(4, 8), [1, 2, 3]);
    }

    #[test]
    fn a_surface_has_a_strip_of_maps() {
        let kept = pulse();
        let mut fault = line();
        let places = (0..41).map(|k| (f64::from(k) * 100.0, f64::from(k % 2) * 1e3)).collect();
        let faces = (0..38).map(|k| vec![k, k + 1, k + 2]).collect();
        fault.shape =
            Shape::Surface(Surface { places, faces, labels: ["x".into(), "z".into()], geographic: false });
        let ruptures =
            Ruptures { title: "t".into(), faults: vec![fault], rates: &kept, paper: Paper::default() };
        let figure = ruptures.successive(&ruptures.faults[0]).unwrap().unwrap();
        let images = figure.shapes.iter().filter(|s| matches!(s, crate::figures::figure::Shape::Image(_)));
        // Eight panels and the colour bar.
        assert_eq!(images.count(), 9);
    }
}
