//! Tractions along an interface in the plane at the ends of stages.

use super::axes::Axis;
use super::colour::viridis;
use super::figure::{Dash, Figure, Point};
use super::framed_figure::FramedFigure;
use super::legend::Entry;
use super::paper::Paper;
use super::title::title;
use crate::bodies::StageEnd;
use crate::bodies::view::InterfaceMesh;
use crate::numbers;
use crate::units::{LENGTH, STRESS};
use serde::{Deserialize, Serialize};

/// Tractions along an interface.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tractions {
    /// Stem of the file names.
    pub(super) file: String,
    /// Title of the scene.
    title: String,
    /// Name of the interface.
    name: String,
    /// Name of the coordinate along it.
    axis: String,
    /// First and last coordinate \[m\].
    ends: (f64, f64),
    stages: Vec<EndProfile>,
}

/// Tractions at the end of a stage.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct EndProfile {
    /// Name of the stage.
    name: String,
    /// Its end \[s\].
    time: f64,
    /// Coordinates \[m\].
    #[serde(deserialize_with = "numbers::or_nan")]
    along: Vec<f64>,
    /// Normal traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    normal: Vec<f64>,
    /// Shear traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    shear: Vec<f64>,
}

impl Tractions {
    /// Tractions along the longest extent of an interface of this number. `None` if it is a point or no stage has ended.
    pub(super) fn from_ends(
        scene: &str,
        stem: &str,
        mesh: &InterfaceMesh,
        interface: usize,
        ends: &[StageEnd],
    ) -> Option<Self> {
        let axis = longest(mesh)?;
        let places: Vec<f64> = mesh.positions.iter().map(|p| p[axis]).collect();
        let one = |end: &StageEnd| {
            let fields = end.interfaces.get(interface)?;
            let along = sorted(&places, &places);
            let normal = sorted(&places, &fields.mean_normal_traction);
            let shear = sorted(&places, &fields.mean_shear_traction);
            Some(EndProfile { name: end.name.clone(), time: end.time, along, normal, shear })
        };
        let stages: Vec<EndProfile> = ends.iter().filter_map(one).collect();
        (!stages.is_empty()).then(|| Self {
            file: format!("{stem}_tractions"),
            title: scene.into(),
            name: mesh.name.clone(),
            axis: ["x", "y", "z"][axis].into(),
            ends: bounds(&places),
            stages,
        })
    }

    /// Normal (solid) and shear traction (dashed) at the ends of stages within a window of time; `None` if there are none.
    pub(super) fn figure(&self, paper: Paper, window: Option<[f64; 2]>) -> Option<Figure> {
        let curves: Vec<Curve> = self
            .curves()
            .into_iter()
            .filter(|(time, _)| window.is_none_or(|[a, b]| a <= *time && *time <= b))
            .map(|c| c.1)
            .collect();
        if curves.is_empty() {
            return None;
        }
        let values = || curves.iter().flat_map(|curve| curve.points.iter()).map(|p| p.1);
        let largest = values().map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
        let (lo, hi) = self.ends;
        let (stress, length) = (STRESS.choose(largest), LENGTH.choose(lo.abs().max(hi.abs())));
        let label = format!("{} [{}]", self.axis, length.name);
        let x = Axis::exact([lo / length.factor, hi / length.factor], label);
        let y =
            Axis::linear(values().map(|v| v / stress.factor), 0.05, format!("Traction [{}]", stress.name));
        let entries: Vec<Entry> = curves.iter().map(|curve| curve.entry.clone()).collect();
        let mut page = FramedFigure::new(paper, x, y, &entries);
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, &self.name);
        frame.grid(figure);
        for Curve { entry, points } in &curves {
            let finite = points.iter().filter(|(_, v)| v.is_finite());
            let line: Vec<Point> =
                finite.map(|(x, v)| frame.point(x / length.factor, v / stress.factor)).collect();
            figure.dashed(line, entry.dash, 1.8, entry.colour);
        }
        Some(page.finish())
    }

    /// Two curves for the end of each stage, with its time.
    fn curves(&self) -> Vec<(f64, Curve)> {
        let mut curves = Vec::with_capacity(2 * self.stages.len());
        for (i, end) in self.stages.iter().enumerate() {
            let colour = viridis(0.25 + 0.5 * i as f64 / (self.stages.len().max(2) - 1) as f64);
            for (name, values, dashed) in [("normal", &end.normal, false), ("shear", &end.shear, true)] {
                let dash: Dash = if dashed { &[6.0, 4.0] } else { &[] };
                let entry = Entry { name: format!("{name}, end of “{}”", end.name), colour, dash };
                let points = end.along.iter().copied().zip(values.iter().copied()).collect();
                curves.push((end.time, Curve { entry, points }));
            }
        }
        curves
    }
}

/// Curve of a traction along the interface.
struct Curve {
    entry: Entry,
    /// Position \[m\] and traction \[Pa\].
    points: Vec<Point>,
}

/// Axis along which the interface is longest; `None` if it is a point.
fn longest(mesh: &InterfaceMesh) -> Option<usize> {
    let extent = |axis: usize| {
        let (lo, hi) = bounds(&mesh.positions.iter().map(|p| p[axis]).collect::<Vec<_>>());
        hi - lo
    };
    let axis = (0..3).max_by(|&a, &b| extent(a).total_cmp(&extent(b)))?;
    (extent(axis) > 0.0 && extent(axis).is_finite()).then_some(axis)
}

fn bounds(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), &x| (lo.min(x), hi.max(x)))
}

/// Values sorted by position.
fn sorted(places: &[f64], values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| places[a].total_cmp(&places[b]));
    order.into_iter().map(|k| values[k]).collect()
}
