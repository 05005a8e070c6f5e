//! Reasons why a file of VTK is not read.

use thiserror::Error;

/// Problem of a file of VTK.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum VtuError {
    /// Text that is no XML.
    #[error("its XML is damaged at byte {byte}: {why}")]
    Xml {
        /// Position.
        byte: usize,
        /// Reason.
        why: String,
    },
    /// XML of something else.
    #[error("it is no file of VTK: its first element is `{found}`")]
    Foreign {
        /// Name of the first element.
        found: String,
    },
    /// Another data set of VTK.
    #[error("it is a `{found}` of VTK, and `UnstructuredGrid` is read")]
    DataSet {
        /// Type of the data set.
        found: String,
    },
    /// Another way of storing numbers.
    #[error("its attribute `{attribute}` is `{found}`, and {read} is read")]
    Storage {
        /// Attribute.
        attribute: &'static str,
        /// Value in the file.
        found: String,
        /// Values that are read.
        read: &'static str,
    },
    /// A part that is missing.
    #[error("it has no {part}")]
    Missing {
        /// Part.
        part: String,
    },
    /// No array of a name.
    #[error("it has no array `{name}` at points or in cells")]
    NoArray {
        /// The name.
        name: String,
        /// Names of all arrays.
        names: Vec<String>,
    },
    /// An array with another number of values, or with damaged ones.
    #[error("array `{name}`: {why}")]
    Array {
        /// Name of the array.
        name: String,
        /// Reason.
        why: String,
    },
}
