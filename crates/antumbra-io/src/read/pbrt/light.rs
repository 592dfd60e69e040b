//! `LightSource` and `AreaLightSource`: point, spot, distant, infinite; the light of a surface.

use std::sync::Arc;

use antumbra::light::{Directional, Environment, Light, Point, Spot, SpotEdge};
use antumbra::texture::{Image, Texels};
use antumbra_math::{DVec3, Frame, Rgb, Transform, real};

use super::Reader;
use super::parameters::Parameters;
use super::spectrum::Of;
use super::text::At;
use crate::error::ReadError;
use crate::read::texels;

/// The light that a surface gives off.
#[derive(Clone, Debug)]
pub(super) struct Area {
    /// L_e, if no power is given.
    pub radiance: Rgb,
    /// Power of the whole surface, in place of what L_e would give.
    pub power: Option<f64>,
    /// From its back too.
    pub both_sides: bool,
    /// Where it is asked for.
    pub at: At,
}

impl Area {
    /// L_e of a surface of this area: Φ = sides · π · A · L_e.
    pub fn of(&self, area: f64) -> Rgb {
        let sides = if self.both_sides { 2.0 } else { 1.0 };
        let full = sides * area * std::f64::consts::PI;
        self.power.map_or(self.radiance, |power| self.radiance * (power / full) as f32)
    }
}

/// Makes the light of a plugin, in its own space → world.
type Make = fn(&mut Reader, &Parameters, &Transform) -> Result<Light, ReadError>;

/// Every light that is read. To add one: a function and a line here.
const LIGHTS: [(&str, Make); 4] =
    [("point", point), ("spot", spot), ("distant", distant), ("infinite", infinite)];

impl Reader<'_> {
    /// Adds a light.
    pub(super) fn light(&mut self, p: &Parameters, plugin: &str) -> Result<(), ReadError> {
        let Some((_, make)) = LIGHTS.iter().find(|l| l.0 == plugin) else {
            self.lacks(p, "left out");
            return Ok(());
        };
        let world = self.world();
        let light = make(self, p, &world)?;
        self.name_the_unread(p);
        self.scene.light("", light);
        Ok(())
    }

    /// What the surfaces that follow give off.
    pub(super) fn area_light(&mut self, p: &Parameters, plugin: &str) -> Result<(), ReadError> {
        if plugin != "diffuse" {
            self.lacks(p, "left out");
            return Ok(());
        }
        let mut radiance = self.amount(p, "L")?;
        if let Some(name) = p.text("filename")? {
            let what = format!("the picture \"{name}\" on {}: it counts by its mean", p.words);
            self.said.warn(p.at.words(), what);
            let decoded = self.open(name).and_then(|bytes| texels::picture(&bytes, true, self.context));
            radiance = decoded.map_err(|why| p.error(format!("the picture \"{name}\": {why}")))?.mean();
            radiance = radiance * p.float("scale", 1.0)? as f32;
        }
        let both_sides = p.boolean("twosided", false)?;
        let power = p.number("power")?.filter(|power| *power > 0.0);
        self.name_the_unread(p);
        self.state.area = Some(Area { radiance, power, both_sides, at: p.at.clone() });
        Ok(())
    }

    /// An amount of light with its scale: white by default, not negative.
    fn amount(&mut self, p: &Parameters, name: &str) -> Result<Rgb, ReadError> {
        let scale = p.float("scale", 1.0)? as f32;
        let amount = match p.get(name) {
            Some(given) => self.color_of(given, p, Of::Light)? * scale,
            None => Rgb::grey(scale),
        };
        if amount.0.iter().any(|c| *c < 0.0) {
            return Err(
                p.error(format!("\"{name}\" with its scale is {:?}: it must not be negative", amount.0))
            );
        }
        Ok(amount)
    }
}

/// Its power, or what the amount 1 makes of it.
fn powered(p: &Parameters, amount: Rgb, of_one: f32) -> Result<Rgb, ReadError> {
    let power = p.number("power")?.filter(|power| *power > 0.0);
    Ok(power.map_or(amount, |power| amount * (power as f32 / of_one)))
}

