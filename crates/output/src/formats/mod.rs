//! Formats of communities: catalogues of events, seismograms, grids of maps, stations and results of benchmarks.

pub mod grd;
pub mod located;
pub mod platform;
pub mod seas;
pub mod seismogram;
