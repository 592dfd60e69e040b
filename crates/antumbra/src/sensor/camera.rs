//! A camera: one receiver where each viewing ray meets a surface.

use antumbra_math::{DVec2, DVec3, Rgb, Vec3, real, warp};
use antumbra_trace::NO_PRIM;

use super::{Looking, Scratch, Seen, Sensor, Tile, grid};
use crate::film::{Film, Planes};
use crate::receiver::Receiver;
use crate::sampler::{AnySampler, Use, stream};
use crate::scene::{Camera, Errand, Lens, Projection, Ray};

/// Sides of a tile: enough rays for a batch, small enough to keep all cores busy.
const TILE: [u32; 2] = [32, 32];

/// Where in the pixel viewing rays pass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Viewing {
    /// Over the pixel filter.
    #[default]
    Filter,
    /// All through the centre, and through the middle of the lens.
    Centre,
}

/// The pixel filter; sampled, so that weights stay 1 and a sample touches one pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// Blackman–Harris window, radius 1.5 pixels.
    #[default]
    BlackmanHarris,
    /// The pixel's square.
    Box,
    /// Triangle, radius 1 pixel.
    Tent,
    /// Gaussian, σ = 0.5 pixels, cut at 2.
    Gaussian,
}

/// What of the scene is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Size of the whole picture.
    pub size: [u32; 2],
    /// The part to render: x, y, width, height.
    pub crop: [u32; 4],
    /// Where in the pixel.
    pub viewing: Viewing,
    /// The pixel filter.
    pub filter: Filter,
}

/// A camera as a sensor.
pub struct CameraSensor {
    eye: DVec3,
    right: DVec3,
    up: DVec3,
    forward: DVec3,
    /// Half the height of the picture at distance 1 (perspective) or in scene units (orthographic).
    half_height: f64,
    parallel: bool,
    lens: Option<Lens>,
    /// From the direction of view to the middle of the picture [pixels].
    shift: [f64; 2],
    view: View,
    profile: Profile,
}

