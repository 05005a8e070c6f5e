//! Laws whose friction is linear in ln V.

/// While |m| is above `from`, `ln V = |m| - offset - b s/a`; `ds/dt = healing exp(-s) - V/L`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// Smallest |m|.
    pub from: f64,
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
