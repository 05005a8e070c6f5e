use asperity::kinds::faults::identity::*;

/// Scene with a title, the ends of its stages, and the values of its events.
fn scene(title: &str, durations: &[&str], events: &str) -> String {
    let stages: String = durations.iter().map(|d| format!("[[stages]]\nduration = \"{d}\"\n")).collect();
    format!("title = \"{title}\"\n{stages}[events]\n{events}\n")
}

fn base() -> String {
    scene("a", &["1 s", "2 s"], "above = 1\nstop_after = 3")
}

fn hash(text: &str) -> String {
    physics(text, ["mesh"].into_iter())
}

#[test]
fn what_only_extends_a_run_does_not_change_its_physics() {
    let same = [
        scene("a", &["1 s", "2 s"], "above = 1\nstop_after = 5"),
        scene("a", &["1 s", "2 s"], "above = 1"),
        scene("b", &["1 s", "2 s"], "above = 1\nstop_after = 3"),
        scene("a", &["1 s", "9 s"], "above = 1\nstop_after = 3"),
        scene("a", &["1 s", "2 s"], "above=1\nstop_after   = 3"),
        format!("# a comment\n{}[place]\nlatitude = 1\n", base()),
    ];
    for text in same {
        assert_eq!(hash(&text), hash(&base()), "{text}");
    }
}

#[test]
fn whatever_else_changes_makes_another_physics() {
    let others = [
        scene("a", &["3 s", "2 s"], "above = 1\nstop_after = 3"),
        scene("a", &["1 s", "2 s"], "above = 2\nstop_after = 3"),
        scene("a", &["1 s", "2 s", "2 s"], "above = 1\nstop_after = 3"),
        format!("{}[output]\n", base()),
        "not a scene".into(),
    ];
    for text in others {
        assert_ne!(hash(&text), hash(&base()), "{text}");
    }
    assert_ne!(physics(&base(), std::iter::empty()), hash(&base()));
}

#[test]
fn loads_agree_to_rounding() {
    let loads = [[1.0, 0.1 + 0.2, -7.0], [f64::MAX, 0.0, 0.0]];
    assert!(same(&loads, &[[1.0, 0.3, -7.0], [f64::MAX, 0.0, 0.0]]));
    assert!(!same(&loads, &loads[..1]));
    assert!(!same(&loads, &[[1.0, 0.3001, -7.0], [f64::MAX, 0.0, 0.0]]));
}
