//! Restrictions on faults in earthquake cycles. Without them, keys that apply to interfaces and sliders would be ignored
//! silently.

use super::Checker;
use crate::model::{Fault, Spanned};

impl Checker<'_> {
    pub(super) fn physics_of(&mut self, fault: &Fault) {
        let positive = |v: f64| v > 0.0 && v.is_finite();
        if let Some(floor) = fault.normal_floor.as_ref().filter(|f| !positive(f.get_ref().0)) {
            self.error(
                floor.span(),
                "`normal_floor` must be positive: without pressure friction has no slip rate",
                "such as `normal_floor = \"1 MPa\"`",
            );
        }
        self.opening_of(fault);
        self.tractions_at_the_start(fault);
    }

    /// Checks the requirements of a fault that opens.
    fn opening_of(&mut self, fault: &Fault) {
        let Some(opening) = fault.opening.as_ref().filter(|o| *o.get_ref() && !self.has_waves()) else {
            return;
        };
        if let Some(stays) = fault.normal_changes.as_ref().filter(|c| !c.get_ref()) {
            self.conflict(
                &opening.span(),
                "`opening` contradicts `normal_changes = false`: a fault opens where its normal traction has gone",
                "remove one of them",
                (&stays.span(), "normal tractions stay"),
            );
        } else if fault.normal_floor.is_none() {
            self.error(
                opening.span(),
                "`opening` needs a `normal_floor`: where a fault is open friction uses it, since without pressure it has no slip rate",
                "such as `normal_floor = \"0.1 MPa\"`, little beside the normal tractions at the start",
            );
        }
    }

    /// Checks the source of the initial tractions: keys of the fault or an initial stress of its bodies.
    fn tractions_at_the_start(&mut self, fault: &Fault) {
        let profile = |p: &Option<crate::model::ParameterProfiles>| {
            p.as_ref().and_then(|p| p.0.first()).map(|p| p.points.span())
        };
        let file = |f: &Option<crate::model::Field>| f.as_ref().map(|f| f.file.span());
        let (profiles, fields) = (&fault.profiles, &fault.fields);
        let normal = fault.normal.as_ref().map(Spanned::span);
        let normal = normal.or(profile(&profiles.normal)).or(file(&fields.normal));
        let shear = fault.shear.as_ref().map(Spanned::span);
        let shear = shear.or(profile(&profiles.shear)).or(file(&fields.shear));
        let bodies = [&fault.minus, &fault.plus].map(|side| self.scene.body_of(side));
        let stress = bodies.iter().flatten().find_map(|b| b.initial_stress.as_ref());
        let pressed = stress.is_some_and(|s| s.get_ref().presses());
        let in_plane = !self.is_antiplane();
        let weight = self.scene.bodies.values().find_map(|b| b.gravity.as_ref()).filter(|_| in_plane);
        let pressing = super::pressing::stage(self.scene).is_some();
        self.tractions_beside_pressing(normal.clone(), fault);
        if normal.is_none() && !pressed && weight.is_none() && !pressing {
            self.error(
                fault.span(),
                "nothing presses the fault: it has no `normal`",
                "such as `normal = \"50 MPa\"`, `profiles.normal`, `gravity`, a stage before the one in which it slides, or an `initial_stress` of its bodies with components in the plane",
            );
        }
        if let (Some(weight), Some(normal)) = (weight, &normal) {
            self.conflict(
                normal,
                "`normal` is given together with `gravity`, which determines the same traction",
                "remove `normal` and its profile, or the `gravity` of the bodies",
                (&weight.span(), "the gravity"),
            );
        }
        let Some(stress) = stress.filter(|_| !pressing) else { return };
        let in_patches = fault.patches.iter().flat_map(|patch| {
            let normal = patch.normal.as_ref().filter(|_| pressed).map(Spanned::span);
            [("normal", normal), ("shear", patch.shear.as_ref().map(Spanned::span))]
        });
        let everywhere = [("normal", normal.filter(|_| pressed)), ("shear", shear)];
        for (key, place) in everywhere.into_iter().chain(in_patches) {
            let Some(place) = place else { continue };
            self.conflict(
                &place,
                format!(
                    "`{key}` is given together with an initial stress, which determines the same traction"
                ),
                format!("remove `{key}` and its profile, or the `initial_stress`"),
                (&stress.span(), "the initial stress"),
            );
        }
    }

    /// Checks gravity in a scene with faults: none in antiplane motion, and the same for all bodies.
    pub(super) fn weight_beside_faults(&mut self) {
        let scene = self.scene;
        let mut weighing = scene.bodies.iter().filter_map(|(name, b)| Some((name, b.gravity.as_ref()?)));
        let Some((name, gravity)) = weighing.next().filter(|_| !scene.faults.is_empty()) else { return };
        if self.is_antiplane() {
            self.error(
                gravity.span(),
                format!("`gravity` of body `{name}` presses no fault in antiplane motion, where bodies move out of the plane only"),
                "leave it out and give the normal traction of the weight less the pressure of pores, such as `profiles.normal = { along = \"y\", points = \
                 [[\"-40 km\", 672e6], [\"0 km\", 1e6]] }` at the fault",
            );
            return;
        }
        let same =
            |b: &crate::model::Body| b.gravity.as_ref().map(Spanned::get_ref) == Some(gravity.get_ref());
        if let Some((other, _)) = scene.bodies.iter().find(|(_, b)| !same(b)) {
            self.error(
                gravity.span(),
                format!("`gravity` of body `{name}` is not that of body `{other}`"),
                "in a scene with faults all bodies have the same `gravity`; what they weigh follows from their densities",
            );
        }
    }

    /// Refuses an initial stress of a body without a fault, which would have no effect.
    pub(super) fn stress_beside_faults(&mut self) {
        let scene = self.scene;
        if scene.faults.is_empty() {
            return;
        }
        let on_fault = |name: &str| {
            let of = |set: &Spanned<String>| set.get_ref().split('.').next() == Some(name);
            scene.faults.values().any(|f| of(&f.minus) || of(&f.plus))
        };
        for (name, body) in &scene.bodies {
            let Some(stress) = body.initial_stress.as_ref().filter(|_| !on_fault(name)) else { continue };
            self.error(
                stress.span(),
                format!("the initial stress of body `{name}` presses no fault, and has no other effect in a scene with faults"),
                "remove it",
            );
        }
    }
}
