//! Every rate-and-state law that slider scenes can name: velocity steps in closed form, cycles and holds on a spring.

use super::slider::{Independent, MU0, V_REF};
use super::slider_scene::{FRICTION, RATE, TIME, files, plan, text};
use crate::{Axis, Capability, Case, CaseError, Cost, Evidence, Ledger, Plot, Series};

/// See the README.
pub const CASE: Case = Case {
    name: "slider_laws",
    readme: include_str!("README.md"),
    covers: &[Capability::Slider, Capability::LawFamily],
    quick: true,
    run,
};

const A: f64 = 0.01;
const B: f64 = 0.015;
/// L \[m\].
const LENGTH: f64 = 1e-5;
/// c of the law of Nagata et al.
const C: f64 = 2.0;
/// Weakened coefficient, and rate \[m/s\] at which flash heating sets in.
const MU_W: f64 = 0.2;
const V_W: f64 = 0.05;
/// Cut-off rates of the direct effect and of the evolution effect \[m/s\].
const V_CUT: f64 = 0.02;
const V_CUT_STATE: f64 = 1e-6;
/// Activation energy \[J/mol\], reference temperature of the parameters \[K\], and temperature \[K\].
const ACTIVATION: f64 = 90e3;
const T_REF: f64 = 300.0;
const TEMPERATURE: f64 = 350.0;
/// Molar gas constant \[J/(mol K)\]: Avogadro's and Boltzmann's constants, which define the SI.
const GAS: f64 = 6.022_140_76e23 * 1.380_649e-23;
/// Source of the references on a spring.
const SOURCE: &str =
    "verification/independent/slider_laws.py: Taylor series of order 20 (heyoka) and scipy's DOP853 agree";

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let reference = Independent::read_laws()?;
    for state in STATES {
        velocity_steps(ledger, state)?;
    }
    rate_alone(ledger)?;
    heat(ledger)?;
    for (name, own, spring) in SPRINGS {
        cycles(ledger, &reference, (name, own, spring))?;
        hold(ledger, &reference, (name, own))?;
    }
    steady_plot(ledger)
}

/// Evolution laws, as scenes name them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Ageing,
    AgeingWithCutOff,
    Slip,
    Prz,
    Nagata,
    Flash,
}

const STATES: [State; 6] =
    [State::Ageing, State::AgeingWithCutOff, State::Slip, State::Prz, State::Nagata, State::Flash];

/// Forms of the strength.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Bare,
    Regularised,
    CutOff,
}

const FORMS: [Form; 3] = [Form::Bare, Form::Regularised, Form::CutOff];

impl Form {
    /// Keys in a scene.
    fn keys(self) -> String {
        match self {
            Self::Bare => "form = \"bare\"".into(),
            Self::Regularised => "form = \"regularised\"".into(),
            Self::CutOff => format!("form = \"cut-off\", v_cut = {V_CUT:e}"),
        }
    }

    /// μ at a slip rate \[m/s\], already times the factor of temperature, with the contribution φ of the state.
    fn friction(self, rate: f64, phi: f64) -> f64 {
        match self {
            Self::Bare => MU0 + phi + A * (rate / V_REF).ln(),
            Self::Regularised => A * (rate / (2.0 * V_REF) * ((MU0 + phi) / A).exp()).asinh(),
            Self::CutOff => MU0 + phi - A * (V_CUT / rate).ln_1p(),
        }
    }
}

