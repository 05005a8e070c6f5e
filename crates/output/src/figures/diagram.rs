//! Diagrams of curves, points and slopes: for convergence, work against precision, and overlays on references.

use schemars::JsonSchema;
use serde::Serialize;

/// Division of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic; points that are not positive are left out.
    Log,
}

/// A setting that failed: drawn as a cross at the top of its diagram.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Failed")]
pub struct FailedSetting {
    /// Position on the horizontal axis.
    pub x: f64,
    /// Reason why it failed.
    pub reason: String,
}

/// A curve.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Series {
    /// Name in the legend.
    pub name: String,
    /// Points.
    pub points: Vec<(f64, f64)>,
    /// True if points are joined.
    pub line: bool,
    /// True if points are marked.
    pub markers: bool,
    /// Settings that failed.
    pub failed: Vec<FailedSetting>,
}

impl Series {
    /// A line through points.
    pub fn line(name: impl Into<String>, points: &[(f64, f64)]) -> Series {
        Series { name: name.into(), points: points.to_vec(), line: true, markers: false, failed: Vec::new() }
    }

    /// Marked points, not joined.
    pub fn points(name: impl Into<String>, points: &[(f64, f64)]) -> Series {
        Series { line: false, markers: true, ..Series::line(name, points) }
    }

    /// Marked points joined by a line.
    pub fn marked(name: impl Into<String>, points: &[(f64, f64)]) -> Series {
        Series { markers: true, ..Series::line(name, points) }
    }

    /// Adds a setting that failed.
    #[must_use]
    pub fn failed(mut self, x: f64, reason: impl Into<String>) -> Series {
        self.failed.push(FailedSetting { x, reason: reason.into() });
        self
    }
}

/// Slope of a power law, drawn as a triangle on two logarithmic axes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Slope {
    /// Power.
    pub order: f64,
    /// Horizontal extent of the triangle.
    pub x: (f64, f64),
    /// Height of its horizontal side.
    pub y: f64,
}

impl Slope {
    /// Its corners: both ends of the horizontal side, and the end of the vertical one.
    #[must_use]
    pub fn corners(&self) -> [(f64, f64); 3] {
        let (from, to) = self.x;
        [(from, self.y), (to, self.y), (to, self.y * (to / from).powf(self.order))]
    }
}

/// A diagram.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Diagram {
    /// Title.
    pub title: String,
    /// Text of the horizontal axis, with the unit.
    pub x_label: String,
    /// Text of the vertical axis, with the unit.
    pub y_label: String,
    /// Division of the horizontal axis.
    pub x_axis: Scale,
    /// Division of the vertical axis.
    pub y_axis: Scale,
    /// Curves.
    pub series: Vec<Series>,
    /// Slopes.
    pub slopes: Vec<Slope>,
    /// True if it sets errors against work.
    pub precision: bool,
    /// Text below the diagram; it is not part of the drawing.
    pub caption: String,
}

impl Diagram {
    /// A diagram with linear axes.
    pub fn xy(title: impl Into<String>, x_label: impl Into<String>, y_label: impl Into<String>) -> Diagram {
        Diagram {
            title: title.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            x_axis: Scale::Linear,
            y_axis: Scale::Linear,
            series: Vec::new(),
            slopes: Vec::new(),
            precision: false,
            caption: String::new(),
        }
    }

    /// A work-precision diagram: error (horizontal) against work (vertical), both logarithmic, so that methods are compared
    /// at equal error. Failed settings stand at the top at the error they were meant to reach.
    pub fn work_precision(
        title: impl Into<String>,
        error: impl Into<String>,
        work: impl Into<String>,
    ) -> Diagram {
        Diagram { precision: true, ..Diagram::xy(title, error, work).log_log() }
    }

    /// Makes both axes logarithmic.
    #[must_use]
    pub fn log_log(self) -> Diagram {
        self.axes(Scale::Log, Scale::Log)
    }

    /// Chooses the axes.
    #[must_use]
    pub fn axes(self, x_axis: Scale, y_axis: Scale) -> Diagram {
        Diagram { x_axis, y_axis, ..self }
    }

    /// Adds a curve.
    #[must_use]
    pub fn series(mut self, series: Series) -> Diagram {
        self.series.push(series);
        self
    }

    /// Adds the triangle of a slope.
    #[must_use]
    pub fn slope(mut self, slope: Slope) -> Diagram {
        self.slopes.push(slope);
        self
    }

    /// Sets the text below the diagram.
    #[must_use]
    pub fn caption(self, text: impl Into<String>) -> Diagram {
        Diagram { caption: text.into(), ..self }
    }

    /// True if a point can be drawn on these axes.
    #[must_use]
    pub fn drawable(&self, x: f64, y: f64) -> bool {
        let fits = |scale: Scale, v: f64| v.is_finite() && (scale == Scale::Linear || v > 0.0);
        fits(self.x_axis, x) && fits(self.y_axis, y)
    }
}
