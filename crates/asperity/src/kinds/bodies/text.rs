//! Results of a run of bodies as text.

use super::passages::Passage;
use super::report::RunReport;
use crate::catalogue::unended;
use asperity_output::decimals::fixed;

impl RunReport {
    /// Summary to be read at the end of the run.
    #[must_use]
    pub fn text(&self) -> String {
        summary(self)
    }
}

fn summary(report: &RunReport) -> String {
    let mut text = String::from("results\n");
    for r in &report.results {
        text.push_str(&format!(
            "  {} after `{}`: mean normal traction {} MPa, mean shear traction {} MPa, slip {} to {} um, friction {} to {}\n",
            r.interface,
            r.stage,
            fixed(r.mean_normal_traction / 1e6, 6),
            fixed(r.mean_shear_traction / 1e6, 6),
            fixed(r.slip[0] * 1e6, 4),
            fixed(r.slip[1] * 1e6, 4),
            fixed(r.friction[0], 4),
            fixed(r.friction[1], 4),
        ));
    }
    for p in &report.points {
        text.push_str(&format!(
            "  point {} after `{}`: displacement {} m, Mises stress {}\n",
            p.point.name,
            p.stage,
            triple(&p.values.displacement),
            pressure(p.values.mises)
        ));
    }
    for f in &report.forces {
        text.push_str(&format!(
            "  force {} on `{}` after `{}`: {} {}\n",
            f.force.name,
            f.force.set,
            f.stage,
            triple(&f.value),
            f.unit
        ));
    }
    if let Some(events) = &report.events {
        text.push_str(&format!("  {} events of interfaces\n", events.all.len()));
        if let Some(onset) = events.under_way {
            text.push_str(&format!("  {}\n", unended(onset)));
        }
    }
    text.push_str(&format!("  {}\n", report.energy.text()));
    if !report.passages.is_empty() {
        let most = |of: fn(&Passage) -> f64| report.passages.iter().map(of).fold(0.0, f64::max);
        text.push_str(&format!(
            "  inertia acted {} times in {} steps; equilibrium left out up to {:.1e} of the largest force before, and {:.1e} of the largest \
             kinetic energy was lost after\n",
            report.passages.len(),
            report.passages.iter().map(|p| p.steps).sum::<usize>(),
            most(|p| p.left_out),
            most(|p| p.lost.abs()),
        ));
    }
    let c = &report.counts;
    text.push_str(&format!(
        "  {} steps ({} rejected), {} iterations{}, {} factorisations, {} body solves\n",
        c.steps,
        c.rejected,
        c.operations.iterations,
        if c.operations.augmentations > 0 {
            format!(", {} augmentations", c.operations.augmentations)
        } else {
            String::new()
        },
        c.operations.factorisations,
        c.operations.body_solves
    ));
    let s = &report.seconds;
    text.push_str(&format!(
        "  seconds: plan {:.2}, set-up {:.2}, steps {:.2}, output {:.2}\n",
        s.plan, s.set_up, s.steps, s.output
    ));
    text
}

/// Vector with seven digits of its largest component.
pub fn triple(v: &[f64; 3]) -> String {
    let largest = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let exponent = if largest > 0.0 && largest.is_finite() { largest.log10().floor() as i32 } else { 0 };
    // Plain notation if it needs few zeros; otherwise a common power of ten.
    let power = if (-3..7).contains(&exponent) { 0 } else { exponent };
    let digits = (6 - (exponent - power)).max(0);
    let fine = 10f64.powi(digits);
    // Adding zero turns -0 into 0.
    let part = |c: f64| (c / 10f64.powi(power) * fine).round() / fine + 0.0;
    let parts = v.map(|c| format!("{:.*}", digits as usize, part(c)));
    let tail = if power == 0 { String::new() } else { format!("e{power}") };
    format!("({}){tail}", parts.join(", "))
}

/// Pressure in the largest unit in which it is at least one.
pub fn pressure(p: f64) -> String {
    let units = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)];
    let (name, unit) = units.into_iter().find(|(_, unit)| p.abs() >= *unit).unwrap_or(("Pa", 1.0));
    format!("{} {name}", fixed(p / unit, 6))
}
