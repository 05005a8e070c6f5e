//! Simple shear under the Jaumann rate: the oscillation, and how plasticity ends it.

use super::body::{self, Body, Work};
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::hardening::Hardening;
use asperity_fem::nonlinear::{Kinematics, Material};
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step};

/// See the README.
pub const CASE: Case = Case {
    name: "jaumann_shear",
    readme: include_str!("README.md"),
    covers: &[Capability::FiniteStrain],
    quick: true,
    run,
};

/// E with G = 1.
const YOUNG: f64 = 2.6;
const POISSON: f64 = 0.3;
/// Shear yield stress over G: large, so that the oscillation has begun when the body yields.
const RHO: f64 = 0.2;

/// (s_xx - s_yy)/2 and s_xy, over G.
type Pair = [f64; 2];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    elastic(ledger)?;
    perfect(ledger)?;
    hardening(ledger)?;
    plot(ledger)
}

/// A body after simple shear to `gamma` in equal steps.
fn sheared_body(material: Material, gamma: f64, steps: usize) -> Result<Body<2>, CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
    let mut body = Body::new(
        mesh,
        body::model(material, Idealisation::PlaneStrain, Kinematics::UpdatedLagrangian),
        &[],
    )?;
    for k in 1..=steps {
        let now = gamma * k as f64 / steps as f64;
        let u = body::field(&body.mesh, |x| [now * x[1], 0.0]);
        body.follow(u, 1.0)?;
    }
    Ok(body)
}

/// Stress after simple shear to `gamma` in equal steps, the error of s_xx + s_yy = 0, and the work.
fn sheared(material: Material, gamma: f64, steps: usize) -> Result<(Pair, f64, Work), CaseError> {
    let body = sheared_body(material, gamma, steps)?;
    let s = body.block.stress_at_points()[5];
    Ok(([0.5 * (s[0] - s[1]), s[3]], s[0] + s[1], body.work))
}

fn distance(a: Pair, b: Pair) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn hypoelastic() -> Result<Material, CaseError> {
    Ok(Material::Elastic(Elastic::new(YOUNG, POISSON)?))
}

fn plastic(modulus: f64) -> Result<Material, CaseError> {
    body::j2(YOUNG, POISSON, Hardening::linear(RHO * 3.0_f64.sqrt(), modulus)?)
}

fn elastic(ledger: &mut Ledger) -> Result<(), CaseError> {
    for gamma in [1.0_f64, 4.0] {
        let exact = [1.0 - gamma.cos(), gamma.sin()];
        let (mut levels, mut last) = (Vec::new(), Cost::default());
        let mut closed = (0.0_f64, 0.0_f64);
        for steps in [50, 100, 200, 400] {
            let (outcome, cost) = Cost::measure(|| sheared(hypoelastic()?, gamma, steps));
            let (found, trace, work) = outcome?;
            let d = gamma / steps as f64;
            levels.push((d, distance(found, exact)));
            last = cost.counts(&work);
            // The integrator's own closed form.
            let theta = 2.0 * (0.25 * d).atan();
            let (amplitude, phase) = (0.5 * d / theta.sin(), 2.0 * steps as f64 * theta);
            let discrete = [amplitude * (1.0 - phase.cos()), amplitude * phase.sin()];
            closed = (closed.0.max(distance(found, discrete)), closed.1.max(trace.abs()));
        }
        let bound = 0.01 * 0.01 * gamma * gamma / 16.0 * (0.125 + gamma / 48.0);
        ledger
            .order(format!("stress over G at gamma = {gamma}, hypoelastic: s_xy = sin gamma, s_xx = 1 - cos gamma"))
            .levels(&levels)
            .expected(2.0)
            .within(0.02)
            .finest(bound, "d^2 (2/16 + gamma/48), from the closed form of the integrator: amplitude 1 + d^2/16, phase gamma (1 - d^2/48)")
            .evidence(Evidence::Exact, "z = G (1 - exp(-i gamma))")
            .because("half of the rotation before the strain increment and half after it: symmetric in time, hence order 2")
            .why_not_tighter("the error has few higher terms here; a tolerance near zero would judge those")
            .cost(&last)
            .record();
        ledger
            .claim(format!("stress over G at gamma = {gamma}, hypoelastic, against the closed form of the integrator, 50 to 400 steps"))
            .value(closed.0)
            .at_most(1e-12)
            .evidence(Evidence::Exact, "z_n = G d/(2 sin theta) (1 - exp(-2 i n theta)), theta = 2 atan(d/4)")
            .because("rounding of up to 400 steps of strains that are differences of nodal positions")
            .why_not_tighter("1e-16 for each step and operation add up at worst")
            .cost(&last)
            .record();
        ledger
            .claim(format!("|s_xx + s_yy| over G at gamma = {gamma}, hypoelastic"))
            .value(closed.1)
            .at_most(1e-12)
            .evidence(Evidence::Exact, "simple shear keeps the volume and the rate has no pressure")
            .because("rounding of up to 400 steps, multiplied by the bulk modulus, 2.2 G")
            .why_not_tighter("1e-16 for each step and operation add up at worst")
            .record();
    }
    Ok(())
}

