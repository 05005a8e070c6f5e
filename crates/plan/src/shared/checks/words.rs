//! Text of the checks.

use super::{BodyCheck, Checks, FaultCheck, InterfaceCheck, MachineCheck, SetCheck, SliderCheck};
use crate::shared::resolution::Softening;
use asperity_scene::lengths::brief;
use std::fmt::{self, Write as _};

/// Noun with its count.
fn count(n: usize, one: &str) -> String {
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}

/// Smallest and largest length as text; one if they are the same to the digits shown.
fn between(range: [f64; 2]) -> String {
    let [least, most] = range.map(brief);
    if least == most { least } else { format!("{least} to {most}") }
}

/// Distance of a station from its point over the distance of points that is rounding of coordinates.
const AT_POINT: f64 = 1e-9;

/// Position as text.
fn position(at: &[f64]) -> String {
    let parts: Vec<String> = at.iter().map(|x| brief(*x)).collect();
    if let [one] = parts.as_slice() { one.clone() } else { format!("({})", parts.join(", ")) }
}

/// Pressure in the unit that fits.
fn pressure(p: f64) -> String {
    let units = [("GPa", 1e9), ("MPa", 1e6), ("kPa", 1e3)];
    let (name, unit) = units.into_iter().find(|(_, unit)| p.abs() >= *unit).unwrap_or(("Pa", 1.0));
    format!("{:.4} {name}", p / unit)
}

impl BodyCheck {
    fn words(&self) -> String {
        let Self { body, from, to, nodes, cells, edges: [short, long] } = self;
        let axis = |(c, (a, b)): (usize, (&f64, &f64))| {
            format!("{} {} to {}", ["x", "y", "z"][c], brief(*a), brief(*b))
        };
        let extent: Vec<String> = from.iter().zip(to).enumerate().map(axis).collect();
        let edges = between([*short, *long]);
        format!(
            "`{body}`: {}; {}, {}, edges {edges}",
            extent.join(", "),
            count(*nodes, "node"),
            count(*cells, "cell")
        )
    }
}

/// Area, or length in the plane.
fn area(value: f64, in_space: bool) -> String {
    if in_space { format!("{value:.4e} m²") } else { brief(value) }
}

impl SetCheck {
    fn words(&self, in_space: bool) -> String {
        let Self { set, used, faces, nodes, area: size } = self;
        if let Some(nodes) = nodes {
            return format!("`{set}` ({}): {}", used.join(", "), count(*nodes, "node"));
        }
        format!("`{set}` ({}): {}, {}", used.join(", "), count(*faces, "face"), area(*size, in_space))
    }
}

/// Stability on a spring of a surface whose critical stiffness is not a number.
fn stability(softening: Softening) -> &'static str {
    match softening {
        Softening::None => "friction does not weaken, so that steady sliding is stable on any spring",
        Softening::Drop => "friction drops at once where slip begins, which no spring holds",
        Softening::Unknown | Softening::Gradual => {
            "the critical stiffness of its law is not known in advance"
        }
    }
}

impl MachineCheck {
    fn words(&self, of: &str) -> String {
        let k = format!("{of}: springs of {:.4e} Pa/m", self.stiffness);
        let Some(normal) = self.critical_normal else {
            return format!("{k}; {}", stability(self.softening));
        };
        match self.critical {
            Some(critical) => {
                let ratio = self.stiffness / critical;
                let unstable = "steady sliding is unstable";
                let condition = if ratio < 1.0 { "" } else { " only if the bodies are soft" };
                format!("{k} are {ratio:.4} of the critical {critical:.4e} Pa/m: {unstable}{condition}")
            }
            None => {
                format!("{k} are critical under {}: steady sliding is unstable under more", pressure(normal))
            }
        }
    }
}

