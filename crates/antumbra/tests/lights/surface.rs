//! Area lights as surfaces: their outline, the primitives that they are, and ends that lie in front of them.

use antumbra::light::{End, Light, LightPoints, LightSurface, OutlinePoint};
use antumbra::math::World;
use antumbra::receiver::Receiver;
use antumbra::trace::{NO_PRIM, Shape};

use crate::{HOWS, draws, receivers};

/// A hair inside of the outline the light is hit, a hair outside it is missed.
#[test]
fn the_outline_is_the_rim() {
    for (kind, light) in Light::examples() {
        for (r, at) in receivers().into_iter().enumerate() {
            let seen: Vec<World> =
                draws(&light, &at, LightPoints::SolidAngle, 500, 3).flatten().map(|s| s.wi).collect();
            let middle = seen.iter().sum::<World>().normalize_or_zero();
            for i in 0..64 {
                let u = (i as f32 + 0.5) / 64.0;
                let Some(rim) = light.outline(&at, u).filter(|_| !seen.is_empty()) else { continue };
                // A thousandth of the way to the middle: far above the 10⁻⁷ of a rounded direction.
                let inward = (middle - rim.wi) * 1e-3;
                let hits = |d: World| light.hit(at.p, d.normalize()).is_some();
                let told = format!("{kind} from receiver {r}: {rim:?}");
                assert!(hits(rim.wi + inward) && !hits(rim.wi - inward), "{told}");
                ends_there(&at, &rim, &told);
            }
        }
    }
}

fn ends_there(at: &Receiver, rim: &OutlinePoint, told: &str) {
    if let End::Point(q) = rim.end {
        assert!(((q - at.p).normalize() - rim.wi).length() < 1e-5, "{told}");
    }
}

/// A surface light tells which primitive a sample lies on, numbered from the first; its points lie in front of it.
#[test]
fn samples_know_their_primitive() {
    for (kind, light) in Light::examples() {
        let mut light = light;
        let unplaced = light.sample(&receivers()[0], [0.2, 0.7], LightPoints::SolidAngle);
        assert!(unplaced.is_none_or(|s| s.prim == NO_PRIM), "{kind}");
        light.set_first_prim(40);
        let surface = light.surface();
        for at in receivers() {
            for s in draws(&light, &at, LightPoints::SolidAngle, 200, 5).flatten() {
                match (&surface, s.end) {
                    (None, _) => assert_eq!(s.prim, NO_PRIM, "{kind}"),
                    (Some(LightSurface::Triangles(all)), End::Point(q)) => {
                        let corners = all[s.prim as usize - 40].map(World::from_array);
                        lies_on(kind, &at, corners, q);
                    }
                    (Some(LightSurface::Shape(_)), _) => assert_eq!(s.prim, 40, "{kind}"),
                    (Some(_), End::Infinity) => panic!("{kind}: a surface at infinity"),
                }
            }
        }
    }
}

/// q lies over the triangle, on the side of the receiver, at most 2⁻²⁰ of the largest coordinate away.
fn lies_on(kind: &str, at: &Receiver, [a, b, c]: [World; 3], q: World) {
    let [a, b, c, q, p] = [a, b, c, q, at.p].map(|x| x.as_dvec3());
    let n = (b - a).cross(c - a).normalize();
    let extent = [a, b, c].iter().fold(0.0f64, |m, x| m.max(x.abs().max_element()));
    let height = (q - a).dot(n) * (p - a).dot(n).signum();
    assert!(height > 0.0 && height < 1e-6 * extent, "{kind}: {height} over {extent}");
    for (x, y) in [(a, b), (b, c), (c, a)] {
        let inside = (y - x).cross(q - x).dot(n) / (y - x).length();
        // Corners of a rectangle are rounded once more.
        assert!(inside > -1e-6 * extent, "{kind}: {q} is {inside} beyond an edge");
    }
}

/// A flat light never lights a point of itself, though rounding puts that point in front of its plane or behind it.
#[test]
fn no_flat_light_shines_on_itself() {
    let flat = |l: &Light| matches!(l, Light::Triangle(_) | Light::Rectangle(_) | Light::Disk(_));
    let mut points = 0;
    for (kind, light) in Light::examples().into_iter().filter(|(_, l)| flat(l)) {
        let mut light = light;
        light.set_first_prim(40);
        for outside in receivers() {
            for s in draws(&light, &outside, LightPoints::Area, 50, 9).flatten() {
                let itself = Receiver { p: outside.p + s.wi * s.distance, prim: s.prim, ..outside };
                points += 1;
                for how in HOWS {
                    let none = draws(&light, &itself, how, 20, 10).flatten().next().is_none();
                    assert!(none, "{kind} at {}", itself.p);
                }
            }
        }
    }
    assert!(points > 500, "{points} points of flat lights were looked at");
}

/// The front that a surface shows is the front that shines.
#[test]
fn fronts_shine() {
    for (kind, light) in Light::examples() {
        let Some(surface) = light.surface() else { continue };
        let (q, n) = match surface {
            LightSurface::Triangles(all) => {
                let [a, b, c] = all[0].map(World::from_array);
                ((a + b + c) / 3.0, (b - a).cross(c - a).normalize())
            }
            LightSurface::Shape(Shape::Disk { center, normal, .. }) => {
                (World::from_array(center), World::from_array(normal).normalize())
            }
            LightSurface::Shape(Shape::Sphere { center, radius }) => {
                (World::from_array(center) + World::Z * radius, World::Z)
            }
            LightSurface::Shape(other) => panic!("{kind}: {other:?}"),
        };
        let hit = light.hit(q + 0.1 * n, -n).unwrap();
        assert_eq!(hit.radiance, light.emitted(-n, true), "{kind}");
        assert!((hit.distance - 0.1).abs() < 1e-5, "{kind}: {hit:?}");
        let behind = light.hit(q - 0.001 * n, n);
        assert_eq!(behind.map_or(0.0, |h| h.radiance.max()), light.emitted(n, false).max(), "{kind}");
    }
}
