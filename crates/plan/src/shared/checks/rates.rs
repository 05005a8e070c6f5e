//! Time of a step at the rates of one core of a server of 2023, which `benches/README.md` measures. They are constants, so that a plan is the same on
//! every machine. Other cores and threads change the time by a factor of a few.

use asperity_ode::Method;

/// Bytes that a product reads per second: a dense operator of 17 MB is read at 18 GB/s, smaller ones faster.
const READ: f64 = 18e9;
/// One evaluation of friction at a point of a fault: slip and state rates with radiation damping \[s\].
const POINT: f64 = 80e-9;
/// One evaluation of the equations of a slider: 32 703 of them take 2.7 ms \[s\].
const SLIDER: f64 = 83e-9;
/// Elastic forces of a cell per degree of freedom: 2.2 ns for tet4 to 3.5 ns for quad9, where cells differ. Grids of equal cells take a third of it \[s\].
const FORCE: f64 = 2.5e-9;
/// Return to friction at a point of a fault between bodies with mass \[s\].
const RETURN: f64 = 300e-9;
/// Operations of a factorisation per second.
const OPERATIONS: f64 = 1e10;
/// Factorisations of an implicit step between bodies in contact: Newton's method takes two to four iterations.
const ITERATIONS: f64 = 3.0;
/// Observers of a step, of which each row is written at once: 20 to 55 us in small runs of all kinds \[s\].
const OBSERVED: f64 = 30e-6;

/// Evaluations of the equations in a step of a method.
fn evaluations(method: Method) -> f64 {
    match method {
        Method::Dop853 | Method::Switching => 12.0,
        Method::Tsit5 | Method::Tsit45 | Method::Stabilised => 6.0,
        // Stages follow from the stiffness, and iterations from the Jacobian.
        Method::Rkc2 | Method::Bdf | Method::TrBdf2 | Method::Esdirk34 | Method::Radau5 => 10.0,
    }
}

/// Time of a step of faults whose operator and diffusion move so many bytes \[s\].
#[must_use]
pub fn fault_step(method: Method, points: usize, bytes: usize) -> f64 {
    OBSERVED + evaluations(method) * (bytes as f64 / READ + points as f64 * POINT)
}

/// Time of a step of spring-sliders \[s\].
#[must_use]
pub fn slider_step(method: Method, sliders: usize) -> f64 {
    OBSERVED + evaluations(method) * sliders as f64 * SLIDER
}

/// Time of an explicit step of bodies with this sum of degrees of freedom over cells, and points on faults \[s\].
#[must_use]
pub fn wave_step(dofs_of_cells: usize, points: usize) -> f64 {
    OBSERVED + dofs_of_cells as f64 * FORCE + points as f64 * RETURN
}

/// Time of an implicit step whose system takes so many operations to factor \[s\].
#[must_use]
pub fn body_step(operations: f64) -> f64 {
    OBSERVED + ITERATIONS * operations / OPERATIONS
}

/// Time as text, to two digits.
#[must_use]
pub fn words(seconds: f64) -> String {
    let units = [("s", 1.0), ("ms", 1e3), ("us", 1e6)];
    if seconds >= 10.0 {
        return asperity_output::words::about(seconds);
    }
    let (unit, value) = units
        .map(|(unit, per)| (unit, seconds * per))
        .into_iter()
        .find(|(_, v)| *v >= 1.0)
        .unwrap_or(("us", seconds * 1e6));
    if value < 10.0 { format!("{value:.1} {unit}") } else { format!("{value:.0} {unit}") }
}
