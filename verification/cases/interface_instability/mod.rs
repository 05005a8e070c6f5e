//! A rigid block on a spring, modelled by bodies and interfaces: onset of instability of quasi-static equilibrium, and its time.

use super::slider;
use super::texts::{BodyRun, attempt, simulate};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity::kinds::sliders::Entry;
use asperity_cycles::Thresholds;
use asperity_cycles::slider::{self as cycles};
use asperity_friction::evolution::ageing::Ageing;
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use asperity_ode::Method;
use asperity_run::report::{Outcome, Stop};
use asperity_vary::Change::{self, Add};
use asperity_vary::SceneText;
use std::sync::Arc;

/// See the README.
pub const CASE: Case = Case {
    name: "interface_instability",
    readme: include_str!("README.md"),
    covers: &[Capability::InterfaceInstability, Capability::AgeingLaw],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
/// Parameters of the ageing law.
const A: f64 = 0.005;
const B: f64 = 0.02;
/// L \[m\].
const LENGTH: f64 = 10e-6;
/// Load rate, also the rate of the initial steady state of the law \[m/s\].
const LOAD: f64 = 1e-6;
/// Slip rate at which runs stop \[m/s\].
const LIMIT: f64 = 10e-3;
/// Duration of the pressing stage \[s\].
const PRESSED: f64 = 1.0;
/// Coefficients and slip-weakening distance \[m\].
const MU_S: f64 = 0.6;
const MU_K: f64 = 0.3;
const D_C: f64 = 100e-6;
/// Stiffness of the bond in the run that measures the compliance of the system \[Pa/m\].
const PROBE: f64 = 1e10;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let system = System::measured(ledger)?;
    states(ledger, &system)?;
    weakening(ledger, &system)?;
    dropping(ledger, &system)
}

/// A scene with this stiffness of the bond \[Pa/m\], law, duration of shear \[s\] and keys of time.
fn scene(spring: f64, law: &str, duration: f64, time: &[Change<'_>]) -> Result<String, CaseError> {
    let scene = SceneText::new(SCENE)
        .add("interfaces.spring.enforcement.tangential", format!("{spring:e} Pa/m"))
        .add("interfaces.fault.law", law)
        .add("stages[1].duration", format!("{duration} s"))
        .changed(time);
    Ok(scene.text()?)
}

/// Normal traction and compliance of the system, measured with a block held by friction.
struct System {
    /// f_n \[Pa\].
    normal: f64,
    /// Compliance in series with the bond \[m/Pa\].
    compliance: f64,
}

impl System {
    fn measured(ledger: &mut Ledger) -> Result<Self, CaseError> {
        let done = simulate(&scene(PROBE, "{ kind = \"coulomb\", mu = 1e3 }", 100.0, &[])?)?;
        ledger.picture(
            "The block held by a spring",
            body_plots::recorded(&done.record, "")?,
            "Mises stress after the first stage.",
        );
        let [normal, shear] = tractions(&done)?;
        Ok(Self { normal, compliance: 100.0 * LOAD / shear - 1.0 / PROBE })
    }

    /// Stiffness of the bond for a total stiffness \[Pa/m\].
    fn bond(&self, stiffness: f64) -> f64 {
        1.0 / (1.0 / stiffness - self.compliance)
    }
}

/// Final mean normal and shear traction of the fault \[Pa\].
fn tractions(done: &BodyRun) -> Result<[f64; 2], CaseError> {
    let last = done.report.results.iter().rfind(|r| r.interface == "fault").ok_or("no results")?;
    Ok([last.mean_normal_traction, last.mean_shear_traction.abs()])
}

/// Time from the start of shear to the instability at which a run stopped \[s\]; none if it completed.
fn onset(done: &BodyRun) -> Result<Option<f64>, CaseError> {
    match &done.report.outcome {
        Outcome::Completed => Ok(None),
        Outcome::Stopped { time, kind: Stop::Instability { .. }, .. } => Ok(Some(time - PRESSED)),
        Outcome::Stopped { reason, .. } => Err(reason.clone().into()),
        Outcome::Interrupted { .. } => Err("interrupted".into()),
    }
}

/// 1 if a run stopped at an instability, 0 if it completed.
fn told(onset: Option<f64>) -> f64 {
    f64::from(u8::from(onset.is_some()))
}

/// The ageing law on both sides of the critical stiffness, and the time of the instability.
fn states(ledger: &mut Ledger, system: &System) -> Result<(), CaseError> {
    let critical = system.normal * (B - A) / LENGTH;
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = {}, a = {A}, b = {B}, l = {LENGTH:e}, v_ref = {:e}, \
         v_initial = {LOAD:e} }}",
        slider::MU0,
        slider::V_REF
    );
    let limit = format!("{LIMIT:e}");
    let limit = [Add("time.slip_rate_limit", &limit)];
    // Loading takes about 500 s; then follow 150 L of slip.
    let at =
        |ratio: f64, time: &[Change<'_>]| attempt(&scene(system.bond(ratio * critical), &law, 2000.0, time)?);
    let fine = [limit[0], Add("time.max_step", "0.5 s")];
    let mut found = Vec::new();
    let mut cost = None;
    for (ratio, time) in [(0.85, &limit[..]), (1.15, &limit), (0.98, &limit), (1.08, &fine)] {
        let done = at(ratio, time)?;
        found.push(told(onset(&done)?));
        cost = Some(done.cost);
    }
    let cost = cost.ok_or("nothing was run")?;
    ledger
        .claim("ageing law, k/k_c = 0.85, 1.15, 0.98, and 1.08 in steps of L/20: stopped (1) or completed (0)")
        .values(&found)
        .equals_each(&[1.0, 0.0, 1.0, 0.0])
        .absolute(0.1)
        .evidence(Evidence::Exact, "k_c = f_n (b - a)/L: linear stability, and for this law of any perturbation")
        .because("the outcome is yes or no; k_c is the limit about steady slip, and a run begins far from it, with a slack spring")
        .why_not_tighter("a smaller bound says no more")
        .covers(&[Capability::InterfaceInstability, Capability::AgeingLaw])
        .cost(&cost)
        .record();
    let (mut times, mut reference) = (Vec::new(), Vec::new());
    for ratio in [0.3, 0.6, 0.85] {
        let done = at(ratio, &limit)?;
        times.push(onset(&done)?.ok_or("it did not stop")?);
        reference.push(by_slider(system.normal, ratio * critical)?);
    }
    ledger
        .claim("ageing law, time at which V passes 10 mm/s, k/k_c = 0.3, 0.6, 0.85")
        .unit("s")
        .values(&times)
        .equals_each(&reference)
        .relative(1e-4)
        .evidence(Evidence::SemiAnalytic, "one slider on a spring, Radau IIA of order 5 with an event")
        .because(
            "errors of friction stay below 1e-4 until it runs away, which the load makes up for within some 0.2 s",
        )
        .covers(&[Capability::InterfaceInstability, Capability::AgeingLaw])
        .cost(&cost)
        .record();
    Ok(())
}