impl State {
    /// Name in claims.
    fn title(self) -> &'static str {
        match self {
            Self::Ageing => "ageing law",
            Self::AgeingWithCutOff => "ageing law with a cut-off of the state",
            Self::Slip => "slip law",
            Self::Prz => "PRZ law",
            Self::Nagata => "Nagata law",
            Self::Flash => "flash heating",
        }
    }

    /// Closed form of the state.
    fn formula(self) -> &'static str {
        match self {
            Self::Ageing => "theta = L/V + (theta_0 - L/V) e^(-V t/L), phi = b ln(Vref theta/L)",
            Self::AgeingWithCutOff => "theta = L/V + (theta_0 - L/V) e^(-V t/L), phi = b ln(1 + V2 theta/L)",
            Self::Slip => "phi = phi_ss + (phi_0 - phi_ss) e^(-V t/L), phi_ss = -b ln(V/Vref)",
            Self::Prz => "V theta/2L = tanh or coth of V t/2L + const",
            Self::Nagata => {
                "phi + c mu keeps its value where V jumps; theta = L/V + (theta_0 - L/V) e^(-V t/[L (1 + c)])"
            }
            Self::Flash => {
                "phi = phi_ss + (phi_0 - phi_ss) e^(-V t/L), phi_ss = mu_w + (mu_lv - mu_w)/[1 + (V/V_w)^8]^(1/8) - mu0 - a ln(V/Vref)"
            }
        }
    }

    /// Keys in a scene.
    fn keys(self) -> String {
        match self {
            Self::Ageing => "evolution = \"ageing\"".into(),
            Self::AgeingWithCutOff => format!("evolution = \"ageing\", v_cut_state = {V_CUT_STATE:e}"),
            Self::Slip => "evolution = \"slip\"".into(),
            Self::Prz => "evolution = \"prz\"".into(),
            Self::Nagata => format!("evolution = \"nagata\", c = {C}"),
            Self::Flash => format!("evolution = \"flash\", mu_w = {MU_W}, v_w = {V_W}"),
        }
    }

    /// State in steady sliding: φ of the slip law and of flash heating, θ \[s\] of the others.
    fn steady(self, rate: f64) -> f64 {
        match self {
            Self::Ageing | Self::AgeingWithCutOff | Self::Nagata => LENGTH / rate,
            Self::Prz => 2.0 * LENGTH / rate,
            Self::Slip => -B * (rate / V_REF).ln(),
            Self::Flash => {
                let weak = (1.0 + (rate / V_W).powi(8)).powf(-0.125);
                MU_W + (MU0 + (A - B) * (rate / V_REF).ln() - MU_W) * weak - MU0 - A * (rate / V_REF).ln()
            }
        }
    }

    /// Contribution φ of a state to friction.
    fn phi(self, state: f64) -> f64 {
        match self {
            Self::Ageing | Self::Nagata => B * (V_REF * state / LENGTH).ln(),
            Self::AgeingWithCutOff => B * (V_CUT_STATE * state / LENGTH).ln_1p(),
            Self::Prz => B * (V_REF * state / (2.0 * LENGTH)).ln(),
            Self::Slip | Self::Flash => state,
        }
    }

    /// State after a jump of the rest of the friction coefficient by `jump`: `φ + c μ` is continuous. This takes μ as a
    /// sum with φ, from which the regularised form differs by e^(-2 μ/a), below 1e-30 here.
    fn after_jump(self, state: f64, jump: f64) -> f64 {
        if self == Self::Nagata { state * (-C / (1.0 + C) * jump / B).exp() } else { state }
    }

    /// State after `time` at a constant slip rate.
    fn after(self, state: f64, rate: f64, time: f64) -> f64 {
        let (steady, x) = (self.steady(rate), rate * time / LENGTH);
        match self {
            Self::Ageing | Self::AgeingWithCutOff | Self::Slip | Self::Flash => {
                steady + (state - steady) * (-x).exp()
            }
            Self::Nagata => steady + (state - steady) * (-x / (1.0 + C)).exp(),
            Self::Prz => {
                let u = state / steady;
                // A steady state does not evolve.
                if u == 1.0 {
                    steady
                } else if u < 1.0 {
                    steady * (0.5 * x + u.atanh()).tanh()
                } else {
                    steady / (0.5 * x + (1.0 / u).atanh()).tanh()
                }
            }
        }
    }
}

/// Durations \[s\] and slip rates \[m/s\]: steps by factors of ten and a hundred, and steps to V_w, far above it and
/// below it again.
const SLOW: [(f64, f64); 3] = [(20.0, 1e-6), (10.0, 1e-5), (170.0, 1e-7)];
const FAST: [(f64, f64); 4] = [(1e-4, 1e-6), (2e-4, V_W), (2e-5, 1.0), (5e-3, 0.01)];
/// Fractions of a stage at which friction is read. The first is just after the jump, where V t/L is below 1e-4.
const SHARES: [f64; 8] = [1e-6, 0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0];

