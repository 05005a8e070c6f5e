//! Sources of the laws and methods that a scene declares.

use super::{Citations, laws, titles};
use asperity_laws::{choose, choose_sliding};
use asperity_plan::bodies::rule;
use asperity_plan::reading::diagnostic::Diagnostics;
use asperity_plan::reading::scene::model::{
    Body, EnforcementKind, Fault, Formulation, Interface, Kinematics, Material, Measure, MeshSource, Method,
    Rule, Scene, Sliding, Spanned, Stepper, Strain,
};
use asperity_plan::reading::scene::slider::SliderScene;

/// Keys of this file, for the test of the table.
pub const KEYS: [&str; 33] = [
    "puso2004",
    "puso2004b",
    "wohlmuth2000",
    "xing2002",
    "vlachos2001",
    "hestenes1969",
    "powell1969",
    "simo1992",
    "alart1991",
    "yamada1968",
    "hairer1993",
    "hairer1996",
    "tsitouras2011",
    "sommeijer1998",
    "rice1993",
    "rice2006",
    "noda2010",
    "hughes1980",
    "hugheswinget1980",
    "simo1998",
    "vanek1996",
    "hestenes1952",
    "segall2010",
    "muskhelishvili1953",
    "okada1992",
    "nikkhoo2015",
    "savage1983",
    "wang2004",
    "king1994",
    "day2005",
    "kaneko2008",
    "lysmer1969",
    "prakash1993",
];

/// Citations of a scene of bodies or faults.
///
/// # Errors
/// A law that is not complete.
pub fn scene_citations(scene: &Scene) -> Result<Citations, Diagnostics> {
    let mut citations = Citations::default();
    titles::add(&mut citations, &scene.title);
    for (name, interface) in &scene.interfaces {
        add_interface(&mut citations, scene, &format!("interface `{name}`"), interface)?;
    }
    for (name, fault) in &scene.faults {
        add_fault(&mut citations, &format!("fault `{name}`"), fault)?;
    }
    if scene.medium.is_some() {
        add_medium(&mut citations, scene);
    }
    if scene.output.coulomb.is_some() {
        citations.add("king1994", "output: changes of Coulomb stress");
    }
    for (name, body) in &scene.bodies {
        add_body(&mut citations, &format!("body `{name}`"), body);
    }
    for (name, material) in &scene.materials {
        add_material(&mut citations, &format!("material `{name}`"), material);
    }
    add_steps(&mut citations, scene);
    if scene.solver.method() == Method::Iterative {
        for key in ["hestenes1952", "vanek1996"] {
            citations.add(key, "linear systems: conjugate gradients with smoothed aggregation");
        }
    }
    Ok(citations)
}

/// Citations of a scene of spring-sliders.
///
/// # Errors
/// A law that is not complete.
pub fn slider_citations(scene: &SliderScene) -> Result<Citations, Diagnostics> {
    let mut citations = Citations::default();
    titles::add(&mut citations, &scene.title);
    for (name, slider) in &scene.sliders {
        let (of, slider) = (format!("slider `{name}`"), slider.get_ref());
        laws::add(&mut citations, &of, &choose_sliding(&slider.law).map_err(Diagnostics)?);
        if slider.damping.is_some() {
            citations.add("rice1993", format!("{of}: radiation damping"));
        }
    }
    add_method(&mut citations, scene.time.method.as_ref(), "switching");
    Ok(citations)
}

