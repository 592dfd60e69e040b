//! No length is built in: a light and its receiver scaled by 2ᵏ give the same bits.

use antumbra::light::{Disk, End, Light, LightSample, Rectangle, Sphere, Triangle};
use antumbra::math::World;
use antumbra::receiver::Receiver;

use crate::{HOWS, draws, receivers};

/// The light at `s` times its size; `None` for kinds without a size.
fn scaled(light: &Light, s: f32) -> Option<Light> {
    Some(match light.clone() {
        Light::Triangle(t) => {
            Triangle::new(t.a * s, t.b * s, t.c * s, t.radiance).both_sides(t.both_sides).into()
        }
        Light::Rectangle(r) => {
            Rectangle::new(r.corner * s, r.u * s, r.v * s, r.radiance).both_sides(r.both_sides).into()
        }
        Light::Disk(d) => {
            Disk::new(d.center * s, d.normal, d.radius * s, d.radiance).both_sides(d.both_sides).into()
        }
        Light::Sphere(b) => Sphere::new(b.center * s, b.radius * s, b.radiance).into(),
        _ => return None,
    })
}

fn said(s: &LightSample, scale: f32) -> (World, f32, f32, Option<World>) {
    let end = match s.end {
        End::Point(q) => Some(q / scale),
        End::Infinity => None,
    };
    (s.wi, s.density.weight(), s.distance / scale, end)
}

/// From 10⁻⁶ to 10⁶.
#[test]
fn scaling_by_powers_of_two_changes_no_bit() {
    for (kind, light) in Light::examples() {
        for k in [-20, -3, 20] {
            let s = 2f32.powi(k);
            let Some(other) = scaled(&light, s) else { continue };
            for at in receivers() {
                let moved = Receiver { p: at.p * s, ..at };
                for how in HOWS {
                    let (small, large) =
                        (draws(&light, &at, how, 200, 6), draws(&other, &moved, how, 200, 6));
                    for (a, b) in small.zip(large) {
                        assert_eq!(a.map(|a| said(&a, 1.0)), b.map(|b| said(&b, s)), "{kind} × 2^{k}");
                        let Some(a) = a else { continue };
                        assert_eq!(light.pdf(&at, a.wi, how), other.pdf(&moved, a.wi, how), "{kind} × 2^{k}");
                    }
                }
                assert_eq!(light.irradiance(&at), other.irradiance(&moved), "{kind} × 2^{k}");
            }
        }
    }
}
