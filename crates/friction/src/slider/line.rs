//! Laws whose friction is linear in ln V where it is large.

/// `|V| = exp(|m| - offset - b s/a) (1 - exp(-2 |m|))` and `ds/dt = healing exp(-s) - |V|/L`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// |m| above which the second factor is 1 to rounding.
    pub from: f64,
    /// |m| above which it loses no digits.
    pub least: f64,
    /// See the struct.
    pub offset: f64,
    /// a \[-\].
    pub a: f64,
    /// b \[-\].
    pub b: f64,
    /// Vref/L \[1/s\].
    pub healing: f64,
    /// L \[m\].
    pub length: f64,
}