/// Factor that multiplies slip rates for temperature.
fn factor(hot: bool) -> f64 {
    if hot { (ACTIVATION / GAS * (1.0 / TEMPERATURE - 1.0 / T_REF)).exp() } else { 1.0 }
}

/// Keys of temperature in a scene.
fn heat_keys(hot: bool) -> String {
    if hot {
        format!(", activation = {ACTIVATION}, t_ref = {T_REF}, temperature = {TEMPERATURE}")
    } else {
        String::new()
    }
}

/// A rate-and-state law in a scene, steady at 1 um/s.
fn law(state: State, form: Form, hot: bool) -> String {
    format!(
        "{{ kind = \"rate-and-state\", mu0 = {MU0}, a = {A}, b = {B}, l = {LENGTH:e}, v_ref = {V_REF:e}, v_initial = \"1 um/s\", {}, {}{} }}",
        form.keys(),
        state.keys(),
        heat_keys(hot)
    )
}

/// Times at which friction is read, each with its stage and the time since the stage began.
fn instants(course: &[(f64, f64)]) -> Vec<(f64, usize, f64)> {
    let (mut begin, mut all) = (0.0, Vec::new());
    for (stage, (duration, _)) in course.iter().enumerate() {
        all.extend(SHARES.iter().map(|share| (begin + share * duration, stage, share * duration)));
        begin += duration;
    }
    all
}

/// Friction at the instants of an imposed course, from the history of a scene.
fn imposed(course: &[(f64, f64)], law: &str) -> Result<Vec<f64>, CaseError> {
    let (mut begin, mut table) = (0.0, Vec::new());
    for (duration, rate) in course {
        table.push(format!("[\"{begin:?} s\", \"{rate:e} m/s\"]"));
        begin += duration;
        table.push(format!("[\"{begin:?} s\", \"{rate:e} m/s\"]"));
    }
    let times: Vec<f64> = instants(course).iter().map(|i| i.0).collect();
    let rest = format!("[time]\nend = {begin:?}\ntolerance = 1e-12\n[output]\ntimes = {times:?}");
    let slider = format!("rate = {{ table = [{}] }}", table.join(", "));
    let [rows, _] = files(&plan(&text("", &slider, law, &rest))?)?;
    let at = |time: &f64| rows.iter().find(|row| row[TIME] == *time).map_or(f64::NAN, |row| row[FRICTION]);
    Ok(times.iter().map(at).collect())
}

/// Friction at the same instants in closed form.
fn closed(course: &[(f64, f64)], state: State, form: Form, hot: bool) -> Vec<f64> {
    let rest = |rate: f64| form.friction(rate * factor(hot), 0.0);
    let mut begins = vec![state.steady(course[0].1)];
    for pair in course.windows(2) {
        let [(duration, rate), (_, next)] = [pair[0], pair[1]];
        let end = state.after(begins[begins.len() - 1], rate, duration);
        begins.push(state.after_jump(end, rest(next) - rest(rate)));
    }
    let at = |&(_, stage, since): &(f64, usize, f64)| {
        let rate = course[stage].1;
        form.friction(rate * factor(hot), state.phi(state.after(begins[stage], rate, since)))
    };
    instants(course).iter().map(at).collect()
}

/// Claims on friction through velocity steps, with each form of the strength, at two temperatures.
fn velocity_steps(ledger: &mut Ledger, state: State) -> Result<(), CaseError> {
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    let (done, cost) = Cost::measure(|| -> Result<(), CaseError> {
        for course in [&SLOW[..], &FAST] {
            for form in FORMS {
                for hot in [false, true] {
                    found.extend(imposed(course, &law(state, form, hot))?);
                    expected.extend(closed(course, state, form, hot));
                }
            }
        }
        Ok(())
    });
    done?;
    ledger
        .claim(format!(
            "{}: friction through imposed velocity steps, three forms of the strength, two temperatures, {} values",
            state.title(),
            found.len()
        ))
        .values(&found)
        .equals_each(&expected)
        .absolute(1e-10 * A)
        .evidence(Evidence::Exact, state.formula())
        .because("errors of ln V and, to the same effect, of states of 1e-12 a step, over a hundred steps")
        .why_not_tighter("the order of the sum of errors of steps is what is known")
        .covers(&[Capability::LawFamily, Capability::Slider])
        .cost(&cost)
        .record();
    Ok(())
}

