//! The SEAS benchmark BP3-QD: dipping faults in plane strain.

use crate::cases::seas::{self, CycleResults};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_cycles::Moment;
use asperity_plan::faults::Plan;
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp3",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::AgeingLaw],
    quick: true,
    run,
};

/// Direction of fault slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sense {
    /// The hanging wall moves up.
    Thrust,
    /// The hanging wall moves down.
    Normal,
}

impl Sense {
    /// Name of the sense.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Thrust => "thrust",
            Self::Normal => "normal",
        }
    }

    /// Sign of slip, tractions and plate motion, which are positive for a thrust.
    fn sign(self) -> f64 {
        match self {
            Self::Thrust => 1.0,
            Self::Normal => -1.0,
        }
    }
}

/// A dip in degrees and a direction of slip.
pub type Faulting = (f64, Sense);

/// Name of the problem in the second implementation.
#[must_use]
pub fn problem((dip, sense): Faulting) -> String {
    format!("bp3:{dip}:{}", sense.name())
}

/// Depth of the bottom and distance of the sides \[km\].
pub const FAR: f64 = 4000.0;

/// Growth factor of cells away from the fault. Cells beside a dipping fault are sheared: at a dip of 30 degrees growth
/// by 1.25 shifts the first onset by 0.10 yr and growth by 1.12 by 0.01 yr (against 1.06). At 90 degrees neither does.
const GROWTH: f64 = 1.12;

/// The scene of a thrust of dip 60 degrees, changed to this dip and sense, cells of `size` \[m\] and borders at `far`
/// \[km\].
fn text((dip, sense): Faulting, size: f64, far: f64) -> Result<String, CaseError> {
    let (s, c) = dip.to_radians().sin_cos();
    let point = |along: f64| format!("[\"{:.9} km\", \"{:.9} km\"]", along * c, -along * s);
    let trace = [0.0, 15.0, 18.0, 40.0].map(point).join(", ");
    let bottom = far * c / s;
    let mesh = format!(
        "{{ trace = [{trace}, [\"{bottom:.9} km\", \"-{far} km\"]], spacing = [[\"0 km\", \"{size} m\"], [\"18 km\", \"{size} m\"], [\"40 km\", \"{} m\"], [\"60 km\", \"3 km\"], [\"{:.0} km\", \"{} km\"]], thickness = \"{size} m\", min = [\"-{far} km\", \"-{far} km\"], max = [\"{:.0} km\", \"0 km\"], growth = {GROWTH}, element = \"quad9\" }}",
        2.0 * size,
        far / s,
        far / 5.0,
        far + bottom
    );
    let half = 0.5e-9 * sense.sign();
    let moved = |set: &str, side: f64| {
        format!(
            "{{ set = \"{set}\", x = {{ rate = \"{:.12e} m/s\" }}, y = {{ rate = \"{:.12e} m/s\" }} }}",
            -side * half * c,
            side * half * s
        )
    };
    let minus = if sense == Sense::Normal { "-" } else { "" };
    let scene = SceneText::new(include_str!("../../../scenes/bp3.toml"))
        .with_or_same("bodies.crust.mesh.fault", mesh)
        .with_or_same("stages[0].conditions[0]", moved("crust.left", -1.0))
        .with_or_same("stages[0].conditions[1]", moved("crust.right", 1.0))
        .with_or_same("faults.main.shear", format!("{minus}26.5461223651 MPa"))
        .with_or_same("faults.main.rate", format!("{minus}1e-9 m/s"))
        .with_or_same("faults.main.creep.rate", format!("{minus}1e-9 m/s"));
    Ok(scene.text()?)
}

/// The plan of a dip and sense, cells of `size` \[m\] and borders at `far` \[km\].
///
/// # Errors
/// Refusals of the reader or the plan.
pub fn plan(faulting: Faulting, size: f64, far: f64) -> Result<Plan, CaseError> {
    seas::plan(&text(faulting, size, far)?)
}

