//! Plots of a case's page: what to draw. [`crate::report::svg`] draws it.

use serde::Serialize;

/// Division of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Linear.
    Linear,
    /// Logarithmic; points that are not positive are left out, and the caption says how many.
    Log,
}

/// A setting that failed: drawn at the top of its plot with the reason in the caption.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failed {
    /// Position on the horizontal axis.
    pub x: f64,
    /// Reason why it failed.
    pub reason: String,
}

/// One curve.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    pub failed: Vec<Failed>,
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
        self.failed.push(Failed { x, reason: reason.into() });
        self
    }
}

/// A plot.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plot {
    /// Title.
    pub title: String,
    /// Text of the horizontal axis, with the unit.
    pub x_label: String,
    /// Text of the vertical axis, with the unit.
    pub y_label: String,
    /// Division of the horizontal axis.
    pub x_axis: Axis,
    /// Division of the vertical axis.
    pub y_axis: Axis,
    /// Curves.
    pub series: Vec<Series>,
    /// Text below the plot.
    pub caption: String,
}

impl Plot {
    /// A plot with linear axes.
    pub fn xy(title: impl Into<String>, x_label: impl Into<String>, y_label: impl Into<String>) -> Plot {
        Plot {
            title: title.into(),
            x_label: x_label.into(),
            y_label: y_label.into(),
            x_axis: Axis::Linear,
            y_axis: Axis::Linear,
            series: Vec::new(),
            caption: String::new(),
        }
    }

    /// A work-precision diagram: error (horizontal) against work (vertical), both logarithmic, so that methods are compared
    /// at equal error. Failed settings stand at the top at the error they were meant to reach.
    pub fn work_precision(
        title: impl Into<String>,
        error: impl Into<String>,
        work: impl Into<String>,
    ) -> Plot {
        Plot::xy(title, error, work).log_log()
    }

    /// Makes both axes logarithmic.
    #[must_use]
    pub fn log_log(self) -> Plot {
        Plot { x_axis: Axis::Log, y_axis: Axis::Log, ..self }
    }

    /// Chooses the axes.
    #[must_use]
    pub fn axes(self, x_axis: Axis, y_axis: Axis) -> Plot {
        Plot { x_axis, y_axis, ..self }
    }

    /// Adds a curve.
    #[must_use]
    pub fn series(mut self, series: Series) -> Plot {
        self.series.push(series);
        self
    }

    /// Sets the text below the plot.
    #[must_use]
    pub fn caption(self, text: impl Into<String>) -> Plot {
        Plot { caption: text.into(), ..self }
    }

    /// True if a point can be drawn on these axes.
    pub fn drawable(&self, (x, y): (f64, f64)) -> bool {
        let fits = |axis: Axis, v: f64| v.is_finite() && (axis == Axis::Linear || v > 0.0);
        fits(self.x_axis, x) && fits(self.y_axis, y)
    }
}
