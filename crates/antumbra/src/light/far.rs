//! Flat lights from far away: the middle of each stands for the whole, eight weighed at once.

use antumbra_math::World;

use super::Light;
use crate::receiver::Receiver;

/// Weighed together: what the compiler turns into SIMD lanes.
const LANES: usize = 8;

/// A small flat light as if it sat in its middle.
#[derive(Clone, Copy, Debug)]
pub struct Far {
    /// Its middle.
    pub middle: World,
    /// The unit normal of its front times its area A.
    pub area: World,
    /// Squared distance of its farthest point from the middle.
    pub reach2: f32,
    /// The back shines too.
    pub both_sides: bool,
    /// Luminance of L_e.
    pub luminance: f32,
}

/// The far looks of all lights of a scene, in their order.
#[derive(Clone, Debug)]
pub struct FarLights(Vec<Lanes>);

impl FarLights {
    /// Of these lights.
    pub fn new(lights: &[Light]) -> FarLights {
        let mut all = vec![Lanes::NOWHERE; lights.len().div_ceil(LANES)];
        for (i, light) in lights.iter().enumerate() {
            if let Some(far) = light.far() {
                all[i / LANES].set(i % LANES, &far);
            }
        }
        FarLights(all)
    }

    /// Of each of these lights L_e A cos θ cos θ′ / r² (luminance) at a receiver: within a fifth of its irradiance, above 0
    /// wherever that is. The irradiance itself if the light is not flat, looks larger than two thirds of a radian across,
    /// may be cut by the horizon, or lies so that f32 cannot tell its sides apart.
    #[inline]
    pub fn weigh(&self, lights: &[Light], at: &Receiver, out: &mut [f32]) {
        for (lanes, out) in self.0.iter().zip(out.chunks_mut(LANES)) {
            let mut weights = [0.0; LANES];
            for (k, weight) in weights.iter_mut().enumerate() {
                *weight = lanes.weight(k, at.p, at.ng);
            }
            out.copy_from_slice(&weights[..out.len()]);
        }
        for (weight, light) in out.iter_mut().zip(lights).filter(|(weight, _)| weight.is_nan()) {
            *weight = light.irradiance(at);
        }
    }
}

/// Eight lights, number by number.
#[derive(Clone, Copy, Debug)]
struct Lanes {
    middle: [[f32; LANES]; 3],
    area: [[f32; LANES]; 3],
    reach2: [f32; LANES],
    /// What the back sends, over what the front sends: 1 or 0.
    back: [f32; LANES],
    luminance: [f32; LANES],
}

impl Lanes {
    /// Lights that are never far.
    const NOWHERE: Lanes = Lanes {
        middle: [[0.0; LANES]; 3],
        area: [[0.0; LANES]; 3],
        reach2: [f32::INFINITY; LANES],
        back: [0.0; LANES],
        luminance: [0.0; LANES],
    };

    #[inline]
    fn set(&mut self, k: usize, far: &Far) {
        for axis in 0..3 {
            self.middle[axis][k] = far.middle[axis];
            self.area[axis][k] = far.area[axis];
        }
        self.reach2[k] = far.reach2;
        self.back[k] = if far.both_sides { 1.0 } else { 0.0 };
        self.luminance[k] = far.luminance;
    }

    /// NaN where the light is near.
    #[inline(always)]
    fn weight(&self, k: usize, p: World, n: World) -> f32 {
        let to = [self.middle[0][k] - p.x, self.middle[1][k] - p.y, self.middle[2][k] - p.z];
        let area = [self.area[0][k], self.area[1][k], self.area[2][k]];
        let distance2 = dot(to, to);
        let height = dot(to, [n.x, n.y, n.z]);
        let facing = -dot(to, area);
        let edge_on = facing * facing <= 1e-10 * distance2 * dot(area, area);
        let near = (distance2 < 9.0 * self.reach2[k]) | (height * height <= self.reach2[k]) | edge_on;
        let over = 1.0 / distance2;
        let signed = facing * over * (height * over);
        // Without a branch, for the lanes.
        let front = if signed > 0.0 { signed } else { 0.0 };
        let back = if signed < 0.0 { -signed } else { 0.0 };
        let weight = (front + back * self.back[k]) * self.luminance[k];
        let weight = if height > 0.0 { weight } else { 0.0 };
        if near { f32::NAN } else { weight }
    }
}

#[inline(always)]
fn dot(a: [f32; 3], b: [f32; 3]) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
