use asperity::checkpoint::scene::*;
use asperity::kinds::faults::physics;

#[test]
fn all_of_a_scene_counts_but_its_title_and_layout() {
    let bodies = |text: &str, mesh: &str| hash(text, |_| (), [mesh].into_iter());
    let faults = |text: &str, mesh: &str| physics(text, [mesh].into_iter());
    for of in [&bodies as &dyn Fn(&str, &str) -> String, &faults] {
        let scene = of("title = \"a\"\nx = 1\n[time]\nmin_step = 2\n", "m");
        assert_eq!(scene, of("# b\ntime.min_step=2\nx=1\ntitle='b'\n", "m"));
        for (text, mesh) in
            [("x = 2\ntime.min_step = 2", "m"), ("x = 1", "m"), ("x = 1\ntime.min_step = 2", "n")]
        {
            assert_ne!(scene, of(text, mesh), "{text}");
        }
    }
}
