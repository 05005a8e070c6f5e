//! Circles of today, which become fewer.

/// The folder of a crate and files of it that use each other, straight or through others. What is broken leaves the list.
pub const KNOWN: &[(&str, &[&str])] = &[(
    "crates/driver/src",
    &[
        "coarse.rs",
        "cohesive.rs",
        "enforcement.rs",
        "fault/cover.rs",
        "fault/place.rs",
        "fault/resolution.rs",
        "fault/plan.rs",
        "free.rs",
        "penalty.rs",
        "plan.rs",
        "plan_doubts.rs",
        "pressed.rs",
        "report.rs",
        "rigid.rs",
        "samples.rs",
        "solver.rs",
        "start_balance.rs",
        "start_gaps.rs",
        "system.rs",
        "views.rs",
    ],
)];
