//! Which lights lie along a direction: spheres about all of them, eight tested at once, then the lights themselves.

use antumbra_math::World;
use antumbra_trace::{NO_PRIM, PrimId};

use super::{End, Light, LightId};

/// Tested together: what the compiler turns into SIMD lanes.
const LANES: usize = 8;

/// So few lights are asked without a look at their spheres.
const DIRECT: usize = 2;

/// More lights than this take longer to test than a ray takes to find one.
const FEW: usize = 64;

/// Spheres about the lights of a scene, in their order.
#[derive(Clone, Debug, Default)]
pub struct Along {
    lanes: Vec<Lanes>,
    few: bool,
    infinite: Vec<LightId>,
    everywhere: bool,
}

impl Along {
    /// Of these lights.
    pub fn new(lights: &[Light]) -> Along {
        let few = lights.len() <= FEW;
        let mut lanes = vec![Lanes::NOWHERE; if few { lights.len().div_ceil(LANES) } else { 0 }];
        for (i, light) in lights.iter().enumerate().filter(|_| few) {
            if !light.is_delta() {
                lanes[i / LANES].set(i % LANES, light, lights.len() <= DIRECT);
            }
        }
        let infinite = lights.iter().zip(0..).filter(|(light, _)| light.is_infinite());
        let around = |light: &Light| light.is_infinite() && light.bounds().cos_spread <= -1.0;
        let (infinite, everywhere) = (infinite.map(|(_, id)| id).collect(), lights.iter().any(around));
        Along { lanes, few, infinite, everywhere }
    }

    /// Some light lies along every direction.
    #[inline]
    pub fn everywhere(&self) -> bool {
        self.everywhere
    }

    /// The lights at infinity.
    #[inline]
    pub fn infinite(&self) -> &[LightId] {
        &self.infinite
    }

    /// They are so few that a direction asks them instead of sending a ray to find them.
    #[inline]
    pub fn few(&self) -> bool {
        self.few
    }

    /// The lights that lie along the unit vector `wi` from a point `from` of the primitive `own` (which never lights
    /// itself), blocked or not, with the ends of segments to them; of [`Along::few`] lights.
    #[inline]
    pub fn lights<'a>(
        &'a self,
        lights: &'a [Light],
        (from, own): (World, PrimId),
        wi: World,
    ) -> impl Iterator<Item = (LightId, End, PrimId)> + 'a {
        let near = self.lanes.iter().enumerate().flat_map(move |(block, lanes)| {
            Set(if lanes.all > 0 { lanes.all } else { lanes.near(from, wi) })
                .map(move |lane| (block * LANES) as LightId + lane)
        });
        let end = move |light: LightId| {
            let (end, prim) = lights[light as usize].end_along(from, wi)?;
            (prim == NO_PRIM || prim != own).then_some((light, end, prim))
        };
        near.filter_map(end)
    }
}

/// The set bits of a word, from the lowest on.
struct Set(u32);

impl Iterator for Set {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let bit = self.0.trailing_zeros();
        self.0 &= self.0.wrapping_sub(1);
        (bit < u32::BITS).then_some(bit)
    }
}

/// Eight spheres, number by number.
#[derive(Clone, Copy, Debug)]
struct Lanes {
    center: [[f32; LANES]; 3],
    /// Twice the squared radius; −∞: no sphere, +∞: everywhere.
    reach2: [f32; LANES],
    /// The lights, if they are so few that all are near.
    all: u32,
}

impl Lanes {
    /// No lights.
    const NOWHERE: Lanes = Lanes { center: [[0.0; LANES]; 3], reach2: [f32::NEG_INFINITY; LANES], all: 0 };

    fn set(&mut self, k: usize, light: &Light, near: bool) {
        self.all |= u32::from(near) << k;
        let bounds = light.bounds();
        self.reach2[k] = f32::INFINITY;
        if bounds.low.is_finite() && bounds.high.is_finite() {
            let center = 0.5 * bounds.low + 0.5 * bounds.high;
            (0..3).for_each(|axis| self.center[axis][k] = center[axis]);
            self.reach2[k] = 2.0 * (bounds.high - center).length_squared();
        }
    }

    /// A bit for each sphere that the ray may meet. The distance of the line from the centre c is |c × ω|, its error below
    /// 2⁻²² |c|: the double of r², and 10⁻¹¹ |c|² more, hold it.
    #[inline]
    fn near(&self, p: World, d: World) -> u32 {
        let mut near = [0u32; LANES];
        for (k, near) in near.iter_mut().enumerate() {
            let [x, y, z] = [self.center[0][k] - p.x, self.center[1][k] - p.y, self.center[2][k] - p.z];
            let off = [y * d.z - z * d.y, z * d.x - x * d.z, x * d.y - y * d.x];
            let off2 = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
            let distance2 = x * x + y * y + z * z;
            let reach2 = self.reach2[k];
            let ahead = (x * d.x + y * d.y + z * d.z > 0.0) | (distance2 <= reach2);
            *near = u32::from((off2 <= reach2 + 1e-11 * distance2) & ahead);
        }
        (0..LANES).fold(0, |set, k| set | near[k] << k)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_math::{hash, warp};

    /// What the spheres leave out is never hit: every example kind of light, from far and near, toward all directions.
    #[test]
    fn no_light_is_missed() {
        let lights: Vec<Light> = Light::examples().into_iter().map(|(_, light)| light).collect();
        let along = Along::new(&lights);
        assert!(along.few());
        let number = |i: u32, k: u32| hash::unit_f32(hash::hash2(i, k));
        let mut met = 0;
        for i in 0..20_000 {
            let scale = if i % 3 == 0 { 1000.0 } else { 4.0 };
            let p = World::from([0, 1, 2].map(|k| (2.0 * number(i, k) - 1.0) * scale));
            let toward = |light: &Light| light.bounds().low - p;
            let aimed = toward(&lights[i as usize % lights.len()]).normalize_or_zero();
            let wi = if i % 2 == 0 && aimed.is_finite() && aimed != World::ZERO {
                aimed
            } else {
                warp::sphere([number(i, 3), number(i, 4)]).0
            };
            let found: Vec<LightId> = along.lights(&lights, (p, NO_PRIM), wi).map(|(id, ..)| id).collect();
            let all = (0..lights.len() as LightId).filter(|id| lights[*id as usize].hit(p, wi).is_some());
            met += found.len();
            assert_eq!(found, all.collect::<Vec<_>>(), "{p} {wi}");
        }
        assert!(met > 20_000);
    }
}
