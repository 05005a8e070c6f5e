//! Events in the seismological formats QuakeML and CMTSOLUTION, with moment tensors and geographic locations.

mod stresses;

use crate::cases::run_files::WrittenRun;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "event_files",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Solid3d, Capability::Events, Capability::Outputs],
    quick: true,
    run,
};

/// Shear modulus \[Pa\], length along strike \[m\] and area of the fault \[m²\].
const ROCK: f64 = 32e9;
const LENGTH: f64 = 1e3;
const AREA: f64 = 1.5e3 * LENGTH;
/// Origin of the scene: degrees north, degrees east, depth \[m\].
const ORIGIN: [f64; 3] = [60.0, -150.0, 1e3];
/// Mean radius of the Earth \[m\] (Moritz 2000), a scale for angles.
const EARTH: f64 = 6_371_008.8;
/// Components of tensors, in the order of both formats.
const NAMES: [&str; 6] = ["Mrr", "Mtt", "Mpp", "Mrt", "Mrp", "Mtp"];

/// A plane and the direction of slip on it \[degrees\].
#[derive(Clone, Copy)]
struct Mechanism {
    strike: f64,
    dip: f64,
    rake: f64,
}

/// The mechanism of the scene, and others.
const MECHANISMS: [Mechanism; 4] = [
    Mechanism { strike: 25.0, dip: 40.0, rake: 110.0 },
    Mechanism { strike: 130.0, dip: 75.0, rake: -20.0 },
    Mechanism { strike: 250.0, dip: 20.0, rake: -100.0 },
    Mechanism { strike: 340.0, dip: 60.0, rake: 160.0 },
];

impl Mechanism {
    /// The scene with this mechanism: the footwall remains on the left.
    fn scene(&self) -> Result<String, CaseError> {
        let (up, across) = self.dip.to_radians().sin_cos();
        let (dips, along) = self.rake.to_radians().sin_cos();
        let rate = |part: f64| format!("{:e}", 0.5e-9 * part);
        let scene = SceneText::new(include_str!("scene.toml"))
            .with_or_same("place.strike", format!("{} deg", self.strike))
            .with_or_same("place.up", format!("[{across:?}, {up:?}, 0]"))
            .with_or_same("faults.main.rake", format!("[0, {dips:?}, {:?}]", -along))
            .with_or_same("stages[0].conditions[0].y.rate", rate(-dips))
            .with_or_same("stages[0].conditions[0].z.rate", rate(along))
            .with_or_same("stages[0].conditions[1].y.rate", rate(dips))
            .with_or_same("stages[0].conditions[1].z.rate", rate(-along))
            .add("output", format!("{{ coulomb = {} }}", stresses::asked()));
        Ok(scene.text()?)
    }

    /// Moment tensor over the scalar moment; axes up, south and east (Aki and Richards 2002, box 4.4).
    fn tensor(&self) -> [f64; 6] {
        let (ss, cs) = self.strike.to_radians().sin_cos();
        let (s2s, c2s) = (2.0 * self.strike).to_radians().sin_cos();
        let (sd, cd) = self.dip.to_radians().sin_cos();
        let (s2d, c2d) = (2.0 * self.dip).to_radians().sin_cos();
        let (sl, cl) = self.rake.to_radians().sin_cos();
        // x north, y east, z down.
        let xx = -(sd * cl * s2s + s2d * sl * ss * ss);
        let xy = sd * cl * c2s + 0.5 * s2d * sl * s2s;
        let xz = -(cd * cl * cs + c2d * sl * ss);
        let yy = sd * cl * s2s - s2d * sl * cs * cs;
        let yz = -(cd * cl * ss - c2d * sl * cs);
        let zz = s2d * sl;
        [zz, xx, yy, xz, -yz, -xy]
    }

