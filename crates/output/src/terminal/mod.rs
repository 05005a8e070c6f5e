//! Standard output and error, and the progress of a run there and in its file.

pub mod printing;
pub mod progress;
mod pulse;

pub use progress::Progress;
pub use pulse::Pulse;
