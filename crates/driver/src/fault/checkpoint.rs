//! A run's checkpoint: one file that holds all there is to know to go on.
//!
//! ```text
//! asperity checkpoint of faults, version 2
//! <SHA-256 of the rest>
//! <JSON>
//! ```
//!
//! Decimals of the JSON are the shortest that read back as the same numbers. The file is on the disc under a temporary name before it
//! takes the place of the one before it.

use super::balance::Sums;
use super::position::Position;
use super::run::Run;
use asperity_output::{OutputError, atomic};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// Name of the file in the output directory.
pub const FILE: &str = "checkpoint";
/// What the first line begins with.
const KIND: &str = "asperity checkpoint of faults, version ";
/// Version of the contents.
const VERSION: &str = "2";

/// Where a run stands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stand {
    /// State, clock, step length, events and counts.
    pub run: Run,
    /// Where the output files stand.
    pub files: Position,
    /// Works until then.
    pub sums: Sums,
}

/// All there is to know to go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Hash of the physics of the scene and of the mesh files it names, see [`super::identity`].
    pub physics: String,
    /// When the run was to end \[s\].
    pub end: f64,
    /// What the loads did until then, see [`super::identity::loads`].
    pub loads: Vec<[f64; 3]>,
    /// Where the run stands.
    pub last: Stand,
    /// Where its time is over: where it restarted last. The step to the end is shorter than one that goes on would have been, and a run
    /// that is extended goes on from here.
    pub before: Option<Box<Stand>>,
}

/// Why a run cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint or an output file cannot be read.
    #[error("cannot read {path}: {source}")]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is no checkpoint, or not what was written.
    #[error("the checkpoint {path} is damaged: {reason}; run without --resume to begin again")]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// Written by another version of the program.
    #[error(
        "the checkpoint {path} has version {found}, and this program reads version {VERSION}; go on with the program that wrote it, or run without --resume to begin again"
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// Its version.
        found: String,
    },
    /// The scene is not the one that was run.
    #[error(
        "the checkpoint {path} is of another scene: the scene file or a mesh file has changed since in more than the duration of the last stage, `stop_after` or `[place]`; restore it, or run without --resume to begin again"
    )]
    Scene {
        /// The file.
        path: PathBuf,
    },
    /// The loads until then are not those that acted.
    #[error(
        "the checkpoint {path} is of other loads: with another duration of the last stage they are not what they were until {until:e} s; prescribe rates instead of values at its end, or run without --resume to begin again"
    )]
    Loads {
        /// The file.
        path: PathBuf,
        /// How far the run has got \[s\].
        until: f64,
    },
    /// The run has got farther than the scene now asks for.
    #[error(
        "the checkpoint {path} lies beyond what the scene asks for: it is at {at:e} s with {events} events; ask for more, or run without --resume to begin again"
    )]
    Beyond {
        /// The file.
        path: PathBuf,
        /// Its time \[s\].
        at: f64,
        /// Its events.
        events: usize,
    },
    /// An output file lacks rows that were there.
    #[error(
        "{path} has {found} bytes and had {expected} at the checkpoint; restore it, or run without --resume to begin again"
    )]
    Shorter {
        /// The file.
        path: PathBuf,
        /// Bytes it has.
        found: u64,
        /// Bytes it had.
        expected: u64,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Observe(#[from] OutputError),
}

fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|b| format!("{b:02x}")).collect()
}

