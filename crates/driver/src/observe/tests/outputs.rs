//! What the observers leave behind.

use super::super::*;
use std::path::PathBuf;
use super::fake::{play, setup};

#[test]
fn every_plot_is_drawn_as_svg_and_png() {
    let dir = tempfile::tempdir().unwrap();
    let out = std::env::var("ASPERITY_KEEP").map_or(dir.path().to_path_buf(), PathBuf::from);
    for layers in [0, 4] {
        let out = out.join(format!("{layers}"));
        let mut recorder = Recorder::new().with_bodies();
        let mut files = Files::create(&out, FieldSchedule { fields: 2, profiles: 10 }).unwrap();
        play(&setup(layers), 200, None, &mut Multi::new(vec![&mut recorder, &mut files])).unwrap();
        let written = plots::draw_all(&out.join("plots"), &recorder).unwrap();
        assert_eq!(written.len(), 12);
    }
}
