//! List of all cases.
//!
//! To add a case, make a folder `verification/cases/<name>/` with
//! * `README.md`, the page of the case in the report, with exactly the headings of [`crate::readme::HEADINGS`];
//! * `mod.rs` with `pub const CASE: Case`, for instance
//!
//! ```text
//! use crate::{Capability, Case, CaseError, Evidence, Ledger};
//!
//! /// The sandwich pressed: mean normal stress.
//! pub const CASE: Case = Case {
//!     name: "sandwich_pressed", // = the folder
//!     readme: include_str!("README.md"),
//!     covers: &[Capability::PlaneStrain, Capability::PenaltyContact2d],
//!     quick: true, // false: only with --full
//!     run,
//! };
//!
//! fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
//!     let (stress, cost) = Cost::measure(|| solve());
//!     ledger.claim("mean normal stress, h = 1.25 mm").unit("MPa")
//!         .value(stress?).equals(12.0).relative(1e-4)
//!         .evidence(Evidence::Exact, "uniform field of a bar under prescribed ends")
//!         .because("the field lies in the finite-element space; only the solver's rounding remains")
//!         .cost(&cost).record();
//!     Ok(())
//! }
//! ```
//!
//! and then write `mod <name>;` and `<name>::CASE` below, in alphabetical order. Where a user could write the problem as a
//! scene, put `scene.toml` beside them and read it through the public reader.

use crate::Case;

mod absence;
mod antiplane;
mod block_dragged;
pub mod bodies;
mod bodies_convergence;
mod bodies_patch;
pub mod body;
pub mod body_plots;
mod cantilever_rotation;
mod contact_combinations;
mod contact_combinations_all;
mod contact_combinations_space;
mod contact_enforcement;
mod contact_extremes;
mod contact_facets;
mod contact_hard;
mod contact_invariance;
mod contact_pairing;
mod contact_patch;
mod contact_patch_mortar;
mod contact_rotation;
mod contact_sliding;
mod cook_membrane;
mod coulomb_strip;
mod cycle_run;
mod dislocation;
mod dynamic_rupture;
mod elastic_plastic_cylinder;
mod elastic_waves;
mod event_files;
mod event_numbers;
mod explicit_files;
mod explicit_materials;
mod fault_balance;
pub(crate) mod fault_bend;
mod fault_bodies;
mod fault_compression;
mod fault_free_surface;
mod fault_gravity;
mod fault_handover;
mod fault_medium;
mod fault_opening;
mod fault_operator;
mod fault_pressing;
mod fault_space;
mod fault_stability;
mod fault_turning;
mod first_slip;
mod flamant_boussinesq;
mod flat_punch;
mod fluid_along_fault;
mod forward_drift;
mod friction_hard_numerics;
mod friction_steady_state;
mod friction_velocity_steps;
mod frictional_bar;
mod frictional_crack;
mod frictional_heat;
pub mod hertz;
mod hertz_ball;
mod hertz_line;
mod hertz_sphere;
mod impact_balls;
mod impact_bars;
mod implicit_dynamics;
mod interface_instability;
mod interface_laws;
mod interface_prestress;
mod interface_rate_state;
mod jaumann_shear;
mod kinds_agree;
mod kostrov_crack;
mod lame_cylinder;
mod large_rotation;
mod maxwell_relaxation;
mod mesh_files;
mod nafems_roller;
mod newton_convergence;
mod okada;
mod output_files;
mod partial_slip;
mod plastic_wave;
mod press_fit;
pub mod programs;
mod restarts;
pub mod run_files;
pub(crate) mod rupture_in_space;
mod rupture_in_space_full;
pub mod sandwich;
mod sandwich_3d;
mod sandwich_pressed;
mod sandwich_sheared;
pub(crate) mod sandwich_state;
mod sandwich_steppers;
mod scene_units;
pub mod seas;
mod seas_bp1;
mod seas_bp1_16mm;
mod seas_bp1_16mm_limit;
mod seas_bp1_25m;
mod seas_bp1_fd;
mod seas_bp1_full;
mod seas_bp1_methods;
mod seas_bp2;
mod seas_bp3;
mod seas_bp3_25m;
mod seas_bp3_full;
mod seas_bp4;
mod seas_bp4_500m;
mod seas_bp5;
mod seas_bp5_limit;
mod seas_bp6;
mod seas_bp7;
pub mod slider;
mod slider_balance;
mod slider_cycles;
mod slider_inertia;
mod slider_inertia_all;
mod slider_laws;
mod slider_normal;
mod slider_orbit;
mod slider_outputs;
mod slider_scene;
mod slider_stability;
mod slider_states;
mod slider_work_precision;
mod stabilised_steps;
mod stage_paths;
mod static_explicit_jumps;
mod steel_strip;
mod stick_slip;
mod stick_slip_inertia;
mod stick_slip_inertia_events;
pub mod texts;
mod two_rings;
mod uniaxial_hardening;
mod unlike_rocks;
mod volumetric_path;
pub mod waves;
mod wavy_sliding;

