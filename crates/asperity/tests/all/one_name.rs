//! A file name means one thing: columns of the same name have the same unit and sign in every kind of run.

use crate::common::written::described;
use crate::common::{coarse_sandwich, cycles, sliders, varied};
use asperity_vary::Change::With;
use std::collections::BTreeMap;
use std::fs;
use std::process::Command;

/// A rupture of bodies with mass: a file of columns that the others have too.
const RUPTURE: &str = include_str!("../../../../scenes/tpv205-2d.toml");

#[test]
fn columns_of_one_name_have_one_unit_and_one_sign_in_every_kind_of_run() {
    let scenes = [
        ("bodies", coarse_sandwich()),
        ("faults", cycles::SCENE.to_string()),
        ("sliders", sliders::CYCLE.to_string()),
        ("dynamics", varied(RUPTURE, &[With("stages[0].duration", "0.2 s")])),
    ];
    let mut all: BTreeMap<(String, String), (&str, String, String)> = BTreeMap::new();
    let mut shared = 0;
    for (kind, scene) in scenes {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), scene).unwrap();
        let mut run = Command::new(env!("CARGO_BIN_EXE_asperity"));
        let run = run.args(["run", "scene.toml", "--no-plots"]).current_dir(folder.path()).output().unwrap();
        assert!(run.status.success(), "{kind}: {}", String::from_utf8_lossy(&run.stderr));
        let described = described(&folder.path().join("out/scene"));
        assert!(!described.is_empty(), "{kind} describes no tables");
        for column in described {
            for file in column.files {
                let own = (kind, column.unit.clone(), column.sign.clone());
                let Some(first) = all.insert((file.clone(), column.column.clone()), own.clone()) else {
                    continue;
                };
                shared += 1;
                assert_eq!(
                    (&first.1, &first.2),
                    (&own.1, &own.2),
                    "`{}` of {file}: {kind}, {}",
                    column.column,
                    first.0
                );
            }
        }
    }
    assert!(shared > 10, "only {shared} columns are of several kinds");
}
