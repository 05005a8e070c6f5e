//! Plausibility of every value of a scene that has a dimension, by one table: values are found by the schema of scenes, so that
//! every key of a unit is judged as soon as it exists.

mod table;

pub use table::covers;

use crate::diagnostic::Diagnostic;
use crate::keys::{Tree, Visited as Step, Visitor, visit, written};
use crate::model::Scene;
use crate::units;
use asperity_run::Warning;
use serde_json::Value as Schema;
use std::collections::BTreeSet;
use std::ops::Range;
use table::{Quantity, RefusalBound, quantity};
use toml_edit::{Document, Value};

/// Speed that shear waves exceed in no rock of the crust or the upper mantle \[m/s\] (PREM; Dziewonski & Anderson 1981).
pub(crate) const ANY_ROCK: f64 = 5e3;

/// Facts about a scene beside its values.
#[derive(Clone, Copy, Debug)]
pub struct SceneFacts {
    /// True for a scene of spring-sliders.
    pub sliders: bool,
    /// True if it has faults.
    pub faults: bool,
    /// Speed of shear waves in its fastest material \[m/s\].
    pub waves: f64,
}

impl SceneFacts {
    /// A scene of spring-sliders.
    pub const SLIDERS: Self = Self { sliders: true, faults: false, waves: ANY_ROCK };

    /// A scene of bodies or of faults.
    #[must_use]
    pub fn from_scene(scene: &Scene) -> Self {
        let speed = |m: &crate::model::Material| {
            let shear = m.young.get_ref().0 / (2.0 * (1.0 + m.poisson.get_ref()));
            let speed = m.density.as_ref().map(|d| (shear / d.get_ref().0).sqrt());
            speed.filter(|s| s.is_finite() && *s > 0.0).unwrap_or(ANY_ROCK)
        };
        let fastest = scene.materials.values().map(speed).reduce(f64::max);
        Self { sliders: false, faults: !scene.faults.is_empty(), waves: fastest.unwrap_or(ANY_ROCK) }
    }
}

/// Adds what is implausible in the text of a scene, read along this tree of keys, to what is wrong with it and to what is doubtful. A value about which
/// something has been said is left alone.
pub(crate) fn judge(
    tree: &Tree,
    document: &Document<&str>,
    facts: SceneFacts,
    errors: &mut Vec<Diagnostic>,
    warnings: &mut Vec<Warning>,
) {
    let mut judge = Judge { facts, told: BTreeSet::new(), errors: Vec::new(), warnings: Vec::new() };
    visit(tree, document, facts.sliders, &mut judge);
    let said = |at: &Range<usize>| {
        let meets = |other: &Range<usize>| other.start < at.end && at.start < other.end;
        errors.iter().any(|e| meets(&e.span))
            || warnings.iter().any(|w| meets(&w.span) && w.span.len() <= at.len())
    };
    let Judge { errors: mut wrong, warnings: mut doubtful, .. } = judge;
    wrong.retain(|e| !said(&e.span));
    doubtful.retain(|w| !said(&w.span));
    errors.append(&mut wrong);
    warnings.append(&mut doubtful);
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
    warnings.sort_by_key(|w| (w.span.is_empty(), w.span.start));
}

/// Doubt about the largest magnitude of the values that a key takes from a file, with a usual value as help; `unit` is
/// the SI unit of the key, empty for a plain number.
#[must_use]
pub fn judge_file(
    keys: &[&str],
    unit: &str,
    values: impl IntoIterator<Item = f64>,
) -> Option<(String, String)> {
    let of = quantity(keys, Some(unit))?;
    let largest = values.into_iter().map(f64::abs).filter(|v| v.is_finite()).fold(0.0, f64::max);
    let [low, high] = of.usual;
    if largest == 0.0 || (low..=high).contains(&largest) {
        return None;
    }
    let unit = if of.unit.is_empty() { String::new() } else { format!(" {}", of.unit) };
    let message = format!("its largest is {}{unit}, and {}", shown(largest), of.are());
    Some((
        message,
        format!("is the unit of the file right? Such as {}; values that are meant may stay", of.example),
    ))
}

struct Judge {
    facts: SceneFacts,
    /// Paths of which something has been said: of a list, only the first entry that is implausible.
    told: BTreeSet<String>,
    errors: Vec<Diagnostic>,
    warnings: Vec<Warning>,
}

