//! Slow events of a pair of blocks without a state, whose sides move faster at times, beside a pair that creeps.

use super::spring;
use crate::cases::run_files::{Table, WrittenRun};
use crate::{CaseError, Evidence, Ledger};

/// Normal traction \[Pa\], and the friction `mu0 + a ln(V/v_ref)`.
const NORMAL: f64 = 1e6;
const A: f64 = 1e-4;
/// Rate of the plates, and that at which slow events begin; they end at half of it \[m/s\].
const PLATES: f64 = 1e-9;
const ON: f64 = 5e-8;
/// Rates of the sides past each other in three pulses, of which the second is fast \[m/s\], with the times at which they begin and
/// end \[s\].
const PULSES: [(f64, [f64; 2]); 3] = [(1e-7, [1e6, 1.2e6]), (2e-3, [2e6, 2e6 + 10.0]), (1e-7, [3e6, 3.1e6])];
const END: f64 = 4e6;

/// Motion of a side at a share of these rates, which begin with that of the plates.
fn moved(share: f64, pulses: &[(f64, [f64; 2])]) -> String {
    let mut rows = vec![(0.0, PLATES)];
    for (rate, [from, to]) in pulses {
        rows.extend([(*from, PLATES), (*from, *rate), (*to, *rate), (*to, PLATES)]);
    }
    rows.push((END, PLATES));
    let rows: Vec<String> =
        rows.iter().map(|(time, rate)| format!("[{time:?}, {:e}]", share * rate)).collect();
    format!("{{ rate = {{ table = [{}] }} }}", rows.join(", "))
}

/// Two pairs of blocks as in `pairs.toml`.
fn scene() -> String {
    let rock = |name: &str, modulus: f64| {
        format!("[materials.{name}]\nyoung = {:?}\npoisson = 0.25\ndensity = 2500\n", 2.5 * modulus)
    };
    let [soft, stiff] = super::MODULI;
    let (mut parts, mut sides) = (rock("soft", soft) + &rock("stiff", stiff), String::new());
    for (name, from, pulses) in [("drawn", -3e3, &PULSES[..]), ("creeps", -13e3, &[])] {
        for (body, rock, [left, right], side, share) in
            [("l", "soft", [-1e3, 0.0], "left", -0.5), ("r", "stiff", [0.0, 1e3], "right", 0.5)]
        {
            parts += &format!(
                "[bodies.{name}_{body}]\nmaterial = \"{rock}\"\nmesh.block = {{ min = [{left:?}, {from:?}], max = [{right:?}, {:?}], divisions = [1, 1], element = \"quad4\" }}\n",
                from + 1e3
            );
            sides += &format!("{{ set = \"{name}_{body}.{side}\", z = {} }}, ", moved(share, pulses));
        }
        parts += &format!(
            "[faults.{name}]\nminus = \"{name}_l.right\"\nplus = \"{name}_r.left\"\nnormal = {NORMAL:?}\nrate = {PLATES:e}\nlaw = {{ kind = \"rate\", mu0 = 0.6, a = {A:e}, v_ref = 1e-6 }}\n"
        );
    }
    format!(
        "schema = 1\ntitle = \"slow events\"\nkinematics = \"antiplane\"\n{parts}[[stages]]\nname = \"pulses\"\nduration = {END:?}\nconditions = [{sides}]\n\
         [time]\nstepper = \"fault-ode\"\nlog_rate_tolerance = 1e-9\n[events]\nabove = 1e-3\nslow_above = {ON:e}\n"
    )
}

/// Time that slip at `from` under a load at `load` takes to reach `to` \[s\]: `dV/dt = V k (load - V)/(a f_n)`.
fn takes([from, to]: [f64; 2], load: f64) -> f64 {
    A * NORMAL / (spring() * load) * ((load / from - 1.0) / (load / to - 1.0)).ln()
}

/// Claims the numbers of events.
fn counts(ledger: &mut Ledger, done: &WrittenRun, table: &Table) -> Result<(), CaseError> {
    let fast = done.files.table("events.csv")?.column("onset")?;
    let of_drawn = table.words("surface")?.iter().filter(|name| **name == "drawn").count();
    let off = [fast.len().abs_diff(1), table.numbers().len().abs_diff(2), of_drawn.abs_diff(2)];
    ledger
        .claim("slow events of a pair that is drawn in two slow pulses and a fast one beside a pair that creeps: events, slow events, and those on its fault, differences from one, two and two")
        .count(off.iter().sum::<usize>() as u64, 0)
        .evidence(Evidence::Exact, "the fast pulse is an event, and no slow one")
        .because("a count")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Ends of the slow events in the report \[s\].
fn reported_ends(done: &WrittenRun) -> Result<Vec<f64>, CaseError> {
    let report = serde_json::to_value(&done.report)?;
    let entries = report["slow_events"].as_array().ok_or("no slow events in the report")?;
    entries.iter().map(|e| Ok(e["end"].as_f64().ok_or("a slow event without an end")?)).collect()
}

/// Claims the slow events.
pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(&scene())?;
    let table = done.files.table("slow_events.csv")?;
    counts(ledger, &done, &table)?;
    let (mut onsets, mut ends, mut found, mut wanted) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let of = |name: &str| table.column(name);
    let (durations, slips, drops) = (of("duration")?, of("mean_slip")?, of("stress_drop")?);
    for (k, (rate, [from, to])) in [PULSES[0], PULSES[2]].into_iter().enumerate() {
        let begins = from + takes([PLATES, ON], rate);
        let after = takes([rate, 0.5 * ON], PLATES);
        // Slip is that of the load, less what the blocks are strained.
        let drop = A * NORMAL * 2f64.ln();
        let slip = rate * (to - begins) + PLATES * after + drop / spring();
        onsets.push(begins);
        ends.push(to + after);
        found.extend([durations[k], slips[k], drops[k]]);
        wanted.extend([to + after - begins, slip, drop]);
    }
    let times = of("onset")?;
    let interval = table.words("interval")?;
    let second: f64 = interval[1].parse()?;
    ledger
        .claim("the slow events: onsets, and the interval between them")
        .unit("s")
        .values(&[times[0], times[1], second])
        .equals_each(&[onsets[0], onsets[1], onsets[1] - onsets[0]])
        .absolute(2e-5)
        .evidence(Evidence::Exact, "dV/dt = V k (W - V)/(a f_n), a logistic curve")
        .because("an error of ln V of 1e-9 in each of some hundred steps is 1e-7 of the time in which V grows, which is 125 s")
        .why_not_tighter("errors of steps add up by chance")
        .cost(&done.cost)
        .record();
    ledger
        .claim("the slow events: ends, in the table and in the report")
        .unit("s")
        .values(&[of("end")?, reported_ends(&done)?].concat())
        .equals_each(&ends.repeat(2))
        .absolute(2e-5)
        .evidence(Evidence::Exact, "the same curve, towards the rate of the plates")
        .because("as for the onsets")
        .why_not_tighter("errors of steps add up by chance")
        .cost(&done.cost)
        .record();
    ledger
        .claim("the slow events: durations, slip and stress drops, over those of the closed form")
        .values(&found.iter().zip(&wanted).map(|(a, b)| a / b).collect::<Vec<_>>())
        .equals_each(&[1.0; 6])
        .relative(2e-7)
        .evidence(
            Evidence::Exact,
            "the same curve; slip is that of the load less a change of friction over the stiffness",
        )
        .because("an error of ln V of 1e-9 in each of some hundred steps, over ln 2")
        .why_not_tighter("errors of steps add up by chance")
        .cost(&done.cost)
        .record();
    Ok(())
}
