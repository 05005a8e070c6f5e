//! Defaults of keys: the plan takes them, and the rows of the keys show them.

/// Local error of slip per step, over the largest prescribed travel \[-\].
pub const SLIP_TOLERANCE: f64 = 2e-5;
/// Estimated error of friction coefficients per step, if a law has a state variable. Over velocity steps, holds and the
/// subsequent response it gives errors of up to 5e-5 (case `interface_rate_state`).
pub const FRICTION_TOLERANCE: f64 = 2e-6;
/// First step as a share of the stage.
pub const FIRST_STEP: f64 = 1e-3;
/// Largest step as a share of the stage.
pub const LARGEST_STEP: f64 = 0.05;
/// Smallest step as a share of the stage. It is six orders below the first, the factor by which slip accelerates from the
/// rate of the loads to the limit of quasi-static states.
pub const SMALLEST_STEP: f64 = 1e-9;
/// Same share if no law weakens: ten orders below the first, for sets of contacts and yielding points that change one by one.
pub const LEAST_STEP: f64 = 1e-13;
/// Bound r8 on |Δ ln V|.
pub const RATE_CHANGE: f64 = 0.5;
/// ζ of r8.
pub const ZETA: f64 = 0.1;
/// Residual that a forward step may leave, over the largest force: a tenth of the precision to which tractions are read.
pub const DRIFT: f64 = 1e-4;
/// The same for laws that depend on slip rate, which respond to unbalanced forces. Its error in friction is that of some tens of
/// steps ([`FRICTION_TOLERANCE`]).
pub const RATE_DRIFT: f64 = 1e-5;
/// Departure of a table from its chord within a step, over the range of the table: a tenth of the precision of load cells and
/// displacement transducers.
pub const COURSE_TOLERANCE: f64 = 1e-4;
/// Spectral radius. Above some 0.6 a point that meets with a stiff penalty opens and closes in every other step, and the
/// energy grows (case `impact_bars`). At 0.5 a vibration of sixty steps a period loses 1.3e-4 of its amplitude in a period.
pub const SPECTRAL_RADIUS: f64 = 0.5;
/// Error of displacement in a step of bodies with mass. It is about the error of the period of a steady vibration, which then
/// takes some sixty steps.
pub const INERTIA_TOLERANCE: f64 = 1e-3;
/// Slip rate above which bodies have inertia \[m/s\], that of events. Radiation changes tractions there by some kPa.
pub const HANDOVER_ABOVE: f64 = 1e-3;
/// Slip rate below which they return to equilibrium, over that above which they leave it \[-\].
pub const HANDOVER_BELOW: f64 = 0.1;
/// Kinetic energy with which they return, over the largest since they left: no bound.
pub const HANDOVER_KINETIC: f64 = 1.0;
/// Method for faults through cycles in the plane.
pub const METHOD: &str = "tsit5";
/// Error of ln V per step of the method.
pub const LOG_RATE: f64 = 1e-5;
/// Method for faults through cycles in space, where the operator is dear.
pub const METHOD_IN_SPACE: &str = "stabilised";
/// Error of ln V per step of that method.
pub const LOG_RATE_IN_SPACE: f64 = 1e-4;
/// Explicit step over the stable one.
pub const COURANT: f64 = 0.5;
/// Time of Kelvin-Voigt viscosity over the step: it damps what the mesh does not resolve.
pub const VISCOSITY: f64 = 0.1;
/// Memory of the solver \[bytes\]. It is a constant because results must not depend on the memory of the machine.
pub const MEMORY: f64 = 8.0 * 1024.0 * 1024.0 * 1024.0;
/// Residual of an iterative solution over its load. Newton's method converges to 1e-11 of the largest force; with linear
/// solutions to 1e-10, linear steps take one or two iterations.
pub const SOLVER_TOLERANCE: f64 = 1e-10;
/// Iterations per solution: twenty times the number for the hardest case of the benchmark.
pub const MOST_ITERATIONS: usize = 2000;
/// Augmentations per step. With a penalty of 1 E/h each leaves a third to a half of the penetration, with 100 E/h a hundredth.
/// If more are needed, the penalty is too small for the method.
pub const AUGMENTATIONS: usize = 40;
/// Field files per stage.
pub const FIELDS: usize = 1;
/// Profiles per stage.
pub const PROFILES: usize = 10;
/// Field files of a run of explicit steps.
pub const WAVE_FIELDS: usize = 10;
/// Profiles of a run of explicit steps.
pub const WAVE_PROFILES: usize = 200;
/// Rows of tables and seismograms of a run of explicit steps.
pub const WAVE_ROWS: usize = 1000;
/// Slip rate at which a point has ruptured \[m/s\], that of the benchmarks of spontaneous rupture; not below that at which events
/// begin.
pub const RUPTURED: f64 = 1e-3;
/// Slip rate at which an event ends, over the rate at which it begins: an order of magnitude, so that a rate fluctuating about the
/// threshold counts as one event.
pub const EVENT_ENDS: f64 = 0.1;
/// Slip rate at which a slow event ends, over the rate at which it begins. Slow events are hardly faster than the plates, which
/// slide on after them.
pub const SLOW_EVENT_ENDS: f64 = 0.5;
/// Number of events with files of their own.
pub const EVENT_FILES: usize = 20;
/// Largest size of a file \[bytes\].
pub const LARGEST_FILE: f64 = 100e6;
/// Change of log10 of the slip rate from row to row.
pub const DECADES: f64 = 0.125;
/// Slip from row to row over the smallest characteristic slip of the fault, which is the slip over which the state evolves. In
/// BP1 this is 4 mm, or a tenth of a second at 4 cm/s.
pub const CADENCE_SLIP: f64 = 0.5;
/// Longest time between rows \[s\], a tenth of a year: the cadence that the benchmarks request between events.
pub const LONGEST: f64 = 0.1 * 365.25 * 86400.0;
/// Least time between rows due to slip alone \[s\]: the cadence that the benchmarks request in events.
pub const SHORTEST: f64 = 0.1;
/// Dip of a rectangle \[rad\].
pub const DIP: f64 = std::f64::consts::FRAC_PI_2;
/// Unit of length of files of meshes.
pub const FILE_UNIT: &str = "m";
/// Column of times of a file of a table.
pub const TIME_COLUMN: &str = "time";
/// Method for spring-sliders.
pub const SLIDER_METHOD: &str = "switching";
/// Error of ln V per step of spring-sliders.
pub const SLIDER_TOLERANCE: f64 = 1e-8;
/// Number of steps of spring-sliders, after which a run is given up.
pub const SLIDER_STEPS: usize = 20_000_000;
/// Change of ln V from row to row of spring-sliders.
pub const SLIDER_CHANGE: f64 = 0.05;