fn point(reader: &mut Reader, p: &Parameters, world: &Transform) -> Result<Light, ReadError> {
    let intensity = reader.amount(p, "I")?;
    let intensity = powered(p, intensity, 4.0 * real::PI)?;
    let position = world.point(p.point("from")?.unwrap_or(DVec3::ZERO)).as_vec3();
    Ok(Point { position, intensity }.into())
}

fn spot(reader: &mut Reader, p: &Parameters, world: &Transform) -> Result<Light, ReadError> {
    let cone = p.float("coneangle", 30.0)?;
    let edge = p.float("conedeltaangle", 5.0)?;
    if !(cone > 0.0 && cone <= 180.0 && (0.0..=cone).contains(&edge)) {
        let what =
            format!("a cone of {cone}° with an edge of {edge}°: 0 < coneangle ≤ 180, the edge within it");
        return Err(p.error(what));
    }
    let (inner, outer) = ((cone - edge).to_radians() as f32, cone.to_radians() as f32);
    let intensity = reader.amount(p, "I")?;
    let (full, none) = (real::cosf(inner), real::cosf(outer));
    let intensity = powered(p, intensity, 2.0 * real::PI * ((1.0 - full) + (full - none) / 2.0))?;
    let (from, to) = ends(p, DVec3::ZERO, DVec3::Z, world)?;
    let axis = (to - from).normalize().as_vec3();
    let spot = Spot::new(from.as_vec3(), axis, intensity, inner, outer, None);
    Ok(Spot { edge: SpotEdge::Hermite, ..spot }.into())
}

/// `from` and `to` in the world, which must not be one point.
fn ends(p: &Parameters, from: DVec3, to: DVec3, world: &Transform) -> Result<(DVec3, DVec3), ReadError> {
    let (from, to) = (p.point("from")?.unwrap_or(from), p.point("to")?.unwrap_or(to));
    let (from, to) = (world.point(from), world.point(to));
    if (to - from).try_normalize().is_none() {
        return Err(p.error("\"from\" and \"to\" are the same point"));
    }
    Ok((from, to))
}

fn distant(reader: &mut Reader, p: &Parameters, world: &Transform) -> Result<Light, ReadError> {
    let radiance = reader.amount(p, "L")?;
    let illuminance = p.number("illuminance")?.filter(|e| *e > 0.0);
    let irradiance = illuminance.map_or(radiance, |e| radiance * e as f32);
    let (from, to) = ends(p, DVec3::ZERO, DVec3::Z, world)?;
    Ok(Directional::new((from - to).normalize().as_vec3(), irradiance).into())
}