    /// North, east and up offsets \[m\] of a point of the scene from the origin.
    fn offset(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let (up, across) = self.dip.to_radians().sin_cos();
        let (right, along) = (x * up - y * across, -z);
        let (sine, cosine) = self.strike.to_radians().sin_cos();
        [along * cosine - right * sine, along * sine + right * cosine, x * across + y * up]
    }
}

/// Latitude and longitude \[degrees\] of an offset on the transverse Mercator projection of WGS84 around the origin, to
/// second order: from the latitude φ of the foot on the meridian, `φ - e² tan φ/(2 M N)` and `e/(N cos φ)` east.
fn travelled([north, east, _]: [f64; 3]) -> [f64; 2] {
    let [along, across] = radii(ORIGIN[0].to_radians());
    let foot = ORIGIN[0].to_radians() + north / along;
    let latitude = foot - east * east * foot.tan() / (2.0 * along * across);
    [latitude.to_degrees(), ORIGIN[1] + (east / (across * foot.cos())).to_degrees()]
}

/// Radii of curvature M and N of WGS84, along the meridian and across it, at a latitude \[m\].
fn radii(latitude: f64) -> [f64; 2] {
    let (major, squared) = (6_378_137.0, 6.694_379_990_141e-3);
    let root = (1.0 - squared * latitude.sin().powi(2)).sqrt();
    [major * (1.0 - squared) / root.powi(3), major / root]
}

/// Number that follows a name, on the same line or in an element `value`.
fn number(text: &str, name: &str) -> Result<f64, CaseError> {
    let after = text.split_once(name).ok_or_else(|| format!("no {name}"))?.1;
    let digits = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    let from = after.find(|c: char| c.is_ascii_digit() || c == '-').ok_or("no number")?;
    let word: String = after[from..].chars().take_while(|c| digits(*c)).collect();
    Ok(word.parse()?)
}

/// Largest errors over all mechanisms.
#[derive(Default)]
struct Worst {
    /// Errors of tensor components over the moment, in QuakeML and in CMTSOLUTION.
    tensors: [f64; 2],
    moment: f64,
    magnitude: f64,
    /// Angles between the locations and those of second order, over the second order.
    places: f64,
    depth: f64,
    /// Differences of coordinates in the table from those in QuakeML, and of the rupture length from the edge of the fault \[m\].
    table: f64,
    length: f64,
}

impl Worst {
    fn add(&mut self, mechanism: &Mechanism, done: &WrittenRun) -> Result<(), CaseError> {
        let events = done.files.table("events.csv")?;
        let moment = ROCK * AREA * events.only("mean_slip")?;
        let (xml, cmt) = (done.files.text("events.quakeml")?, done.files.text("CMTSOLUTION")?);
        for (name, expected) in NAMES.iter().zip(mechanism.tensor()) {
            let found = [
                number(&xml, &format!("<{name}>"))? / moment,
                number(&cmt, &format!("{name}:"))? / (1e7 * moment),
            ];
            for (worst, found) in self.tensors.iter_mut().zip(found) {
                *worst = worst.max((found - expected).abs());
            }
        }
        self.moment = self.moment.max((number(&xml, "<scalarMoment>")? / moment - 1.0).abs());
        let magnitude = (moment.log10() - 9.1) / 1.5;
        self.magnitude = self.magnitude.max((number(&xml, "<mag>")? - magnitude).abs());
        let at = [events.only("x")?, events.only("y")?, events.only("z")?];
        for (column, name) in [("latitude", "<latitude>"), ("longitude", "<longitude>"), ("depth", "<depth>")]
        {
            self.table = self.table.max((events.only(column)? - number(&xml, name)?).abs());
        }
        self.length = self.length.max((events.only("rupture_length")? - LENGTH).abs());
        self.place(mechanism.offset(at), &xml)
    }

