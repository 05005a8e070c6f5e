//! The community's benchmark BP3-QD: dipping faults in plane strain.

use crate::cases::seas::{self, Found};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_driver::fault::{Moment, Plan};

/// See the README.
pub const CASE: Case = Case {
    name: "seas_bp3",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::PlaneStrain, Capability::AgeingLaw],
    quick: true,
    run,
};

/// The scene of dip 60 degrees, with another dip; `size` of cells \[m\].
fn text(dip: f64, size: f64) -> Result<String, CaseError> {
    let scene = include_str!("../../../scenes/bp3.toml");
    let (s, c) = dip.to_radians().sin_cos();
    let point = |along: f64| format!("[\"{:.9} km\", \"{:.9} km\"]", along * c, -along * s);
    let deep = 1000.0;
    let trace = [0.0, 15.0, 18.0, 40.0].map(point).join(", ");
    let bottom = deep * c / s;
    let mesh = format!(
        "mesh.fault = {{ trace = [{trace}, [\"{bottom:.9} km\", \"-{deep} km\"]], spacing = [[\"0 km\", \"{size} m\"], [\"18 km\", \"{size} m\"], [\"40 km\", \"{} m\"], [\"60 km\", \"3 km\"], [\"{:.0} km\", \"200 km\"]], thickness = \"{size} m\", min = [\"-1000 km\", \"-{deep} km\"], max = [\"{:.0} km\", \"0 km\"], growth = 1.25, element = \"quad9\" }}",
        600.0 / 156.25 * size,
        deep / s,
        1000.0 + bottom
    );
    let half = 0.5e-9;
    let motion = |sign: f64| {
        format!(
            "x = {{ rate = \"{:.12e} m/s\" }}, y = {{ rate = \"{:.12e} m/s\" }} }}",
            -sign * half * c,
            sign * half * s
        )
    };
    let left = format!("    {{ set = \"crust.left\", {},", motion(-1.0));
    let right = format!("    {{ set = \"crust.right\", {},", motion(1.0));
    let mut replaced = 0;
    let lines: Vec<&str> = scene
        .lines()
        .map(|line| {
            let start = line.trim_start();
            let new = [
                ("mesh.fault", mesh.as_str()),
                ("{ set = \"crust.left\"", &left),
                ("{ set = \"crust.right\"", &right),
            ]
            .into_iter()
            .find(|(old, _)| start.starts_with(old));
            replaced += usize::from(new.is_some());
            new.map_or(line, |(_, new)| new)
        })
        .collect();
    if replaced == 3 { Ok(lines.join("\n")) } else { Err("the scene of BP3 has changed".into()) }
}

fn plan(dip: f64, size: f64) -> Result<Plan, CaseError> {
    seas::plan(&text(dip, size)?)
}

fn found(plan: &Plan, events: usize, look: impl FnMut(&Moment<'_>)) -> Result<Found, CaseError> {
    let mut settings = plan.settings;
    settings.most_events = Some(events);
    seas::found(plan, &settings, look)
}

const CODES: &str = "boundary-element codes of the benchmark, cells of 25 m";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    vertical(ledger)?;
    for (dip, onset, spread) in [(60.0, 177.5, 0.5), (30.0, 172.0, 4.0)] {
        dipping(ledger, dip, onset, spread)?;
    }
    Ok(())
}

/// Dip 90: one period after a few events, and normal tractions that do not change.
fn vertical(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plan = plan(90.0, 156.25)?;
    let mut change = 0.0_f64;
    let run = found(&plan, 7, |now| {
        for p in 0..plan.points.len() {
            change = change.max((now.normal(&plan.fault, p) / plan.fault.normal[p] - 1.0).abs());
        }
    })?;
    let intervals: Vec<f64> = run.onsets.windows(2).map(|w| w[1] - w[0]).collect();
    ledger
        .claim("interval between the sixth and the seventh event, dip 90")
        .unit("yr")
        .value(intervals[5])
        .equals(89.83)
        .relative(1e-3)
        .uncertainty(0.01)
        .evidence(Evidence::OtherCode, CODES)
        .because("cells of 156 m leave 0.05 % in antiplane motion; intervals still alternate by 0.03 % here")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain, Capability::Events])
        .cost(&run.cost)
        .record();
    ledger
        .claim("largest relative change of normal traction, dip 90")
        .value(change)
        .at_most(1e-9)
        .evidence(Evidence::Exact, "symmetry: slip on a vertical fault changes no normal traction there")
        .because("rounding of the condensation, a share of 1e-9 of shear tractions at most")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&run.cost)
        .record();
    Ok(())
}

fn dipping(ledger: &mut Ledger, dip: f64, onset: f64, spread: f64) -> Result<(), CaseError> {
    let plan = plan(dip, 156.25)?;
    let run = found(&plan, 1, |_| {})?;
    ledger
        .claim(format!("onset of the first event, dip {dip}, thrust"))
        .unit("yr")
        .value(run.onsets[0])
        .equals(onset)
        .absolute(spread + 0.5)
        .uncertainty(spread)
        .evidence(Evidence::OtherCode, CODES)
        .because("codes agree within a few years only; cells of half the size and a box four times as large change the onset by 0.04 yr here")
        .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
        .cost(&run.cost)
        .record();
    Ok(())
}