impl InterfaceCheck {
    fn lines(&self, in_space: bool) -> Vec<(&'static str, String)> {
        let Self { interface, points, faces: [slave, master], area: size, .. } = self;
        let mut lines = vec![(
            "interface",
            format!(
                "`{interface}`: {} over {}, {} against {master}",
                count(*points, "point"),
                area(*size, in_space),
                count(*slave, "face")
            ),
        )];
        if let Some(w) = &self.weakening {
            let apart = format!("points at most {} apart, at {}", brief(w.spacing), position(&w.at));
            let text = match (&w.normal, &w.cohesive_zone, &w.nucleation) {
                (Some(normal), Some(zone), Some(nucleation)) => format!(
                    "{:.1} to the cohesive zone of {} and {:.1} to the nucleation length of {} under {}",
                    zone.points,
                    brief(zone.length),
                    nucleation.points,
                    brief(nucleation.length),
                    pressure(*normal)
                ),
                _ => {
                    let [zone, nucleation] = w.one_point.map(pressure);
                    format!(
                        "one to the cohesive zone under {zone}, and one to the nucleation length under {nucleation}"
                    )
                }
            };
            lines.push(("lengths", format!("`{interface}`: {text}; {apart}")));
        }
        lines.extend(self.machine.iter().map(|m| ("machine", m.words(&format!("`{interface}`")))));
        lines
    }
}

impl FaultCheck {
    /// Description of the stations by the one that is farthest from its point.
    fn farthest(&self) -> Option<String> {
        let far = self.stations.iter().max_by(|a, b| a.off.total_cmp(&b.off))?;
        let all = count(self.stations.len(), "station");
        Some(if far.off <= AT_POINT * self.spacing[0] {
            format!("{all} at points")
        } else {
            format!("{all}, at most {} from their points, at {}", brief(far.off), position(&far.requested))
        })
    }

    fn lines(&self, in_space: bool) -> Vec<(&'static str, String)> {
        let name = &self.fault;
        let prescribed = match self.prescribed {
            0 => String::new(),
            1 => "; 1 creeps or is locked".to_string(),
            n => format!("; {n} creep or are locked"),
        };
        let weakening = match self.weakening_points {
            0 => "friction weakens nowhere".to_string(),
            n => format!("friction weakens at {n}, over {}", area(self.weakening_area, in_space)),
        };
        let spacing = between(self.spacing);
        let mut lines = vec![(
            "fault",
            format!(
                "`{name}`: {} over {}, {spacing} apart{prescribed}; {weakening}",
                count(self.points, "sliding point"),
                area(self.area, in_space)
            ),
        )];
        lines.extend(self.resolution.iter().map(|r| ("lengths", r.words(in_space))));
        for p in &self.profiles {
            let beyond =
                if p.beyond == 0 { String::new() } else { format!(", {} beyond its ends", p.beyond) };
            lines.push(("profile", format!("`{name}`, `{}`: {}{beyond}", p.key, count(p.points, "point"))));
        }
        for (k, p) in self.patches.iter().enumerate() {
            let edge = if p.edge == 0 { String::new() } else { format!(", {} in its edge", p.edge) };
            lines.push(("patch", format!("`{name}`, number {}: {}{edge}", k + 1, count(p.points, "point"))));
        }
        lines.extend(self.farthest().map(|words| ("station", format!("`{name}`: {words}"))));
        if let Some(rate) = self.loading {
            let sense = if rate > 0.0 { "along" } else { "against" };
            lines.push((
                "load",
                format!("`{name}`: loads drive it {sense} `rate`, {rate:.4e} Pa/s in the mean"),
            ));
        }
        lines.extend(self.machine.iter().map(|m| ("machine", m.words(&format!("`{name}`")))));
        lines
    }
}

impl SliderCheck {
    fn words(&self) -> String {
        let Self { slider, stiffness, critical, unstable } = self;
        let result = if *unstable { "unstable" } else { "stable" };
        format!(
            "`{slider}`: springs of {stiffness:.4e} Pa/m against the critical {critical:.4e}: steady sliding is {result}"
        )
    }
}

impl fmt::Display for Checks {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = String::from("checks\n");
        let in_space = self.in_space;
        let mut lines: Vec<(&str, String)> = self.bodies.iter().map(|b| ("body", b.words())).collect();
        lines.extend(self.sets.iter().map(|s| ("set", s.words(in_space))));
        lines.extend(self.interfaces.iter().flat_map(|i| i.lines(in_space)));
        lines.extend(self.faults.iter().flat_map(|i| i.lines(in_space)));
        lines.extend(self.sliders.iter().map(|s| ("machine", s.words())));
        lines.extend(self.cost.words().into_iter().map(|w| ("cost", w)));
        for (name, value) in lines {
            writeln!(text, "  {name:<9} {value}")?;
        }
        f.write_str(&text)
    }
}