/// A law without a state.
fn rate_alone(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    for form in FORMS {
        for hot in [false, true] {
            let law = format!(
                "{{ kind = \"rate\", mu0 = {MU0}, a = {A}, v_ref = {V_REF:e}, {}{} }}",
                form.keys(),
                heat_keys(hot)
            );
            found.extend(imposed(&FAST, &law)?);
            expected.extend(instants(&FAST).iter().map(|i| form.friction(FAST[i.1].1 * factor(hot), 0.0)));
        }
    }
    ledger
        .claim("law without a state: friction through imposed velocity steps, three forms, two temperatures")
        .values(&found)
        .equals_each(&expected)
        .absolute(1e-15)
        .evidence(Evidence::Exact, "the strength at the rate imposed")
        .because("rounding of friction of 0.6, some times")
        .why_not_tighter("a few units in the last place")
        .covers(&[Capability::VelocityFriction, Capability::Slider])
        .record();
    Ok(())
}

/// Decrease of steady friction with temperature.
fn heat(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut lost = Vec::new();
    for state in STATES {
        for form in [Form::Bare, Form::Regularised] {
            let at = |hot| -> Result<f64, CaseError> { Ok(imposed(&SLOW, &law(state, form, hot))?[0]) };
            lost.push(at(false)? - at(true)?);
        }
    }
    let expected = A * ACTIVATION / GAS * (1.0 / T_REF - 1.0 / TEMPERATURE);
    ledger
        .claim("six laws, two forms: friction in steady sliding at 300 K less that at 350 K, Q = 90 kJ/mol")
        .values(&lost)
        .equals_each(&vec![expected; lost.len()])
        .absolute(1e-15)
        .evidence(Evidence::Exact, "a (Q/R)(1/T_ref - 1/T): a hot fault is weaker (Chester 1994)")
        .because("rounding of friction of 0.6, some times; the regularised form differs by a e^(-2 mu/a)")
        .why_not_tighter("a few units in the last place")
        .covers(&[Capability::LawFamily])
        .record();
    Ok(())
}

/// Laws for runs on a spring: names, keys, and half the critical stiffness \[Pa/m\].
const SPRINGS: [(&str, &str, f64); 3] = [
    ("prz", "", 0.5 * CRITICAL),
    ("nagata", ", c = 2.0", 0.5 * CRITICAL / (1.0 + C)),
    ("flash", ", mu_w = 0.2, v_w = \"0.05 m/s\"", 0.5 * CRITICAL),
];
/// Critical stiffness f_n (b - a)/L \[Pa/m\].
const CRITICAL: f64 = 5e6 * (B - A) / LENGTH;

/// A slider on a spring of the given stiffness \[Pa/m\].
fn on_spring(load: &str, (name, own): (&str, &str), (stiffness, more): (f64, &str), rest: &str) -> String {
    let law = format!(
        "{{ kind = \"rate-and-state\", evolution = \"{name}\", mu0 = {MU0}, a = {A}, b = {B}, l = {LENGTH:e}, v_ref = {V_REF:e}, v_initial = \"1 um/s\"{own} }}"
    );
    text(load, &format!("stiffness = {stiffness:e}\ndamping = \"5 MPa s/m\"\n{more}"), &law, rest)
}

