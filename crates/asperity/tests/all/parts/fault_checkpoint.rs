use asperity::checkpoint::{FILE, ResumeError, parse, read, remove, write};
use asperity::kinds::faults::checkpoint::*;
use asperity::kinds::faults::position::Position;
use asperity_cycles::{Components, FaultRun, NextStep, Rupture, Sums, Thresholds};
use asperity_run::ALL;
use std::fs;

fn sample() -> Checkpoint {
    let thresholds = Thresholds { on: 1e-3, off: 1e-4 };
    let mut run = FaultRun::new(vec![0.1 + 0.2, -0.0, 5e-324, 1.797e308], &[0..2, 2..4], thresholds);
    // A time with a carry, which a single number cannot hold.
    run.at = asperity_ode::Clock::new(6.2e9, 1.0 / 3.0).rebased().later(1e-13);
    run.next_step = Some(NextStep { length: Some(1.0 / 7.0), stiff: false });
    let details = Rupture {
        above: 0.1,
        hypocentre: 1,
        slip: Components::new(vec![0.1, 0.2, 0.3, 0.4], 4),
        ..Rupture::default()
    };
    run.catalogue.begin(ALL, run.at, 2.5, details);
    let last = StoredRun { run, files: Position::default(), sums: Sums::default() };
    let before = Some(Box::new(last.clone()));
    Checkpoint { end: 1.0 / 9.0, loads: vec![[0.1, 0.2, 0.3]], last, before }
}

#[test]
fn what_is_read_is_what_was_written_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let written = sample();
    write(folder.path(), "s", &written).unwrap();
    let read = read::<Checkpoint>(folder.path(), "s").unwrap().unwrap();
    assert_eq!(read, written);
    let bits = |c: &Checkpoint| c.last.run.unknowns.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&read), bits(&written));
    assert_eq!(format!("{:?}", read.last.run.at), format!("{:?}", written.last.run.at));
}

#[test]
fn no_checkpoint_is_no_error_and_can_be_removed() {
    let folder = tempfile::tempdir().unwrap();
    assert!(read::<Checkpoint>(folder.path(), "s").unwrap().is_none());
    remove(folder.path()).unwrap();
}

#[test]
fn every_changed_byte_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "s", &sample()).unwrap();
    let path = folder.path().join(FILE);
    let bytes = fs::read(&path).unwrap();
    assert!(parse::<Checkpoint>(bytes.clone(), &path, "s").is_ok());
    for k in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[k] ^= 1;
        assert!(parse::<Checkpoint>(changed, &path, "s").is_err(), "byte {k}");
        assert!(parse::<Checkpoint>(bytes[..k].to_vec(), &path, "s").is_err(), "cut at {k}");
    }
}

#[test]
fn another_version_and_another_scene_are_told_apart_from_damage() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "s", &sample()).unwrap();
    assert!(matches!(read::<Checkpoint>(folder.path(), "t"), Err(ResumeError::Scene { .. })));
    let path = folder.path().join(FILE);
    let text = fs::read_to_string(&path).unwrap();
    let (before, after) = text.split_once("version 6").unwrap();
    fs::write(&path, format!("{before}version 99{after}")).unwrap();
    let error = read::<Checkpoint>(folder.path(), "s").unwrap_err();
    assert!(error.to_string().contains("has version 99"), "{error}");
}