fn add_interface(
    citations: &mut Citations,
    scene: &Scene,
    of: &str,
    interface: &Interface,
) -> Result<(), Diagnostics> {
    if let Some(law) = &interface.law {
        laws::add(citations, of, &choose(law).map_err(Diagnostics)?);
    }
    match interface.measure.get_ref() {
        Measure::NodeToPoint => citations.add("xing2002", format!("{of}: node-to-point contact")),
        Measure::Mortar => add_mortar(citations, scene, of, interface),
    }
    if interface.smoothing.is_some() {
        citations.add("vlachos2001", format!("{of}: cubic smoothing of the master"));
    }
    let (keys, how): (&[&'static str], _) = match interface.enforcement.kind.get_ref() {
        EnforcementKind::Penalty => (&[], ""),
        EnforcementKind::Uzawa => {
            (&["hestenes1969", "powell1969", "simo1992"], "multipliers by Uzawa's method")
        }
        EnforcementKind::AugmentedLagrangian => (&["alart1991"], "multipliers as unknowns"),
    };
    for key in keys {
        citations.add(key, format!("{of}: {how}"));
    }
    Ok(())
}

fn add_mortar(citations: &mut Citations, scene: &Scene, of: &str, interface: &Interface) {
    citations.add("puso2004", format!("{of}: mortar contact"));
    if interface.law.is_some() {
        citations.add("puso2004b", format!("{of}: mortar contact with friction"));
    }
    let small = *interface.sliding.get_ref() == Sliding::Small;
    if small && scene.body_of(&interface.slave).is_none_or(|slave| !is_of_second_order(slave)) {
        citations.add("wohlmuth2000", format!("{of}: dual functions on facets of first order"));
    }
}

/// True for a generated mesh of elements of second order. What a mesh file has is not known before it is read.
fn is_of_second_order(body: &Body) -> bool {
    let element = match &body.mesh {
        MeshSource::Block(mesh) => &mesh.element,
        MeshSource::Quadrilateral(mesh) => &mesh.element,
        MeshSource::Fault(mesh) => &mesh.element,
        MeshSource::Gmsh(_) | MeshSource::Abaqus(_) => return false,
    };
    !["tri3", "quad4", "tet4", "hex8", "wedge6"].contains(&element.get_ref().as_str())
}

fn add_fault(citations: &mut Citations, of: &str, fault: &Fault) -> Result<(), Diagnostics> {
    laws::add(citations, of, &choose(&fault.law).map_err(Diagnostics)?);
    if fault.damping.is_some() {
        citations.add("rice1993", format!("{of}: radiation damping"));
    }
    if fault.heat.is_some() {
        for key in ["rice2006", "noda2010"] {
            citations.add(key, format!("{of}: heat of friction"));
        }
    }
    if fault.diffusion.is_some() {
        citations.add("hairer1996", format!("{of}: implicit steps of the fluid"));
    }
    Ok(())
}

fn add_medium(citations: &mut Citations, scene: &Scene) {
    let of_triangles = |fault: &Fault| fault.triangles.is_some();
    let triangles = scene.faults.values().any(of_triangles);
    let key = match scene.kinematics.get_ref() {
        Kinematics::Antiplane => Some("segall2010"),
        // Of rectangles.
        Kinematics::ThreeD => (!scene.faults.values().all(of_triangles)).then_some("okada1992"),
        _ => Some("muskhelishvili1953"),
    };
    for key in key.into_iter().chain(triangles.then_some("nikkhoo2015")) {
        citations.add(key, "dislocations in homogeneous rock");
    }
    if scene.faults.values().any(|fault| fault.creep.is_some()) {
        citations.add("savage1983", "loading by slip deficit");
        citations.add("wang2004", "coupling of faults to plates");
    }
}

fn add_body(citations: &mut Citations, of: &str, body: &Body) {
    if body.formulation.as_ref().is_some_and(|f| *f.get_ref() == Formulation::BBar) {
        citations.add("hughes1980", format!("{of}: formulation \"b-bar\""));
    }
    if body.strain.as_ref().is_some_and(|s| *s.get_ref() == Strain::Finite) {
        citations.add("hugheswinget1980", format!("{of}: large deformation"));
    }
}

fn add_material(citations: &mut Citations, of: &str, material: &Material) {
    if material.plasticity.is_some() {
        citations.add("simo1998", format!("{of}: plasticity"));
    }
    if material.viscosity.is_some() || material.maxwell.is_some() {
        citations.add("simo1998", format!("{of}: viscoelasticity"));
    }
}

fn add_steps(citations: &mut Citations, scene: &Scene) {
    match scene.time.stepper.get_ref() {
        Stepper::FaultOde => add_method(citations, scene.time.method.as_ref(), "tsit5"),
        Stepper::StaticExplicit => {
            for key in ["yamada1968", "xing2002"] {
                citations.add(key, "static-explicit steps by the R-minimum rule");
            }
        }
        Stepper::Explicit => add_waves(citations, scene),
        Stepper::Auto if !scene.faults.is_empty() => {
            add_method(citations, scene.time.method.as_ref(), "tsit5");
            add_waves(citations, scene);
        }
        Stepper::Implicit | Stepper::Auto => {}
    }
    if scene.inertia().is_some() && scene.faults.is_empty() {
        citations.add("chung1993", "inertia by the generalised-alpha method");
        if scene.stages.iter().any(|stage| stage.steps.is_none()) {
            citations.add("zienkiewicz1991", "error control of bodies with inertia");
        }
    }
    if !scene.interfaces.is_empty() && rule(scene) == Rule::Bdf2 {
        citations.add("hairer1993", "rule \"bdf2\" with variable steps");
    }
}

/// Sources of steps with inertia.
fn add_waves(citations: &mut Citations, scene: &Scene) {
    let conditions = || scene.stages.iter().flat_map(|s| &s.conditions).map(Spanned::get_ref);
    if conditions().any(|c| c.absorbing.as_ref().is_some_and(|a| *a.get_ref())) {
        citations.add("lysmer1969", "absorbing sides");
    }
    if !scene.faults.is_empty() {
        citations.add("day2005", "friction at split nodes");
    }
    if scene.faults.values().any(Fault::slides) {
        citations.add("kaneko2008", "friction that depends on the slip rate at split nodes");
    }
    if scene.faults.values().any(|f| f.normal_delay.is_some()) {
        citations.add("prakash1993", "friction that follows the normal traction with a delay");
    }
}

/// Sources of an integrator, by its name in scenes.
fn add_method(citations: &mut Citations, given: Option<&Spanned<String>>, usual: &str) {
    let name = given.map_or(usual, |name| name.get_ref());
    for key in integrator(name) {
        citations.add(key, format!("integrator \"{name}\""));
    }
}

/// Sources of an integrator.
#[must_use]
pub fn integrator(name: &str) -> &'static [&'static str] {
    match name {
        "tsit5" | "tsit45" => &["tsitouras2011"],
        "dop853" => &["hairer1993"],
        "radau5" | "bdf" | "tr-bdf2" | "esdirk34" => &["hairer1996"],
        "switching" => &["hairer1993", "hairer1996"],
        "rkc2" => &["sommeijer1998"],
        "stabilised" => &["tsitouras2011", "sommeijer1998"],
        _ => &[],
    }
}
