use asperity::checkpoint::scene::*;

#[test]
fn all_of_a_scene_counts_but_its_title_and_layout() {
    let of = |text: &str, mesh: &str| hash_of_bodies(text, [mesh].into_iter());
    let scene = of("title = \"a\"\nx = 1\n[time]\nmin_step = 2\n", "m");
    assert_eq!(scene, of("# b\ntime.min_step=2\nx=1\ntitle='b'\n", "m"));
    for (text, mesh) in [("x = 2\ntime.min_step = 2", "m"), ("x = 1", "m"), ("x = 1\ntime.min_step = 2", "n")]
    {
        assert_ne!(scene, of(text, mesh), "{text}");
    }
}
