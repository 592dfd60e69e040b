//! The same bits: for any number of threads, every SIMD level, and in a part of the picture.

use antumbra::estimator::EstimatorKind;
use antumbra::film::Planes;
use antumbra::sampler::SamplerKind;
use antumbra::settings::Settings;
use antumbra::trace::SimdLevel;

use super::pictures::{look, plane, small};
use super::rooms;

/// A picture of several tiles.
fn wide(estimator: EstimatorKind) -> Settings {
    Settings { size: Some([70, 40]), viewing_rays: 6, bounces: 3, ..small(estimator) }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let scene = rooms::lit().build().unwrap();
    for kind in EstimatorKind::ALL {
        let of = |threads| look(&scene, &Settings { threads, ..wide(*kind) });
        let one = of(1);
        for threads in [2, 5] {
            let other = of(threads);
            assert_eq!((one.hash, &one.pixels), (other.hash, &other.pixels), "{kind:?} on {threads} threads");
            assert_eq!(one.standard_error, other.standard_error);
        }
    }
}

#[test]
fn every_simd_level_gives_the_same_bits() {
    let scene = rooms::under_sky().build().unwrap();
    let auto = look(&scene, &wide(EstimatorKind::Path));
    for level in SimdLevel::available() {
        let other = look(&scene.at_level(level), &wide(EstimatorKind::Path));
        assert_eq!(auto.hash, other.hash, "{}", level.name());
        assert_eq!(auto.pixels, other.pixels);
    }
}

/// Every plane of a crop is that part of the whole picture.
#[test]
fn a_crop_is_a_part_of_the_picture() {
    let scene = rooms::lit().build().unwrap();
    let aov = Planes::ALL;
    let whole = look(&scene, &Settings { aov, ..wide(EstimatorKind::Path) });
    let [x0, y0, w, h] = [13, 7, 35, 33];
    let crop = Some([x0, y0, w, h]);
    let part = look(&scene, &Settings { aov, crop, ..wide(EstimatorKind::Path) });
    assert_eq!([part.width, part.height], [w, h]);
    let names: Vec<(&str, usize)> = part.aovs.iter().map(|(n, c, _)| (n.as_str(), *c)).collect();
    for y in 0..h {
        for x in 0..w {
            let (i, j) = ((y * w + x) as usize, ((y + y0) * whole.width + x + x0) as usize);
            assert_eq!(part.pixels[i], whole.pixels[j], "pixel {x}, {y}");
            for (name, c) in &names {
                let of = |values: &[f32], i: usize| values[i * c..(i + 1) * c].to_vec();
                assert_eq!(of(plane(&part, name), i), of(plane(&whole, name), j), "{name} at {x}, {y}");
            }
        }
    }
}

#[test]
fn another_seed_is_another_noise() {
    let scene = rooms::lit().build().unwrap();
    for sampler in SamplerKind::ALL {
        let of = |seed, rotate| {
            look(&scene, &Settings { sampler: *sampler, seed, rotate, ..wide(EstimatorKind::Path) })
        };
        let rotate = *sampler == SamplerKind::Regular;
        assert_eq!(of(1, rotate).hash, of(1, rotate).hash);
        assert_ne!(of(1, rotate).hash, of(2, rotate).hash, "{sampler:?}");
    }
}

/// Below 256 viewing rays four replicates, from there sixteen; a fixed grid has no replicates and says so.
#[test]
fn the_error_is_known_where_there_are_replicates() {
    let scene = rooms::lit().build().unwrap();
    let of = |viewing_rays, sampler| {
        look(&scene, &Settings { viewing_rays, sampler, size: Some([4, 3]), ..small(EstimatorKind::Area) })
    };
    assert!(of(1, SamplerKind::Owen).standard_error.is_none());
    assert!(of(2, SamplerKind::Owen).standard_error.is_some());
    assert!(of(16, SamplerKind::Regular).standard_error.is_none());
}
