//! Faults in earthquake cycles.

use super::Checker;
use super::interfaces::RATED;
use crate::law;
use crate::model::{
    Along, Creep, CreepLoading, DampingSpec, EventSpec, Fault, Interface, Kinematics, Motion, Outside,
    ParameterProfiles, Profile, SlipSpec, Spanned, Station, Stepper,
};
use crate::suggestions::suggest;
use crate::units::Angle;

/// Kinds of law from which the slip rate cannot be computed.
const WITHOUT_RATE: [&str; 3] = ["coulomb", "static-kinetic", "slip-weakening"];

/// Advice on a normal traction that vanishes, as its weight does at the surface.
const AT_SURFACE: &str = "friction needs a normal traction, also at a free surface: a small value there, in Pa, such as that of the weight at half the depth of a cell";

impl Checker<'_> {
    pub(super) fn faults(&mut self) {
        let scene = self.scene;
        self.stepper_of_faults();
        for (name, fault) in &scene.faults {
            self.name("a fault", name, fault.span());
            self.geometry(name, fault);
            self.friction(fault);
            self.start_of(fault);
            self.physics_of(fault);
            self.wells(fault);
            self.diffusion(fault);
            self.heat_of(fault);
            self.processes_of(fault);
            for (name, profile) in fault.profiles.all() {
                let sense = match name {
                    "shear" => fault.slides().then(|| fault.rate.get_ref().0.signum()),
                    _ => Some(1.0),
                };
                for profile in profile.iter().flat_map(|ParameterProfiles(list)| list) {
                    self.profile(name, profile, sense);
                }
            }
            self.fields(fault);
            self.pulses(fault);
            self.forced(fault);
            self.patches(fault);
            self.rake(fault);
            if let Some(creep) = &fault.creep {
                self.creep(creep);
            }
        }
        self.stress_beside_faults();
        self.weight_beside_faults();
        self.directions_of_slip();
        self.stations();
        self.cadence();
        self.events();
        self.springs();
        self.medium();
    }

    /// Checks springs that pull sets.
    fn springs(&mut self) {
        let scene = self.scene;
        for condition in scene.stages.iter().flat_map(|s| &s.conditions) {
            let c = condition.get_ref();
            for motion in [&c.x, &c.y, &c.z].into_iter().flatten() {
                let Motion::Spring { stiffness, .. } = *motion.get_ref() else { continue };
                if self.has_waves() {
                    self.error(
                        motion.span(),
                        "a spring loads sides of bodies without mass",
                        "prescribe the motion itself, such as `{ rate = \"1 um/s\" }`",
                    );
                }
                if !(stiffness > 0.0 && stiffness.is_finite()) {
                    self.error(
                        motion.span(),
                        "`spring` must be positive",
                        "a stiffness in N/m, in the plane per metre of thickness, such as `{ spring = 1.4e10, rate = \"1 um/s\" }`",
                    );
                }
            }
        }
    }

    /// Checks that faults and the stepper "fault-ode" are used together, without interfaces and in one stage.
    fn stepper_of_faults(&mut self) {
        if self.has_waves() {
            return self.explicit();
        }
        if self.has_ruptures() {
            self.ruptures();
        }
        let (scene, stepper) = (self.scene, &self.scene.time.stepper);
        let alone = *stepper.get_ref() == Stepper::FaultOde;
        let ode = alone || *stepper.get_ref() == Stepper::Auto;
        match scene.faults.values().next() {
            None if alone => self.error(
                stepper.span(),
                "the stepper \"fault-ode\" integrates faults, and the scene has none",
                "add `[faults.NAME]`, or use \"implicit\" or \"static-explicit\"",
            ),
            Some(fault) if ode => self.stages_of_faults(fault),
            _ => {}
        }
        self.events_without_source();
    }

    /// Refuses events where nothing has them: they are those of faults, and of interfaces whose laws depend on the slip rate.
    fn events_without_source(&mut self) {
        let scene = self.scene;
        let of_rate = |i: &Interface| {
            let kind = i.law.as_ref().and_then(|l| l.get_ref().kind.as_ref());
            kind.is_some_and(|k| RATED.contains(&k.get_ref().as_str()))
        };
        let source = !scene.faults.is_empty() || scene.interfaces.values().any(of_rate);
        let Some(events) = scene.events.as_ref().filter(|_| !source) else { return };
        self.error(
            events.above.span(),
            "events are those of faults and of interfaces whose laws depend on the slip rate, and the scene has neither",
            "remove `[events]`, or give an interface a law of kind \"rate-and-state\" or \"rate\"",
        );
    }

    fn friction(&mut self, fault: &Fault) {
        self.errors.extend(law::choose(&fault.law, self.laws).err().unwrap_or_default());
        let kind = fault.law.get_ref().kind.as_ref().filter(|_| !self.has_waves());
        if let Some(kind) = kind.filter(|k| WITHOUT_RATE.contains(&k.get_ref().as_str())) {
            self.error(
                kind.span(),
                format!("the slip rate of a fault does not follow from a law of kind \"{}\"", kind.get_ref()),
                "\"rate-and-state\", or \"rate\"; bodies with inertia take them, with `stepper = \"explicit\"`",
            );
        }
    }

    /// True if friction of the fault depends on the slip rate.
    fn needs_rate(fault: &Fault) -> bool {
        let kind = fault.law.get_ref().kind.as_ref();
        !kind.is_some_and(|k| WITHOUT_RATE.contains(&k.get_ref().as_str()) || k.get_ref() == "tied")
    }

    fn start_of(&mut self, fault: &Fault) {
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if let Some(normal) = fault.normal.as_ref().filter(|n| !positive(n.get_ref().0)) {
            self.error(normal.span(), "`normal` must be positive", "such as `normal = \"50 MPa\"`");
        }
        let rate = fault.rate.get_ref().0;
        let place = if fault.rate.span().is_empty() { fault.span() } else { fault.rate.span() };
        if (rate == 0.0 && Self::needs_rate(fault)) || !rate.is_finite() {
            self.error(
                place,
                "`rate` must not be zero",
                "such as `rate = \"1e-9 m/s\"`; its sign is the direction of slip",
            );
        } else if rate != 0.0 && self.has_waves() && !Self::needs_rate(fault) {
            self.error(
                place,
                "`rate` of a fault whose friction does not depend on the slip rate, and which starts at rest",
                "remove `rate`: slip follows the shear traction",
            );
        }
        if let Some(shear) = fault.shear.as_ref()
            && !((shear.get_ref().0 * rate.signum() > 0.0 || !fault.slides())
                && shear.get_ref().0.is_finite())
        {
            self.conflict(
                &shear.span(),
                "`shear` must have the sign of `rate`",
                "friction resists the motion",
                (&fault.rate.span(), "`rate`"),
            );
        }
        if let Some(damping) = &fault.damping
            && let DampingSpec::Value(value) = *damping.get_ref()
            && !(value >= 0.0 && value.is_finite())
        {
            self.error(
                damping.span(),
                "`damping` must not be negative",
                "such as `damping = \"radiation\"` or `damping = \"4.6 MPa s/m\"`",
            );
        }
    }

    pub(super) fn in_space(&self) -> bool {
        *self.scene.kinematics.get_ref() == Kinematics::ThreeD
    }

    /// Checks the direction of slip. It must be given in space, and is unique in the plane.
    fn rake(&mut self, fault: &Fault) {
        let free = fault.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
        if let Some(azimuth) = &fault.azimuth {
            self.azimuth(fault, azimuth);
            if fault.rake.is_none() {
                return;
            }
        }
        match (&fault.rake, self.in_space()) {
            (None, true) => self.error(
                fault.span(),
                "a fault in three dimensions has no `rake`",
                "the direction in which plus slips past minus, such as `rake = [0, 0, 1]`; slip across it is held at zero, or with `slip = \"free\"` turns from there",
            ),
            (Some(rake), true) => self.direction(rake),
            (_, false) => {}
        }
        if let Some(rake) = fault.creep.as_ref().and_then(|c| c.rake.as_ref()) {
            self.direction(rake);
            if !free {
                self.conflict(
                    &rake.span(),
                    "creep has a direction of its own where slip may not turn",
                    "add `slip = \"free\"` to the fault, or leave the `rake` of the creep out",
                    (&fault.span(), "the fault"),
                );
            }
        }
    }

    /// Checks a direction of slip on the map, from which the rake follows.
    fn azimuth(&mut self, fault: &Fault, azimuth: &Spanned<Angle>) {
        let degrees = azimuth.get_ref().0.to_degrees();
        if self.scene.place.is_none() {
            self.error(
                azimuth.span(),
                "`azimuth` is a direction on a map, which needs three dimensions and a `[place]`",
                "`rake = [x, y, z]`, or add a `[place]`",
            );
        } else if !(-360.0..=360.0).contains(&degrees) {
            self.error(
                azimuth.span(),
                format!("`azimuth` must lie between -360 and 360 degrees, found {degrees:.6}"),
                "such as `azimuth = \"125 deg\"`, clockwise from north",
            );
        }
        if let Some(rake) = fault.rake.as_ref().filter(|rake| rake.span() != azimuth.span()) {
            self.conflict(
                &azimuth.span(),
                "the direction of slip is given twice",
                "remove `rake` or `azimuth`",
                (&rake.span(), "and here"),
            );
        }
    }

    fn direction(&mut self, rake: &Spanned<[f64; 3]>) {
        let size = rake.get_ref().iter().map(|c| c * c).sum::<f64>();
        if !(size > 0.0 && size.is_finite()) {
            self.error(rake.span(), "`rake` has no direction", "such as `rake = [0, 0, 1]`");
        }
    }

    /// Checks that all faults slip along their rakes, or that all may turn.
    fn directions_of_slip(&mut self) {
        let scene = self.scene;
        let kind = |f: &Fault| f.slip.as_ref().map_or(SlipSpec::AlongRake, |s| *s.get_ref());
        let Some(first) = scene.faults.values().next() else { return };
        if let Some(other) = scene.faults.values().find(|f| kind(f) != kind(first)) {
            let place = |f: &Fault| f.slip.as_ref().map_or(f.span(), Spanned::span);
            self.conflict(
                &place(other),
                "slip of one fault may turn and that of another may not",
                "`slip = \"free\"` for all faults of a scene, or for none",
                (&place(first), "another fault"),
            );
        }
    }

    fn creep(&mut self, creep: &Creep) {
        if !creep.rate.get_ref().0.is_finite() {
            self.error(
                creep.rate.span(),
                "the rate of creep must be finite",
                "such as `rate = \"1e-9 m/s\"`",
            );
        }
        if let Some(loading) = creep.loading.as_ref() {
            self.creep_loading(creep, loading);
        }
        match (&creep.beyond, &creep.outside) {
            (Some(beyond), Some(outside)) => self.conflict(
                &outside.span(),
                "`outside` and `beyond` are both given",
                "one of them says where the fault creeps",
                (&beyond.span(), "`beyond`"),
            ),
            // In a medium the continuation of the fault creeps.
            (None, None) if self.scene.medium.is_some() || creep.is_backslip() => {}
            (None, None) => self.error(
                creep.rate.span(),
                "the creep of a fault says nowhere",
                format!(
                    "add `beyond = \"40 km\"`{}",
                    ", or `outside = { y = { from = \"-40 km\" } }`; or `loading = \"backslip\"`, if what creeps is not part of the bodies"
                ),
            ),
            (Some(_), None) => {}
            (None, Some(outside)) => self.ranges("outside", outside),
        }
    }

    /// Refuses a load of creep that a medium does not have, and backslip without a rate.
    fn creep_loading(&mut self, creep: &Creep, loading: &Spanned<CreepLoading>) {
        let backslip = *loading.get_ref() == CreepLoading::Backslip;
        if let Some(medium) = self.scene.medium.as_ref().filter(|_| !backslip) {
            self.conflict(
                &loading.span(),
                "in a medium creep loads a fault by backslip",
                "remove it, or `loading = \"backslip\"`: the part of a fault that creeps has no cells here",
                (&medium.kind.span(), "the medium"),
            );
        }
        if backslip && creep.rate.get_ref().0 == 0.0 {
            self.error(
                creep.rate.span(),
                "backslip at no rate loads nothing",
                "the rate of the plates, such as `rate = \"1e-9 m/s\"`",
            );
        }
    }

    /// Checks ranges of coordinates, the value of this key.
    pub(super) fn ranges(&mut self, key: &str, given: &Spanned<Outside>) {
        let ranges = given.get_ref().ranges();
        if ranges.iter().all(Option::is_none) {
            self.error(
                given.span(),
                format!("`{key}` has no range"),
                format!("such as `{key} = {{ y = {{ from = \"-40 km\" }} }}`"),
            );
        }
        for (axis, range) in ["x", "y", "z"].into_iter().zip(ranges) {
            let Some(range) = range else { continue };
            let (from, to) = (range.from.map(|l| l.0), range.to.map(|l| l.0));
            let ordered = from.zip(to).is_none_or(|(a, b)| a < b);
            if !ordered || (from.is_none() && to.is_none()) {
                self.error(
                    given.span(),
                    format!("the range of {axis} is empty or has no end"),
                    format!("such as `{key} = {{ {axis} = {{ from = \"-40 km\", to = \"40 km\" }} }}`"),
                );
            }
        }
    }

    /// Checks a profile of values of a sign, if they must have one.
    pub(super) fn profile(&mut self, name: &str, profile: &Profile, sign: Option<f64>) {
        match (*profile.along.get_ref(), self.in_space()) {
            (Along::Distance, true) => self.error(
                profile.along.span(),
                "there is no distance along a fault in three dimensions",
                "use \"x\", \"y\" or \"z\"; of a list of profiles the largest value holds",
            ),
            (Along::Z, false) => self.error(
                profile.along.span(),
                "there is no coordinate z in the plane",
                "use \"x\", \"y\" or \"distance\"",
            ),
            _ => {}
        }
        let points = profile.points.get_ref();
        let value = match name {
            "permeability" => "1e-15",
            "storage" => "1e-9",
            _ => "0.01",
        };
        let example = format!(
            "such as `profiles.{name} = {{ along = \"distance\", points = [[\"15 km\", {value}], ..] }}`"
        );
        if points.is_empty() {
            self.error(profile.points.span(), format!("the profile of `{name}` has no points"), example);
        } else if !points.windows(2).all(|w| w[0].0.0 < w[1].0.0) {
            self.error(
                profile.points.span(),
                format!("the positions of the profile of `{name}` must ascend"),
                example,
            );
        } else if let Some(p) = points.iter().find(|p| {
            let none = name == "cohesion" && p.1 == 0.0;
            !((none || sign.is_none_or(|s| s * p.1 > 0.0)) && p.1.is_finite())
        }) {
            let what = match name {
                "shear" => "have the sign of `rate`",
                "cohesion" => "not be negative",
                _ => "be positive",
            };
            let message = format!("the profile of `{name}` must {what}, found {:?}", p.1);
            let help = if name == "normal" && p.1 == 0.0 { AT_SURFACE } else { "values are numbers in SI" };
            self.error(profile.points.span(), message, help);
        }
    }

    fn stations(&mut self) {
        let scene = self.scene;
        for (name, stations) in &scene.output.stations {
            if !scene.faults.contains_key(name) {
                self.error(
                    stations.span(),
                    format!("stations on `{name}`, but there is no such fault"),
                    suggest(name, "faults", scene.faults.keys().map(String::as_str)),
                );
            }
            let dimension = if self.in_space() { 3 } else { 2 };
            for station in stations.get_ref() {
                match station.get_ref() {
                    Station::Along(_) if dimension == 3 => self.error(
                        station.span(),
                        "there is no distance along a fault in three dimensions",
                        "stations are coordinates, such as [\"0 km\", \"-10 km\", \"24 km\"]",
                    ),
                    Station::At(at) if at.len() != dimension => self.error(
                        station.span(),
                        format!("a station has {dimension} coordinates here, found {}", at.len()),
                        "such as [\"0 km\", \"-10 km\"], in three dimensions with z",
                    ),
                    _ => {}
                }
            }
        }
    }

    fn events(&mut self) {
        let scene = self.scene;
        let tolerance = scene.time.log_rate_tolerance.as_ref();
        if let Some(t) = tolerance.filter(|t| !(*t.get_ref() > 0.0 && *t.get_ref() < 1.0)) {
            self.error(
                t.span(),
                "`log_rate_tolerance` must lie between 0 and 1",
                "such as `log_rate_tolerance = 1e-5`",
            );
        }
        let Some(events) = &scene.events else { return };
        let above = events.above.get_ref().0;
        if !(above > 0.0 && above.is_finite()) {
            self.error(events.above.span(), "`above` must be positive", "such as `above = \"1 mm/s\"`");
        }
        if let Some(below) = events.below.as_ref().filter(|b| !(b.get_ref().0 > 0.0 && b.get_ref().0 < above))
        {
            self.conflict(
                &below.span(),
                "`below` must be positive and less than `above`",
                "an event ends at a lower rate than it begins, so that it is not counted twice",
                (&events.above.span(), "`above`"),
            );
        }
        self.slow_events(events);
        if let Some(n) = events.stop_after.as_ref().filter(|n| *n.get_ref() == 0) {
            self.error(n.span(), "`stop_after` must be at least 1", "or leave the line out");
        }
    }

    /// Checks the slip rates of slow events, which lie below those of the others.
    fn slow_events(&mut self, events: &EventSpec) {
        let Some(slow) = &events.slow_above else {
            if let Some(below) = &events.slow_below {
                self.error(
                    below.span(),
                    "`slow_below` ends slow events, and there are none without `slow_above`",
                    "add `slow_above`, such as `slow_above = \"1e-8 m/s\"`, or remove `slow_below`",
                );
            }
            return;
        };
        let (rate, above) = (slow.get_ref().0, events.above.get_ref().0);
        if !(rate > 0.0 && rate < above) {
            self.conflict(
                &slow.span(),
                "`slow_above` must be positive and less than `above`",
                "a slow event never becomes as fast as one that `above` begins",
                (&events.above.span(), "`above`"),
            );
        }
        if let Some(below) =
            events.slow_below.as_ref().filter(|b| !(b.get_ref().0 > 0.0 && b.get_ref().0 < rate))
        {
            self.conflict(
                &below.span(),
                "`slow_below` must be positive and less than `slow_above`",
                "a slow event ends at a lower rate than it begins",
                (&slow.span(), "`slow_above`"),
            );
        }
    }
}