fn infinite(reader: &mut Reader, p: &Parameters, world: &Transform) -> Result<Light, ReadError> {
    let radiance = reader.amount(p, "L")?;
    if p.get("portal").is_some() {
        reader.said.note(p.at.words(), "\"portal\" is not needed: the sky is drawn without it");
    }
    let illuminance = p.number("illuminance")?.filter(|e| *e > 0.0);
    let Some(name) = p.text("filename")? else {
        // E = π L.
        let radiance = illuminance.map_or(radiance, |e| radiance * (e as f32 / real::PI));
        return Ok(Environment::constant(radiance).into());
    };
    if p.has("L") {
        return Err(p.error("\"L\" and \"filename\" exclude each other"));
    }
    let fail = |why: String| p.error(format!("the picture \"{name}\": {why}"));
    let image = reader.open(name).and_then(|b| texels::picture(&b, true, reader.context)).map_err(fail)?;
    let axis = |v: DVec3| world.vector(v).try_normalize().map(|v| v.as_vec3());
    let (Some(x), Some(y), Some(z)) = (axis(DVec3::X), axis(DVec3::Y), axis(DVec3::Z)) else {
        return Err(p.error("the transform is singular"));
    };
    if x.dot(y).abs().max(y.dot(z).abs()).max(z.dot(x).abs()) > 1e-3 {
        return Err(p.error("the transform is not a rotation"));
    }
    // The map's y is pbrt's z, its pole.
    let sky = if image.width == image.height {
        let bytes = reader.context.textures.take(u64::from(image.width) * u64::from(image.width), 12 * 32);
        bytes.map_err(|_| fail("the pictures of the scene are too large together".into()))?;
        let turned = lat_long(&image).ok_or_else(|| fail("it has no pixels".into()))?;
        Environment::image(Arc::new(turned)).nearest(true).oriented(Frame { s: x, t: z, n: y })
    } else if image.width == 2 * image.height {
        reader.said.note(
            p.at.words(),
            format!("\"{name}\" is twice as wide as high: read by latitude and longitude"),
        );
        Environment::image(Arc::new(image)).oriented(Frame { s: y, t: z, n: -x })
    } else {
        let what = format!(
            "it has {} × {} pixels: a square in the equal-area layout is needed",
            image.width, image.height
        );
        return Err(
            fail(what).hint("`imgtool makeequiarea` of pbrt makes one of a latitude-longitude picture.")
        );
    };
    let sky = sky.scaled(Rgb::grey(p.float("scale", 1.0)? as f32));
    let Some(e) = illuminance else { return Ok(sky.into()) };
    let above = upper(&sky, z);
    if above <= 0.0 {
        return Err(p.error("\"illuminance\" of a picture that is black above its horizon"));
    }
    Ok(sky.scaled(Rgb::grey((e / above) as f32)).into())
}

/// Rows of a picture by latitude for each of an equal-area square, and what is looked up along each side of its texels.
const ROWS: u32 = 4;
const LOOKED: u32 = 3;
/// Rows at most.
const MOST: u32 = 2048;

/// The square's light by latitude and longitude about its +z: our (x, y, z) is its (x, z, y).
fn lat_long(square: &Image) -> Option<Image> {
    let height = (ROWS * square.height).min(MOST).max(square.height);
    let width = 2 * height;
    let part = |i: u32, n: u32, whole: f64| whole * (f64::from(i) + 0.5) / f64::from(n * LOOKED);
    let rows: Vec<_> =
        (0..height * LOOKED).map(|i| Latitude::at(part(i, height, std::f64::consts::PI))).collect();
    let columns: Vec<_> =
        (0..width * LOOKED).map(|i| Longitude::at(part(i, width, std::f64::consts::TAU))).collect();
    let texel = |x: f64, n: u32| ((x * f64::from(n)) as u32).min(n - 1);
    let mut texels = Vec::with_capacity(width as usize * height as usize);
    for rows in rows.chunks_exact(LOOKED as usize) {
        for columns in columns.chunks_exact(LOOKED as usize) {
            let mut sum = [0.0; 3];
            for (row, column) in rows.iter().flat_map(|row| columns.iter().map(move |c| (row, c))) {
                let [u, v] = to_square(row, column);
                let found = square.texel(texel(u, square.width), texel(v, square.height));
                (0..3).for_each(|c| sum[c] += found[c]);
            }
            texels.push(sum.map(|s| s / (LOOKED * LOOKED) as f32));
        }
    }
    Image::new(width, height, Texels::Float(texels))
}

/// How far from the pole: √(1 − |cos θ|), and whether below the horizon.
struct Latitude(f64, bool);

impl Latitude {
    fn at(theta: f64) -> Latitude {
        let cos = real::cos(theta);
        Latitude((1.0 - cos.abs()).max(0.0).sqrt(), cos < 0.0)
    }
}

/// Where in its quarter turn, from 0 at its x to 1 at its y, and the signs of both.
struct Longitude(f64, [f64; 2]);

impl Longitude {
    /// Of the direction (sin φ, −cos φ).
    fn at(phi: f64) -> Longitude {
        let (x, y) = (real::sin(phi), -real::cos(phi));
        Longitude(real::atan2(y.abs(), x.abs()) * 2.0 / std::f64::consts::PI, [x, y])
    }
}

