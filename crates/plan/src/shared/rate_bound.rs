//! The bound of slip rates. The sides of a surface part no faster than waves carry them away: slip at the speed of shear waves takes
//! a drop of stress of about half the shear modulus. A state beyond it is one of an equation, not of rock, in every kind of run.

pub use asperity_cycles::ANY_ROCK;

/// Smallest speed of shear waves among those of several materials, of which some may be unknown \[m/s\].
#[must_use]
pub fn bound(speeds: impl IntoIterator<Item = Option<f64>>) -> f64 {
    speeds.into_iter().map(|speed| speed.unwrap_or(ANY_ROCK)).reduce(f64::min).unwrap_or(ANY_ROCK)
}

/// Reason for the end of a run in which a surface slipped faster than the bound, `most` \[m/s\]: where and when, and the remedy.
#[must_use]
pub fn reason(surface: &str, place: &str, after: f64, [rate, most]: [f64; 2], radiates: bool) -> String {
    let remedy = if radiates {
        "check the units of `damping` (in Pa s/m, G/(2 c_s), some 5e6 in rock), of rates and of tractions"
    } else {
        "nothing is radiated: add `damping = \"radiation\"`, which bounds the slip rate, or inertia, and check the units of rates and tractions"
    };
    format!(
        "slip of {surface} at {place} outruns shear waves: V = {rate:.3e} m/s after t = {after:.9e} s, beyond {most:.4e} m/s, where no state is meaningful; \
         the last state before it is kept; {remedy}"
    )
}