/// Time at which a slider on an initially slack spring exceeds the limit rate \[s\].
fn by_slider(normal: f64, stiffness: f64) -> Result<f64, CaseError> {
    let form = Regularised(Parameters::new(slider::MU0, A, slider::V_REF)?);
    let law = Arc::new(RateLaw::new(form, Ageing::new(B, LENGTH, slider::V_REF)?, LOAD, None)?);
    let slider = Slider { law, stiffness, damping: 0.0, mass: None, normal: History::Constant(normal) };
    let mut plan = slider::plan(slider, History::Constant(LOAD), LOAD, 1.0, 1e5)?;
    // mu/a is zero: the spring is slack.
    plan.start[0] = 0.0;
    plan.method = Method::Radau5;
    plan.tolerance = 1e-9;
    plan.events = Some(Thresholds { on: LIMIT, off: 0.1 * LIMIT });
    plan.most_events = Some(1);
    // The run has no end condition: it fails after the limit has been exceeded.
    let run = cycles::run(&plan, &mut ())?;
    Ok(Entry::all(&run).first().ok_or("the slider did not pass the limit")?.onset)
}

/// Slip weakening on both sides of the rate of weakening.
fn weakening(ledger: &mut Ledger, system: &System) -> Result<(), CaseError> {
    let rate = system.normal * (MU_S - MU_K) / D_C;
    let law = format!("{{ kind = \"slip-weakening\", mu_s = {MU_S}, mu_k = {MU_K}, d_c = {D_C:e} }}");
    let at = |ratio: f64| attempt(&scene(system.bond(ratio * rate), &law, 500.0, &[])?);
    let (soft, stiff) = (at(0.98)?, at(1.02)?);
    let found = [&soft, &stiff].map(onset);
    let [soft_onset, stiff_onset] = found;
    let soft_onset = soft_onset?;
    ledger
        .claim("slip weakening, k over f_n (mu_s - mu_k)/d_c = 0.98 and 1.02: stopped (1) or completed (0)")
        .values(&[told(soft_onset), told(stiff_onset?)])
        .equals_each(&[1.0, 0.0])
        .absolute(0.1)
        .evidence(
            Evidence::Exact,
            "a spring that unloads more slowly than the surface weakens has no equilibrium",
        )
        .because("the outcome is yes or no")
        .why_not_tighter("a smaller bound says no more")
        .covers(&[Capability::InterfaceInstability])
        .cost(&soft.cost)
        .record();
    let yields = MU_S * system.normal / (0.98 * rate * LOAD);
    ledger
        .claim("slip weakening, k = 0.98: time of the instability over that at which the strength is reached")
        .value(soft_onset.ok_or("it did not stop")? / yields)
        .equals(1.0)
        .relative(1e-3)
        .evidence(Evidence::Exact, "t = mu_s f_n/(k V)")
        .because("normal tractions are uniform to some parts in ten thousand, and points share what one of them cannot hold")
        .why_not_tighter("how uniform they are is known by its order only")
        .covers(&[Capability::InterfaceInstability])
        .cost(&soft.cost)
        .record();
    let [normal, shear] = tractions(&stiff)?;
    ledger
        .claim("slip weakening, k = 1.02: friction coefficient once it has slipped by more than d_c")
        .value(shear / normal)
        .equals(MU_K)
        .relative(1e-4)
        .evidence(Evidence::Exact, "mu_k")
        .because("every point has slipped by 200 um")
        .why_not_tighter("the claim is that the stable run passes through all of the weakening")
        .covers(&[Capability::InterfaceInstability])
        .cost(&stiff.cost)
        .record();
    Ok(())
}

