//! The manufactured displacements.

use super::super::bodies::Field;
use asperity_fem::block::FieldValue;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;

/// Plane waves u = Σ A sin(k·x + φ), held by -div σ = Σ (G |k|² A + (λ+G) (k·A) k) sin(k·x + φ).
pub struct Waves {
    shear: f64,
    lame: f64,
    /// A, k, φ.
    waves: Vec<([f64; 3], [f64; 3], f64)>,
}

impl Waves {
    /// General waves of moderate wavelength.
    pub fn general(material: &Elastic, space: Idealisation) -> Self {
        let lame = match space {
            Idealisation::PlaneStress => material.plane_stress_lame(),
            // The single component has the body force of λ = -G.
            Idealisation::Antiplane => -material.shear(),
            _ => material.lame(),
        };
        let mut waves = vec![
            ([1.0, 0.2, 0.3], [1.0, 2.0, 0.5], 0.0),
            ([0.1, 1.0, -0.2], [2.0, -1.0, 1.0], 1.3),
            ([0.3, -0.1, 1.0], [0.5, 1.0, -2.0], 0.4),
        ];
        if space.dimension() == 2 {
            waves.iter_mut().for_each(|(a, k, _)| (a[2], k[2]) = (0.0, 0.0));
        } else {
            // Longer waves in 3D, where meshes are coarser.
            waves.iter_mut().for_each(|(_, k, _)| *k = k.map(|k| 0.5 * k));
        }
        Self { shear: material.shear(), lame, waves }
    }

    /// Transverse waves without dilatation, and a longitudinal one of amplitude G/(λ+2G): as λ grows the field becomes
    /// divergence-free while the pressure stays of the order of G.
    pub fn incompressible(material: &Elastic, dimension: usize) -> Self {
        let (shear, lame) = (material.shear(), material.lame());
        let small = shear / (lame + 2.0 * shear);
        let waves = if dimension == 2 {
            vec![
                ([2.0, -1.0, 0.0], [1.5, 3.0, 0.0], 0.2),
                ([1.0, 2.0, 0.0], [3.0, -1.5, 0.0], 1.0),
                ([2.0 * small, small, 0.0], [2.0, 1.0, 0.0], 0.5),
            ]
        } else {
            vec![
                ([2.0, -1.0, 0.5], [1.0, 2.0, 0.0], 0.2),
                ([0.0, 1.0, 1.0], [1.0, -1.5, 1.5], 1.0),
                ([2.0 * small, small, -small], [2.0, 1.0, -1.0], 0.5),
            ]
        };
        Self { shear, lame, waves }
    }

    fn phase<const D: usize>((_, k, phase): &([f64; 3], [f64; 3], f64), x: &[f64; D]) -> f64 {
        x.iter().zip(k).map(|(x, k)| x * k).sum::<f64>() + phase
    }
}

impl<const D: usize> Field<D> for Waves {
    fn at(&self, x: &[f64; D]) -> FieldValue {
        let (mut u, mut h) = ([0.0; 3], [[0.0; 3]; 3]);
        for wave in &self.waves {
            let (sine, cosine) = Self::phase(wave, x).sin_cos();
            for c in 0..3 {
                u[c] += wave.0[c] * sine;
                (0..3).for_each(|j| h[c][j] += wave.0[c] * wave.1[j] * cosine);
            }
        }
        (u, h)
    }

    fn force(&self, x: &[f64; D]) -> [f64; 3] {
        let mut force = [0.0; 3];
        for wave in &self.waves {
            let (a, k, _) = wave;
            let kk: f64 = k.iter().map(|k| k * k).sum();
            let ka: f64 = k.iter().zip(a).map(|(k, a)| k * a).sum();
            let sine = Self::phase(wave, x).sin();
            for c in 0..3 {
                force[c] += (self.shear * kk * a[c] + (self.lame + self.shear) * ka * k[c]) * sine;
            }
        }
        force
    }
}

/// u_r = r³ sin 2z, u_z = r² cos 2z about an axis: θ = 2 r² sin 2z.
pub struct Round {
    shear: f64,
    lame: f64,
}

impl Round {
    /// The field in a material.
    pub fn new(material: &Elastic) -> Self {
        Self { shear: material.shear(), lame: material.lame() }
    }
}

impl Field<2> for Round {
    fn at(&self, &[r, z]: &[f64; 2]) -> FieldValue {
        let (s, c) = (2.0 * z).sin_cos();
        let gradient =
            [[3.0 * r * r * s, 2.0 * r.powi(3) * c, 0.0], [2.0 * r * c, -2.0 * r * r * s, 0.0], [0.0; 3]];
        ([r.powi(3) * s, r * r * c, 0.0], gradient)
    }

    /// -(λ+G) ∇θ - G (Δu_r - u_r/r², Δu_z), with Δ = ∂rr + ∂r/r + ∂zz.
    fn force(&self, &[r, z]: &[f64; 2]) -> [f64; 3] {
        let (s, c) = (2.0 * z).sin_cos();
        let volumetric = self.lame + self.shear;
        [
            -(volumetric * 4.0 * r * s + self.shear * (8.0 * r - 4.0 * r.powi(3)) * s),
            -(volumetric * 4.0 * r * r * c + self.shear * (4.0 - 4.0 * r * r) * c),
            0.0,
        ]
    }
}
