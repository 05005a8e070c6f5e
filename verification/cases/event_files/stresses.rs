//! Stresses of the blocks and tractions of the fault over an event, in fields and in the table of its points.
//!
//! Slip by s shears both blocks, each a kilometre wide, by half of it: the stress changes by -G s/(2 km).

use super::{Mechanism, ROCK};
use crate::cases::output_files::vtu::Fields;
use crate::cases::run_files::WrittenRun;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};

/// Friction coefficient, strike, dip and rake \[degrees\] of the planes on which stress is resolved.
const FRICTION: f64 = 0.4;
const PLANES: Mechanism = Mechanism { strike: 200.0, dip: 70.0, rake: 35.0 };
/// Stiffness of both blocks in series \[Pa/m\].
const STIFFNESS: f64 = ROCK / 2e3;
/// Rate of the load, and slip rate at the onset \[m/s\].
const LOAD: f64 = 1e-9;
const ON: f64 = 1e-4;
/// Radiation damping, G/(2 c_s) \[Pa s/m\].
const DAMPING: f64 = 4.622e6;
/// Corners of the fault, and the middle of its sides of 1.5 km, in the order of the scene's axes \[m\].
const PLACES: [[f64; 3]; 6] = [
    [-5e3, 1e3, -3e3],
    [-5e3, 1.75e3, -3e3],
    [-5e3, 2.5e3, -3e3],
    [-5e3, 1e3, -2e3],
    [-5e3, 1.75e3, -2e3],
    [-5e3, 2.5e3, -2e3],
];

/// Key `coulomb` of the scene.
pub(super) fn asked() -> String {
    let Mechanism { strike, dip, rake } = PLANES;
    format!(
        "{{ friction = {FRICTION:?}, strike = \"{strike} deg\", dip = \"{dip} deg\", rake = \"{rake} deg\" }}"
    )
}

/// Normal and direction of slip of the planes, north, east and up (Aki and Richards 2002, section 4.5).
fn planes() -> [[f64; 3]; 2] {
    let Mechanism { strike, dip, rake } = PLANES;
    let [(ss, cs), (sd, cd), (sl, cl)] = [strike, dip, rake].map(|angle| angle.to_radians().sin_cos());
    let normal = [-sd * ss, sd * cs, cd];
    [normal, [cl * cs + cd * sl * ss, cl * ss - cd * sl * cs, sl * sd]]
}

/// Shear traction along the slip of the planes and pressure on them, of these shear stresses in planes across x \[Pa\].
fn resolved(mechanism: &Mechanism, [y, z]: [f64; 2]) -> [f64; 2] {
    let origin = mechanism.offset([0.0; 3]);
    // An axis of the scene as parts north, east and up.
    let axis = |c: usize| {
        let moved = mechanism.offset(std::array::from_fn(|k| f64::from(u8::from(k == c))));
        [0, 1, 2].map(|k| moved[k] - origin[k])
    };
    let axes = [axis(0), axis(1), axis(2)];
    let part = |way: &[f64; 3], c: usize| (0..3).map(|k| way[k] * axes[c][k]).sum::<f64>();
    let on = |one: &[f64; 3], other: &[f64; 3]| {
        y * (part(one, 0) * part(other, 1) + part(one, 1) * part(other, 0))
            + z * (part(one, 0) * part(other, 2) + part(one, 2) * part(other, 0))
    };
    let [normal, along] = planes();
    [on(&normal, &along), -on(&normal, &normal)]
}

/// Largest errors over all mechanisms.
#[derive(Default)]
pub(super) struct Worst {
    /// Of stresses of cells, over that of the slip.
    stress: f64,
    /// Of changes on planes, over the same.
    changes: f64,
    /// Of stress drops in the table and in the fields, over the drop.
    drops: f64,
    /// Of rupture times \[s\] and largest slip rates in the fields against the table, relative.
    others: f64,
    /// Positions in the table \[m\].
    places: f64,
}

/// The largest of a value and those of others.
fn most(worst: f64, others: impl IntoIterator<Item = f64>) -> f64 {
    // A missing number counts as wrong.
    others.into_iter().fold(worst, |m, v| if v.is_nan() { f64::INFINITY } else { m.max(v.abs()) })
}

impl Worst {
    pub(super) fn add(&mut self, mechanism: &Mechanism, done: &WrittenRun) -> Result<(), CaseError> {
        let events = done.files.table("events.csv")?;
        let slip = events.only("mean_slip")?;
        let (sine, cosine) = mechanism.rake.to_radians().sin_cos();
        // The rake is in the fault: its part up dip along y, and that along strike against z.
        let way = [0.0, sine, -cosine];
        self.stressed(mechanism, done, way.map(|part| -STIFFNESS * slip * part))?;
        let drop = STIFFNESS * (slip - LOAD * events.only("duration")?);
        self.dropped(done, way, drop)
    }

