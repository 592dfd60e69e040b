//! What is drawn: χ² of samples against the density, ∫ of the density, E[1/pdf], agreement with `hit`, bounds.

use antumbra::density::Density;
use antumbra::light::{End, Light, LightPoints, LightSample, LightSurface};
use antumbra::math::stats::{SphereBins, chi_square_test, sidak};
use antumbra::math::{Frame, Local, World, real};
use antumbra::receiver::Receiver;
use antumbra::trace::Shape;

use crate::{HOWS, draws, numbers, receivers};

const N: u32 = 12_000;

/// The ways of drawing that differ for a light: those of the lecture are for flat ones.
fn ways(light: &Light) -> impl Iterator<Item = LightPoints> + use<> {
    let flat = match light.surface() {
        Some(LightSurface::Triangles(_)) => true,
        Some(LightSurface::Shape(shape)) => matches!(shape, Shape::Disk { .. }),
        None => false,
    };
    let lecture = [LightPoints::Skewed, LightPoints::Nearest, LightPoints::Hole];
    HOWS.into_iter().chain(lecture.into_iter().filter(move |_| flat))
}

/// Every example that fills a solid angle × every receiver × every way of drawing, with its number.
fn cases() -> impl Iterator<Item = (String, Light, Receiver, LightPoints, u32)> {
    let lights = Light::examples().into_iter().enumerate().filter(|(_, (_, light))| !light.is_delta());
    lights.flat_map(|(k, (kind, light))| {
        receivers().into_iter().enumerate().flat_map(move |(r, at)| {
            let light = light.clone();
            ways(&light).map(move |how| {
                let name = format!("{kind} #{k} from receiver {r}, {how:?}");
                (name, light.clone(), at, how, (100 * k + r) as u32)
            })
        })
    })
}

/// The cap about the middle of the draws that holds them all.
fn cap(drawn: &[LightSample]) -> (World, f64) {
    let axis = drawn.iter().map(|s| s.wi).sum::<World>().normalize_or(World::Y);
    let angle = |s: &LightSample| 2.0 * real::asin(0.5 * f64::from((s.wi - axis).length()).min(2.0));
    let widest = drawn.iter().map(angle).fold(0.0, f64::max);
    (axis, (1.1 * widest).min(std::f64::consts::PI))
}

/// What a grid over a cap found.
struct Grid {
    /// ∫ pdf over each bin.
    share: Vec<f64>,
    /// ∫ [pdf > 0].
    support: f64,
    /// How many of its directions found a density.
    found: u32,
}

impl Grid {
    fn add(&mut self, bin: usize, p: f64, cell: f64) {
        self.share[bin] += p * cell;
        self.support += if p > 0.0 { cell } else { 0.0 };
        self.found += u32::from(p > 0.0);
    }
}

/// One random direction in each cell of a grid over the cap; of a grid over the light's area where that finds too little
/// of it (slivers).
fn integrate(
    bins: &SphereBins,
    axis: World,
    half_angle: f64,
    light: &Light,
    at: &Receiver,
    how: LightPoints,
) -> Grid {
    let pdf = |d: World| f64::from(light.pdf(at, d, how));
    // Drawn by area, the density grows without bound toward a round light's limb: more cells find it there.
    let cells = if how == LightPoints::Area { (400, 520) } else { (200, 260) };
    let grid = over_cap(bins, axis, half_angle, cells, pdf);
    if grid.found >= 10_000 || light.is_infinite() { grid } else { over_area(bins, light, at, pdf) }
}

fn over_area(bins: &SphereBins, light: &Light, at: &Receiver, pdf: impl Fn(World) -> f64) -> Grid {
    const SIDE: u32 = 400;
    let mut grid = Grid { share: vec![0.0; bins.len()], support: 0.0, found: 0 };
    for i in 0..SIDE * SIDE {
        let jitter = numbers(i, 4712);
        let u =
            [((i % SIDE) as f32 + jitter[0]) / SIDE as f32, ((i / SIDE) as f32 + jitter[1]) / SIDE as f32];
        let Some(s) = light.sample(at, u, LightPoints::Area) else { continue };
        let cell = 1.0 / (f64::from(s.density.weight()) * f64::from(SIDE * SIDE));
        grid.add(bins.index(s.wi), pdf(s.wi), cell);
    }
    grid
}

