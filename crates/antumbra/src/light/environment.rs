//! Light from everywhere at infinity: one radiance, or a lat-long picture.

use std::sync::Arc;

use antumbra_math::{Frame, Rgb, World, real, warp};
use antumbra_trace::{NO_PRIM, PrimId};

use super::flat::amount_fault;
use super::lat_long::LatLong;
use super::{End, LightBounds, LightHit, LightKind, LightPoints, LightSample, OutlinePoint};
use crate::density::Density;
use crate::receiver::Receiver;
use crate::texture::{Image, Texels};

/// An environment: radiance L_e by direction.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The picture; `None`: the same radiance from everywhere.
    pub picture: Option<Arc<LatLong>>,
    /// L_e [W·m⁻²·sr⁻¹], or what the picture is multiplied with.
    pub radiance: Rgb,
    /// World directions of the map's x, y and z.
    pub frame: Frame,
}

impl Environment {
    /// The same radiance from everywhere.
    pub fn constant(radiance: Rgb) -> Environment {
        let frame = Frame { s: World::X, t: World::Y, n: World::Z };
        Environment { picture: None, radiance, frame }
    }

    /// A lat-long picture, looked up bilinearly: d = (sin φ sin θ, cos θ, −cos φ sin θ), φ = 2πu, θ = πv, v = 0 at the
    /// top row.
    pub fn image(image: Arc<Image>) -> Environment {
        let picture = Some(Arc::new(LatLong::new(image, false)));
        Environment { picture, ..Environment::constant(Rgb::WHITE) }
    }

    /// Whether each texel is a patch of one radiance, instead of bilinear interpolation.
    pub fn nearest(self, nearest: bool) -> Environment {
        let again = |p: Arc<LatLong>| {
            if p.nearest() == nearest { p } else { Arc::new(LatLong::new(p.image().clone(), nearest)) }
        };
        Environment { picture: self.picture.map(again), ..self }
    }

    /// Turned by `angle` [rad] about +y of the world, right-handed, after what turned it before.
    pub fn rotated(self, angle: f32) -> Environment {
        let (sin, cos) = (real::sinf(angle), real::cosf(angle));
        let turn = |d: World| World::new(d.x * cos + d.z * sin, d.y, d.z * cos - d.x * sin);
        let Frame { s, t, n } = self.frame;
        Environment { frame: Frame { s: turn(s), t: turn(t), n: turn(n) }, ..self }
    }

    /// With the map's x, y and z along three orthonormal directions of the world (which may mirror it).
    pub fn oriented(self, frame: Frame) -> Environment {
        Environment { frame, ..self }
    }

    /// Its light multiplied.
    pub fn scaled(self, factor: Rgb) -> Environment {
        Environment { radiance: self.radiance * factor, ..self }
    }

    /// L_e from the unit direction `wi`.
    #[inline]
    pub fn radiance_from(&self, wi: World) -> Rgb {
        match &self.picture {
            Some(picture) => self.radiance * picture.radiance(self.frame.to_local(wi).0),
            None => self.radiance,
        }
    }
}

/// A sample along `wi`.
#[inline]
fn arrive(wi: World, radiance: Rgb, pdf: f32) -> Option<LightSample> {
    (pdf > 0.0).then_some(LightSample {
        wi,
        end: End::Infinity,
        distance: f32::INFINITY,
        radiance,
        density: Density::SolidAngle(pdf),
        prim: NO_PRIM,
        cos: 1.0,
    })
}

impl LightKind for Environment {
    /// Solid angle: a picture by its luminance, its sun by what it gives this receiver; one radiance by cos θ / π about the receiver's geometric normal. Area:
    /// there is none, so uniform over the hemisphere of that normal, 1/(2π).
    #[inline]
    fn sample(&self, at: &Receiver, u: [f32; 2], how: LightPoints) -> Option<LightSample> {
        let around = |l: antumbra_math::Local| Frame::about(at.ng).to_world(l).normalize();
        match (&self.picture, how) {
            (_, LightPoints::Area) => {
                let wi = around(warp::hemisphere(u));
                arrive(wi, self.radiance_from(wi), self.pdf(at, wi, how))
            }
            (None, _) => {
                let wi = around(warp::cosine_hemisphere(u));
                arrive(wi, self.radiance, self.pdf(at, wi, how))
            }
            (Some(picture), _) => {
                let drawn = picture.sample(u, self.frame.to_local(at.ng).0)?;
                let wi = self.frame.to_world(antumbra_math::Local(drawn.wi)).normalize();
                arrive(wi, self.radiance * drawn.radiance, drawn.pdf)
            }
        }
    }