impl CameraSensor {
    /// Looks at the scene with `camera`.
    pub fn new(camera: &Camera, view: View) -> CameraSensor {
        let forward = (camera.look_at - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let (half_height, parallel) = match camera.projection {
            Projection::Perspective { vertical_fov } => (real::tan(vertical_fov / 2.0), false),
            Projection::Orthographic { height } => (height / 2.0, true),
        };
        let profile = Profile::of(view.filter);
        let [width, height] = view.size.map(f64::from);
        CameraSensor {
            eye: camera.eye,
            right: if camera.mirrored { -right } else { right },
            up: right.cross(forward),
            forward,
            half_height,
            parallel,
            lens: camera.lens.filter(|lens| lens.radius > 0.0),
            shift: [camera.shift[0] * width, camera.shift[1] * height],
            view,
            profile,
        }
    }

    /// Origin and unit direction of the viewing ray through (x, y) in pixels of the whole picture and the middle of the
    /// lens.
    pub fn ray(&self, x: f64, y: f64) -> (Vec3, Vec3) {
        self.ray_through(x, y, DVec2::ZERO)
    }

    /// As [`CameraSensor::ray`], through a point of the lens right of and above its middle: all rays through (x, y) meet
    /// where that of the middle is in focus.
    fn ray_through(&self, x: f64, y: f64, on_lens: DVec2) -> (Vec3, Vec3) {
        let (x, y) = (x + self.shift[0], y + self.shift[1]);
        let [w, h] = self.view.size.map(f64::from);
        let right = (2.0 * x / w - 1.0) * self.half_height * (w / h);
        let up = (1.0 - 2.0 * y / h) * self.half_height;
        let across = self.right * right + self.up * up;
        if self.parallel {
            ((self.eye + across).as_vec3(), self.forward.as_vec3())
        } else {
            let (mut eye, mut toward) = (self.eye, self.forward + across);
            if let (Some(lens), true) = (self.lens, on_lens != DVec2::ZERO) {
                let aside = self.right * on_lens.x + self.up * on_lens.y;
                (eye, toward) = (eye + aside, toward * lens.focus - aside);
            }
            (eye.as_vec3(), toward.normalize().as_vec3())
        }
    }

    /// The viewing ray of sample `index` of `of` through a pixel of the whole picture: its origin and unit direction.
    pub fn sample(
        &self,
        pixel: [u32; 2],
        u: &AnySampler,
        (stream, index, of): (u32, u32, u32),
    ) -> (Vec3, Vec3) {
        let offset = self.offset(u.pair(stream, index, of, Use::Pixel.at(0)));
        let on_lens = self.on_lens(|| u.pair(stream, index, of, Use::Lens.at(0)));
        let [x, y] = [0, 1].map(|k| f64::from(pixel[k]) + 0.5 + offset[k]);
        self.ray_through(x, y, on_lens)
    }

    /// The stream of a pixel. Numbers belong to the pixel of the whole picture: a crop shows the same noise.
    pub fn stream(&self, [x, y]: [u32; 2], seed: u32, replicate: u32) -> u32 {
        stream(seed, y * self.view.size[0] + x, replicate)
    }

    /// A point of the lens for two numbers in [0, 1), which are asked for only where there is one.
    fn on_lens(&self, u: impl FnOnce() -> [f32; 2]) -> DVec2 {
        match (self.lens, self.view.viewing) {
            (Some(lens), Viewing::Filter) => warp::disk(u()).as_dvec2() * lens.radius,
            _ => DVec2::ZERO,
        }
    }

    /// Offset from the pixel's centre for two numbers in [0, 1).
    fn offset(&self, u: [f32; 2]) -> [f64; 2] {
        match self.view.viewing {
            Viewing::Centre => [0.0; 2],
            Viewing::Filter => u.map(|u| f64::from(self.profile.sample(u)) * filter_radius(self.view.filter)),
        }
    }
}

impl Sensor for CameraSensor {
    fn receivers(
        &self,
        looking: &Looking<'_>,
        tile: Tile,
        pass: u32,
        scratch: &mut Scratch,
        film: &mut Film,
        out: &mut Vec<Receiver>,
    ) {
        let (replicate, index, of) = looking.passes.locate(pass);
        let [left, top, ..] = self.view.crop;
        let rows = (0..tile.height).map(|y| top + tile.y + y);
        let pixels = rows.flat_map(|y| (0..tile.width).map(move |x| [left + tile.x + x, y]));
        scratch.rays.clear();
        scratch.streams.clear();
        for pixel in pixels {
            let stream = self.stream(pixel, looking.seed, replicate);
            scratch.streams.push(stream);
            let (o, d) = self.sample(pixel, looking.sampler, (stream, index, of));
            let number = stream ^ index.wrapping_mul(0x9e37_79b9);
            scratch.rays.push_ray(o.to_array(), d.to_array(), f32::INFINITY, NO_PRIM, number);
        }
        looking.visibility.nearest(scratch.rays.as_segments(), &mut scratch.hits);
        let rays = scratch.rays.as_segments();
        for cell in 0..tile.cells() {
            let i = cell as usize;
            let (o, d) = (Vec3::from(rays.origin_at(i)), Vec3::from(rays.end_at(i)));
            let hits = &scratch.hits;
            if hits.prim[i] == NO_PRIM {
                note_sky(film, looking, cell, d);
                continue;
            }
            let (t, prim, uv, number) = (hits.t[i], hits.prim[i], hits.uv[i], rays.number[i]);
            let errand = Errand { cell, stream: scratch.streams[i], index, ..Errand::default() };
            let met = looking.scene.meet_for(errand, &Ray { o, d, t, prim, uv, number }, &looking.look);
            if let (Some((_, radiance)), Seen::Light) = (met.emitted, looking.seen) {
                note_light(film, cell, radiance);
            }
            if !met.shown.is_black() && looking.seen == Seen::Light {
                note_light(film, cell, met.shown);
            }
            if film.planes().has(OF_SURFACES) {
                note_surface(film, &met.receiver, hits.t[i] as f32);
            }
            out.push(met.receiver);
        }
    }

    fn size(&self) -> [u32; 2] {
        [self.view.crop[2], self.view.crop[3]]
    }

