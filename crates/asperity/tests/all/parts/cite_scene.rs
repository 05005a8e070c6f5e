use asperity_ode::Method as Integrator;
use asperity_reference::cite::scene::*;

#[test]
fn every_integrator_has_a_source() {
    for method in Integrator::ALL {
        assert!(!integrator(method.name()).is_empty(), "{}", method.name());
    }
}