    #[inline]
    fn pdf(&self, at: &Receiver, wi: World, how: LightPoints) -> f32 {
        let cos = wi.dot(at.ng);
        match (&self.picture, how) {
            (_, LightPoints::Area) => {
                if cos > 0.0 {
                    0.5 * real::INV_PI
                } else {
                    0.0
                }
            }
            (None, _) => cos.max(0.0) * real::INV_PI,
            (Some(picture), _) => picture.pdf(self.frame.to_local(wi).0, self.frame.to_local(at.ng).0),
        }
    }

    #[inline]
    fn hit(&self, _from: World, wi: World) -> Option<LightHit> {
        Some(LightHit { distance: f32::INFINITY, radiance: self.radiance_from(wi) })
    }

    #[inline]
    fn end_along(&self, _from: World, _wi: World) -> Option<(End, PrimId)> {
        Some((End::Infinity, NO_PRIM))
    }

    fn emitted(&self, _wi: World, _front: bool) -> Rgb {
        Rgb::BLACK
    }

    /// π L_e, or the picture's sun and the harmonics of the rest.
    fn irradiance(&self, at: &Receiver) -> f32 {
        let light = self.radiance.luminance();
        match &self.picture {
            Some(picture) => light * picture.irradiance(self.frame.to_local(at.ng).0),
            None => light * real::PI,
        }
    }

    /// 4π · mean L_e · π R².
    fn power(&self, scene_radius: f32) -> f32 {
        let mean = self.picture.as_ref().map_or(1.0, |p| p.mean() as f32);
        let sphere = 4.0 * real::PI * real::PI;
        self.radiance.luminance() * mean * sphere * scene_radius * scene_radius
    }

    fn bounds(&self) -> LightBounds {
        LightBounds::at_infinity(World::Y, -1.0)
    }

    fn outline(&self, _at: &Receiver, _u: f32) -> Option<OutlinePoint> {
        None
    }

    fn is_infinite(&self) -> bool {
        true
    }

    fn is_environment(&self) -> bool {
        true
    }

    fn fault(&self) -> Option<String> {
        let Frame { s, t, n } = self.frame;
        // Orthonormal to the roundings of f32 products.
        let square = [s.dot(t), t.dot(n), n.dot(s)].iter().all(|x| x.abs() < 1e-4);
        if !square || ![s, t, n].iter().all(|x| x.is_normalized()) {
            return Some("its orientation is not a rotation".into());
        }
        amount_fault(self.radiance).or_else(|| self.picture.as_ref().and_then(|p| p.fault()))
    }

    fn examples() -> Vec<Environment> {
        let picture = |w: u32, h: u32, light: fn(u32, u32) -> f32| {
            let texels = (0..w * h).map(|i| [light(i % w, i / w); 3]).collect();
            Image::new(w, h, Texels::Float(texels)).map(|image| Environment::image(Arc::new(image)))
        };
        let clouds = picture(16, 8, |x, y| ((x * 7 + y * 5) % 11) as f32 * 0.1);
        let hot = picture(16, 8, |x, y| if (x, y) == (3, 2) { 1000.0 } else { 0.0 });
        let dot = picture(1, 1, |_, _| 2.0);
        let black = picture(4, 2, |_, _| 0.0);
        let pole = picture(16, 8, |x, y| if (x, y) == (5, 0) { 20.0 } else { 1.0 });
        let sunny = picture(64, 32, |x, y| if (x, y) == (63, 9) { 2000.0 } else { 1.0 + (x % 5) as f32 });
        let constant = Environment::constant(Rgb::new(1.0, 0.8, 0.6));
        let turned = clouds.clone().map(|e| e.rotated(0.7).scaled(Rgb::new(1.0, 2.0, 3.0)));
        let patch = hot.clone().map(|e| e.nearest(true));
        [Some(constant), clouds, turned, hot, patch, dot, black, pole, sunny].into_iter().flatten().collect()
    }
}
