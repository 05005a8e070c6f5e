//! Files of fields, each read once.

use crate::reading::columns::Columns;
use crate::reading::columns::file::{bytes, refused};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::missing_file::FileKind;
use crate::reading::sniff::{self, Reader};
use asperity_fem::mesh::netcdf;
use asperity_output::fields::vtu::reading;
use asperity_scene::model::Spanned;
use std::collections::BTreeMap;
use std::path::Path;

/// Files of fields.
const KINDS: FileKind = FileKind { what: "files of values", extensions: &["csv", "txt", "grd", "nc", "vtu"] };

/// Files that have been read, by name.
#[derive(Default)]
pub(crate) struct Files(BTreeMap<String, Content>);

/// Content of a file.
pub(super) enum Content {
    Columns(Columns),
    Netcdf(Vec<u8>),
    Vtk(Vec<u8>),
}

impl Files {
    /// Content of a file in a folder.
    ///
    /// # Errors
    /// [`Diagnostic`] at the name of the file.
    pub(super) fn content(&mut self, folder: &Path, file: &Spanned<String>) -> Result<&Content, Diagnostic> {
        let name = file.get_ref();
        if !self.0.contains_key(name) {
            let bytes = bytes(folder, file, KINDS)?;
            if let Some(wrong) = sniff::other(&bytes, Reader::Fields) {
                return Err(refused(file, file.span(), wrong));
            }
            let content = if netcdf::is_netcdf(&bytes) {
                Content::Netcdf(bytes)
            } else if reading::is_xml(&bytes) {
                Content::Vtk(bytes)
            } else {
                Content::Columns(Columns::parse(&bytes).map_err(|wrong| refused(file, file.span(), wrong))?)
            };
            self.0.insert(name.clone(), content);
        }
        Ok(&self.0[name])
    }
}
