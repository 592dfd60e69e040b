//! What writers share about lights: where they stand, and amounts as a colour and a factor.

use antumbra::light::{Disk, Light, Point, Rectangle, Sphere, Spot, Triangle};
use antumbra_math::{DVec3, Rgb, Vec3, solid_angle};

/// Moves a light that has a place.
pub(super) fn shift(light: &mut Light, by: DVec3) {
    let at = |p: Vec3| (p.as_dvec3() + by).as_vec3();
    match light {
        Light::Point(l) => *l = Point { position: at(l.position), ..*l },
        Light::Spot(l) => *l = Spot { position: at(l.position), ..*l },
        Light::Triangle(l) => {
            *l = Triangle::new(at(l.a), at(l.b), at(l.c), l.radiance).both_sides(l.both_sides)
        }
        Light::Rectangle(l) => {
            *l = Rectangle::new(at(l.corner), l.u, l.v, l.radiance).both_sides(l.both_sides);
        }
        Light::Disk(l) => {
            *l = Disk::new(at(l.center), l.normal, l.radius, l.radiance).both_sides(l.both_sides);
        }
        Light::Sphere(l) => *l = Sphere::new(at(l.center), l.radius, l.radiance),
        Light::Directional(_) | Light::Sun(_) | Light::Environment(_) => {}
    }
}

/// L_e of an area light, and whether its back shines too; `None` for the others.
pub(super) fn of_surface(light: &Light) -> Option<(Rgb, bool)> {
    match light {
        Light::Triangle(l) => Some((l.radiance, l.both_sides)),
        Light::Rectangle(l) => Some((l.radiance, l.both_sides)),
        Light::Disk(l) => Some((l.radiance, l.both_sides)),
        Light::Sphere(l) => Some((l.radiance, false)),
        _ => None,
    }
}

/// Irradiance of a surface that faces a sun: L_e π sin² α = L_e π v (2 − v), v = 1 − cos α.
pub(super) fn sun_irradiance(radiance: Rgb, half_angle: f32) -> Rgb {
    let versin = solid_angle::versin(f64::from(half_angle));
    radiance * (std::f64::consts::PI * versin * (2.0 - versin)) as f32
}

/// A colour with components up to 1 and a factor whose product is `amount` to the last bit: the factor is a power of 2.
pub(super) fn split(amount: Rgb) -> (Rgb, f32) {
    let mut factor = 1.0f32;
    while factor < amount.max() && factor < f32::MAX / 4.0 {
        factor *= 2.0;
    }
    (amount.map(|c| c / factor), factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_colour_times_its_factor_is_the_amount_to_the_bit() {
        for amount in [[0.3, 0.0, 1.0], [17.3, 0.123, 5.0], [1e12, 1e-3, 3.0], [0.0; 3]].map(Rgb) {
            let (color, factor) = split(amount);
            assert_eq!(color * factor, amount);
            assert!(color.max() <= 1.0 && factor >= 1.0);
        }
    }

    /// ∫ cos θ dω over the cone of α is π sin² α.
    #[test]
    fn a_hemisphere_of_light_gives_pi() {
        let half = std::f32::consts::FRAC_PI_2;
        assert!((sun_irradiance(Rgb::WHITE, half).0[0] - std::f32::consts::PI).abs() < 1e-6);
        // A small disc: L Ω to second order in α.
        assert!((sun_irradiance(Rgb::WHITE, 1e-3).0[0] / (std::f32::consts::PI * 1e-6) - 1.0).abs() < 1e-5);
    }
}
