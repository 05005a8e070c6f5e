//! Results in the files in which the SEAS community collects them: what their heads say, and their axes.

use asperity_output::formats::platform::Submission;

/// The files of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct Platform {
    /// Contents of their heads.
    pub submission: Submission,
    /// Unit vectors of the benchmark: normal of the fault, along strike and down.
    pub axes: [[f64; 3]; 3],
    /// True if slip may turn.
    pub turns: bool,
    /// Signs of the components of slip along the second and the third axis.
    pub signs: [f64; 2],
    /// Names and locations of the stations of the fault.
    pub stations: Vec<(String, String)>,
    /// Names and locations of the receivers.
    pub receivers: Vec<(String, String)>,
}
