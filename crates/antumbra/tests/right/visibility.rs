//! No false shadow and no leak, through the whole way from a hit to the light: at every scale and far from the origin.

use antumbra::estimator::EstimatorKind;
use antumbra::light::Environment;
use antumbra::math::hash::{hash3, unit_f32};
use antumbra::math::{DVec3, Frame, Rgb, Vec3, real};
use antumbra::query::{self, RayHit};
use antumbra::receiver::Receiver;
use antumbra::scene::{Camera, Material, Scene, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::sensor::Query;
use antumbra::settings::Settings;
use antumbra::trace::{Bits, NO_PRIM, SegmentBuffer, Shape, Triangles, Visibility};

use super::closed::settings;
use super::furnace::cube_inside;
use super::judge::size;
use super::pictures::{look, small};
use super::rooms::ball;

/// Scales, and offsets as multiples of the scale.
const SCALES: [f64; 5] = [1e-6, 1e-3, 1.0, 1e3, 1e6];
const OFFSETS: [f64; 4] = [0.0, 1.0, 37.0, 1000.0];

/// Where a thing of size 1 is put: turned, scaled, moved.
#[derive(Clone, Copy, Debug)]
struct Put {
    scale: f64,
    offset: f64,
    turned: bool,
}

impl Put {
    fn all() -> impl Iterator<Item = Put> {
        let of = |scale| OFFSETS.into_iter().map(move |offset| (scale, offset));
        let both = SCALES.into_iter().flat_map(of);
        both.flat_map(|(scale, offset)| [false, true].map(|turned| Put { scale, offset, turned }))
    }

    fn point(self, p: DVec3) -> DVec3 {
        let n = DVec3::new(0.6, 0.0, 0.8);
        // Mirrored about a plane and swapped: any turn will do.
        let p = if self.turned { p - n * (2.0 * n.dot(p)) } else { p };
        let p = if self.turned { DVec3::new(p.y, p.x, p.z) } else { p };
        (p + DVec3::new(1.0, -0.7, 0.3) * self.offset) * self.scale
    }

    fn mesh(self, triangles: Triangles) -> Triangles {
        let put = |v: [f32; 3]| self.point(DVec3::from(v.map(f64::from))).as_vec3().to_array();
        Triangles { vertices: triangles.vertices.into_iter().map(put).collect(), ..triangles }
    }
}

/// Convex things about the origin, each inside the unit ball.
fn convex(put: Put) -> Vec<(&'static str, SceneBuilder)> {
    let scene = |name, add: &dyn Fn(&mut SceneBuilder, u32)| {
        let mut builder = SceneBuilder::new(name);
        let grey = builder.material(Material::diffuse(Rgb::WHITE));
        add(&mut builder, grey);
        (name, builder)
    };
    let at = |x, y, z| put.point(DVec3::new(x, y, z)).as_vec3().to_array();
    let radius = (0.8 * put.scale) as f32;
    let center = at(0.0, 0.0, 0.0);
    let quad = super::scenes::parallelogram(Vec3::new(-0.5, 0.0, -0.5), Vec3::Z, Vec3::X);
    vec![
        scene("square", &|b, m| b.object("", put.mesh(quad.clone()), m)),
        scene("ball of triangles", &|b, m| b.object("", put.mesh(ball(Vec3::ZERO, 0.9).0), m)),
        scene("sphere", &|b, m| b.shape("", Shape::Sphere { center, radius }, m)),
        scene("disk", &|b, m| {
            let normal = Vec3::new(0.3, 0.9, -0.2).to_array();
            b.shape("", Shape::Disk { center, normal, radius }, m);
        }),
    ]
}

/// Receivers where rays from around meet the thing from outside.
fn receivers(scene: &Scene, put: Put, n: u32, seed: u32) -> Vec<Receiver> {
    let unit = |i: u32, k: u32| f64::from(unit_f32(hash3(i, k, seed)));
    let on_ball = |i: u32, k: u32| {
        let (z, phi) = (2.0 * unit(i, k) - 1.0, 2.0 * std::f64::consts::PI * unit(i, k + 1));
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * real::cos(phi), z, r * real::sin(phi))
    };
    let fill = |range: std::ops::Range<usize>, out: &mut SegmentBuffer| {
        for i in range {
            let (from, to) = (on_ball(i as u32, 1) * 3.0, on_ball(i as u32, 3) * 0.7);
            let (from, to) = (put.point(from).as_vec3(), put.point(to).as_vec3());
            out.push_ray(from.to_array(), (to - from).to_array(), f32::INFINITY, NO_PRIM, 0);
        }
    };
    let mut hits = vec![RayHit::MISS; n as usize];
    query::closest_hit(scene, &fill, 1, &mut hits, &mut |_| Flow::Continue);
    hits.iter().filter_map(|h| h.met(scene)).map(|met| met.receiver).collect()
}

/// Directions above the horizon of a receiver, down to grazing.
fn above(at: &Receiver, i: u32) -> Vec3 {
    let u = |k: u32| unit_f32(hash3(i, k, 17));
    let phi = 2.0 * real::PI * u(0);
    let height = real::powf(10.0, -9.0 * u(1));
    let frame = Frame::about(at.ng);
    (frame.s * real::cosf(phi) + frame.t * real::sinf(phi) + frame.n * height).normalize()
}

