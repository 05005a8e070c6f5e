//! Sketches of friction laws and spring-sliders.

use asperity_output::figures::Sketch;

pub(super) fn draw(name: &str) -> Option<Sketch> {
    let sketch = match name {
        "friction_steady_state" => forced("V = 1e−20 to 1e4 m/s", "steady: state and rate do not change"),
        "friction_velocity_steps" => forced("V₁, then V₂; held; again", "rigid or a stiff spring"),
        "friction_hard_numerics" => forced("V", "one trap at a time"),
        "slider_cycles" => slider("k < k_c", "η or M", "V_load", "mild, hard, reference, inertial"),
        "slider_balance" => slider("k < k_c, or 2 k_c", "η or M", "V_load", "five events; steady sliding"),
        "slider_inertia" | "slider_inertia_all" => {
            slider("k", "M", "V_load", "384 sets: laws, a/b, k/k_c, M, V_load")
        }
        "slider_laws" => {
            slider("k, or rigid", "η", "V_load(t)", "each evolution of the state, two temperatures")
        }
        "slider_normal" => slider("2 k_c", "η", "V_load", "f_n steps, oscillates, or falls to nothing"),
        "slider_orbit" => slider("k = k_c", "", "V_load", "slip law, kicked out of steady sliding"),
        "slider_outputs" => slider("k, or rigid", "η", "V_load(t)", "scenes run as by the program"),
        "slider_stability" => slider("k", "η or M", "V_load", "perturbed by 1e−4 in each unknown"),
        "slider_work_precision" => slider("k < k_c", "η or M", "V_load", "mild, hard, inertial, soft"),
        "slider_states" => coupled(),
        _ => return None,
    };
    Some(sketch)
}

/// A block with prescribed motion.
fn forced(motion: &str, text: &str) -> Sketch {
    Sketch::new(50.0)
        .block((36.0, 14.0), (56.0, 28.0), "")
        .held((16.0, 14.0), (86.0, 14.0))
        .fault(&[(36.0, 14.0), (56.0, 14.0)])
        .load((36.0, 28.0), (56.0, 28.0), (0.0, -5.0), "f_n")
        .arrow((57.0, 22.0), (70.0, 22.0), "")
        .text((78.0, 29.0), motion)
        .note((57.0, 17.5), "τ = f_n μ(V, θ)")
        .text((50.0, 5.0), text)
}

/// A slider on a spring, with damping or mass.
fn slider(stiffness: &str, slowed: &str, load: &str, text: &str) -> Sketch {
    Sketch::new(52.0)
        .block((26.0, 14.0), (46.0, 28.0), slowed)
        .held((10.0, 14.0), (86.0, 14.0))
        .fault(&[(26.0, 14.0), (46.0, 14.0)])
        .load((26.0, 28.0), (46.0, 28.0), (0.0, -5.0), "f_n")
        .spring((46.0, 21.0), (74.0, 21.0), stiffness)
        .line(&[(74.0, 16.0), (74.0, 26.0)])
        .arrow((75.0, 21.0), (88.0, 21.0), "")
        .text((88.0, 27.0), load)
        .text((24.0, 10.0), "μ(V, θ)")
        .text((50.0, 4.0), text)
}

fn coupled() -> Sketch {
    Sketch::new(52.0)
        .block((14.0, 14.0), (28.0, 26.0), "")
        .block((48.0, 14.0), (62.0, 26.0), "")
        .held((6.0, 14.0), (90.0, 14.0))
        .fault(&[(14.0, 14.0), (28.0, 14.0)])
        .fault(&[(48.0, 14.0), (62.0, 14.0)])
        .load((14.0, 26.0), (28.0, 26.0), (0.0, -5.0), "f_n")
        .load((48.0, 26.0), (62.0, 26.0), (0.0, -5.0), "f_n")
        .spring((28.0, 20.0), (48.0, 20.0), "k₁₂")
        .spring((62.0, 20.0), (82.0, 20.0), "k")
        .arrow((83.0, 20.0), (94.0, 20.0), "")
        .text((90.0, 26.0), "V_load")
        .text((50.0, 4.0), "one or two states, L = 10 and 100 µm")
}