/// Closed form of the perfectly plastic stress.
fn exact_perfect(gamma: f64) -> Pair {
    let first = 2.0 * (0.5 * RHO).asin();
    let (s, q) = ((1.0 - RHO * RHO).sqrt(), ((1.0 + RHO) / (1.0 - RHO)).sqrt());
    // The argument of 1 - exp(-i gamma) is pi/2 - gamma/2.
    let start = q * (0.5 * (0.5 * std::f64::consts::PI - 0.5 * first)).tan();
    let line = (1.0 / start).atanh() + 0.5 * s * (gamma - first) / RHO;
    let phi = 2.0 * (1.0 / (q * line.tanh())).atan();
    [RHO * phi.cos(), RHO * phi.sin()]
}

fn perfect(ledger: &mut Ledger) -> Result<(), CaseError> {
    let gamma = 0.5;
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [200, 400, 800, 1600] {
        let (outcome, cost) = Cost::measure(|| sheared(plastic(0.0)?, gamma, steps));
        let (found, _, work) = outcome?;
        levels.push((gamma / steps as f64, distance(found, exact_perfect(gamma)) / RHO));
        last = cost.counts(&work);
    }
    ledger
        .order("stress over k at gamma = 0.5, perfectly plastic")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .or_better()
        .finest(
            1.6e-4,
            "the return lags by half a step: the phase by d/2 = 1.6e-4 in the steady state and less before",
        )
        .evidence(Evidence::Exact, "hyperbolic cotangent of a line in gamma, see the README")
        .because("radial return is backward Euler in the direction of flow")
        .why_not_tighter("the error has few higher terms here; a tolerance near zero would judge those")
        .covers(&[Capability::FiniteStrain, Capability::Plasticity])
        .cost(&last)
        .record();
    let (gamma, steps) = (8.0, 1600);
    let (outcome, cost) = Cost::measure(|| sheared(plastic(0.0)?, gamma, steps));
    let (found, _, work) = outcome?;
    let cost = cost.counts(&work);
    let d = gamma / steps as f64;
    // Steady state of the scheme: G d cos(phi + theta) = k sin 2 theta.
    let theta = 2.0 * (0.25 * d).atan();
    let phi = (RHO * (2.0 * theta).sin() / d).acos() - theta;
    ledger
        .claim("stress over k at gamma = 8, perfectly plastic, against the steady state of the scheme")
        .values(&found.map(|x| x / RHO))
        .equals_each(&[phi.cos(), phi.sin()])
        .absolute(1e-12)
        .evidence(Evidence::Exact, "phi = acos(k sin(2 theta)/(G d)) - theta, the direction a step reproduces")
        .because("what is left of the start decays by exp(-s G/k) per unit of shear, to exp(-38); rounding of 1600 steps")
        .why_not_tighter("1e-16 for each step and operation add up at worst")
        .covers(&[Capability::FiniteStrain, Capability::Plasticity])
        .cost(&cost)
        .record();
    ledger
        .claim("shear stress over k at gamma = 8, perfectly plastic: no oscillation, steady state sqrt(1 - (k/G)^2)")
        .value(found[1] / RHO)
        .equals((1.0 - RHO * RHO).sqrt())
        .absolute(0.5 * d * RHO + 0.126 * d * d)
        .evidence(Evidence::Exact, "fixed point of phi' = (G/k) cos phi - 1")
        .because("a phase that lags by half a step, d/2, times the cosine k/G of the direction, and half the square of the lag")
        .covers(&[Capability::FiniteStrain, Capability::Plasticity])
        .cost(&cost)
        .record();
    Ok(())
}

/// |z| and phi of a body with linear hardening after yield.
struct Flow {
    modulus: f64,
}

impl Problem for Flow {
    fn size(&self) -> usize {
        2
    }

    fn rates(&self, _: Clock, y: &[f64], dy: &mut [f64]) {
        // Consistency: |z|' = G sin phi - sqrt(3) G e', |z|' = H e'/sqrt(3).
        let share = self.modulus / (self.modulus + 3.0);
        dy[0] = share * y[1].sin();
        dy[1] = y[1].cos() / y[0] - 1.0;
    }

    fn jacobian(&self, _: Clock, y: &[f64], jac: &mut [f64]) {
        let share = self.modulus / (self.modulus + 3.0);
        jac.copy_from_slice(&[0.0, -y[1].cos() / (y[0] * y[0]), share * y[1].cos(), -y[1].sin() / y[0]]);
    }
}

/// A sink that records nothing.
struct Silent;