fn over_cap(
    bins: &SphereBins,
    axis: World,
    half_angle: f64,
    (rings, sectors): (u32, u32),
    pdf: impl Fn(World) -> f64,
) -> Grid {
    let frame = Frame::about(axis);
    let versin = 2.0 * real::sin(0.5 * half_angle) * real::sin(0.5 * half_angle);
    let cell = std::f64::consts::TAU * versin / f64::from(rings * sectors);
    let mut grid = Grid { share: vec![0.0; bins.len()], support: 0.0, found: 0 };
    for i in 0..rings * sectors {
        let jitter = numbers(i, 4711);
        let t = versin * (f64::from(i / sectors) + f64::from(jitter[0])) / f64::from(rings);
        let phi =
            std::f64::consts::TAU * (f64::from(i % sectors) + f64::from(jitter[1])) / f64::from(sectors);
        let sin = (t * (2.0 - t)).sqrt();
        let l = Local::new((sin * real::cos(phi)) as f32, (sin * real::sin(phi)) as f32, (1.0 - t) as f32);
        let d = frame.to_world(l).normalize();
        grid.add(bins.index(d), pdf(d), cell);
    }
    grid
}

/// α = 10⁻³ over all cases. The grid knows each bin to a fraction of the deviation of its count. Densities integrate to
/// the share of draws that give light.
#[test]
fn samples_follow_their_density() {
    let each = sidak(1e-3, cases().count());
    for (name, light, at, how, seed) in cases() {
        let drawn: Vec<_> = draws(&light, &at, how, N, seed).collect();
        let lit: Vec<LightSample> = drawn.iter().flatten().copied().collect();
        if lit.is_empty() {
            let dark = |i| light.pdf(&at, antumbra::math::warp::sphere(numbers(i, 9)).0, how) == 0.0;
            assert!((0..1000).all(dark), "{name}: a density without samples");
            continue;
        }
        let (axis, half_angle) = cap(&lit);
        let bins = SphereBins::cap(axis, half_angle, 8, 12);
        let mut share = integrate(&bins, axis, half_angle, &light, &at, how).share;
        let sum: f64 = share.iter().sum();
        let share_lit = lit.len() as f64 / f64::from(N);
        // Five standard errors of the draws, and what a jump costs the grid: a percent.
        let se = (share_lit * (1.0 - share_lit) / f64::from(N)).sqrt();
        assert!((sum - share_lit).abs() < 5.0 * se + 0.01, "{name}: ∫pdf = {sum}, {share_lit} drawn");
        share.iter_mut().for_each(|s| *s *= share_lit / sum);
        share[bins.rest()] += 1.0 - share_lit;
        let observed = bins.count(N, |i| drawn[i as usize].map(|s| s.wi));
        let expected: Vec<f64> = share.iter().map(|s| s * f64::from(N)).collect();
        let found = chi_square_test(&observed, &expected);
        assert!(found.p > each, "{name}: {found:?}");
    }
}