impl<'s> Visitor<'s> for Judge {
    /// Judges a value. One that does not belong to the scene, or is no number, is left to other checks.
    fn value(&mut self, forms: &[&'s Schema], value: &Value, path: &[Step<'_>]) {
        let Some(at) = value.span() else { return };
        let unit = forms.iter().find_map(|f| f["x-unit"].as_str());
        let is_number = |f: &&&Schema| f["type"].as_str().is_some_and(|t| t == "number" || t == "integer");
        if unit.is_none() && !forms.iter().any(|f| is_number(&f)) && !forms.iter().any(|f| lists_number(f)) {
            return;
        }
        let (found, given) = match value {
            Value::Float(number) => (*number.value(), true),
            Value::Integer(number) => (*number.value() as f64, true),
            Value::String(text) => match units::si_value(text.value()) {
                Some(value) => (value, false),
                None => return,
            },
            _ => return,
        };
        let root = self.facts.faults.then_some("faulted");
        let steps = path.iter().map(|s| if s.named { "" } else { s.key });
        let mut keys: Vec<&str> = root.into_iter().chain(steps).collect();
        // The value of a point of a profile is that of its parameter, in SI units.
        let profiled = unit.is_none() && keys.contains(&"profiles") && keys.last() == Some(&"points");
        if profiled {
            keys.pop();
        }
        let of_unit = if profiled { None } else { Some(unit.unwrap_or_default()) };
        let Some(quantity) = quantity(&keys, of_unit) else { return };
        self.compare(quantity, (found, given), at, path);
    }
}

