use asperity_verification::report::fields::{FIELDS, PLOTS, WITHOUT, draw};

#[test]
fn fields_of_small_scenes_are_drawn() {
    for name in ["contact_enforcement", "frictional_bar", "antiplane", "contact_sliding", "restarts"] {
        for (_, scene, stage) in FIELDS.iter().filter(|(case, ..)| *case == name) {
            let drawn = draw(scene, stage);
            assert!(drawn.as_ref().is_ok_and(|picture| picture.svg.contains("<image")), "{scene}: {drawn:?}");
        }
    }
}

/// True if the sources of a case draw a picture or a diagram.
fn draws(case: &str) -> bool {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(case);
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let sources = files.filter(|path| path.extension().is_some_and(|e| e == "rs"));
    let calls = ["body_plots::", "drawn(", "ledger.plot(", "ledger.picture(", "ledger\n        .plot("];
    sources.into_iter().any(|path| {
        let text = std::fs::read_to_string(path).unwrap();
        calls.iter().any(|call| text.contains(call))
    })
}

#[test]
fn every_case_has_a_picture_or_a_reason_why_not() {
    for case in asperity_verification::cases::ALL {
        let name = case.name;
        let of_scene = FIELDS.iter().any(|f| f.0 == name) || PLOTS.iter().any(|p| p.0 == name);
        let reason = WITHOUT.iter().any(|w| w.0 == name);
        // The two tables of combinations share one function.
        let shared = name.starts_with("contact_combinations");
        assert!(of_scene || draws(name) || reason || shared, "{name} has no picture");
    }
}

#[test]
fn fields_are_of_cases() {
    let names = FIELDS.iter().map(|(name, ..)| name).chain(PLOTS.iter().map(|(name, ..)| name));
    let names = names.chain(WITHOUT.iter().map(|(name, _)| name));
    for name in names {
        assert!(asperity_verification::cases::ALL.iter().any(|case| case.name == *name), "{name}");
    }
}
