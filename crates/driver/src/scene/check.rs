//! What can be wrong with a scene beyond its syntax. Everything is collected, not only the first error.

use super::SceneError;
use super::law;
use super::model::{
    BlockMesh, Condition, Interface, Kinematics, Loading, MeshSource, Motion, Rule, Scene, Sliding, Spanned, Stage,
    Stepper,
};
use super::units::{Length, Penalty};
use std::collections::BTreeMap;
use std::ops::Range;

/// Sides of a block per axis, as the generator names them.
const SIDES: [[&str; 2]; 3] = [["left", "right"], ["bottom", "top"], ["back", "front"]];
/// Elements of each dimension, and whether they are linear.
const ELEMENTS: [(&str, usize, bool); 6] = [
    ("quad4", 2, true),
    ("quad9", 2, false),
    ("tri3", 2, true),
    ("tri6", 2, false),
    ("hex8", 3, true),
    ("tet4", 3, true),
];
/// Relative deviation from a whole number of elements that is rounding of decimal input.
const WHOLE: f64 = 1e-9;

struct Checker<'a> {
    scene: &'a Scene,
    dimension: usize,
    errors: Vec<SceneError>,
}

/// Everything wrong with a scene.
#[must_use]
pub fn check(scene: &Scene) -> Vec<SceneError> {
    let dimension = match scene.kinematics.get_ref() {
        Kinematics::PlaneStrain => 2,
        Kinematics::ThreeD => 3,
    };
    let mut checker = Checker { scene, dimension, errors: Vec::new() };
    checker.general();
    checker.materials();
    checker.bodies();
    checker.interfaces();
    checker.stages();
    checker.time();
    checker.output();
    checker.errors
}

