//! Runs that would mix in one directory, for every kind of run: two at once, a changed scene, another kind, and a directory that cannot be written.
#![allow(clippy::disallowed_methods)]
#![cfg(unix)]

use crate::common::{told, varied};
use crate::ends::{OFTEN, kinds, start, under_way};
use crate::resume::{files, folder, run, text};
use asperity_vary::Change::With;
use std::fs;
use std::os::unix::fs::PermissionsExt as _;
use std::path::Path;
use std::process::Command;

/// A run that is refused for these reasons, and changes nothing in `out`.
fn refused(folder: &Path, out: &str, arguments: &[&str], parts: &[&str]) {
    let before = files(&folder.join(out));
    let output = run(folder, out, arguments);
    let said = told(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for part in parts {
        assert!(said.contains(part), "{part} is not in\n{said}");
    }
    assert!(files(&folder.join(out)) == before, "{arguments:?} changed something");
}

#[test]
fn the_second_run_in_one_directory_is_refused_with_the_process_of_the_first() {
    for (kind, scene, table) in kinds() {
        let folder = folder(&scene);
        let folder = folder.path();
        let mut first = start(folder, "out", &OFTEN, None);
        under_way(&mut first, &folder.join("out"), table, 1);
        let process = format!("another run (process {}) writes into out", first.id());
        for arguments in [&[][..], &["--resume"], &["--force"]] {
            let output = run(folder, "out", arguments);
            assert_eq!(output.status.code(), Some(1), "{kind}: {}", told(&output));
            let unfinished =
                arguments.is_empty() && told(&output).contains("an unfinished run with a checkpoint");
            assert!(unfinished || told(&output).contains(&process), "{kind}: {}", told(&output));
        }
        assert!(first.try_wait().unwrap().is_none(), "{kind} has ended");
        // Its lock ends with the process.
        first.kill().unwrap();
        first.wait().unwrap();
        let output = run(folder, "out", &["--resume", "--wall-time", "0 s"]);
        assert!(text(&output.stdout).contains("resumed "), "{kind}: {}", told(&output));
    }
}

/// A change of what is computed.
fn changed(kind: &str, scene: &str) -> String {
    let change = match kind {
        "bodies" => With("materials.granite.poisson", "0.13"),
        "faults" => With("faults.main.law.mu0", "0.61"),
        "sliders" => With("sliders.block.normal", "5.1 MPa"),
        _ => With("materials.rock.density", "2680"),
    };
    varied(scene, &[change])
}

#[test]
fn a_run_is_not_resumed_with_another_scene_or_another_kind() {
    let kinds = kinds();
    for (k, (kind, scene, _)) in kinds.iter().enumerate() {
        let folder = folder(scene);
        let folder = folder.path();
        let (wall, write) =
            (["--wall-time", "0.05 s"], |scene: &str| fs::write(folder.join("s.toml"), scene));
        assert_eq!(run(folder, "out", &wall).status.code(), Some(3), "{kind}");
        write(&changed(kind, scene)).unwrap();
        refused(folder, "out", &["--resume"], &["is of another scene", "--resume to begin again"]);
        refused(folder, "out", &[], &["unfinished run with a checkpoint", "--resume", "--force"]);
        let (_, other, _) = &kinds[(k + 1) % kinds.len()];
        write(other).unwrap();
        refused(folder, "out", &["--resume"], &["is of a run of", "and the scene is of"]);
        let checkpoint = fs::read(folder.join("out/checkpoint")).unwrap();
        // The same file with another title is another scene.
        refused(folder, "out", &["--set", "title=other"], &["out holds"]);
        assert_eq!(run(folder, "out", &["--force", wall[0], wall[1]]).status.code(), Some(3), "{kind}");
        assert_eq!(fs::read(folder.join("out.previous/checkpoint")).unwrap(), checkpoint, "{kind}");
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_refused_before_anything_is_computed() {
    for (kind, scene, _) in kinds() {
        let folder = folder(&scene);
        let folder = folder.path();
        if Path::new("/proc/self").exists() {
            let output = run(folder, "/proc/nowhere", &[]);
            assert_eq!(output.status.code(), Some(1), "{kind}: {}", told(&output));
            assert!(told(&output).contains("/proc/nowhere"), "{kind}: {}", told(&output));
        }
        let out = folder.join("out");
        fs::create_dir(&out).unwrap();
        fs::set_permissions(&out, fs::Permissions::from_mode(0o555)).unwrap();
        // The administrator may write anywhere.
        let mine = Command::new("test").arg("-w").arg(&out).status().unwrap().success();
        if !mine {
            refused(folder, "out", &[], &["cannot write out/.lock"]);
        }
        fs::set_permissions(&out, fs::Permissions::from_mode(0o755)).unwrap();
    }
}
