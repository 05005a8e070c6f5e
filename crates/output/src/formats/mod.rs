//! Formats of communities: catalogues of events, seismograms, grids of maps, stations and results of benchmarks.

pub mod catalogues;
pub mod grd;
pub mod platform;
pub mod seas;
pub mod seismogram;
