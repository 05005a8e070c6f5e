//! The command `new`: a commented scene to begin with.

use super::end::End;
use asperity_output::terminal::printing::out;
use clap::ValueEnum;
use miette::{IntoDiagnostic, WrapErr, miette};
use std::fs::File;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Scenes to begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Template {
    /// Double direct shear in the laboratory: three blocks, a machine, stick-slip.
    Lab,
    /// A block pressed on a base and pushed across it.
    Contact,
    /// A block pressed on a plate and drawn along it, in space.
    #[value(name = "contact-3d")]
    Contact3d,
    /// A block on a spring.
    Sliders,
    /// Earthquake cycles of a strike-slip fault in two dimensions.
    #[value(name = "cycles-2d")]
    Cycles2d,
    /// Earthquake cycles of a strike-slip fault in three dimensions.
    #[value(name = "cycles-3d")]
    Cycles3d,
    /// Earthquake cycles on a section across a subduction zone.
    Subduction,
}

impl Template {
    /// Name of the template.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Lab => "lab",
            Self::Contact => "contact",
            Self::Contact3d => "contact-3d",
            Self::Sliders => "sliders",
            Self::Cycles2d => "cycles-2d",
            Self::Cycles3d => "cycles-3d",
            Self::Subduction => "subduction",
        }
    }

    /// Text of the scene.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Lab => include_str!("../../templates/lab.toml"),
            Self::Contact => include_str!("../../templates/contact.toml"),
            Self::Contact3d => include_str!("../../templates/contact-3d.toml"),
            Self::Sliders => include_str!("../../templates/sliders.toml"),
            Self::Cycles2d => include_str!("../../templates/cycles-2d.toml"),
            Self::Cycles3d => include_str!("../../templates/cycles-3d.toml"),
            Self::Subduction => include_str!("../../templates/subduction.toml"),
        }
    }
}

/// Writes a scene to a file that does not exist yet.
pub(super) fn write(template: Template, file: Option<&Path>) -> miette::Result<End> {
    let usual = || PathBuf::from(format!("{}.toml", template.name()));
    let path = file.map_or_else(usual, Path::to_path_buf);
    let shown = path.display();
    let mut created = match File::create_new(&path) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            return Err(miette!(
                "{shown} exists already: name another file, `asperity new {} FILE`",
                template.name()
            ));
        }
        other => other.into_diagnostic().wrap_err_with(|| format!("cannot write {shown}"))?,
    };
    let written = created.write_all(template.text().as_bytes());
    written.into_diagnostic().wrap_err_with(|| format!("cannot write {shown}"))?;
    out(format_args!("wrote {shown}; run it with: asperity run {shown}\n"));
    Ok(End::Done)
}
