//! Parts of a set-up are used as they were written, or not at all.
#![allow(clippy::disallowed_methods)]

use asperity_plan::shared::setup::{Setups, When};
use asperity_run::report::{Part, Use};
use std::convert::Infallible;
use std::fs;
use std::path::Path;

/// A part that is computed; `count` counts how often.
fn part(setups: &Setups, inputs: &str, count: &mut usize) -> Vec<f64> {
    let inputs = setups.hash(|key| key.value(&inputs));
    let make = || {
        *count += 1;
        Ok::<_, Infallible>(vec![0.1, -0.0, f64::MIN_POSITIVE, 1e300])
    };
    setups.part(Part::Operator, inputs, make).unwrap()
}

/// File of the part in a directory.
fn file(out: &Path) -> std::path::PathBuf {
    out.join("setup/operator.bin")
}

#[test]
fn a_part_is_computed_once_and_has_the_same_bits() {
    let out = tempfile::tempdir().unwrap();
    let mut count = 0;
    let first = Setups::beside(out.path(), When::Always);
    let computed = part(&first, "a", &mut count);
    let second = Setups::beside(out.path(), When::Auto);
    let read = part(&second, "a", &mut count);
    let bits = |v: &[f64]| v.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
    assert_eq!((bits(&read), count), (bits(&computed), 1));
    let ((written, _), (read, warnings)) = (first.finish(), second.finish());
    assert_eq!((written[0].how, read[0].how), (Use::Written, Use::Read));
    assert_eq!((written[0].seconds, written[0].bytes), (read[0].seconds, read[0].bytes));
    assert!(warnings.is_empty());
}

#[test]
fn a_part_that_takes_little_time_leaves_no_file_unless_it_is_asked_for() {
    let out = tempfile::tempdir().unwrap();
    let mut count = 0;
    for when in [When::Auto, When::Never] {
        part(&Setups::beside(out.path(), when), "a", &mut count);
        assert!(!out.path().join("setup").exists());
    }
    part(&Setups::beside(out.path(), When::Always), "a", &mut count);
    assert!(file(out.path()).is_file());
    part(&Setups::beside(out.path(), When::Never), "a", &mut count);
    assert_eq!(count, 4);
}

#[test]
fn a_file_with_any_byte_changed_and_a_file_of_any_other_length_is_named_and_not_used() {
    let out = tempfile::tempdir().unwrap();
    let setups = Setups::beside(out.path(), When::Always);
    let mut count = 0;
    part(&setups, "a", &mut count);
    let whole = fs::read(file(out.path())).unwrap();
    let changed = (0..whole.len()).map(|k| {
        let mut bytes = whole.clone();
        bytes[k] ^= 1 << (k % 8);
        bytes
    });
    let cut = (0..whole.len()).map(|length| whole[..length].to_vec());
    let longer = [[&whole[..], b"\n"].concat(), [&whole[..], &whole[..]].concat()];
    let all: Vec<Vec<u8>> = changed.chain(cut).chain(longer).collect();
    for bytes in &all {
        fs::write(file(out.path()), bytes).unwrap();
        part(&setups, "a", &mut count);
        assert!(fs::read(file(out.path())).unwrap().len() == whole.len(), "it is written again");
    }
    assert_eq!(count, 1 + all.len());
    let (_, warnings) = setups.finish();
    assert_eq!(warnings.len(), all.len());
    let named = |w: &String| w.contains("setup/operator.bin is not used") && w.contains("it is damaged");
    assert!(warnings.iter().all(named), "{warnings:?}");
}

#[test]
fn a_part_of_other_inputs_is_named_and_not_used() {
    let out = tempfile::tempdir().unwrap();
    let mut count = 0;
    part(&Setups::beside(out.path(), When::Always), "a", &mut count);
    let setups = Setups::beside(out.path(), When::Auto);
    part(&setups, "b", &mut count);
    let (kept, warnings) = setups.finish();
    assert!(kept.is_empty() && count == 2);
    assert!(
        warnings[0].contains("the points, the rock, the bodies or their loads were others"),
        "{warnings:?}"
    );
}

#[test]
fn a_size_that_no_memory_has_is_refused_before_memory_is_taken() {
    let out = tempfile::tempdir().unwrap();
    let setups = Setups::beside(out.path(), When::Always);
    let inputs = setups.hash(|key| key.value(&"a"));
    // The number of values of a vector stands before them.
    setups.part(Part::Operator, inputs, || Ok::<_, Infallible>(1_u64 << 60)).unwrap();
    part(&setups, "a", &mut 0);
    let (_, warnings) = setups.finish();
    assert!(warnings[0].contains("it is damaged"), "{warnings:?}");
}

#[test]
fn a_folder_that_cannot_be_made_is_a_warning() {
    let out = tempfile::tempdir().unwrap();
    fs::write(out.path().join("setup"), "").unwrap();
    let setups = Setups::beside(out.path(), When::Always);
    let mut count = 0;
    part(&setups, "a", &mut count);
    let (kept, warnings) = setups.finish();
    assert!(kept.is_empty() && count == 1);
    assert!(warnings[0].contains("the next run computes it again"), "{warnings:?}");
}

#[test]
fn a_file_that_was_half_written_is_removed() {
    let out = tempfile::tempdir().unwrap();
    fs::create_dir(out.path().join("setup")).unwrap();
    fs::write(out.path().join("setup/.operator.bin.tmp"), "half").unwrap();
    let setups = Setups::beside(out.path(), When::Auto);
    part(&setups, "a", &mut 0);
    assert!(setups.finish() == (Vec::new(), Vec::new()));
    assert!(!out.path().join("setup").exists());
}

#[test]
fn hashes_tell_apart_values_that_differ_in_the_last_bit_or_in_their_division() {
    let setups = Setups::beside(Path::new("nowhere"), When::Always);
    let of = |a: &[f64], b: &[f64]| setups.hash(|key| key.numbers(a).numbers(b)).unwrap();
    let (x, next) = (0.1_f64, 0.1_f64.next_up());
    assert_ne!(of(&[x], &[]), of(&[next], &[]));
    assert_ne!(of(&[x], &[x]), of(&[x, x], &[]));
    let text = |value: f64| setups.hash(|key| key.value(&[value])).unwrap();
    assert_ne!(text(x), text(next));
    assert_ne!(text(0.0), text(-0.0));
    assert_eq!(text(x), text(0.1));
}