    fn place(&mut self, offset: [f64; 3], xml: &str) -> Result<(), CaseError> {
        let expected = travelled(offset);
        let [north, east] =
            [number(xml, "<latitude>")? - expected[0], number(xml, "<longitude>")? - expected[1]];
        let (tangent, cosine) = (ORIGIN[0].to_radians().tan(), ORIGIN[0].to_radians().cos());
        let arc = offset[0].hypot(offset[1]) / EARTH;
        let apart = north.hypot(east * cosine).to_radians() / (arc * arc * tangent);
        self.places = self.places.max(apart);
        self.depth = self.depth.max((number(xml, "<depth>")? - (ORIGIN[2] - offset[2])).abs());
        Ok(())
    }
}

/// A claim: its quantity, unit, value, bound, source and reason.
type ClaimRow = (&'static str, &'static str, f64, f64, &'static str, &'static str);

impl Worst {
    fn claims(&self) -> [ClaimRow; 8] {
        let couple = "Aki and Richards: the double couple of strike, dip and rake, with Mrr = Mzz, Mtt = Mxx, Mpp = Myy, Mrt = Mxz, Mrp = -Myz, Mtp = -Mxy";
        [
            (
                "components of the moment tensor in QuakeML over G times area times slip, largest error",
                "-",
                self.tensors[0],
                1e-12,
                couple,
                "rounding of angles and sums: all digits are written",
            ),
            (
                "components of the moment tensor in CMTSOLUTION over G times area times slip in dyn cm, largest error",
                "-",
                self.tensors[1],
                5.1e-7,
                couple,
                "the format has seven digits",
            ),
            (
                "scalar moment in QuakeML over G times area times slip, largest relative error",
                "-",
                self.moment,
                1e-12,
                "a double couple has the moment of its slip",
                "rounding",
            ),
            (
                "magnitude in QuakeML, largest error",
                "-",
                self.magnitude,
                1e-12,
                "Mw = (log10 M0 - 9.1)/1.5 with M0 in N m, standard of IASPEI (2013)",
                "rounding",
            ),
            (
                "coordinates of the hypocentre in the table of events against those in QuakeML, largest difference",
                "deg or m",
                self.table,
                1e-9,
                "the same position in another file",
                "rounding: all digits are written",
            ),
            (
                "rupture length over four mechanisms, largest error",
                "m",
                self.length,
                1e-6,
                "the horizontal edge of the fault, 1 km, at whose ends the points lie; up dip they lie 1.5 km apart",
                "rounding of positions of kilometres",
            ),
            (
                "arc between hypocentre in QuakeML and its offset to second order, over d^2 tan(latitude), d the arc from the origin",
                "-",
                self.places,
                0.02,
                "Snyder (1987), transverse Mercator projection, equations 8-17 and 8-18",
                "third order of d = 1e-3, with some factors of the tangent of 60 degrees, and changes of the radii, 0.7 % of the second order",
            ),
            (
                "depth of the hypocentre in QuakeML, largest error",
                "m",
                self.depth,
                1e-10,
                "position along the direction up, from the depth of the origin",
                "rounding of some thousand metres and of directions: a few times 1e-12",
            ),
        ]
    }
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut worst, mut stresses, mut last) = (Worst::default(), stresses::Worst::default(), None);
    for mechanism in &MECHANISMS {
        let done = WrittenRun::from_text(&mechanism.scene()?)?;
        worst.add(mechanism, &done)?;
        stresses.add(mechanism, &done)?;
        last = Some(done.cost);
    }
    let cost = last.ok_or("no mechanism")?;
    for (what, unit, value, bound, source, because) in worst.claims() {
        ledger
            .claim(format!("events of four oblique mechanisms: {what}"))
            .unit(unit)
            .value(value)
            .at_most(bound)
            .evidence(Evidence::Exact, source)
            .because(because)
            .why_not_tighter("rounding depends on the mechanism and the place; a digit that the files lacked would show at 1e-10 or above")
            .cost(&cost)
            .record();
    }
    stresses.claims(ledger, &cost);
    Ok(())
}