impl Checker<'_> {
    fn error(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(SceneError::at(span, message, help));
    }

    fn general(&mut self) {
        if *self.scene.schema.get_ref() != 1 {
            let message = format!("schema {} is not known", self.scene.schema.get_ref());
            self.error(self.scene.schema.span(), message, "this version reads schema = 1");
        }
        if self.scene.bodies.is_empty() {
            self.error(self.scene.kinematics.span(), "the scene has no body", "add [bodies.NAME]");
        }
        if self.scene.stages.is_empty() {
            self.error(self.scene.kinematics.span(), "the scene has no stage", "add [[stages]]");
        }
    }

    fn materials(&mut self) {
        let scene = self.scene;
        for (name, m) in &scene.materials {
            let young = m.young.get_ref().0;
            if !(young > 0.0 && young.is_finite()) {
                self.error(m.young.span(), format!("young of `{name}` is {young} Pa"), "E must be positive");
            }
            let nu = *m.poisson.get_ref();
            if !(nu > -1.0 && nu < 0.5) {
                self.error(m.poisson.span(), format!("poisson of `{name}` is {nu}"), "-1 < nu < 0.5");
            }
            if let Some(density) = &m.density
                && !(density.get_ref().0 > 0.0)
            {
                let message = format!("density of `{name}` is {} kg/m^3", density.get_ref().0);
                self.error(density.span(), message, "the density must be positive");
            }
        }
    }

    fn bodies(&mut self) {
        let scene = self.scene;
        for (name, body) in &scene.bodies {
            if !scene.materials.contains_key(body.material.get_ref()) {
                let known: Vec<&str> = scene.materials.keys().map(String::as_str).collect();
                let message = format!("there is no material `{}`", body.material.get_ref());
                self.error(body.material.span(), message, format!("materials are {}", known.join(", ")));
            }
            let MeshSource::Block(mesh) = &body.mesh;
            self.block(name, mesh);
            if let Some(stress) = &body.initial_stress {
                let n = stress.get_ref().len();
                let right = if self.dimension == 2 { n == 3 || n == 6 } else { n == 6 };
                if !right {
                    let help = if self.dimension == 2 { "give [xx, yy, xy]" } else { "give [xx, yy, zz, xy, yz, zx]" };
                    self.error(stress.span(), format!("initial_stress has {n} components"), help);
                }
            }
            if let Some(gravity) = &body.gravity
                && gravity.get_ref().len() != self.dimension
            {
                let message = format!("gravity has {} components", gravity.get_ref().len());
                self.error(gravity.span(), message, format!("give {}", self.dimension));
            }
        }
    }

    fn block(&mut self, name: &str, mesh: &BlockMesh) {
        let d = self.dimension;
        for corner in [&mesh.min, &mesh.max] {
            if corner.get_ref().len() != d {
                let message = format!("body `{name}`: a corner of {} coordinates", corner.get_ref().len());
                self.error(corner.span(), message, format!("this scene has {d} dimensions"));
                return;
            }
        }
        let known: Vec<&str> = ELEMENTS.iter().filter(|e| e.1 == d).map(|e| e.0).collect();
        if !known.contains(&mesh.element.get_ref().as_str()) {
            let message = format!("there is no {d}-dimensional element `{}`", mesh.element.get_ref());
            self.error(mesh.element.span(), message, format!("elements are {}", known.join(", ")));
        }
        let lengths: Vec<f64> = mesh.max.get_ref().iter().zip(mesh.min.get_ref()).map(|(b, a)| b.0 - a.0).collect();
        if let Some(axis) = lengths.iter().position(|l| *l <= 0.0) {
            let message = format!("body `{name}`: max is not beyond min along axis {}", axis + 1);
            self.error(mesh.max.span(), message, "each coordinate of max must exceed that of min");
            return;
        }
        match (&mesh.size, &mesh.divisions) {
            (Some(size), None) => self.size(name, size, &lengths),
            (None, Some(divisions)) => {
                if divisions.get_ref().len() != d || divisions.get_ref().contains(&0) {
                    let message = format!("body `{name}`: divisions {:?}", divisions.get_ref());
                    self.error(divisions.span(), message, format!("give {d} positive numbers"));
                }
            }
            (Some(_), Some(divisions)) => {
                self.error(divisions.span(), format!("body `{name}`: both size and divisions"), "give one of them");
            }
            (None, None) => {
                self.error(mesh.element.span(), format!("body `{name}`: neither size nor divisions"), "give `size`");
            }
        }
        if let Some(grading) = &mesh.grading
            && (grading.get_ref().len() != d || grading.get_ref().iter().any(|g| !(*g > 0.0 && g.is_finite())))
        {
            let message = format!("body `{name}`: grading {:?}", grading.get_ref());
            self.error(grading.span(), message, format!("give {d} positive ratios of last to first size"));
        }
    }

    fn size(&mut self, name: &str, size: &Spanned<Length>, lengths: &[f64]) {
        let h = size.get_ref().0;
        if !(h > 0.0) {
            self.error(size.span(), format!("body `{name}`: size {h} m"), "the size must be positive");
            return;
        }
        for length in lengths {
            let n = (length / h).round();
            if n < 1.0 || (length / h - n).abs() > WHOLE * n {
                let message = format!("body `{name}`: size {h} m does not divide the edge of {length} m");
                self.error(size.span(), message, format!("{} m does", length / n.max(1.0)));
                return;
            }
        }
    }

    /// Axis and body of a set name; records an error when it does not exist.
    fn set(&mut self, set: &Spanned<String>) -> Option<(String, usize, usize)> {
        let text = set.get_ref();
        let mut parts = text.splitn(2, '.');
        let (body, side) = (parts.next().unwrap_or(""), parts.next().unwrap_or(""));
        if !self.scene.bodies.contains_key(body) {
            let known: Vec<&str> = self.scene.bodies.keys().map(String::as_str).collect();
            let help = format!("a set is written body.side; bodies are {}", known.join(", "));
            self.error(set.span(), format!("`{text}`: there is no body `{body}`"), help);
            return None;
        }
        for (axis, names) in SIDES.iter().enumerate().take(self.dimension) {
            if let Some(end) = names.iter().position(|n| *n == side) {
                return Some((body.to_string(), axis, end));
            }
        }
        let known: Vec<&str> = SIDES.iter().take(self.dimension).flatten().copied().collect();
        let message = format!("there is no set `{text}`");
        self.error(set.span(), message, format!("sides of a block are {}", known.join(", ")));
        None
    }

    fn interfaces(&mut self) {
        let scene = self.scene;
        for (name, interface) in &scene.interfaces {
            let slave = self.set(&interface.slave);
            let master = self.set(&interface.master);
            if let (Some(slave), Some(master)) = (&slave, &master) {
                if slave.0 == master.0 {
                    let message = format!("interface `{name}`: both sides belong to body `{}`", slave.0);
                    self.error(interface.master.span(), message, "self-contact does not exist: name two bodies");
                }
                self.sliding(name, interface, [&slave.0, &master.0]);
            }
            self.enforcement(name, interface);
            if let Some(spec) = &interface.law
                && let Err(errors) = law::choose(spec)
            {
                self.errors.extend(errors);
            }
        }
    }

    fn sliding(&mut self, name: &str, interface: &Interface, bodies: [&String; 2]) {
        if *interface.sliding.get_ref() == Sliding::Small {
            return;
        }
        for body in bodies {
            let MeshSource::Block(mesh) = &self.scene.bodies[body].mesh;
            let element = mesh.element.get_ref();
            if ELEMENTS.iter().any(|e| e.0 == element && !e.2) {
                let message = format!("interface `{name}`: finite sliding on element {element} of body `{body}`");
                let help = "finite sliding needs straight segments: quad4, tri3, hex8 or tet4, or sliding = \"small\"";
                self.error(interface.sliding.span(), message, help);
            }
        }
    }

    fn enforcement(&mut self, name: &str, interface: &Interface) {
        let e = &interface.enforcement;
        for penalty in [Some(&e.normal), e.tangential.as_ref()].into_iter().flatten() {
            let (Penalty::Value(value) | Penalty::YoungPerSize(value)) = *penalty.get_ref();
            if !(value > 0.0 && value.is_finite()) {
                let message = format!("interface `{name}`: penalty {value}");
                self.error(penalty.span(), message, "a penalty must be positive, such as \"100 E/h\"");
            }
        }
        match (&interface.law, &e.tangential) {
            (Some(law), None) => {
                let message = format!("interface `{name}` has friction and no tangential penalty");
                self.error(law.span(), message, "add `tangential = \"100 E/h\"` to the enforcement");
            }
            (None, Some(tangential)) => {
                let message = format!("interface `{name}` has a tangential penalty and no friction");
                self.error(tangential.span(), message, "add a `law`, or leave `tangential` out");
            }
            _ => {}
        }
    }

    fn stages(&mut self) {
        let scene = self.scene;
        for stage in &scene.stages {
            let duration = stage.duration.get_ref().0;
            if !(duration > 0.0) {
                let message = format!("stage `{}` lasts {duration} s", stage.name);
                self.error(stage.duration.span(), message, "the duration must be positive");
            }
            if let Some(steps) = &stage.steps
                && *steps.get_ref() == 0
            {
                self.error(steps.span(), format!("stage `{}` has no steps", stage.name), "give at least one");
            }
            for interface in &stage.frictionless {
                if !scene.interfaces.contains_key(interface.get_ref()) {
                    let message = format!("there is no interface `{}`", interface.get_ref());
                    let known: Vec<&str> = scene.interfaces.keys().map(String::as_str).collect();
                    self.error(interface.span(), message, format!("interfaces are {}", known.join(", ")));
                }
            }
            self.conditions(stage);
        }
    }

    fn conditions(&mut self, stage: &Stage) {
        let mut seen: BTreeMap<(String, usize, usize, usize), Motion> = BTreeMap::new();
        for condition in &stage.conditions {
            let c = condition.get_ref();
            let Some(set) = &c.set else {
                self.error(condition.span(), "the condition names no set", "add `set = \"body.side\"`");
                continue;
            };
            let Some((body, axis, end)) = self.set(set) else { continue };
            let motions = self.motions(c, axis);
            if motions.is_empty() && c.traction.is_none() && c.pressure.is_none() {
                self.error(condition.span(), "the condition prescribes nothing", "add x, y, symmetry, traction or pressure");
            }
            for (component, motion, span) in motions {
                self.motion(&motion, span.clone());
                self.overlap(&seen, (&body, axis, end, component), &motion, span);
                seen.insert((body.clone(), axis, end, component), motion);
            }
            self.loads(c, axis);
        }
    }

    /// Components a condition prescribes, symmetry included.
    fn motions(&mut self, c: &Condition, normal: usize) -> Vec<(usize, Motion, Range<usize>)> {
        let mut list = Vec::new();
        for (component, motion) in [&c.x, &c.y, &c.z].into_iter().enumerate() {
            let Some(motion) = motion else { continue };
            if component >= self.dimension {
                self.error(motion.span(), "there is no z in a plane scene", "leave z out, or use kinematics = \"3d\"");
                continue;
            }
            list.push((component, motion.get_ref().clone(), motion.span()));
        }
        if let Some(symmetry) = &c.symmetry
            && *symmetry.get_ref()
        {
            if list.iter().any(|m| m.0 == normal) {
                let help = "symmetry already holds the component along the normal";
                self.error(symmetry.span(), "symmetry and a motion along the same normal", help);
            } else {
                list.push((normal, Motion::Fixed(0.0), symmetry.span()));
            }
        }
        list
    }

    fn motion(&mut self, motion: &Motion, span: Range<usize>) {
        if let Motion::Table(points) = motion {
            self.table(points, span);
        }
    }

    fn table(&mut self, points: &[(f64, f64)], span: Range<usize>) {
        if points.is_empty() || points.windows(2).any(|w| w[0].0 >= w[1].0) {
            self.error(span, "the times of the table do not increase", "sort the rows by time, without repetition");
        }
    }

    /// The same component of the same side twice, or of two adjoining sides with different prescriptions.
    fn overlap(
        &mut self,
        seen: &BTreeMap<(String, usize, usize, usize), Motion>,
        (body, axis, end, component): (&String, usize, usize, usize),
        motion: &Motion,
        span: Range<usize>,
    ) {
        for ((other, other_axis, other_end, other_component), other_motion) in seen {
            if other != body || *other_component != component {
                continue;
            }
            let name = |axis: usize, end: usize| format!("{body}.{}", SIDES[axis][end]);
            let axis_name = ["x", "y", "z"][component];
            if (*other_axis, *other_end) == (axis, end) {
                let message = format!("{axis_name} of `{}` is prescribed twice in this stage", name(axis, end));
                self.error(span.clone(), message, "keep one of the two");
            } else if *other_axis != axis && other_motion != motion {
                let message = format!(
                    "{axis_name} of `{}` contradicts `{}`, with which it shares nodes",
                    name(axis, end),
                    name(*other_axis, *other_end)
                );
                self.error(span.clone(), message, "prescribe the same motion on both, or only one of them");
            }
        }
    }

    fn loads(&mut self, c: &Condition, normal: usize) {
        if let Some(traction) = &c.traction {
            if traction.get_ref().len() != self.dimension {
                let message = format!("traction has {} components", traction.get_ref().len());
                self.error(traction.span(), message, format!("give {}", self.dimension));
            }
            for (component, (loading, motion)) in traction.get_ref().iter().zip([&c.x, &c.y, &c.z]).enumerate() {
                if motion.is_some() && *loading != Loading::Fixed(0.0) {
                    let message = format!("{} is both moved and loaded", ["x", "y", "z"][component]);
                    self.error(traction.span(), message, "a component has a motion or a traction, not both");
                }
                if let Loading::Table(points) = loading {
                    self.table(points, traction.span());
                }
            }
        }
        if let Some(pressure) = &c.pressure {
            if [&c.x, &c.y, &c.z][normal].is_some() {
                let help = "the normal component has a motion or a pressure, not both";
                self.error(pressure.span(), "the set is both moved and pressed along its normal", help);
            }
            if let Loading::Table(points) = pressure.get_ref() {
                self.table(points, pressure.span());
            }
        }
    }

    fn time(&mut self) {
        let t = &self.scene.time;
        let lengths = [("first_step", &t.first_step), ("max_step", &t.max_step), ("min_step", &t.min_step)];
        for (key, value) in lengths {
            if let Some(value) = value
                && !(value.get_ref().0 > 0.0)
            {
                self.error(value.span(), format!("{key} = {} s", value.get_ref().0), "a step must be positive");
            }
        }
        if let Some(tolerance) = &t.tolerance
            && !(tolerance.get_ref().0 > 0.0)
        {
            let message = format!("tolerance = {} m", tolerance.get_ref().0);
            self.error(tolerance.span(), message, "the tolerance must be a positive length");
        }
        for (key, value) in [("rate_change", &t.rate_change), ("zeta", &t.zeta)] {
            if let Some(value) = value
                && !(*value.get_ref() > 0.0 && value.get_ref().is_finite())
            {
                self.error(value.span(), format!("{key} = {}", value.get_ref()), "a bound must be positive");
            }
        }
        self.stepper_keys();
    }

    /// Keys of the other stepper.
    fn stepper_keys(&mut self) {
        let t = &self.scene.time;
        let implicit = *t.stepper.get_ref() == Stepper::Implicit;
        let own = [("rule", t.rule.as_ref().map(Spanned::span)), ("tolerance", t.tolerance.as_ref().map(Spanned::span))];
        let other = [
            ("carry", t.carry.as_ref().map(Spanned::span)),
            ("rate_change", t.rate_change.as_ref().map(Spanned::span)),
            ("zeta", t.zeta.as_ref().map(Spanned::span)),
        ];
        let (foreign, stepper): (&[_], _) = if implicit { (&other, "static-explicit") } else { (&own, "implicit") };
        for (key, span) in foreign {
            if let Some(span) = span {
                let message = format!("`{key}` belongs to the {stepper} stepper");
                self.error(span.clone(), message, format!("leave it out, or use stepper = \"{stepper}\""));
            }
        }
        if let Some(rule) = &t.rule
            && *rule.get_ref() == Rule::Bdf2
        {
            let state = |i: &Interface| {
                i.law.as_ref().is_some_and(|l| {
                    l.get_ref().kind.as_ref().is_some_and(|k| k.get_ref() == "rate-and-state")
                })
            };
            if self.scene.interfaces.values().any(state) {
                let help = "use rule = \"backward-euler\": the state would remain of first order";
                self.error(rule.span(), "rule bdf2 exists for laws without state only", help);
            }
        }
    }

    fn output(&mut self) {
        let scene = self.scene;
        for (name, count) in &scene.output.probes {
            if !scene.interfaces.contains_key(name) {
                let known: Vec<&str> = scene.interfaces.keys().map(String::as_str).collect();
                let message = format!("probes of an interface `{name}` that does not exist");
                self.error(count.span(), message, format!("interfaces are {}", known.join(", ")));
            }
            if *count.get_ref() == 0 {
                self.error(count.span(), format!("no probes on `{name}`"), "give at least one, or leave it out");
            }
        }
    }
}