    fn tiles(&self) -> Vec<Tile> {
        grid(self.size(), TILE)
    }
}

/// Where nothing is: light from infinity, or openness.
fn note_sky(film: &mut Film, looking: &Looking<'_>, cell: u32, d: Vec3) {
    match looking.seen {
        Seen::Open => film.add(Planes::BEAUTY, cell, Rgb::WHITE),
        Seen::Light => {
            looking.scene.from_infinity(d).for_each(|(_, radiance)| note_light(film, cell, radiance))
        }
    }
}

fn note_light(film: &mut Film, cell: u32, radiance: Rgb) {
    film.add(Planes::BEAUTY, cell, radiance);
    film.add(Planes::EMISSION, cell, radiance);
}

/// The planes about what is seen.
const OF_SURFACES: Planes = Planes::ALBEDO.union(Planes::NORMAL).union(Planes::POSITION).union(Planes::DEPTH);

/// What is seen, for the planes that want it.
fn note_surface(film: &mut Film, at: &Receiver, depth: f32) {
    let of = |v: Vec3| Rgb(v.to_array());
    film.add(Planes::ALBEDO, at.cell, at.bsdf.albedo());
    film.add(Planes::NORMAL, at.cell, of(at.frame.n));
    film.add(Planes::POSITION, at.cell, of(at.p));
    film.add(Planes::DEPTH, at.cell, Rgb::grey(depth));
}

/// Half width of a filter [pixels].
fn filter_radius(filter: Filter) -> f64 {
    match filter {
        Filter::Box => 0.5,
        Filter::Tent => 1.0,
        Filter::BlackmanHarris => 1.5,
        Filter::Gaussian => 2.0,
    }
}

/// The filter's profile at x in [−1, 1] of its radius.
fn filter_profile(filter: Filter, x: f64) -> f64 {
    match filter {
        Filter::Box => 1.0,
        Filter::Tent => 1.0 - x.abs(),
        // σ = 0.5 pixels = a quarter of the radius.
        Filter::Gaussian => real::exp(-8.0 * x * x),
        // F. Harris 1978, four terms, centred.
        Filter::BlackmanHarris => {
            let phase = std::f64::consts::PI * (x + 1.0);
            0.35875 - 0.48829 * real::cos(phase) + 0.14128 * real::cos(2.0 * phase)
                - 0.01168 * real::cos(3.0 * phase)
        }
    }
}

/// Steps of a profile.
const STEPS: usize = 256;

/// A filter's profile over [−1, 1], ready to be drawn from.
struct Profile {
    /// Its running integral, from 0 to 1.
    cdf: Vec<f32>,
    /// For each 256th of [0, 1): the first step that it can fall into (Chen & Asau 1974).
    guide: Vec<u16>,
}

impl Profile {
    fn of(filter: Filter) -> Profile {
        let mut sum = 0.0;
        let mut sums = vec![0.0];
        for i in 0..STEPS {
            sum += filter_profile(filter, (2.0 * i as f64 + 1.0) / STEPS as f64 - 1.0);
            sums.push(sum);
        }
        let cdf: Vec<f32> = sums.iter().map(|c| (c / sum) as f32).collect();
        let first = |k: usize| cdf.partition_point(|c| *c <= k as f32 / STEPS as f32).clamp(1, STEPS) as u16;
        let guide = (0..STEPS).map(first).collect();
        Profile { cdf, guide }
    }

    /// x in [−1, 1] with the profile's density, for u in [0, 1): the inverse of the integral, linear in each step.
    #[inline]
    fn sample(&self, u: f32) -> f32 {
        let mut step = usize::from(self.guide[((u * STEPS as f32) as usize).min(STEPS - 1)]);
        while step < STEPS && self.cdf[step] <= u {
            step += 1;
        }
        let (low, high) = (self.cdf[step - 1], self.cdf[step]);
        let within = if high > low { (u - low) / (high - low) } else { 0.5 };
        (step as f32 - 1.0 + within.clamp(0.0, 1.0)) / STEPS as f32 * 2.0 - 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: View =
        View { size: [64, 48], crop: [0, 0, 64, 48], viewing: Viewing::Centre, filter: Filter::Box };

    #[test]
    fn sampled_filters_have_the_moments_of_their_profiles() {
        for filter in [Filter::Box, Filter::Tent, Filter::Gaussian, Filter::BlackmanHarris] {
            let sampled = Profile::of(filter);
            let n = 100_000;
            let (mut mean, mut square) = (0.0, 0.0);
            for i in 0..n {
                let x = f64::from(sampled.sample((i as f32 + 0.5) / n as f32));
                mean += x / f64::from(n);
                square += x * x / f64::from(n);
            }
            let (mut weight, mut moment) = (0.0, 0.0);
            for i in 0..n {
                let x = (2.0 * f64::from(i) + 1.0) / f64::from(n) - 1.0;
                weight += filter_profile(filter, x);
                moment += filter_profile(filter, x) * x * x;
            }
            // 256 linear steps: second moment to 1/256² relative, plus f32 rounding.
            assert!(
                mean.abs() < 1e-4 && (square - moment / weight).abs() < 1e-4,
                "{filter:?} {mean} {square}"
            );
        }
    }

    #[test]
    fn the_middle_of_the_picture_is_where_the_camera_looks() {
        let camera = Camera::perspective(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.5, -1.0), 50.0);
        let (_, d) = CameraSensor::new(&camera, VIEW).ray(32.0, 24.0);
        let toward = (camera.look_at - camera.eye).normalize().as_vec3();
        assert!((d - toward).length() < 1e-6);
    }

