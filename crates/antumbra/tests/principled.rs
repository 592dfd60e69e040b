//! The principled model against Mitsuba's own numbers, the parameters one by one and all together; and what it gives back.

use antumbra::bsdf::{BsdfKind, Principled};
use antumbra::math::{Local, Rgb, Vec3, real};

/// Made by `python tools/principled.py`, with mitsuba 3.9.1.
const MITSUBA: &str = include_str!("principled.txt");

fn look(name: &str) -> Principled {
    let plain = Principled { base: Rgb([0.7, 0.4, 0.1]), ..Principled::default() };
    match name {
        "plain" => plain,
        "metal" => Principled { metallic: 0.7, anisotropic: 0.6, roughness: 0.4, ..plain },
        "tinted" => Principled { spec_tint: 0.8, eta: 1.8, roughness: 0.3, ..plain },
        "cloth" => Principled { sheen: 0.8, sheen_tint: 0.6, roughness: 0.9, ..plain },
        "flat" => Principled { flatness: 0.7, roughness: 0.6, metallic: 0.2, ..plain },
        "coat" => Principled { clearcoat: 0.9, clearcoat_gloss: 0.3, roughness: 0.6, ..plain },
        "glass" => Principled { spec_trans: 1.0, eta: 1.33, roughness: 0.5, ..plain },
        "all" => Principled {
            metallic: 0.3,
            anisotropic: 0.4,
            roughness: 0.45,
            eta: 1.7,
            spec_trans: 0.4,
            spec_tint: 0.5,
            sheen: 0.5,
            sheen_tint: 0.3,
            clearcoat: 0.6,
            clearcoat_gloss: 0.2,
            flatness: 0.25,
            ..plain
        },
        other => panic!("{other}"),
    }
}

/// ∫ f cos θ_i dω_i over the side above, by midpoints in (cos², φ).
fn albedo(look: &Principled, cos: f32) -> f32 {
    let direction = |mu: f32, phi: f32| {
        let sin = real::safe_sqrt(1.0 - mu * mu);
        Local(Vec3::new(sin * real::cosf(phi), sin * real::sinf(phi), mu))
    };
    let (n, wo) = (400, direction(cos, 0.0));
    let step = |i: i32| (i as f32 + 0.5) / n as f32;
    let at = |k: i32| look.eval(wo, direction(step(k % n).sqrt(), 2.0 * real::PI * step(k / n))).mean();
    (0..n * n).map(|k| f64::from(at(k))).sum::<f64>() as f32 * real::PI / (n * n) as f32
}

/// The parts are added, not weighed: what the model gives back of even light, held below what is written of it.
#[test]
fn white_looks_give_back_more_than_they_get() {
    let white = Principled { base: Rgb::WHITE, ..Principled::default() };
    let cosines = [1.0, 0.5, 0.2, 0.1, 0.05];
    let told = [
        ("grey 0.5", Principled::default(), 1.0),
        ("white", white, 1.25),
        ("white, sheen 1", Principled { sheen: 1.0, ..white }, 1.3),
    ];
    for (name, look, most) in told {
        let all = cosines.map(|cos| albedo(&look, cos));
        println!("{name:<15} {all:.3?} at cos θ {cosines:?}");
        let peak = all.into_iter().fold(0.0, f32::max);
        assert!(peak <= most && (peak > 1.0) == (most > 1.0), "{name}: {all:?}");
    }
}

#[test]
fn every_number_of_mitsuba() {
    let mut shown = 0;
    for line in MITSUBA.lines() {
        let (name, rest) = line.split_once(' ').unwrap();
        let n: Vec<f32> = rest.split(' ').map(|x| x.parse().unwrap()).collect();
        let [wo, wi, f] = [0, 3, 6].map(|i| [n[i], n[i + 1], n[i + 2]]);
        let told = look(name).eval(Local(Vec3::from(wo)), Local(Vec3::from(wi)));
        for c in 0..3 {
            // f32 on both sides; near α = 0.16 the tails of D take three squares of a half vector.
            assert!((told.0[c] - f[c]).abs() <= 1e-4 * f[c] + 1e-7, "{line}: {told:?}");
        }
        // From its other side the surface is the same, turned over.
        let under = |w: [f32; 3]| Local(Vec3::new(w[0], w[1], -w[2]));
        assert_eq!(look(name).turned().eval(under(wo), under(wi)), told, "{line}");
        shown += usize::from(f[0] > 0.0);
    }
    // Of 96 pairs, those that are black have a direction below a surface that lets nothing through.
    assert!(shown >= 70, "{shown}");
}