/// Static-kinetic friction of a whole surface that slips at once.
fn dropping(ledger: &mut Ledger, system: &System) -> Result<(), CaseError> {
    let law = format!("{{ kind = \"static-kinetic\", mu_s = {MU_S}, mu_k = {MU_K} }}");
    let stiffness = 2e10;
    let done = attempt(&scene(system.bond(stiffness), &law, 500.0, &[])?)?;
    let yields = MU_S * system.normal / (stiffness * LOAD);
    let [normal, shear] = tractions(&done)?;
    ledger
        .claim("static-kinetic: time of the instability over that at which the strength is reached; friction coefficient kept over mu_s")
        .values(&[onset(&done)?.ok_or("it did not stop")? / yields, shear / normal / MU_S])
        .equals_each(&[1.0, 1.0])
        .relative(1e-3)
        .evidence(Evidence::Exact, "t = mu_s f_n/(k V); the state before the drop carries mu_s f_n")
        .because("normal tractions are uniform to some parts in ten thousand, and points share what one of them cannot hold")
        .why_not_tighter("how uniform they are is known by its order only")
        .covers(&[Capability::InterfaceInstability])
        .cost(&done.cost)
        .record();
    let whole = [Add("time.first_step", "500 s"), Add("time.max_step", "500 s")];
    let leapt = attempt(&scene(system.bond(stiffness), &law, 500.0, &whole)?)?;
    ledger
        .claim("static-kinetic, first step as long as the stage: time of the instability over that at which the strength is reached")
        .value(onset(&leapt)?.ok_or("it did not stop")? / yields)
        .equals(1.0)
        .relative(1e-3)
        .evidence(Evidence::Exact, "t = mu_s f_n/(k V), however long the step that reaches it")
        .because("normal tractions are uniform to some parts in ten thousand, and points share what one of them cannot hold")
        .why_not_tighter("how uniform they are is known by its order only")
        .covers(&[Capability::InterfaceInstability])
        .cost(&leapt.cost)
        .record();
    let Outcome::Stopped { reason, .. } = &done.report.outcome else { return Err("it did not stop".into()) };
    let words: Vec<&str> = reason.split_whitespace().collect();
    let slip =
        words.windows(3).find(|w| w[0] == "slips" && w[1] == "by").and_then(|w| w[2].parse::<f64>().ok());
    ledger
        .claim("static-kinetic: slip of the jump")
        .unit("m")
        .value(slip.ok_or("the message tells no slip")?)
        .equals((MU_S - MU_K) * system.normal / stiffness)
        .relative(2e-3)
        .evidence(Evidence::Exact, "(mu_s - mu_k) f_n/k: the spring unloads to mu_k f_n")
        .because(
            "normal tractions are uniform to a few parts in ten thousand, and the message has four digits",
        )
        .why_not_tighter("the last of four digits may be off by a half")
        .covers(&[Capability::InterfaceInstability])
        .cost(&done.cost)
        .record();
    Ok(())
}