/// Every case, in the order of the report.
pub const ALL: &[Case] = &[
    absence::CASE,
    antiplane::CASE,
    block_dragged::CASE,
    bodies_convergence::CASE,
    bodies_patch::CASE,
    contact_combinations::CASE,
    contact_combinations_all::CASE,
    contact_combinations_space::CASE,
    contact_enforcement::CASE,
    contact_extremes::CASE,
    contact_facets::CASE,
    contact_hard::CASE,
    contact_invariance::CASE,
    contact_pairing::CASE,
    contact_patch::CASE,
    contact_patch_mortar::CASE,
    contact_rotation::CASE,
    contact_sliding::CASE,
    cook_membrane::CASE,
    coulomb_strip::CASE,
    event_files::CASE,
    event_numbers::CASE,
    fault_balance::CASE,
    fault_bodies::CASE,
    fault_compression::CASE,
    fault_bend::CASE,
    fault_free_surface::CASE,
    fault_gravity::CASE,
    fault_handover::CASE,
    fault_medium::CASE,
    fault_opening::CASE,
    fault_operator::CASE,
    fault_pressing::CASE,
    fault_space::CASE,
    fault_stability::CASE,
    fault_turning::CASE,
    flamant_boussinesq::CASE,
    flat_punch::CASE,
    fluid_along_fault::CASE,
    friction_hard_numerics::CASE,
    friction_steady_state::CASE,
    friction_velocity_steps::CASE,
    frictional_bar::CASE,
    frictional_crack::CASE,
    frictional_heat::CASE,
    hertz_line::CASE,
    hertz_sphere::CASE,
    hertz_ball::CASE,
    impact_balls::CASE,
    impact_bars::CASE,
    implicit_dynamics::CASE,
    interface_instability::CASE,
    interface_laws::CASE,
    interface_prestress::CASE,
    interface_rate_state::CASE,
    lame_cylinder::CASE,
    nafems_roller::CASE,
    newton_convergence::CASE,
    output_files::CASE,
    partial_slip::CASE,
    press_fit::CASE,
    restarts::CASE,
    sandwich_3d::CASE,
    sandwich_pressed::CASE,
    sandwich_sheared::CASE,
    sandwich_state::CASE,
    sandwich_steppers::CASE,
    scene_units::CASE,
    seas_bp1::CASE,
    seas_bp1_fd::CASE,
    seas_bp1_full::CASE,
    seas_bp1_methods::CASE,
    seas_bp1_16mm::CASE,
    seas_bp1_16mm_limit::CASE,
    seas_bp1_25m::CASE,
    seas_bp2::CASE,
    seas_bp3::CASE,
    seas_bp3_25m::CASE,
    seas_bp3_full::CASE,
    seas_bp4::CASE,
    seas_bp4_500m::CASE,
    seas_bp5::CASE,
    seas_bp5_limit::CASE,
    seas_bp6::CASE,
    seas_bp7::CASE,
    slider_balance::CASE,
    slider_cycles::CASE,
    slider_inertia::CASE,
    slider_inertia_all::CASE,
    slider_laws::CASE,
    slider_normal::CASE,
    slider_orbit::CASE,
    slider_outputs::CASE,
    slider_stability::CASE,
    slider_states::CASE,
    slider_work_precision::CASE,
    stabilised_steps::CASE,
    two_rings::CASE,
    // Nonlinear bodies.
    cantilever_rotation::CASE,
    dynamic_rupture::CASE,
    elastic_plastic_cylinder::CASE,
    elastic_waves::CASE,
    explicit_files::CASE,
    explicit_materials::CASE,
    rupture_in_space::CASE,
    rupture_in_space_full::CASE,
    first_slip::CASE,
    forward_drift::CASE,
    static_explicit_jumps::CASE,
    mesh_files::CASE,
    stage_paths::CASE,
    steel_strip::CASE,
    stick_slip::CASE,
    stick_slip_inertia::CASE,
    stick_slip_inertia_events::CASE,
    jaumann_shear::CASE,
    large_rotation::CASE,
    kinds_agree::CASE,
    kostrov_crack::CASE,
    maxwell_relaxation::CASE,
    uniaxial_hardening::CASE,
    unlike_rocks::CASE,
    volumetric_path::CASE,
    wavy_sliding::CASE,
];