impl Checkpoint {
    /// Writes it into `out`.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, out: &Path) -> Result<(), OutputError> {
        let path = out.join(FILE);
        let contents = serde_json::to_string(self).map_err(|e| OutputError::write(&path, e.into()))?;
        let text = format!("{KIND}{VERSION}\n{}\n{contents}\n", sha256(contents.as_bytes()));
        atomic::write_durably(&path, text.as_bytes())
    }

    /// Reads that of `out`; none where there is none.
    ///
    /// # Errors
    /// Where it is damaged, of another version, or of another scene than that of `physics`.
    pub fn read(out: &Path, physics: &str) -> Result<Option<Self>, ResumeError> {
        let path = out.join(FILE);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(e) if e.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(ResumeError::Read { path, source }),
        };
        let damaged = |reason: &str| ResumeError::Damaged { path: path.clone(), reason: reason.into() };
        let text = String::from_utf8(bytes).map_err(|_| damaged("it is no text"))?;
        let mut lines = text.splitn(3, '\n');
        let version = lines.next().and_then(|line| line.strip_prefix(KIND));
        let version = version.ok_or_else(|| damaged("its first line is that of no checkpoint"))?;
        if version != VERSION {
            return Err(ResumeError::Version { path, found: version.into() });
        }
        let sum = lines.next().unwrap_or_default();
        let contents = lines.next().and_then(|rest| rest.strip_suffix('\n')).unwrap_or_default();
        if sha256(contents.as_bytes()) != sum {
            return Err(damaged("its contents do not have the sum written beside them"));
        }
        let read: Self = serde_json::from_str(contents).map_err(|e| damaged(&e.to_string()))?;
        if read.physics != physics {
            return Err(ResumeError::Scene { path });
        }
        Ok(Some(read))
    }

    /// An error about contents that do not fit the run.
    pub(super) fn foreign(out: &Path, reason: &str) -> ResumeError {
        ResumeError::Damaged { path: out.join(FILE), reason: reason.into() }
    }

    /// Removes that of an earlier run from `out`.
    ///
    /// # Errors
    /// When there is one that cannot be removed.
    pub fn remove(out: &Path) -> Result<(), OutputError> {
        let path = out.join(FILE);
        match fs::remove_file(&path) {
            Err(e) if e.kind() != ErrorKind::NotFound => Err(OutputError::write(&path, e)),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fault::catalogue::{Crossing, Thresholds};

    fn sample() -> Checkpoint {
        let mut run = Run::new(vec![0.1 + 0.2, -0.0, 5e-324, 1.797e308], Thresholds { on: 1e-3, off: 1e-4 });
        // A time with a carry, which one number does not hold.
        run.at = asperity_ode::Clock::new(6.2e9, 1.0 / 3.0).rebased().later(1e-13);
        run.next_step = Some(1.0 / 7.0);
        run.catalogue.pass(Crossing::Begins, run.at, 1, [&[0.1, 0.2], &[3.0, 4.0], &[]]);
        run.catalogue.rate(2.5);
        let last = Stand { run, files: Position::default(), sums: Sums::default() };
        let before = Some(Box::new(last.clone()));
        Checkpoint { physics: "s".into(), end: 1.0 / 9.0, loads: vec![[0.1, 0.2, 0.3]], last, before }
    }

    #[test]
    fn what_is_read_is_what_was_written_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let written = sample();
        written.write(folder.path()).unwrap();
        let read = Checkpoint::read(folder.path(), "s").unwrap().unwrap();
        assert_eq!(read, written);
        let bits = |c: &Checkpoint| c.last.run.unknowns.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&read), bits(&written));
        assert_eq!(format!("{:?}", read.last.run.at), format!("{:?}", written.last.run.at));
    }

    #[test]
    fn no_checkpoint_is_no_error_and_can_be_removed() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Checkpoint::read(folder.path(), "s").unwrap().is_none());
        Checkpoint::remove(folder.path()).unwrap();
    }

    #[test]
    fn every_changed_byte_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        sample().write(folder.path()).unwrap();
        let path = folder.path().join(FILE);
        let bytes = fs::read(&path).unwrap();
        for k in 0..bytes.len() {
            let mut changed = bytes.clone();
            changed[k] ^= 1;
            fs::write(&path, &changed).unwrap();
            assert!(Checkpoint::read(folder.path(), "s").is_err(), "byte {k}");
            fs::write(&path, &bytes[..k]).unwrap();
            assert!(Checkpoint::read(folder.path(), "s").is_err(), "cut at {k}");
        }
    }

    #[test]
    fn another_version_and_another_scene_are_told_apart_from_damage() {
        let folder = tempfile::tempdir().unwrap();
        sample().write(folder.path()).unwrap();
        assert!(matches!(Checkpoint::read(folder.path(), "t"), Err(ResumeError::Scene { .. })));
        let path = folder.path().join(FILE);
        let text = fs::read_to_string(&path).unwrap().replacen("version 2", "version 99", 1);
        fs::write(&path, text).unwrap();
        let error = Checkpoint::read(folder.path(), "s").unwrap_err();
        assert!(error.to_string().contains("has version 99"), "{error}");
    }
}
