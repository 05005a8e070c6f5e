//! Reasons why a file of VTK is not read.

use thiserror::Error;

/// Problem of a file of VTK.
#[derive(Clone, Debug, PartialEq, Error)]
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
        why: ArrayError,
    },
}

/// Problem of the values of an array.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ArrayError {
    /// Another number of values.
    #[error("it has {found} values, and {needed} are needed")]
    Count {
        /// Number of values.
        found: usize,
        /// Number that is needed.
        needed: usize,
    },
    /// Another type of values.
    #[error("its type `{0}` is no number of VTK")]
    Type(String),
    /// More bytes than can be counted.
    #[error("it is too long")]
    Long,
    /// Another format.
    #[error("its format `{0}` is not `ascii`, `binary` or `appended`")]
    Format(String),
    /// An offset that the file does not have.
    #[error("its offset `{0}` lies beyond the appended data")]
    Offset(String),
    /// Far more values than the file has room for.
    #[error("it announces {count} values in {packed} bytes, more than {ratio} to one, as damaged files do")]
    Announced {
        /// Number of values.
        count: usize,
        /// Bytes in the file.
        packed: usize,
        /// Largest ratio of their bytes.
        ratio: usize,
    },
    /// A word that is no number.
    #[error("`{0}` is not a number")]
    Word(String),
    /// Values that the file does not have.
    #[error("the file ends within its values")]
    Ends,
    /// Another number of bytes than that of the values.
    #[error("it has {stated} bytes, and its values take {wanted}")]
    Bytes {
        /// Bytes of its header.
        stated: usize,
        /// Bytes of its values.
        wanted: usize,
    },
    /// Compressed values that cannot be unpacked.
    #[error("its compressed values are damaged: {0}")]
    Compressed(String),
    /// Compressed values of another size.
    #[error("its compressed values do not have the {wanted} bytes that are needed")]
    Unpacked {
        /// Bytes that are needed.
        wanted: usize,
    },
    /// Text that is no base64.
    #[error("its base64 is damaged")]
    Base64,
    /// Other components in other pieces of the file.
    #[error("it has {first} components in one piece and {other} in another")]
    Components {
        /// Components in the first piece.
        first: usize,
        /// Components in another.
        other: usize,
    },
    /// Pieces of the file without it.
    #[error("some of the pieces of the file lack it")]
    Lacking,
    /// A coordinate that is not finite.
    #[error("point {0} has a coordinate that is not finite")]
    Coordinate(usize),
    /// A number that is no end of a cell.
    #[error("{end} after {before} is no end of a cell")]
    CellEnd {
        /// The number.
        end: f64,
        /// End of the cell before.
        before: usize,
    },
    /// A number that is no point.
    #[error("{number} is not one of {points} points")]
    Point {
        /// The number.
        number: f64,
        /// Number of points.
        points: usize,
    },
    /// A number that is no type of cell.
    #[error("it has a number that is no type of cell")]
    CellType,
}