/// The equal-area octahedral map of the sphere onto the unit square (Clarberg 2008, "Fast Equal-Area Mapping of the
/// (Hemi)Sphere using SIMD").
fn to_square(Latitude(r, below): &Latitude, Longitude(part, signs): &Longitude) -> [f64; 2] {
    let (mut u, mut v) = (r - part * r, part * r);
    if *below {
        (u, v) = (1.0 - v, 1.0 - u);
    }
    [0.5 * (u.copysign(signs[0]) + 1.0), 0.5 * (v.copysign(signs[1]) + 1.0)]
}

/// ∫ L cos θ over the hemisphere about `up`, by midpoints.
fn upper(sky: &Environment, up: antumbra_math::World) -> f64 {
    const STEPS: u32 = 256;
    let frame = Frame::about(up);
    let mut sum = 0.0;
    for i in 0..STEPS {
        // Even steps of sin² θ: each cell is worth π / STEPS / columns.
        let sin2 = (f64::from(i) + 0.5) / f64::from(STEPS);
        for j in 0..2 * STEPS {
            let phi = std::f64::consts::PI * (f64::from(j) + 0.5) / f64::from(STEPS);
            let (sin, cos) = (sin2.sqrt(), (1.0 - sin2).sqrt());
            let local = DVec3::new(sin * real::cos(phi), sin * real::sin(phi), cos).as_vec3();
            sum += f64::from(sky.radiance_from(frame.to_world(antumbra_math::Local(local))).luminance());
        }
    }
    sum * std::f64::consts::PI / f64::from(2 * STEPS * STEPS)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Clarberg's map back onto the sphere, written down from the same paper.
    fn to_sphere([x, y]: [f64; 2]) -> DVec3 {
        let (u, v) = (2.0 * x - 1.0, 2.0 * y - 1.0);
        let signed = 1.0 - (u.abs() + v.abs());
        let r = 1.0 - signed.abs();
        let phi = if r == 0.0 { 1.0 } else { (v.abs() - u.abs()) / r + 1.0 } * std::f64::consts::PI / 4.0;
        let around = r * (2.0 - r * r).sqrt();
        DVec3::new(
            around * real::cos(phi).copysign(u),
            around * real::sin(phi).copysign(v),
            (1.0 - r * r).copysign(signed),
        )
    }

    #[test]
    fn the_square_and_the_sphere_go_both_ways() {
        for i in 0..400 {
            let place = [f64::from(i % 20), f64::from(i / 20)].map(|x| (x + 0.37) / 20.0);
            let d = to_sphere(place);
            let (theta, phi) = (real::acos(d.z), real::atan2(d.x, -d.y));
            let back = to_square(&Latitude::at(theta), &Longitude::at(phi));
            assert!((0..2).all(|c| (back[c] - place[c]).abs() < 1e-12), "{place:?} {back:?}");
        }
    }

    /// A square that is 1 above its horizon, 0 below: half of the sphere, by latitude too.
    #[test]
    fn by_latitude_the_light_stays_where_it_was() {
        let n = 64;
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(n);
        let lit = |i: u32| to_sphere([middle(i % n), middle(i / n)]);
        let texels = (0..n * n).map(|i| [if lit(i).z > 0.0 { 1.0 } else { 0.0 }; 3]).collect();
        let square = Image::new(n, n, Texels::Float(texels)).unwrap();
        let sky = Environment::image(Arc::new(lat_long(&square).unwrap())).nearest(true);
        let sky = sky.oriented(Frame {
            s: antumbra_math::World::X,
            t: antumbra_math::World::Z,
            n: antumbra_math::World::Y,
        });
        // E = π from above, 0 from below; texels across the horizon are off by a row of 256.
        let (above, below) = (upper(&sky, antumbra_math::World::Z), upper(&sky, antumbra_math::World::NEG_Z));
        assert!((above - std::f64::consts::PI).abs() < 0.02 && below < 0.02, "{above} {below}");
    }
}