/// Each sample says the density that `pdf` says, what `hit` says, and lies in the bounds.
#[test]
fn samples_agree_with_pdf_hit_and_bounds() {
    for (name, light, at, how, seed) in cases() {
        let (mut lit, mut missed) = (0, 0);
        for s in draws(&light, &at, how, 2000, seed).flatten() {
            lit += 1;
            let Density::SolidAngle(density) = s.density else { panic!("{name}: {s:?}") };
            assert!(
                (s.wi.length() - 1.0).abs() < 1e-6 && density > 0.0 && density.is_finite(),
                "{name}: {s:?}"
            );
            in_bounds(&name, &light, &s);
            let (Some(hit), pdf) = (light.hit(at.p, s.wi), light.pdf(&at, s.wi, how)) else {
                missed += 1;
                continue;
            };
            if pdf == 0.0 {
                missed += 1;
                continue;
            }
            // ω is rounded to f32: 6·10⁻⁸ of a direction, more of a distance or a density at grazing angles.
            let same = |a: f32, b: f32| a == b || (a - b).abs() <= 2e-3 * a.max(b);
            assert!(same(hit.distance, s.distance), "{name}: {hit:?} {s:?}");
            let off =
                (0..3).any(|c| (hit.radiance.0[c] - s.radiance.0[c]).abs() > 1e-2 * (1.0 + s.radiance.max()));
            assert!(!off, "{name}: {hit:?} {s:?}");
            missed += i32::from((pdf - density).abs() > 1e-2 * density);
        }
        // At an edge (of a light, of a texel) rounding may fall on the other side; at the silhouette of a sphere that is
        // small and far the density by area is as steep as the roundings of ω are large.
        assert!(missed * 10 <= lit, "{name}: {missed} of {lit} samples disagree");
    }
}

fn in_bounds(name: &str, light: &Light, s: &LightSample) {
    let bounds = light.bounds();
    if let End::Point(q) = s.end {
        // The start offset, 2⁻²¹ of the largest coordinate, twice.
        let slack = World::splat(1e-6 * q.abs().max(bounds.high.abs()).max(bounds.low.abs()).max_element());
        let inside = q.cmpge(bounds.low - slack).all() && q.cmple(bounds.high + slack).all();
        assert!(inside, "{name}: {q} is not in {bounds:?}");
    }
    let along = -s.wi.dot(bounds.axis);
    assert!(along >= bounds.cos_spread - 1e-6, "{name}: shines along {along} outside {bounds:?}");
}

/// E[1/pdf] over the draws that give light is the solid angle of the support. Not for densities that fall to 0 (the
/// cosine about a normal, whose 1/pdf has no variance).
#[test]
fn inverse_densities_average_to_the_solid_angle() {
    for (name, light, at, how, seed) in cases().filter(|c| !c.1.is_environment()) {
        let lit: Vec<LightSample> = draws(&light, &at, how, N, seed).flatten().collect();
        if lit.is_empty() {
            continue;
        }
        let (axis, half_angle) = cap(&lit);
        let bins = SphereBins::cap(axis, half_angle, 1, 1);
        let Grid { support, .. } = integrate(&bins, axis, half_angle, &light, &at, how);
        let inverse = |s: Option<LightSample>| s.map_or(0.0, |s| 1.0 / f64::from(s.density.weight()));
        let (omega, se) = crate::mean(draws(&light, &at, how, N, seed + 50).map(inverse));
        // Five standard errors, and a percent of the grid.
        assert!((omega - support).abs() < 5.0 * se + 0.01 * support, "{name}: {omega} ± {se}, {support}");
    }
}

/// Delta lights have one direction, no density and nothing to hit.
#[test]
fn delta_lights() {
    for (name, light) in Light::examples().into_iter().filter(|(_, light)| light.is_delta()) {
        for at in receivers() {
            let Some(s) = light.sample(&at, [0.3, 0.6], LightPoints::SolidAngle) else { continue };
            assert!(s.density.is_delta() && (s.wi.length() - 1.0).abs() < 1e-6, "{name}");
            assert_eq!((light.pdf(&at, s.wi, LightPoints::SolidAngle), light.hit(at.p, s.wi)), (0.0, None));
            let e = s.radiance.luminance() * s.wi.dot(at.ng).max(0.0);
            assert!((light.irradiance(&at) - e).abs() <= 1e-5 * e, "{name}");
            in_bounds(name, &light, &s);
            if let End::Point(q) = s.end {
                assert!((at.p + s.wi * s.distance - q).length() <= 1e-5 * s.distance, "{name}");
            }
        }
    }
}
