//! The kernels alone, at every SIMD level of the machine: any hit, closest hit, build.
//!
//! `cargo bench --profile demo -p antumbra-trace --bench kernels [-- FILTER]`

#[allow(dead_code, reason = "the race against Embree uses more of it")]
#[path = "embree/rays.rs"]
mod rays;
#[path = "embree/scenes.rs"]
mod scenes;

use std::sync::{Arc, OnceLock};

use antumbra_trace::{
    Bits, BuildOptions, Geometry, Hits, Instance, Pool, SimdLevel, Triangles, Visibility, World,
};
use divan::Bencher;
use divan::counter::ItemsCount;
use rays::Class;

fn main() {
    divan::main();
}

fn build(mesh: &Triangles) -> Option<World> {
    let geometries = vec![Geometry::Triangles(Arc::new(mesh.clone()))];
    let instance = Instance { geometry: 0, transform: None, masked: false };
    World::build(geometries, vec![instance], &BuildOptions::default(), Pool::serial()).ok()
}

/// Scenes at a tenth of their size, made once.
fn prepared() -> &'static [(scenes::Scene, World, Vec<Class>)] {
    static ALL: OnceLock<Vec<(scenes::Scene, World, Vec<Class>)>> = OnceLock::new();
    ALL.get_or_init(|| {
        let prepare = |mut scene: scenes::Scene| {
            scene.rows = 128;
            let world = build(&scene.mesh)?;
            let classes = rays::classes(&scene, &world);
            Some((scene, world, classes))
        };
        scenes::all(0.1).into_iter().filter_map(prepare).collect()
    })
}

const SCENES: [&str; 5] = ["interior", "terrain", "pillars", "hall", "scan"];
const LEVELS: [SimdLevel; 4] = SimdLevel::ALL;

/// Every question of the given classes at one level.
fn ask(bencher: Bencher<'_, '_>, level: SimdLevel, scene: &str, nearest: bool, classes: &[&str]) {
    let Some((_, world, all)) = prepared().iter().find(|(s, ..)| s.name == scene) else { return };
    if !level.is_available() {
        return;
    }
    let world = world.clone().with_level(level);
    let asked: Vec<_> =
        all.iter().filter(|c| c.nearest == nearest && classes.contains(&c.name)).map(|c| &c.asked).collect();
    let rays: usize = asked.iter().map(|a| a.len()).sum();
    let (mut bits, mut hits) = (Bits::default(), Hits::default());
    bencher.counter(ItemsCount::new(rays)).bench_local(|| {
        for asked in &asked {
            if nearest {
                world.nearest(asked.as_segments(), &mut hits);
            } else {
                world.occluded(asked.as_segments(), &mut bits);
            }
        }
    });
}

macro_rules! kernels {
    ($($name:ident: $nearest:literal, $classes:expr;)*) => {$(
        #[divan::bench_group(sample_count = 20)]
        mod $name {
            #[divan::bench(args = crate::SCENES, consts = [0, 1, 2, 3])]
            fn at_level<const LEVEL: usize>(bencher: divan::Bencher<'_, '_>, scene: &str) {
                crate::ask(bencher, crate::LEVELS[LEVEL], scene, $nearest, &$classes);
            }
        }
    )*};
}

kernels! {
    any_hit_area: false, ["area light"];
    any_hit_ambient: false, ["ambient"];
    closest_camera: true, ["camera"];
    closest_bounce: true, ["bounce"];
}

#[divan::bench(args = SCENES, sample_count = 5)]
fn build_serial(bencher: Bencher<'_, '_>, scene: &str) {
    let Some((scene, ..)) = prepared().iter().find(|(s, ..)| s.name == scene) else { return };
    bencher.counter(ItemsCount::new(scene.mesh.indices.len())).bench_local(|| build(&scene.mesh));
}
