//! Every file of `bad_scenes` is refused where and as its first line says: `# expect: LINE:COLUMN part of the message`,
//! or `# expect: - part of the message` where the error is about no place in the file.

use asperity_driver::diagnostic;
use asperity_driver::diagnostic::Diagnostics;
use asperity_driver::scene::{self, units};
use serde::Deserialize;
use std::path::PathBuf;

fn files(folder: &str) -> Vec<(String, String)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(folder);
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    files.retain(|f| f.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
        .into_iter()
        .map(|f| {
            (f.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(&f).unwrap())
        })
        .collect()
}

fn errors(text: &str) -> Option<Diagnostics> {
    if scene::slider::is_slider(text) {
        return asperity_driver::slider_planner::read(text).err();
    }
    let meshes = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/meshes");
    match scene::read_in(text, &meshes) {
        Err(errors) => Some(errors),
        Ok(scene) => asperity_driver::plan::plan_scene(&scene).err().map(Diagnostics::from),
    }
}

/// What is wrong with how a file is refused.
fn complaint(text: &str) -> Option<String> {
    let first = text.lines().next().unwrap_or_default();
    let (place, part) = first.strip_prefix("# expect: ").and_then(|e| e.split_once(' ')).unwrap();
    let Some(errors) = errors(text) else { return Some("is accepted".into()) };
    let error = &errors.0[0];
    let (line, column) = diagnostic::line_column(text, error.span.start);
    let found = if error.span.is_empty() { "-".to_string() } else { format!("{line}:{column}") };
    if found != place || !error.message.contains(part) {
        return Some(format!("expected {place} {part}\n   found {found} {}", error.message));
    }
    // A second line may ask for the remedy.
    let remedy = text.lines().nth(1).and_then(|line| line.strip_prefix("# help: "))?;
    let help = error.help.clone().unwrap_or_default();
    (!help.contains(remedy)).then(|| format!("expected the help {remedy}\n   found {help}"))
}

#[test]
fn every_bad_scene_is_refused_at_its_place_with_its_reason() {
    let files = files("tests/bad_scenes");
    assert!(files.len() >= 370, "only {} files", files.len());
    let wrong: Vec<String> =
        files.iter().filter_map(|(name, text)| complaint(text).map(|c| format!("{name}: {c}"))).collect();
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), files.len(), wrong.join("\n"));
}

#[test]
fn every_scene_of_the_repository_is_accepted() {
    let files = files("../../scenes");
    assert!(!files.is_empty());
    for (name, text) in files {
        let refused = errors(&text);
        assert!(refused.is_none(), "{name}: {}", refused.unwrap());
    }
}

/// The scene of two blocks with some text replaced.
fn changed(changes: &[(&str, &str)]) -> String {
    let (_, text) = files("tests/bad_scenes").into_iter().find(|(name, _)| name == "poisson.toml").unwrap();
    let mut text = text.replace("poisson = 0.5", "poisson = 0.25");
    for (old, new) in changes {
        assert!(text.contains(old), "{old}");
        text = text.replacen(old, new, 1);
    }
    text
}

fn accepted(changes: &[(&str, &str)]) {
    let text = changed(changes);
    let refused = errors(&text);
    assert!(refused.is_none(), "{}\n{text}", refused.unwrap());
}

const STATE: &str = "{ kind = \"rate-and-state\", form = \"bare\", evolution = \"slip\", mu0 = 0.6, a = 0.01, b = 0.02, \
                     l = \"10 um\", v_ref = \"1 um/s\", v_initial = \"1 nm/s\", f_limit = \"50 MPa\" }";
const RATE: &str = "{ kind = \"rate\", mu0 = 0.6, a = 0.01, v_ref = \"1 um/s\" }";