    #[test]
    fn a_mirrored_camera_exchanges_left_and_right() {
        let camera = Camera::perspective(DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.5, -1.0), 50.0);
        let mirrored = Camera { mirrored: true, ..camera.clone() };
        let (plain, mirrored) = (CameraSensor::new(&camera, VIEW), CameraSensor::new(&mirrored, VIEW));
        for (x, y) in [(3.0, 5.0), (40.0, 47.0)] {
            assert_eq!(plain.ray(x, y), mirrored.ray(64.0 - x, y));
        }
    }

    /// A camera with a lens of radius 0.2 and a picture of 64 × 48 pixels, 0.4 × 0.3 at distance 1.
    fn with_lens(focus: f64, shift: [f64; 2]) -> CameraSensor {
        let fov = 2.0 * real::atan(0.15);
        let eye = DVec3::new(1.0, 2.0, 3.0);
        let pinhole = Camera::perspective(eye, eye - DVec3::Z, fov.to_degrees());
        let camera = Camera { lens: Some(Lens { radius: 0.2, focus }), shift, ..pinhole };
        CameraSensor::new(&camera, View { viewing: Viewing::Filter, ..VIEW })
    }

    #[test]
    fn rays_of_a_point_in_focus_meet_and_others_part_as_a_thin_lens_parts_them() {
        let focus = 2.5;
        let sensor = with_lens(focus, [0.0; 2]);
        for depth in [1.0, 2.5, 7.0] {
            let at = |on_lens: DVec2| {
                let (o, d) = sensor.ray_through(50.0, 11.0, on_lens);
                let (o, d) = (o.as_dvec3(), d.as_dvec3());
                o + d * ((depth + o.z - 3.0) / -d.z)
            };
            let ends = [DVec2::X, DVec2::Y].map(|axis| at(axis * 0.2).distance(at(axis * -0.2)));
            // Similar triangles on both sides of the plane in focus; f32 rays, 2⁻²³ of lengths up to 10.
            let blur = 0.4 * (depth - focus).abs() / focus;
            assert!(ends.iter().all(|end| (end - blur).abs() < 1e-5), "{depth} {ends:?} {blur}");
        }
    }

    #[test]
    fn a_lens_is_a_disk_and_without_one_no_number_is_drawn() {
        let sensor = with_lens(1.0, [0.0; 2]);
        let n = 32;
        let points = (0..n * n).map(|i| [(i % n) as f32 + 0.5, (i / n) as f32 + 0.5].map(|u| u / n as f32));
        let points: Vec<DVec2> = points.map(|u| sensor.on_lens(|| u)).collect();
        assert!(points.iter().all(|p| p.length() < 0.2));
        // ⟨r²⟩ = R²/2 of an even disk; a grid of 32 × 32 is within 1/32² of it.
        let square = points.iter().map(|p| p.length_squared()).sum::<f64>() / f64::from(n * n);
        assert!((square / 0.02 - 1.0).abs() < 2e-3, "{square}");
        let pinhole = CameraSensor { lens: None, ..sensor };
        assert_eq!(pinhole.on_lens(|| panic!("a pinhole needs no number")), DVec2::ZERO);
    }

    #[test]
    fn a_shift_moves_the_picture_and_keeps_its_perspective() {
        let (shifted, straight) = (with_lens(1.0, [0.25, -0.5]), with_lens(1.0, [0.0; 2]));
        assert_eq!(shifted.ray(10.0, 30.0), straight.ray(26.0, 6.0));
        // What stands straight ahead is a quarter left of the middle, a half below it.
        assert!((shifted.ray(16.0, 48.0).1 - Vec3::NEG_Z).length() < 1e-6);
    }
}