#[test]
fn convex_things_do_not_shade_themselves() {
    let (points, rays) = (size(40, 400), size(24, 200));
    let mut asked = 0u64;
    for put in Put::all() {
        for (name, builder) in convex(put) {
            let scene = builder.build().unwrap();
            let met = receivers(&scene, put, points, 5);
            assert!(met.len() as u32 > points / 8, "{name} {put:?}: {} receivers", met.len());
            openness_is(&scene, &met, 1.0, name, put);
            // Rounding bends a turned square: its halves may meet directions below 2⁻²² of the horizon (LAW §5).
            if name == "square" && put.turned {
                continue;
            }
            let mut segments = SegmentBuffer::default();
            for at in &met {
                for i in 0..rays {
                    let wi = above(at, i);
                    if at.sees_side(wi) {
                        segments.push_ray(at.start, wi.to_array(), f32::INFINITY, at.prim, 0);
                    }
                }
            }
            let mut blocked = Bits::default();
            scene.visibility(false).occluded(segments.as_segments(), &mut blocked);
            assert_eq!(blocked.count(), 0, "{name} {put:?}: of {}", segments.len());
            asked += segments.len() as u64;
        }
    }
    println!("{asked} segments leave convex things, none is blocked");
}

/// Ambient occlusion at receivers, to the last bit.
fn openness_is(scene: &Scene, met: &[Receiver], value: f32, name: &str, put: Put) {
    let query = |at: &Receiver| Query {
        p: at.p.as_dvec3().to_array(),
        n: at.ng.as_dvec3().to_array(),
        start: Some((at.start, at.prim)),
    };
    let queries: Vec<Query> = met.iter().map(query).collect();
    let s = settings(EstimatorKind::AmbientOcclusion, 16);
    let found = query::ambient_occlusion(scene, &queries, &s, &mut |_| Flow::Continue);
    let wrong = found.values.iter().filter(|v| v[0] != value).count();
    assert_eq!(wrong, 0, "{name} {put:?}: openness is not {value} at {wrong} of {}", queries.len());
}

/// A closed room: nothing comes in, from its walls or from a camera inside, by any estimator. Long paths are followed
/// only where the band at the creases is narrower than 10⁻⁶ of the room.
#[test]
fn closed_rooms_are_dark() {
    for put in Put::all() {
        let centered = |t: Triangles| {
            let move_by = |v: [f32; 3]| (Vec3::from(v) - 0.5).to_array();
            Triangles { vertices: t.vertices.into_iter().map(move_by).collect(), ..t }
        };
        for (name, triangles) in
            [("box", centered(cube_inside())), ("ball of triangles", ball(Vec3::ZERO, 0.9).0)]
        {
            let mut builder = SceneBuilder::new(name);
            let white = builder.material(Material::diffuse(Rgb::WHITE));
            builder.object(name, put.mesh(triangles), white);
            builder.light("sky", Environment::constant(Rgb::WHITE));
            let eye = put.point(DVec3::new(0.1, -0.05, 0.08));
            builder.cameras.push(Camera::perspective(eye, put.point(DVec3::new(0.4, 0.3, 0.1)), 120.0));
            let scene = builder.build().unwrap();
            let met = inside(&scene, put, size(40, 400));
            openness_is(&scene, &met, 0.0, name, put);
            if put.offset > 1.0 {
                continue;
            }
            for estimator in [EstimatorKind::Area, EstimatorKind::Path] {
                let base = Settings { viewing_rays: 4, bounces: 4, size: Some([16, 12]), ..small(estimator) };
                let picture = look(&scene, &base);
                let lit = picture.pixels.iter().filter(|p| **p != [0.0; 3]).count();
                assert_eq!(lit, 0, "{name} {put:?} {estimator:?}: light leaks into {lit} pixels");
            }
        }
    }
}

/// Receivers where rays from the middle meet the walls, and lie off the creases between them by more than the rounding
/// of their start: 2·2⁻²⁴ M / sin φ (LAW §5), with the least altitude of the triangles here a twentieth of their size.
fn inside(scene: &Scene, put: Put, n: u32) -> Vec<Receiver> {
    let fill = |range: std::ops::Range<usize>, out: &mut SegmentBuffer| {
        for i in range {
            let u = |k: u32| f64::from(unit_f32(hash3(i as u32, k, 23))) - 0.5;
            let middle = put.point(DVec3::ZERO).as_vec3().to_array();
            let d = DVec3::new(u(0), u(1), u(2)).as_vec3().to_array();
            out.push_ray(middle, d, f32::INFINITY, NO_PRIM, 0);
        }
    };
    let mut hits = vec![RayHit::MISS; n as usize];
    query::closest_hit(scene, &fill, 1, &mut hits, &mut |_| Flow::Continue);
    assert!(hits.iter().all(|h| h.prim != NO_PRIM), "{put:?}: a ray left the room");
    let band = 20.0 * 4.0 * f32::EPSILON * (put.offset as f32 + 1.0);
    let off_crease = |h: &&RayHit| h.uv[0].min(h.uv[1]).min(1.0 - h.uv[0] - h.uv[1]) > band;
    hits.iter().filter(off_crease).filter_map(|h| h.met(scene)).map(|met| met.receiver).collect()
}
