//! Slip of an event on a surface, with lines of equal rupture time.

use super::arrivals::{arrivals, fronts, last, mark};
use super::{AT, BELOW, ROOM, RupturedFault, Shape, Surface, room};
use crate::figures::colour::INK;
use crate::figures::field::Bar;
use crate::figures::figure::{Anchor, Figure, Point};
use crate::figures::paper::Paper;
use crate::figures::title::title;
use crate::units::LENGTH;

/// A fault in an event.
#[derive(Clone, Debug)]
pub(in crate::figures) struct EventOnFault {
    /// Stem of the file names.
    pub stem: String,
    /// Title: the scene and the event.
    pub title: String,
    /// The fault with its rupture times since the onset.
    pub fault: RupturedFault,
    /// Slip of its points, or of the faces of its surface \[m\].
    pub slip: Vec<f64>,
    /// Hypocentre on the surface, if it is on this fault.
    pub hypocentre: Option<Point>,
}

impl EventOnFault {
    /// Rupture times, and on a surface the slip, with their file names; without those of which there is nothing to draw.
    pub(in crate::figures) fn figures(&self, paper: Paper) -> Vec<(String, Figure)> {
        let times = arrivals(&self.title, &self.fault, self.hypocentre, paper);
        let slip = match &self.fault.shape {
            Shape::Surface(surface) => self.slip_on(surface, paper),
            Shape::Line(_) => None,
        };
        let named = [("rupture_times", times), ("slip", slip)].into_iter();
        named.filter_map(|(kind, figure)| Some((format!("{}_{kind}", self.stem), figure?))).collect()
    }

    /// Map of the slip.
    fn slip_on(&self, surface: &Surface, paper: Paper) -> Option<Figure> {
        let sizes: Vec<f64> = self.slip.iter().map(|s| s.abs()).collect();
        let most = sizes.iter().copied().reduce(f64::max).filter(|most| *most > 0.0)?;
        let frame = surface.frame(AT, room(paper))?;
        let unit = LENGTH.choose(most);
        let mut figure =
            Figure::new(AT.0 + frame.size.0.max(200.0) + ROOM, AT.1 + frame.size.1.max(190.0) + BELOW[1]);
        title(&mut figure, &frame, &self.title, &format!("slip of {}", self.fault.name));
        figure.image(surface.image(&frame, &sizes, 0.0, most));
        let ruptured = &self.fault.arrivals;
        let apart = last(ruptured).and_then(|last| fronts(&mut figure, &frame, surface, ruptured, last));
        mark(&mut figure, &frame, surface, self.hypocentre);
        frame.draw(&mut figure);
        let range = (0.0, most / unit.factor);
        Bar { range, above: None, label: format!("Slip [{}]", unit.name) }.draw(&mut figure, &frame);
        if let Some(apart) = apart {
            let at = (AT.0, AT.1 + frame.size.1 + 62.0);
            figure.text(at, format!("rupture times every {apart}"), 12.5, Anchor::Start, INK);
        }
        Some(figure)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::line;
    use super::*;

    #[test]
    fn a_surface_has_a_map_of_slip_and_a_line_has_none() {
        let places = (0..41).map(|k| (f64::from(k) * 100.0, f64::from(k % 2) * 1e3)).collect();
        let faces = (0..38).map(|k| vec![k, k + 1, k + 2]).collect();
        let surface = Surface { places, faces, labels: ["x".into(), "z".into()], geographic: false };
        let slip = vec![-1.0; 41];
        let of = |fault| EventOnFault {
            stem: "s".into(),
            title: "t".into(),
            fault,
            slip: slip.clone(),
            hypocentre: None,
        };
        let names = |event: EventOnFault| -> Vec<String> {
            event.figures(Paper::default()).into_iter().map(|figure| figure.0).collect()
        };
        assert_eq!(names(of(line())), ["s_rupture_times"]);
        let fault = RupturedFault { shape: Shape::Surface(surface), ..line() };
        assert_eq!(names(of(fault.clone())), ["s_rupture_times", "s_slip"]);
        // Slow slip ruptures nothing.
        let slow = RupturedFault { arrivals: vec![f64::NAN; 41], ..fault };
        assert_eq!(names(of(slow)), ["s_slip"]);
    }
}
