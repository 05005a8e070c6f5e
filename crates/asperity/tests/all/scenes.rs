//! Scenes that are accepted and refused, and the reading of values. The messages themselves are in the book's reference,
//! see `messages`.

use crate::messages::{self, refusal};
use asperity_plan::reading::diagnostic;
use asperity_plan::reading::scene::{self, units};
use asperity_vary::Change::{Add, Push, With, Without};
use asperity_vary::{Change, SceneText};
use serde::Deserialize;

/// The scene of two blocks with some changes.
fn changed(changes: &[Change<'_>]) -> String {
    SceneText::new(&messages::base("contact")).changed(changes).text().unwrap()
}

fn accepted(changes: &[Change<'_>]) {
    let text = changed(changes);
    let refused = refusal(&text);
    assert!(refused.is_none(), "{}\n{text}", refused.unwrap());
}

/// Key path of the law.
const LAW: &str = "interfaces.fault.law";

#[test]
fn each_law_with_its_parameters_is_accepted() {
    accepted(&[]);
    accepted(&[With(LAW, "{ kind = \"coulomb\", mu = 0.6 }")]);
    let state = "kind = \"rate-and-state\", mu0 = 0.6, a = 0.01, v_ref = \"1 um/s\", v_initial = \"1 nm/s\", f_limit = \"50 MPa\"";
    let one = "b = 0.02, l = \"10 um\"";
    let two = "b = [0.012, 0.003], l = [\"10 um\", \"1 mm\"]";
    for (form, evolution, b) in [("bare", "slip", one), ("regularised", "ageing", one), ("bare", "slip", two)]
    {
        let law = format!("{{ {state}, form = \"{form}\", evolution = \"{evolution}\", {b} }}");
        accepted(&[With(LAW, &law)]);
    }
    accepted(&[With(LAW, "{ kind = \"static-kinetic\", mu_s = 0.6, mu_k = 0.5 }")]);
    accepted(&[With(LAW, "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.5, d_c = \"0.4 m\" }")]);
    accepted(&[Without(LAW), Without("interfaces.fault.enforcement.tangential")]);
}

#[test]
fn sides_that_meet_may_say_the_same() {
    let (press, shear) = ("stages[0].conditions", "stages[1].conditions");
    accepted(&[Add("stages[0].conditions[1].x", "{ to = \"1 mm\" }")]);
    accepted(&[Push(press, "{ set = \"A.right\", y = \"hold\" }")]);
    // The position that one side reached in the first stage may be prescribed for the other in the second.
    accepted(&[Push(shear, "{ set = \"A.top\", x = \"1 mm\" }")]);
    // The same motion in different forms: a rate, a table, and positions held by both conditions.
    let x = "stages[0].conditions[1].x";
    accepted(&[Add(x, "{ rate = \"0.1 mm/s\" }"), Push(shear, "{ set = \"A.bottom\", x = \"hold\" }")]);
    accepted(&[Add(x, "{ table = [[0, 0], [\"4 s\", \"0.4 mm\"], [\"10 s\", \"1 mm\"]] }")]);
    accepted(&[Push(shear, "{ set = \"A.top\", x = \"hold\" }")]);
    // Opposite sides have no node in common.
    accepted(&[Push(press, "{ set = \"A.right\", x = \"2 mm\" }")]);
}

#[test]
fn a_released_component_meets_no_other_and_may_be_loaded() {
    accepted(&[
        With("stages[1].conditions[0].x", "free"),
        Add("stages[1].conditions[0].pressure", "{ to = \"5 MPa\" }"),
        Push("stages[1].conditions", "{ set = \"A.bottom\", x = \"3 mm\" }"),
    ]);
    accepted(&[
        Without("stages[0].conditions[0].x"),
        Add("stages[0].conditions[0].y", "0"),
        Add("stages[0].conditions[0].traction", "[{ table = [[0, 0], [\"10 s\", \"5 MPa\"]] }, 0]"),
    ]);
}

#[test]
fn a_scene_in_three_dimensions_is_accepted() {
    accepted(&[
        With("kinematics", "3d"),
        With("bodies.A.mesh.block.min", "[0, 0, 0]"),
        With("bodies.A.mesh.block.max", "[\"2 m\", \"4 m\", \"2 m\"]"),
        With("bodies.A.mesh.block.element", "hex8"),
        With("bodies.B.mesh.block.min", "[\"2 m\", \"-1 m\", 0]"),
        With("bodies.B.mesh.block.max", "[\"4 m\", \"5 m\", \"2 m\"]"),
        With("bodies.B.mesh.block.element", "tet4"),
        Add("stages[0].conditions[1].z", "0"),
        Push("stages[0].conditions", "{ set = \"B.back\", symmetry = true }"),
    ]);
}

#[test]
fn all_errors_of_a_scene_are_told_in_the_order_of_the_file() {
    let text = changed(&[
        With("materials.rock.poisson", "0.5"),
        With("stages[0].conditions[1].set", "A.botom"),
        With("time.tolerance", "0"),
    ]);
    let errors = scene::read(&text).unwrap_err();
    assert_eq!(errors.0.len(), 3, "{errors}");
    assert!(errors.0.windows(2).all(|w| w[0].span.start < w[1].span.start));
}

#[test]
fn a_report_shows_the_place_a_caret_and_the_remedy() {
    let text = "schema = 1\ntitle = \"x\"\nkinematics = \"plane-stres\"\n";
    let errors = scene::read(text).unwrap_err();
    let report = format!("{:?}", diagnostic::report("x.toml", text, &errors));
    for part in ["x.toml:3:14", "plane-stres`", "did you mean `plane-stress`?"] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
}

#[test]
fn a_slider_that_is_wrong_once_is_told_once() {
    for entry in messages::entries().iter().filter(|entry| entry.name.starts_with("sliders: ")) {
        let errors = entry.errors().unwrap();
        assert_eq!(errors.0.len(), 1, "{}: {errors}", entry.name);
    }
}

#[test]
fn all_errors_of_sliders_are_told_in_the_order_of_the_file() {
    let text = SceneText::new(&messages::base("sliders"))
        .with("sliders.left.damping", "-5 MPa s/m")
        .with("sliders.right.mass", "-1")
        .with("springs[0].between", "[\"left\", \"rigth\"]")
        .with("time.end", "0")
        .with("events.stop_after", "0")
        .text()
        .unwrap();
    let errors = refusal(&text).unwrap();
    let lines: Vec<usize> = errors.0.iter().map(|e| diagnostic::line_column(&text, e.span.start).0).collect();
    assert_eq!(lines, [9, 14, 17, 20, 24], "{errors}");
    let meant = errors.0[2].help.as_ref().unwrap();
    assert!(meant.contains("did you mean `right`?"), "{meant}");
}

#[test]
fn a_report_marks_both_places() {
    let text = messages::text("contact: shared nodes");
    let report = format!("{:?}", diagnostic::report("x.toml", &text, &refusal(&text).unwrap()));
    for part in ["x.toml:26:", "here", "and here", "`A.left` prescribes 0 m to 1 mm, `A.bottom` 0 m"] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
}

#[test]
fn places_far_apart_are_shown_without_what_lies_between() {
    let text = messages::text("contact: bdf2 of slip weakening");
    let report = format!("{:?}", diagnostic::report("x.toml", &text, &refusal(&text).unwrap()));
    for part in ["x.toml:19:", "the law of slip", "x.toml:36:", "rule = \"bdf2\""] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
    assert!(!report.contains("frictionless"), "{report}");
}

#[test]
fn a_name_that_cannot_be_is_told_once() {
    let errors = refusal(&messages::text("contact: body name")).unwrap();
    let about: Vec<&str> =
        errors.0.iter().map(|e| e.message.as_str()).filter(|m| m.contains("A.1")).collect();
    assert_eq!(about, ["`A.1` cannot be the name of a body"]);
}

#[derive(Debug, Deserialize)]
struct Holder<T> {
    value: T,
}

fn value<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, String> {
    toml::from_str::<Holder<T>>(&format!("value = {text}"))
        .map(|h| h.value)
        .map_err(|e| e.message().to_string())
}

#[test]
fn units_are_read_to_the_last_bit() {
    use units::{Density, Length, Penalty, Pressure, Time, Velocity};
    assert_eq!(value("\"1.25 mm\""), Ok(Length(0.00125)));
    assert_eq!(value("\"25mm\""), Ok(Length(0.025)));
    assert_eq!(value("\"-10 mm\""), Ok(Length(-0.01)));
    assert_eq!(value("\"1 nm\""), Ok(Length(1e-9)));
    assert_eq!(value("\"3 µm\""), Ok(Length(3e-6)));
    assert_eq!(value("\"100 km\""), Ok(Length(1e5)));
    assert_eq!(value("0"), Ok(Length(0.0)));
    assert_eq!(value("0.3"), Ok(Length(0.3)));
    assert_eq!(value("\"44.8 GPa\""), Ok(Pressure(44.8e9)));
    assert_eq!(value("\"1e-3 mm/s\""), Ok(Velocity(1e-6)));
    assert_eq!(value("\"-1E-3 mm/s\""), Ok(Velocity(-1e-6)));
    assert_eq!(value("\"35 mm/yr\""), Ok(Velocity(0.035 * (1.0 / 31_557_600.0))));
    assert_eq!(value("\"9.66 s\""), Ok(Time(9.66)));
    assert_eq!(value("\"20 yr\""), Ok(Time(631_152_000.0)));
    assert_eq!(value("\"90 min\""), Ok(Time(5400.0)));
    assert_eq!(value("\"2700 kg/m^3\""), Ok(Density(2700.0)));
    assert_eq!(value("\"2.7 g/cm^3\""), Ok(Density(2700.0)));
    assert_eq!(value("\"100 E/h\""), Ok(Penalty::YoungPerSize(100.0)));
    assert_eq!(value("\"1e12 Pa/m\""), Ok(Penalty::Value(1e12)));
    assert_eq!(value("\"5 MPa/mm\""), Ok(Penalty::Value(5e9)));
    assert_eq!(value("1e12"), Ok(Penalty::Value(1e12)));
}

#[test]
fn every_unit_is_of_one_dimension() {
    use units::{Density, Length, Pressure, Time, Velocity};
    let texts =
        ["1 mm", "1 s", "1 MPa", "1 m/s", "1 kg/m^3", "1 Pa/m", "1 E/h", "1 s/m", "1 bananas", "mm", "1"];
    for (i, text) in texts.iter().enumerate() {
        let quoted = format!("\"{text}\"");
        let read = [
            value::<Length>(&quoted).is_ok(),
            value::<Time>(&quoted).is_ok(),
            value::<Pressure>(&quoted).is_ok(),
            value::<Velocity>(&quoted).is_ok(),
            value::<Density>(&quoted).is_ok(),
        ];
        for (j, read) in read.into_iter().enumerate() {
            assert_eq!(read, i == j, "{text} as quantity {j}");
        }
    }
}

#[test]
fn a_value_that_is_not_finite_is_refused() {
    use units::Length;
    for text in [
        "inf",
        "-inf",
        "nan",
        "\"1e400 m\"",
        "\"inf m\"",
        "\"nan m\"",
        "\"1e99999999999 m\"",
        "\"- m\"",
        "\"e m\"",
    ] {
        assert!(value::<Length>(text).is_err(), "{text}");
    }
}

/// A fixed sequence that covers mantissas and exponents.
fn samples() -> impl Iterator<Item = f64> {
    let mut seed = 0x9e37_79b9_7f4a_7c15_u64;
    (0..2000).map(move |k| {
        seed ^= seed << 13;
        seed ^= seed >> 7;
        seed ^= seed << 17;
        (seed as f64 / u64::MAX as f64 - 0.5) * 10f64.powi(k % 25 - 12)
    })
}

#[test]
fn a_number_and_the_same_number_with_the_si_unit_are_one_value() {
    for x in samples() {
        assert_eq!(units::parse(&format!("{x:e} m"), units::Dimension::Length), Ok(x));
        assert_eq!(units::parse(&format!("{x} Pa"), units::Dimension::Pressure), Ok(x));
    }
}

#[test]
fn prefixes_agree_with_powers_of_ten() {
    use units::{Dimension, parse};
    for x in samples() {
        let kilometres = parse(&format!("{x} km"), Dimension::Length).unwrap();
        assert_eq!(kilometres, format!("{x}e3").parse::<f64>().unwrap());
        let micrometres = parse(&format!("{x:e} um"), Dimension::Length).unwrap();
        assert!((micrometres * 1e6 - x).abs() <= 4.0 * f64::EPSILON * x.abs());
        let year = parse(&format!("{x} mm/yr"), Dimension::Velocity).unwrap();
        assert!((year * 1e3 * 31_557_600.0 - x).abs() <= 8.0 * f64::EPSILON * x.abs());
    }
}