fn found(plan: &Plan, events: usize, look: impl FnMut(&Moment<'_>)) -> Result<CycleResults, CaseError> {
    let mut settings = plan.problem.settings;
    settings.most_events = Some(events);
    seas::found(plan, &settings, look)
}

/// Reference of the onsets by dip.
pub const CODES: &str = "boundary-element codes of the benchmark, cells of 25 m";
/// Cell size of the second implementation \[m\].
pub const THEIRS: f64 = 39.0625;
/// Error of a first onset with cells of 156 m here, and of 39 m in the second implementation \[yr\].
const FIRST: f64 = 0.1;
const UNSURE: f64 = 0.05;
/// Relative error of the period by its cells: the period grows by 0.045 % from 78 to 39 m.
pub const PERIOD: f64 = 4.5e-4;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    vertical(ledger)?;
    for (dip, onset, spread) in [(60.0, 177.5, 0.5), (30.0, 172.0, 4.0)] {
        dipping(ledger, dip, onset, spread)?;
    }
    Ok(())
}

/// Dip 90: a constant period after a few events, and constant normal tractions.
fn vertical(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = plan((90.0, Sense::Thrust), 156.25, FAR)?;
    let mut change = 0.0_f64;
    let run = found(&plan, 5, |now| change = change.max(normal_change(&plan, now)))?;
    let intervals: Vec<f64> = run.onsets.windows(2).map(|w| w[1] - w[0]).collect();
    let there = seas::independent("bp3:90:thrust", THEIRS)?;
    ledger
        .claim("interval between the fourth and the fifth event, dip 90")
        .unit("yr")
        .value(intervals[3])
        .equals(there[4] - there[3])
        .relative(1e-3)
        .uncertainty(PERIOD * intervals[3])
        .evidence(Evidence::OtherCode, seas::INDEPENDENT)
        .because("cells of 156 m leave 0.05 % in antiplane motion, and as much is what constant slip on 39 m leaves")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Events])
        .cost(&run.cost)
        .record();
    ledger
        .claim("largest relative change of normal traction, dip 90")
        .value(change)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "symmetry: slip on a vertical fault changes no normal traction there")
        .because("rounding of the condensation, a share of 1e-9 of shear tractions at most")
        .why_not_tighter("rounding depends on the order of elimination; a dip of 89 degrees makes 1e-2")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&run.cost)
        .record();
    Ok(())
}

/// Largest relative change of normal traction from the start.
pub fn normal_change(plan: &Plan, now: &Moment<'_>) -> f64 {
    let of = |p: usize| (now.normal(p) / plan.problem.fault.normal[p] - 1.0).abs();
    (0..plan.points.len()).map(of).fold(0.0, f64::max)
}

fn dipping(ledger: &mut Ledger, dip: f64, onset: f64, spread: f64) -> Result<(), CaseError> {
    let plan = plan((dip, Sense::Thrust), 156.25, FAR)?;
    let run = found(&plan, 1, |_| {})?;
    ledger
        .claim(format!("onset of the first event, dip {dip}, thrust"))
        .unit("yr")
        .value(run.onsets[0])
        .equals(onset)
        .absolute(spread + 0.5)
        .uncertainty(spread)
        .evidence(Evidence::OtherCode, CODES)
        .because("codes agree within a few years only")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&run.cost)
        .record();
    first(ledger, (dip, Sense::Thrust), 156.25, &run)
}

/// Compares the first onset with the second implementation.
///
/// # Errors
/// If the second implementation has no such run.
pub fn first(
    ledger: &mut Ledger,
    faulting: Faulting,
    size: f64,
    found: &CycleResults,
) -> Result<(), CaseError> {
    let (dip, sense) = faulting;
    ledger
        .claim(format!("onset of the first event against boundary elements of 39 m, dip {dip}, {}, cells of {size} m", sense.name()))
        .unit("yr")
        .value(found.onsets[0])
        .equals(seas::independent(&problem(faulting), THEIRS)?[0])
        .absolute(FIRST * (size / 156.25) + UNSURE)
        .uncertainty(UNSURE)
        .evidence(Evidence::OtherCode, seas::INDEPENDENT)
        .because("first order from where the fault begins to creep: cells of 156 m leave 0.1 yr there (156 against 78 m); and what constant slip on 39 m leaves")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&found.cost)
        .record();
    Ok(())
}
