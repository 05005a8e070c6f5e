//! Errors of surfaces that are given by depths.

use super::scattered_samples::ScatterError;

/// Reason why a surface given by depths cannot be divided into triangles. Positions are east and north of the origin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SheetError {
    /// A line of a text does not hold three numbers.
    #[error("line {line} does not hold a longitude, a latitude and a depth: `{text}`")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// Beginning of the line.
        text: String,
    },
    /// Too few positions, or all on one line.
    #[error("{positions} positions span no surface: at least three are needed that are not on one line")]
    Few {
        /// Number of distinct positions.
        positions: usize,
    },
    /// Two depths at one position.
    #[error("two depths, {} and {} km, are given {}", km(&.depths[0]), km(&.depths[1]), spot(.at))]
    Twice {
        /// Position \[m\].
        at: [f64; 2],
        /// Depths \[m\].
        depths: [f64; 2],
    },
    /// A depth that the surface does not pass.
    #[error("a depth of {} km does not lie between those of the file, {} and {} km", km(.depth), km(&.range[0]), km(&.range[1]))]
    Outside {
        /// Depth \[m\].
        depth: f64,
        /// Least and largest depth of the surface \[m\].
        range: [f64; 2],
    },
    /// The surface has several parts at a depth.
    #[error("the contour at a depth of {:.3} km has several parts, such as {} and {}", km(.depth), spot(&.at[0]), spot(&.at[1]))]
    Parts {
        /// Depth \[m\].
        depth: f64,
        /// Positions on two parts \[m\].
        at: [[f64; 2]; 2],
    },
    /// A contour returns to its beginning: the surface has a summit or a hollow there.
    #[error("the contour at a depth of {:.3} km is closed, {}", km(.depth), spot(.at))]
    Closed {
        /// Depth \[m\].
        depth: f64,
        /// Position on the contour \[m\].
        at: [f64; 2],
    },
    /// The way down dip leaves the surface, or rises, before it reaches a depth.
    #[error("the way down dip ends at a depth of {:.3} km, {}, before {} km", km(&.at[2]), spot(&[.at[0], .at[1]]), km(.depth))]
    Ends {
        /// Depth that is not reached \[m\].
        depth: f64,
        /// Last position on the way, and its depth \[m\].
        at: [f64; 3],
    },
    /// The middle of the upper contour lies outside the positions.
    #[error("the upper contour leaves the positions of the file {}", spot(.at))]
    Left {
        /// Position \[m\].
        at: [f64; 2],
    },
    /// A contour that is shorter than a triangle.
    #[error("the contour at a depth of {:.3} km is {:.3} km long, less than the size of a triangle", km(.depth), km(.length))]
    Short {
        /// Depth \[m\].
        depth: f64,
        /// Length of the contour \[m\].
        length: f64,
    },
    /// More triangles than anyone could use.
    #[error("the surface would have some {triangles:.0} triangles")]
    Many {
        /// Estimated number of triangles.
        triangles: f64,
    },
}

impl From<ScatterError> for SheetError {
    fn from(error: ScatterError) -> Self {
        match error {
            ScatterError::Few { positions } => Self::Few { positions },
            ScatterError::Twice { at, values } => Self::Twice { at, depths: values },
        }
    }
}

fn km(metres: &f64) -> f64 {
    metres / 1e3
}

fn spot(x: &[f64; 2]) -> String {
    format!("{:.1} km east and {:.1} km north of the origin", km(&x[0]), km(&x[1]))
}