impl Judge {
    fn compare(&mut self, of: &Quantity, (found, bare): (f64, bool), at: Range<usize>, path: &[Step<'_>]) {
        let size = found.abs();
        let [low, high] = of.usual;
        let most = match of.refused {
            RefusalBound::Never => f64::INFINITY,
            RefusalBound::Waves => self.facts.waves,
            RefusalBound::From(value) => value,
        };
        if size == 0.0 || !size.is_finite() || (low..=high).contains(&size) && size < most {
            return;
        }
        let steps = path.iter().map(|s| written(s.key));
        let path = steps.collect::<Vec<_>>().join(".");
        if !self.told.insert(path.clone()) {
            return;
        }
        let unit = if of.unit.is_empty() { String::new() } else { format!(" {}", of.unit) };
        let example = of.example;
        let mut help = match bare && !of.unit.is_empty() {
            true => {
                format!("a number without a unit is in {}: is a unit missing? Such as {example}", of.unit)
            }
            false => format!("is the unit right? Such as {example}"),
        };
        let value = format!("`{path}` is {}{unit}", shown(found));
        if size >= most {
            let why = match of.refused {
                RefusalBound::Waves => {
                    format!("{} reach the speed of shear waves, {most:.4e} m/s, in no rock", of.name)
                }
                _ => format!("{} stay below {}{unit}", of.name, shown(most)),
            };
            self.errors.push(Diagnostic::at(at, format!("{value}: {why}"), help));
            return;
        }
        help += "; a value that is meant may stay";
        self.warnings.push(Warning::at(at, format!("{value}, and {}", of.are()), help));
    }
}

/// True for a form whose type is one of several, such as a number or nothing.
fn lists_number(form: &Schema) -> bool {
    form["type"].as_array().is_some_and(|all| all.iter().any(|t| t == "number"))
}

impl Quantity {
    /// Usual values, as text.
    fn are(&self) -> String {
        let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
        let (name, [low, high]) = (self.name, self.usual);
        match low > 0.0 {
            true => format!("{name} are {} to {}{unit}", shown(low), shown(high)),
            false => format!("{name} are at most {}{unit}", shown(high)),
        }
    }
}

/// A number with few digits where that is short.
fn shown(value: f64) -> String {
    let size = value.abs();
    if (1e-3..1e5).contains(&size) || size == 0.0 { format!("{value}") } else { format!("{value:e}") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::units::Dimension;

    /// Refusals and warnings of a scene, with line and message.
    fn said(text: &str, facts: SceneFacts) -> Vec<(bool, usize, String)> {
        let (mut errors, mut warnings) = (Vec::new(), Vec::new());
        let (tree, document) = (Tree::new(), Document::parse(text).unwrap());
        judge(&tree, &document, facts, &mut errors, &mut warnings);
        let line = |at: &Range<usize>| text[..at.start].lines().count();
        let wrong = errors.iter().map(|e| (true, line(&e.span), e.message.clone()));
        wrong.chain(warnings.iter().map(|w| (false, line(&w.span), w.message.clone()))).collect()
    }

    const FAULTS: SceneFacts = SceneFacts { sliders: false, faults: true, waves: 3464.0 };

    #[test]
    fn every_dimension_has_a_row() {
        for dimension in Dimension::ALL {
            assert!(covers(dimension), "{dimension:?}");
        }
    }

    #[test]
    fn every_plain_number_of_a_row_is_a_key_of_scenes() {
        let last = |key: &'static str| key.rsplit('.').next().unwrap_or(key);
        for key in table::QUANTITIES.iter().flat_map(|q| q.keys).copied().map(last) {
            let found = crate::keys::find(key);
            assert!(matches!(found, crate::keys::KeySearch::Keys(_)), "{key}");
        }
    }

    #[test]
    fn a_forgotten_unit_is_told_of_wherever_the_unit_is_read() {
        for (line, path) in [
            ("faults.main.normal = 50", "faults.main.normal"),
            ("faults.main.normal = \"50 Pa\"", "faults.main.normal"),
            (
                "faults.main.profiles.normal = { along = \"y\", points = [[0, 50e6], [1, 60]] }",
                "profiles.normal.points",
            ),
            ("faults.main.profiles.a = [{ along = \"y\", points = [[0, 10]] }]", "profiles.a.points"),
            ("faults.main.patches = [{ a = 8 }]", "patches.a"),
            ("faults.main.pulses = [{ traction = 25 }]", "pulses.traction"),
            ("faults.main.damping = 5", "damping"),
            ("faults.main.law = { mu0 = 60 }", "law.mu0"),
            ("faults.main.law.l = [\"8 um\", 40]", "law.l"),
            ("faults.main.law.f_limit = 100", "law.f_limit"),
            ("faults.main.law.activation = 90", "law.activation"),
            ("faults.main.law.temperature = 20", "law.temperature"),
            ("faults.main.heat.temperature = 20", "heat.temperature"),
            ("faults.l.heat.capacity = 2.7", "capacity"),
            ("faults.main.creep.rate = \"1 m/s\"", "creep.rate"),
            ("faults.main.rectangle.dip = 30", "dip"),
            ("materials.rock.young = 80", "young"),
            ("materials.rock.density = 2.67", "density"),
            ("materials.rock.viscosity = 5", "viscosity"),
            ("materials.rock.plasticity.yield = 300", "yield"),
            ("bodies.A.initial_stress = [0, -50, 0, 0]", "initial_stress"),
            ("bodies.A.gravity = [0, 9810]", "gravity"),
            ("interfaces.i.damping = 5", "damping"),
            ("interfaces.i.enforcement.normal = 10", "enforcement.normal"),
            ("[[stages]]\nconditions = [{ x = { rate = \"1 m/s\" } }]", "conditions.x.rate"),
            ("[[stages]]\nconditions = [{ pressure = { table = [[0, 0], [1, 5]] } }]", "pressure.table"),
            ("time.log_rate_tolerance = 0.5", "log_rate_tolerance"),
            ("time.viscosity = 5", "time.viscosity"),
            ("bodies.A.mesh.fault.growth = 50", "growth"),
            ("solver.memory = 4", "memory"),
        ] {
            let said = said(line, FAULTS);
            let [(refused, at, message)] = said.as_slice() else { panic!("{line}: {said:?}") };
            assert!(!refused && message.contains(path), "{line}: {message}");
            assert_eq!(*at, line.lines().count(), "{line}");
        }
    }

    #[test]
    fn values_of_files_are_judged_by_their_largest() {
        assert_eq!(judge_file(&["pressure"], "Pa", [0.0, 5e6, f64::NAN]), None);
        assert_eq!(judge_file(&["fields", "a"], "", [0.0, 0.015]), None);
        let (message, help) = judge_file(&["pressure"], "Pa", [0.0, -5.0]).unwrap();
        assert!(message.contains("its largest is 5 Pa, and tractions are 1000 to 2e10 Pa"), "{message}");
        assert!(help.contains("\"50 MPa\""), "{help}");
        assert!(judge_file(&["fields", "a"], "", [0.01, 15.0]).is_some());
        assert!(judge_file(&["fields", "l"], "m", [8.0, 40.0]).is_some());
    }

    #[test]
    fn rates_of_waves_are_refused_and_usual_values_are_not() {
        for line in [
            "faults.main.rate = 5e10",
            "faults.main.law.v_initial = 1e9",
            "faults.main.creep.rate = \"4 km/s\"",
        ] {
            assert!(said(line, FAULTS).iter().all(|s| s.0) && !said(line, FAULTS).is_empty(), "{line}");
        }
        for line in ["sliders.A.start = 1e9", "load.rate = { mean = 1e4, amplitude = 0, period = 1 }"] {
            assert!(said(line, SceneFacts::SLIDERS).iter().any(|s| s.0), "{line}");
        }
        for line in [
            "faults.main.normal = 50e6",
            "faults.main.shear = 0",
            "faults.l.line.spacing = \"500 m\"",
            "faults.l.creep.beyond = \"40 km\"",
            "faults.main.profiles.l = { along = \"y\", points = [[\"-40 km\", 0.1]] }",
            "interfaces.i.enforcement.normal = \"10 E/h\"",
            "time.tolerance = \"1 nm\"",
            "faults.main.rectangle.dip = \"90 deg\"",
        ] {
            assert_eq!(said(line, FAULTS), [], "{line}");
        }
    }
}