impl Sink for Silent {
    fn accepted(&mut self, _: &Step<'_>) -> Control {
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}

/// Tolerance of the reference, three orders of magnitude below the bounds that use it.
const TIGHT: f64 = 1e-13;

fn integrated(modulus: f64, gamma: f64) -> Result<Pair, CaseError> {
    let first = 2.0 * (0.5 * RHO).asin();
    let start = [RHO, 0.5 * (std::f64::consts::PI - first)];
    let options = Options {
        method: Method::Dop853,
        rtol: TIGHT,
        atol: vec![TIGHT; 2],
        first_step: None,
        begin_stiff: false,
        largest_step: None,
        most_steps: 100_000,
    };
    let end = asperity_ode::integrate(
        &Flow { modulus },
        Clock::new(0.0, 0.0),
        &start,
        gamma - first,
        &options,
        &mut Silent,
    );
    if end.outcome != Outcome::Completed {
        return Err(format!("the reference: {:?}", end.outcome).into());
    }
    Ok([end.state[0] * end.state[1].cos(), end.state[0] * end.state[1].sin()])
}

fn hardening(ledger: &mut Ledger) -> Result<(), CaseError> {
    let check = integrated(0.0, 1.0)?;
    ledger
        .claim("the integrated reference without hardening against the closed form, gamma = 1")
        .value(distance(check, exact_perfect(1.0)))
        .at_most(1e-12)
        .evidence(Evidence::Exact, "hyperbolic cotangent of a line in gamma")
        .because("tolerance 1e-13 a step")
        .why_not_tighter("a check of the reference, not of the program")
        .covers(&[Capability::Integrators])
        .record();
    let modulus = 0.5;
    let gamma = 2.0;
    let exact = integrated(modulus, gamma)?;
    let (mut levels, mut last) = (Vec::new(), Cost::default());
    for steps in [200, 400, 800, 1600] {
        let (outcome, cost) = Cost::measure(|| sheared(plastic(modulus)?, gamma, steps));
        let (found, _, work) = outcome?;
        levels.push((gamma / steps as f64, distance(found, exact) / exact[0].hypot(exact[1])));
        last = cost.counts(&work);
    }
    ledger
        .order("stress at gamma = 2, relative, linear hardening H = G/2")
        .levels(&levels)
        .expected(1.0)
        .within(0.1)
        .or_better()
        .finest(6.3e-4, "the phase lags by at most half a step, d/2 = 6.25e-4")
        .evidence(
            Evidence::SemiAnalytic,
            "two equations for modulus and direction of the stress, Dormand-Prince at 1e-13",
        )
        .because("radial return is backward Euler in the direction of flow")
        .why_not_tighter("the error has few higher terms here; a tolerance near zero would judge those")
        .covers(&[Capability::FiniteStrain, Capability::Plasticity])
        .cost(&last)
        .record();
    Ok(())
}

fn plot(ledger: &mut Ledger) -> Result<(), CaseError> {
    let body = sheared_body(hypoelastic()?, 1.0, 20)?;
    body_plots::displacement(ledger, "Simple shear, gamma = 1", &body.mesh, &body.u, true)?;
    let gammas: Vec<f64> = (1..=60).map(|k| 0.1 * f64::from(k)).collect();
    let computed =
        |material: &dyn Fn() -> Result<Material, CaseError>| -> Result<Vec<(f64, f64)>, CaseError> {
            let at = |&g: &f64| Ok((g, sheared(material()?, g, (20.0 * g).round() as usize)?.0[1]));
            gammas.iter().step_by(3).map(at).collect()
        };
    let exact: Vec<(f64, f64)> = gammas.iter().map(|g| (*g, g.sin())).collect();
    // Green and Naghdi: s_xy = 2 cos 2b (2b - 2 tan 2b ln cos b - tan b), tan b = gamma/2 (Dienes 1979).
    let naghdi: Vec<(f64, f64)> = gammas
        .iter()
        .map(|g| {
            let b = (0.5 * g).atan();
            // cos 2b tan 2b = sin 2b stays finite where 2b is a right angle.
            (*g, 2.0 * ((2.0 * b).cos() * (2.0 * b - b.tan()) - 2.0 * (2.0 * b).sin() * b.cos().ln()))
        })
        .collect();
    ledger.plot(
        Plot::xy("Simple shear", "gamma [-]", "shear stress over G [-]")
            .series(Series::line("Jaumann, exact", &exact))
            .series(Series::points("hypoelastic, 20 steps per unit", &computed(&hypoelastic)?))
            .series(Series::marked("perfectly plastic, k = G/5", &computed(&|| plastic(0.0))?))
            .series(Series::marked("hardening, H = G/2", &computed(&|| plastic(0.5))?))
            .series(Series::line("Green and Naghdi, exact, not in the program", &naghdi)),
    );
    Ok(())
}