/// Claims on stick-slip at half the critical stiffness: onsets, and extremes of the slip rate.
fn cycles(
    ledger: &mut Ledger,
    reference: &Independent,
    (name, own, stiffness): (&str, &str, f64),
) -> Result<(), CaseError> {
    let case = format!("cycles_{name}");
    let expected = reference.numbers(&case, "crossings_s")?;
    let rest = format!(
        "[time]\nend = 1e9\ntolerance = 1e-13\n[events]\nabove = \"1 mm/s\"\nstop_after = {}",
        expected.len()
    );
    let scene =
        on_spring("[load]\nrate = \"1 um/s\"", (name, own), (stiffness, "start = \"1.5 um/s\""), &rest);
    let (read, cost) = Cost::measure(|| files(&plan(&scene)?));
    let [_, events] = read?;
    let found: Vec<f64> = events.iter().map(|e| e[1]).collect();
    let recurrence = expected[expected.len() - 1] - expected[expected.len() - 2];
    let error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs() / recurrence).fold(0.0, f64::max);
    ledger
        .claim(format!("{name}, k = k_c/2: times of {} events, error over the recurrence", expected.len()))
        .value(if found.len() == expected.len() { error } else { f64::NAN })
        .at_most(1e-11)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("a tolerance of 1e-13 a step, amplified by what an event does to the time of the next")
        .why_not_tighter("how much an event amplifies is known by its order only")
        .covers(&[Capability::LawFamily, Capability::Slider, Capability::Events])
        .cost(&cost)
        .record();
    // The peak rate of the last event but one, and the least rate before the last event.
    let [.., before, last] = &events[..] else { return Ok(()) };
    let [peak, least] = [before[5], last[6]];
    let wanted = [
        reference.number(&case, "v_max_between_last_two")?.ln(),
        reference.number(&case, "v_min_between_last_two")?.ln(),
    ];
    ledger
        .claim(format!("{name}, k = k_c/2: ln V at the peak and at the least of the last cycle"))
        .values(&[peak.ln(), least.ln()])
        .equals_each(&wanted)
        .absolute(1e-11)
        .evidence(Evidence::OtherCode, SOURCE)
        .because("a tolerance of 1e-13 a step, over a hundred steps; extremes are found to second order")
        .why_not_tighter("the order of the sum of errors of steps is what is known")
        .covers(&[Capability::LawFamily, Capability::Slider, Capability::Events])
        .cost(&cost)
        .record();
    Ok(())
}

/// Slide-hold-slide on a spring of five times f_n (b - a)/L.
fn hold(ledger: &mut Ledger, reference: &Independent, law: (&str, &str)) -> Result<(), CaseError> {
    let case = format!("hold_{}", law.0);
    let times = reference.numbers(&case, "t_s")?;
    let load =
        "[load]\nrate = { table = [[\"0 s\", \"0 m/s\"], [\"100 s\", \"0 m/s\"], [\"100 s\", \"1 um/s\"]] }";
    let rest = format!("[time]\nend = \"200 s\"\ntolerance = 1e-13\n[output]\ntimes = {times:?}");
    let scene = on_spring(load, law, (5.0 * CRITICAL, "start = \"1 um/s\""), &rest);
    let (read, cost) = Cost::measure(|| files(&plan(&scene)?));
    let [rows, _] = read?;
    let at = |time: &f64, column: usize| {
        rows.iter().find(|row| row[TIME] == *time).map_or(f64::NAN, |row| row[column])
    };
    let rates: Vec<f64> = times.iter().map(|t| at(t, RATE).ln()).collect();
    let frictions: Vec<f64> = times.iter().map(|t| at(t, FRICTION)).collect();
    let wanted: Vec<f64> = reference.numbers(&case, "v")?.iter().map(|v| v.ln()).collect();
    for (what, found, expected, bound) in
        [("ln V", rates, wanted, 1e-11), ("friction", frictions, reference.numbers(&case, "mu")?, 1e-11 * A)]
    {
        ledger
            .claim(format!("{}, hold of 100 s and sliding again, k = 5 k_c: {what} at 11 times", law.0))
            .values(&found)
            .equals_each(&expected)
            .absolute(bound)
            .evidence(Evidence::OtherCode, SOURCE)
            .because(
                "a tolerance of 1e-13 a step of ln V, and of a times that for friction, over a hundred steps",
            )
            .why_not_tighter("the order of the sum of errors of steps is what is known")
            .covers(&[Capability::LawFamily, Capability::Slider])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Plots friction through the slow course.
fn steady_plot(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut plot =
        Plot::xy("Steps of the slip rate: 1, 10, 0.1 um/s", "time [s]", "friction coefficient [-]")
            .axes(Axis::Linear, Axis::Linear);
    for state in [State::Ageing, State::Slip, State::Prz, State::Nagata] {
        let found = imposed(&SLOW, &law(state, Form::Regularised, false))?;
        let points: Vec<(f64, f64)> = instants(&SLOW).iter().map(|i| i.0).zip(found).collect();
        plot = plot.series(Series::line(state.title(), &points));
    }
    ledger.plot(plot.caption("From the history of a scene with an imposed slip rate."));
    Ok(())
}
