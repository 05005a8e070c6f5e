use asperity_cycles::Thresholds;
use asperity_cycles::slider::{Problem, run};
use asperity_friction::evolution::{Evolution, ageing::Ageing};
use asperity_friction::rate::RateLaw;
use asperity_friction::slider::{History, Slider, System};
use asperity_friction::strength::{Parameters, regularised::Regularised};
use std::sync::Arc;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (v_ref, load) = (1e-6, 1e-6);
    let ageing = Ageing::new(0.015, 1e-5, v_ref)?;
    let law = RateLaw::new(Regularised(Parameters::new(0.6, 0.010, v_ref)?), ageing, v_ref, None)?;
    let block = Slider {
        law: Arc::new(law),
        stiffness: 1.25e9,
        damping: 5e6,
        mass: None,
        normal: History::Constant(5e6),
    };
    let system = System::new(vec![block], vec![], History::Constant(load))?;
    let state = ageing.steady(f64::ln(load));
    let start = system.start(&[1.5 * load], &[vec![state]])?;

    let mut problem = Problem::new(system, start, 4000.0);
    problem.events = Some(Thresholds { on: 1e-3, off: 1e-4 });
    problem.most_events = Some(10);
    problem.peaks = true;
    let found = run(&problem, &mut ())?;
    for event in found.catalogue.events(0) {
        println!("{:.6} s, {:?}, {:e} m/s", event.onset.seconds(), event.interval, event.peak);
    }
    println!("{:?}, {} right-hand sides", found.outcome, found.counts.rates);
    Ok(())
}
