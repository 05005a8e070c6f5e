/// Cases of many problems, or of files.
const WITHOUT: [&str; 13] = [
    "absence",
    "contact_pairing",
    "elastic_waves",
    "event_files",
    "explicit_files",
    "explicit_materials",
    "implicit_dynamics",
    "kinds_agree",
    "newton_convergence",
    "output_files",
    "restarts",
    "scene_units",
    "stabilised_steps",
];

#[test]
fn every_case_of_one_problem_has_a_sketch_with_finite_places() {
    for case in asperity_verification::cases::ALL {
        match asperity_verification::sketches::draw(case.name) {
            Some(svg) => assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{}", case.name),
            None => assert!(WITHOUT.contains(&case.name), "{} has no sketch", case.name),
        }
    }
}
