//! Coefficients of the Radau IIA method with three stages, order 5.
//!
//! Source: E. Hairer, G. Wanner, "Solving Ordinary Differential Equations II", 2nd ed. (1996), section IV.8. With s = sqrt(6) the nodes
//! are (4 - s)/10, (4 + s)/10 and 1; the inverse of the matrix of the method has one real eigenvalue and a complex pair.

/// Nodes of the stages, as fractions of the step.
pub(super) const NODES: [f64; 3] = [0.155_051_025_721_682_22, 0.644_948_974_278_317_8, 1.0];

/// Weights of the stages in the error estimate: (-13 - 7 s, -13 + 7 s, -1)/3.
pub(super) const ERROR: [f64; 3] = [-10.048_809_399_827_414, 1.382_142_733_160_748, -1.0 / 3.0];

/// Real eigenvalue: 3 + 3^(2/3) - 3^(1/3).
pub(super) const REAL: f64 = 3.637_834_252_744_496;
/// Complex eigenvalue, real part: 3 + (3^(1/3) - 3^(2/3))/2.
pub(super) const COMPLEX_REAL: f64 = 2.681_082_873_627_752_3;
/// Complex eigenvalue, imaginary part: -(3^(5/6) + 3^(7/6))/2.
pub(super) const COMPLEX_IMAGINARY: f64 = -3.050_430_199_247_411;

/// Transform from transformed to true stages.
pub(super) const FROM: [[f64; 3]; 3] = [
    [0.094_438_762_488_975_24, -0.141_255_295_020_954_2, 0.030_029_194_105_147_42],
    [0.250_213_122_965_333_3, 0.204_129_352_293_799_94, -0.382_942_112_757_261_9],
    [1.0, 1.0, 0.0],
];

/// Transform from true to transformed stages.
pub(super) const INTO: [[f64; 3]; 3] = [
    [4.178_718_591_551_904, 0.327_682_820_761_062_37, 0.523_376_445_499_449_5],
    [-4.178_718_591_551_904, -0.327_682_820_761_062_37, 0.476_623_554_500_550_45],
    [0.502_872_634_945_786_8, -2.571_926_949_855_605, 0.596_039_204_828_224_9],
];

/// From the stages to the coefficients of the collocation polynomial: a row per stage, a column per power from 1 to 3.
pub(super) const DENSE: [[f64; 3]; 3] = [
    [10.048_809_399_827_414, -25.629_591_447_076_64, 15.580_782_047_249_224],
    [-1.382_142_733_160_748, 10.296_258_113_743_303, -8.914_115_380_582_556],
    [1.0 / 3.0, -8.0 / 3.0, 10.0 / 3.0],
];