    /// Stresses of the cells, whose blocks have these tractions on planes across x \[Pa\].
    fn stressed(
        &mut self,
        mechanism: &Mechanism,
        done: &WrittenRun,
        [_, y, z]: [f64; 3],
    ) -> Result<(), CaseError> {
        let fields = Fields::read(&done.files.text("events/stress_000.vtu")?)?;
        let size = y.hypot(z);
        // VTK's order: xx, yy, zz, xy, yz, xz.
        let wanted = [0.0, 0.0, 0.0, y, 0.0, z];
        let stress = &fields.array("stress")?.values;
        let off = stress.chunks(6).flat_map(|cell| (0..6).map(move |c| (cell[c] - wanted[c]) / size));
        self.stress = most(self.stress, off);
        let [shear, pressed] = resolved(mechanism, [y, z]);
        for (name, wanted) in [
            ("shear_change", shear),
            ("normal_change", pressed),
            ("coulomb_change", shear - FRICTION * pressed),
        ] {
            let values = &fields.array(name)?.values;
            self.changes = most(self.changes, values.iter().map(|found| (found - wanted) / size));
        }
        if stress.len() == 24 { Ok(()) } else { Err("not four cells".into()) }
    }

    /// Positions, stress drops, rupture times and largest slip rates of the points, which slip along `way`.
    fn dropped(&mut self, done: &WrittenRun, way: [f64; 3], drop: f64) -> Result<(), CaseError> {
        let table = done.files.table("events/rupture_times_000.csv")?;
        let fields = Fields::read(&done.files.text("fields/main_event_000.vtu")?)?;
        let numbers = |name: &str| table.column(name);
        for (c, axis) in ["x", "y", "z"].into_iter().enumerate() {
            let found = numbers(axis)?;
            let off = (0..PLACES.len()).map(|k| found.get(k).map_or(f64::NAN, |at| at - PLACES[k][c]));
            self.places = most(self.places, off);
        }
        let values = |name: &str| -> Result<&[f64], CaseError> { Ok(&fields.array(name)?.values) };
        let found = [numbers("stress_drop")?, values("stress_drop")?.to_vec()].concat();
        self.drops = most(self.drops, found.iter().map(|found| found / drop - 1.0));
        let vectors = values("stress_drop_vector")?.chunks(3);
        self.drops =
            most(self.drops, vectors.flat_map(|v| (0..3).map(|c| v[c] / drop - way[c]).collect::<Vec<_>>()));
        for (name, column) in
            [("rupture_time", "time since onset"), ("largest_slip_rate", "largest slip_rate")]
        {
            let wanted = numbers(column)?;
            let off = values(name)?.iter().zip(&wanted).map(|(found, wanted)| found / wanted - 1.0);
            self.others = most(self.others, off);
        }
        let whole = found.len() == 2 * PLACES.len() && values("rupture_time")?.len() == PLACES.len();
        if whole { Ok(()) } else { Err("points are missing".into()) }
    }

    pub(super) fn claims(&self, ledger: &mut Ledger, cost: &Cost) {
        let damped = DAMPING * ON / 4e6;
        for (what, unit, value, bound, source, because) in [
            (
                "stress of the cells of both blocks in events/stress_000.vtu, largest error over that of the slip",
                "-",
                self.stress,
                1e-8,
                "-G s/(2 km) along the slip, in planes across x",
                "points differ by 1e-9 of their slip",
            ),
            (
                "shear_change, normal_change and coulomb_change on oblique planes in the same file, largest error over the stress",
                "-",
                self.changes,
                1e-8,
                "Aki and Richards: normal and slip of strike, dip and rake, and the direction north of the scene",
                "points differ by 1e-9 of their slip",
            ),
            (
                "stress_drop in the table of rupture times, and stress_drop and stress_drop_vector in fields/main_event_000.vtu, largest error over the drop",
                "-",
                self.drops,
                damped,
                "G/(2 km) times what the slip exceeds the load, along the rake",
                "the slip rate at the onset is damped by 4.6 MPa s/m: 462 Pa of more than 4 MPa",
            ),
            (
                "rupture_time and largest_slip_rate in fields/main_event_000.vtu against the table, largest relative difference",
                "-",
                self.others,
                1e-8,
                "the same points in another file",
                "the table has ten digits",
            ),
            (
                "positions in the table of rupture times, largest error",
                "m",
                self.places,
                1e-6,
                "nodes of two cells of 750 m at x = -5 km, by z and then by y",
                "rounding of positions of kilometres",
            ),
        ] {
            ledger
                .claim(format!("events of four oblique mechanisms: {what}"))
                .unit(unit)
                .value(value)
                .at_most(bound)
                .evidence(Evidence::Exact, source)
                .because(because)
                .why_not_tighter("rounding and the errors of steps depend on the mechanism; a wrong sign, axis or unit is of the order of one")
                .covers(&[Capability::Outputs])
                .cost(cost)
                .record();
        }
    }
}
