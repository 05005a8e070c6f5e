//! Arguments of the binary.

use super::compare::Comparison;
use super::new::Template;
use super::pausing::Pausing;
use super::plot::Redrawing;
use asperity_plan::reading::scene::settings::Setting;
use asperity_plan::shared::setup::When;
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use std::path::PathBuf;

/// Exit codes, as `--help` prints them.
const CODES: &str = "Exit codes:
  0  done: the run reached its end, results agree
  1  refused: an error in the scene or in a file; results do not agree
  2  stopped: the run could not continue, or the disk was full before its first checkpoint; memory that cannot be had; input of `compare` that cannot be read; wrong arguments
  3  interrupted: by SIGINT, SIGTERM, SIGHUP, --wall-time or a full disk; --resume continues the run";

/// Faults and rock friction by finite elements.
#[derive(Debug, Parser)]
#[command(name = "asperity", version, after_help = CODES)]
pub struct Arguments {
    /// Action.
    #[command(subcommand)]
    pub command: Command,
}

/// Commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Run a scene.
    #[command(after_help = CODES)]
    Run(Running),
    /// Print the plan of a scene and its checks without running it.
    Check(Checking),
    /// Write a commented scene to begin with.
    New {
        /// Scene to begin with.
        template: Template,
        /// File to write, which must not exist; `<template>.toml` by default.
        file: Option<PathBuf>,
    },
    /// Print how far the run in an output directory is.
    Status {
        /// Output directory.
        directory: PathBuf,
        /// Print as JSON.
        #[arg(long)]
        json: bool,
    },
    /// Compare a result with a benchmark, or two output directories: exit code 0 if they agree, 1 if not, 2 if one cannot be read.
    Compare(Comparison),
    /// Draw the figures of a run again from its output directory, without running it: some of them, in another size or format, or of a part of the run.
    Plot(Redrawing),
    /// Print what to cite, as BibTeX: the program, the problem, and the laws and methods that a scene declares.
    Cite {
        /// Scene file (TOML), or name of a verification case or benchmark; without it, the program alone.
        #[arg(value_name = "SCENE|CASE")]
        of: Option<String>,
    },
    /// Print what a key of scenes means: its values, unit, choices and the keys below it.
    Explain {
        /// Key, such as `faults.main.law.a`; the beginning and the names may be left out, as in `law.a`. Without it, the keys that scenes begin with.
        key: Option<String>,
    },
    /// Print the JSON Schema of a file.
    Schema {
        /// The file.
        of: Schema,
    },
    /// Print a script that completes commands and options in a shell.
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Print the manual page, in the format of `man`.
    Man,
}

/// Options of a run.
#[derive(Debug, Args)]
pub struct Running {
    /// Scene file (TOML).
    pub scene: PathBuf,
    /// Output directory; `out/<scene name>` by default.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Values set in the scene.
    #[command(flatten)]
    pub set: Set,
    /// Number of threads; by default that of the processors. Results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub threads: Option<u16>,
    /// Print only warnings and errors.
    #[arg(long)]
    pub quiet: bool,
    /// Print lines of JSON on standard output instead of text.
    #[arg(long, conflicts_with = "quiet")]
    pub json: bool,
    /// Draw no plots.
    #[arg(long)]
    pub no_plots: bool,
    /// Move an unfinished run, or the result of another scene, from the output directory to `<directory>.previous`.
    #[arg(long, conflicts_with = "resume")]
    pub force: bool,
    /// Set-up of faults to keep in the output directory, where the next run reads it: one that took a minute or longer, any, or none.
    #[arg(long, value_name = "WHEN", value_enum, default_value_t)]
    pub cache: When,
    /// Reasons to interrupt the run, and how to resume it.
    #[command(flatten)]
    pub pauses: Pausing,
}

/// Scene and options of `asperity check`.
#[derive(Args, Clone, Debug)]
pub struct Checking {
    /// Scene file (TOML).
    pub scene: PathBuf,
    /// Values set in the scene.
    #[command(flatten)]
    pub set: Set,
    /// Print the checks, notes and warnings as JSON.
    #[arg(long)]
    pub json: bool,
    /// End with exit code 1 if there are warnings.
    #[arg(long)]
    pub strict: bool,
    /// Draw the mesh with its sets, conditions and stations into this file, PNG or SVG.
    #[arg(long, value_name = "FILE")]
    pub plot: Option<PathBuf>,
}

/// Values set in a scene.
#[derive(Clone, Debug, Default, Args)]
pub struct Set {
    /// Sets a value of the scene, such as `faults.main.normal=25MPa` or `stages[0].duration=10 yr`; may be repeated.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = Setting::read)]
    pub values: Vec<Setting>,
}

/// Files that have a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Schema {
    /// A scene.
    Scene,
    /// `report.json`.
    Report,
}