#[test]
fn each_law_with_its_parameters_is_accepted() {
    accepted(&[]);
    accepted(&[(RATE, "{ kind = \"coulomb\", mu = 0.6 }")]);
    accepted(&[(RATE, STATE)]);
    accepted(&[(RATE, &STATE.replace("slip", "ageing").replace("bare", "regularised"))]);
    accepted(&[(RATE, "{ kind = \"static-kinetic\", mu_s = 0.6, mu_k = 0.5 }")]);
    accepted(&[(RATE, "{ kind = \"slip-weakening\", mu_s = 0.6, mu_k = 0.5, d_c = \"0.4 m\" }")]);
    let two = STATE.replace("b = 0.02, l = \"10 um\"", "b = [0.012, 0.003], l = [\"10 um\", \"1 mm\"]");
    accepted(&[(RATE, &two)]);
    let law = format!("law = {RATE}\n");
    accepted(&[(law.as_str(), ""), (", tangential = \"100 E/h\"", "")]);
}

#[test]
fn sides_that_meet_may_say_the_same() {
    let bottom = "{ set = \"A.bottom\", y = 0 }";
    accepted(&[(bottom, "{ set = \"A.bottom\", x = { to = \"1 mm\" }, y = 0 }")]);
    accepted(&[(bottom, "{ set = \"A.bottom\", y = 0 }, { set = \"A.right\", y = \"hold\" }")]);
    // What one side reached in the first stage, the other may prescribe in the second.
    accepted(&[(
        "{ set = \"A.left\", x = \"hold\" }",
        "{ set = \"A.left\", x = \"hold\" }, { set = \"A.top\", x = \"1 mm\" }",
    )]);
    // One course in other words: a rate, a table, and what is held on both.
    let hold = "{ set = \"A.left\", x = \"hold\" }";
    let rate = "{ set = \"A.bottom\", x = { rate = \"0.1 mm/s\" }, y = 0 }";
    accepted(&[(bottom, rate), (hold, &format!("{hold}, {{ set = \"A.bottom\", x = \"hold\" }}"))]);
    let table = "{ set = \"A.bottom\", x = { table = [[0, 0], [\"4 s\", \"0.4 mm\"], [\"10 s\", \"1 mm\"]] }, y = 0 }";
    accepted(&[(bottom, table)]);
    accepted(&[(hold, &format!("{hold}, {{ set = \"A.top\", x = \"hold\" }}"))]);
    // Opposite sides have no node in common.
    accepted(&[(bottom, "{ set = \"A.bottom\", y = 0 }, { set = \"A.right\", x = \"2 mm\" }")]);
}

#[test]
fn a_released_component_meets_no_other_and_may_be_loaded() {
    accepted(&[(
        "{ set = \"A.left\", x = \"hold\" }",
        "{ set = \"A.left\", x = \"free\", pressure = { to = \"5 MPa\" } }, { set = \"A.bottom\", x = \"3 mm\" }",
    )]);
    accepted(&[(
        "x = { to = \"1 mm\" }",
        "y = 0, traction = [{ table = [[0, 0], [\"10 s\", \"5 MPa\"]] }, 0]",
    )]);
}

#[test]
fn a_scene_in_three_dimensions_is_accepted() {
    accepted(&[
        ("plane-strain", "3d"),
        ("[0, 0]", "[0, 0, 0]"),
        ("\"4 m\"]", "\"4 m\", \"2 m\"]"),
        ("[\"2 m\", \"-1 m\"]", "[\"2 m\", \"-1 m\", 0]"),
        ("\"5 m\"]", "\"5 m\", \"2 m\"]"),
        ("quad4", "hex8"),
        ("quad4", "tet4"),
        (
            "    { set = \"A.bottom\", y = 0 },",
            "{ set = \"A.bottom\", y = 0, z = 0 }, { set = \"B.back\", symmetry = true },",
        ),
    ]);
}

