//! Capabilities of the product, as the rows of the coverage matrix.

use schemars::JsonSchema;
use serde::Serialize;

macro_rules! capabilities {
    ($($(#[$doc:meta])* $variant:ident => $text:literal,)*) => {
        /// A capability that evidence may cover: a row of the coverage matrix.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, JsonSchema)]
        pub enum Capability { $($(#[$doc])* #[serde(rename = $text)] $variant,)* }

        impl Capability {
            /// All capabilities, in the order of the matrix.
            pub const ALL: &[Capability] = &[$(Capability::$variant,)*];

            /// Title of the row.
            pub fn title(self) -> &'static str {
                match self { $(Capability::$variant => $text,)* }
            }
        }
    };
}

capabilities! {
    /// Linear elasticity in plane strain.
    PlaneStrain => "plane-strain elasticity",
    /// Linear elasticity in plane stress.
    PlaneStress => "plane-stress elasticity",
    /// Axisymmetric linear elasticity.
    Axisymmetric => "axisymmetric elasticity",
    /// Antiplane elasticity.
    Antiplane => "antiplane elasticity",
    /// Linear elasticity in three dimensions.
    Solid3d => "three-dimensional elasticity",
    /// Linear and quadratic triangles.
    Triangles => "elements tri3, tri6",
    /// Linear and quadratic quadrilaterals.
    Quadrilaterals => "elements quad4, quad9",
    /// Linear hexahedra and tetrahedra.
    Solids => "elements hex8, tet4",
    /// Quadrilaterals and hexahedra without interior nodes.
    Serendipity => "elements quad8, hex20",
    /// Quadratic solids with complete quadratic polynomials.
    QuadraticSolids => "elements tet10, hex27",
    /// Prisms.
    Wedges => "elements wedge6, wedge15",
    /// B-bar and mean pressure.
    NearlyIncompressible => "nearly incompressible bodies (B-bar)",
    /// J2 plasticity with hardening.
    Plasticity => "J2 plasticity",
    /// Updated Lagrangian bodies with the Jaumann rate of the Kirchhoff stress.
    FiniteStrain => "large strain and rotation",
    /// Maxwell materials.
    Viscoelasticity => "viscoelasticity",
    /// Forward steps of bodies and their limits r1, r2, r3.
    BodyLimits => "forward steps of nonlinear bodies",
    /// Prescribed displacements, ramps, holds, symmetry planes and stages.
    Stages => "prescribed displacements and stages",
    /// Traction, pressure, body force, initial stress.
    Loads => "traction, pressure, body force, initial stress",
    /// Explicit dynamics of bodies: waves, absorbing sides, impact.
    Waves => "waves: explicit dynamics of bodies",
    /// Ruptures of faults at split nodes, with waves.
    DynamicRupture => "dynamic rupture",
    /// Node-to-point penalty contact in the plane.
    PenaltyContact2d => "penalty contact, 2D",
    /// Node-to-point penalty contact in three dimensions.
    PenaltyContact3d => "penalty contact, 3D",
    /// Mortar contact: gaps averaged over the overlap of facets.
    Mortar => "mortar contact",
    /// Contact of curved bodies with a contact area that depends on the load.
    Hertz => "contact of curved bodies (Hertz, partial slip)",
    /// Contact by multipliers: Uzawa's method and augmented Lagrangian.
    Multipliers => "contact by multipliers",
    /// Contact problems near the limit of solvability: limit of friction, gaps, overlaps, bodies held by contact alone, corners.
    HardContact => "contact on the edge of solvability",
    /// Contact under changes of units, numbering and order, and on extreme meshes.
    ContactInvariance => "contact: units, numbering, order, extreme meshes",
    /// Rate-and-state friction between bodies over time.
    InterfaceStates => "interfaces: rate and state in time",
    /// Interfaces with a law that weakens faster than the bodies unload.
    InterfaceInstability => "interfaces: the end of quasi-static equilibrium",
    /// Pairing updated in large sliding.
    FiniteSliding => "finite sliding on flat segments",
    /// Coulomb friction.
    Coulomb => "Coulomb friction",
    /// Velocity-dependent friction.
    VelocityFriction => "velocity-dependent friction",
    /// Rate-and-state friction, slip law.
    SlipLaw => "rate and state, slip law",
    /// Rate-and-state friction, ageing law.
    AgeingLaw => "rate and state, ageing law",
    /// Unregularised, regularised, cut-off and Arrhenius strengths with every evolution law.
    LawFamily => "family of rate and state laws",
    /// Any number of state variables.
    SeveralStates => "several state variables",
    /// Memory of normal traction (Linker and Dieterich).
    NormalMemory => "memory of normal traction",
    /// Slip rate from traction and the implicit step of a point.
    PointSolver => "point solver",
    /// One slider on a spring.
    Slider => "spring-slider",
    /// Faults through earthquake cycles.
    FaultCycles => "faults through earthquake cycles",
    /// Temperature and pore pressure of faults that friction heats.
    FrictionalHeat => "frictional heat of faults",
    /// Pore fluid that diffuses along faults from wells.
    FluidDiffusion => "fluid that diffuses along faults",
    /// Faults in homogeneous rock without bodies.
    Medium => "faults in homogeneous rock without bodies",
    /// Sliders coupled by springs.
    CoupledSliders => "coupled sliders",
    /// Detection of events and extremes.
    Events => "events",
    /// Integrators of ordinary differential equations.
    Integrators => "integrators in time",
    /// The implicit stepper.
    Implicit => "implicit stepper",
    /// Inertia of bodies in implicit steps.
    Inertia => "inertia of bodies",
    /// Passage from equilibrium to inertia and back.
    Handover => "from equilibrium to inertia and back",
    /// The static-explicit stepper.
    StaticExplicit => "static-explicit stepper",
    /// Condensation onto the interface.
    Condensation => "condensed interface",
    /// Consistent tangents.
    Tangents => "consistent tangents",
    /// Force and moment balance.
    Balance => "force and moment balance",
    /// Bit-identical results for any number of threads.
    Determinism => "results independent of the number of threads",
    /// Runs resumed from their checkpoints.
    Restarts => "runs resumed from checkpoints",
    /// Scenes, their validation, and the plan.
    Scenes => "scene reader and plan",
    /// Files written by a run.
    Outputs => "output files",
    /// Files exchanged with other programs, in both directions.
    Interop => "interop with other programs",
}
