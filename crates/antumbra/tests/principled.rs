//! The principled model against Mitsuba's own numbers, the parameters one by one and all together; and what it gives back.

use antumbra::bsdf::{BsdfKind, Principled};
use antumbra::math::{Local, Rgb, Vec3};

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