#[test]
fn all_errors_of_a_scene_are_told_in_the_order_of_the_file() {
    let (_, text) = files("tests/bad_scenes").into_iter().find(|(name, _)| name == "poisson.toml").unwrap();
    let text = text.replace("\"A.bottom\"", "\"A.botom\"").replace("\"1 nm\"", "0");
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

/// Line and column of the places an error points to, its own first.
fn places(name: &str) -> Vec<(usize, usize)> {
    let (_, text) = files("tests/bad_scenes").into_iter().find(|(file, _)| file == name).unwrap();
    let error = errors(&text).unwrap().0.swap_remove(0);
    let spans = std::iter::once(&error.span).chain(error.also.iter().map(|(span, _)| span));
    spans.map(|span| diagnostic::line_column(&text, span.start)).collect()
}

#[test]
fn what_contradicts_itself_is_shown_at_both_places() {
    assert_eq!(places("shared_nodes.toml"), [(27, 29), (26, 27)]);
    assert_eq!(places("shared_nodes_later.toml"), [(34, 68), (34, 37)]);
    assert_eq!(places("condition_twice.toml"), [(27, 58), (27, 29)]);
    assert_eq!(places("symmetry_and_motion.toml"), [(28, 45), (28, 35)]);
    assert_eq!(places("traction_and_motion.toml"), [(26, 55), (26, 27)]);
    assert_eq!(places("pressure_on_held_motion.toml"), [(34, 44), (26, 27)]);
    assert_eq!(places("size_and_divisions.toml"), [(9, 78), (9, 59)]);
    assert_eq!(places("min_above_max.toml"), [(37, 12), (38, 12)]);
    assert_eq!(places("bdf2_of_slip_weakening.toml"), [(37, 8), (20, 16)]);
    assert_eq!(places("law_states_of_two_lengths.toml"), [(20, 139), (20, 119)]);
    assert_eq!(places("law_memory_without_state.toml"), [(20, 170), (20, 129)]);
    assert_eq!(places("law_kinetic_above_static.toml"), [(20, 53), (20, 41)]);
    assert_eq!(places("table_beyond_its_stage.toml"), [(26, 27), (23, 12)]);
    assert_eq!(places("bdf2_of_static_kinetic.toml"), [(37, 8), (20, 16)]);
    assert_eq!(places("slider_table_backwards.toml"), [(6, 58), (6, 38)]);
    assert_eq!(places("slider_first_step_above_largest.toml"), [(22, 14), (23, 12)]);
}

#[test]
fn a_slider_that_is_wrong_once_is_told_once() {
    for (name, text) in files("tests/bad_scenes").iter().filter(|(name, _)| name.starts_with("slider_")) {
        let errors = errors(text).unwrap();
        assert_eq!(errors.0.len(), 1, "{name}: {errors}");
    }
}

#[test]
fn all_errors_of_sliders_are_told_in_the_order_of_the_file() {
    let (_, text) =
        files("tests/bad_scenes").into_iter().find(|(name, _)| name == "slider_unknown_slider.toml").unwrap();
    let text = text
        .replace("\"5 MPa s/m\"", "\"-5 MPa s/m\"")
        .replace("\"1000 s\"", "0")
        .replace("\"3000 kg/m^2\"", "-1")
        .replace("stop_after = 10", "stop_after = 0");
    let errors = errors(&text).unwrap();
    let lines: Vec<usize> = errors.0.iter().map(|e| diagnostic::line_column(&text, e.span.start).0).collect();
    assert_eq!(lines, [10, 15, 18, 21, 25], "{errors}");
    let meant = errors.0[2].help.as_ref().unwrap();
    assert!(meant.contains("did you mean `right`?"), "{meant}");
}

#[test]
fn a_report_marks_both_places() {
    let (_, text) =
        files("tests/bad_scenes").into_iter().find(|(file, _)| file == "shared_nodes.toml").unwrap();
    let report = format!("{:?}", diagnostic::report("x.toml", &text, &errors(&text).unwrap()));
    for part in ["x.toml:27:29", "here", "and here", "`A.left` prescribes 0 m to 1 mm, `A.bottom` 0 m"] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
}

#[test]
fn places_far_apart_are_shown_without_what_lies_between() {
    let (_, text) = files("tests/bad_scenes")
        .into_iter()
        .find(|(file, _)| file == "bdf2_of_slip_weakening.toml")
        .unwrap();
    let report = format!("{:?}", diagnostic::report("x.toml", &text, &errors(&text).unwrap()));
    for part in ["x.toml:20:16", "the law of slip", "x.toml:37:8", "rule = \"bdf2\""] {
        assert!(report.contains(part), "{part} is not in\n{report}");
    }
    assert!(!report.contains("frictionless"), "{report}");
}

#[test]
fn a_name_that_cannot_be_is_told_once() {
    let errors =
        scene::read(&changed(&[("[bodies.A]", "[bodies.\"A.1\"]"), ("\"A.right\"", "\"A.1.right\"")]))
            .unwrap_err();
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
