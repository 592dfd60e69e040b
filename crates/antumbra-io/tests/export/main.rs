//! Scenes go out and come back: written as glTF and Mitsuba XML, read again, they give the same picture.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod files;
mod looks;
mod rules;

use std::fs;
use std::path::PathBuf;

use antumbra::render::{Picture, render};
use antumbra::scene::{Projection, SceneBuilder, builtin};
use antumbra::schedule::Flow;
use antumbra::settings::Settings;
use antumbra_io::{ReadOptions, Written, read_path, write_scene};

/// A folder of its own for one test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("antumbra-export-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn built_in(name: &str) -> SceneBuilder {
    builtin::build(name, &[]).unwrap()
}

fn write(folder: &Folder, name: &str, scene: &SceneBuilder) -> Written {
    write_scene(&folder.0.join(name), scene.clone(), [0.0; 3]).unwrap()
}

/// Written and read again.
fn back(folder: &Folder, name: &str, scene: &SceneBuilder) -> SceneBuilder {
    write(folder, name, scene);
    read_path(&folder.0.join(name), &ReadOptions::default()).unwrap()
}

/// A small picture with these settings.
fn picture(scene: &SceneBuilder, words: &[(&str, &str)]) -> Picture {
    let mut settings = Settings::default();
    for (name, value) in [("size", "32x24"), ("viewing_rays", "4"), ("filter", "box")].iter().chain(words) {
        settings.set(name, value).unwrap();
    }
    render(&scene.clone().build().unwrap(), &settings, None, &mut |_| Flow::Continue).unwrap()
}

/// Scenes of meshes and shapes under lights that Mitsuba has too come back with every bit.
#[test]
fn mitsuba_scenes_give_the_same_picture_to_the_bit() {
    let folder = Folder::new("xml");
    for name in ["pillars", "cornell-box", "veach-mis", "eclipse", "corner"] {
        let scene = built_in(name);
        let read = back(&folder, &format!("{name}.xml"), &scene);
        let (a, b) = (picture(&scene, &[("estimator", "mis")]), picture(&read, &[("estimator", "mis")]));
        assert_eq!(a.pixels, b.pixels, "{name}");
        assert!(a.pixels.iter().flatten().any(|x| *x > 0.0), "{name}");
        assert_eq!(read.cameras[0].size, scene.cameras[0].size);
    }
}

/// Colours of vertices come back from Mitsuba's XML with every bit.
#[test]
fn painted_meshes_come_back_from_mitsuba() {
    let folder = Folder::new("painted");
    let mut scene = built_in("cornell-box");
    for mesh in &mut scene.meshes {
        let tint = |i: usize| [0.25 * (i % 4) as f32, 1.0, 0.125 * (i % 8) as f32, 1.0];
        mesh.colors = Some((0..mesh.triangles.vertices.len()).map(tint).collect());
    }
    let read = back(&folder, "painted.xml", &scene);
    assert!(read.meshes.iter().any(|m| m.colors.is_some()));
    let [a, b] = [&scene, &read].map(|s| picture(s, &[("estimator", "mis")]).pixels);
    // White times a colour and a colour times white: the factor is rounded once on either way.
    let near = |(x, y): (&f32, &f32)| (x - y).abs() <= 4.0 * f32::EPSILON * x.max(1.0);
    assert!(a.iter().flatten().zip(b.iter().flatten()).all(near));
}

/// Parallel rays come back: the picture's height takes one rounding of f64, which moves no f32 by more than its last bit.
#[test]
fn an_orthographic_camera_comes_back() {
    let folder = Folder::new("parallel");
    let mut scene = built_in("pillars");
    for mirrored in [false, true] {
        let camera = &mut scene.cameras[0];
        (camera.projection, camera.mirrored) = (Projection::Orthographic { height: 3.7 }, mirrored);
        let read = back(&folder, "parallel.xml", &scene);
        let Projection::Orthographic { height } = read.cameras[0].projection else { panic!() };
        assert!((height / 3.7 - 1.0).abs() < 1e-15 && read.cameras[0].mirrored == mirrored);
        let [a, b] = [&scene, &read].map(|s| picture(s, &[("estimator", "ambient-occlusion")]).pixels);
        let same = a.iter().zip(&b).filter(|(a, b)| a == b).count();
        assert!(same * 100 >= a.len() * 99, "{same} of {}", a.len());
    }
}

/// Meshes come back from glTF with every bit; light that leaves a rectangle takes two roundings of its edges on the way,
/// 2⁻²³ each of numbers about as large as the picture's own.
#[test]
fn gltf_scenes_give_the_same_picture() {
    let folder = Folder::new("glb");
    for name in ["pillars", "cornell-box"] {
        let scene = built_in(name);
        let read = back(&folder, &format!("{name}.glb"), &scene);
        let open = [("estimator", "ambient-occlusion")];
        assert_eq!(picture(&scene, &open).pixels, picture(&read, &open).pixels, "{name}");
        let lit = [("estimator", "mis")];
        let (a, b) = (picture(&scene, &lit), picture(&read, &lit));
        for (x, y) in a.pixels.iter().flatten().zip(b.pixels.iter().flatten()) {
            assert!((x - y).abs() <= 4.0 * f32::EPSILON * x.max(1.0), "{name}: {x} {y}");
        }
    }
}

/// Round lights and shapes become triangles in glTF, with their area: the mean picture stays, within five standard errors
/// of both (α < 10⁻⁶) and 10⁻³ for what lies between circle and polygon.
#[test]
fn round_things_in_gltf_give_the_same_mean_picture() {
    let folder = Folder::new("round");
    for name in ["antumbra", "eclipse"] {
        let scene = built_in(name);
        let read = back(&folder, &format!("{name}.glb"), &scene);
        let clay = [("estimator", "area"), ("clay", "0.5"), ("viewing_rays", "32")];
        let mean = |p: &Picture| {
            let n = p.pixels.len() as f64;
            let sum: f64 = p.pixels.iter().map(|x| f64::from(x[1])).sum();
            let error =
                p.standard_error.as_ref().unwrap().iter().map(|e| f64::from(e[1]).powi(2)).sum::<f64>();
            (sum / n, error.sqrt() / n)
        };
        let ((a, da), (b, db)) = (mean(&picture(&scene, &clay)), mean(&picture(&read, &clay)));
        assert!(
            (a - b).abs() <= 5.0 * (da * da + db * db).sqrt() + 1e-3 * a,
            "{name}: {a} ± {da}, {b} ± {db}"
        );
    }
}

/// Everything has its place relative to the origin of the world that is given.
#[test]
fn a_scene_far_from_zero_stands_where_it_stood() {
    let folder = Folder::new("far");
    let scene = built_in("antumbra");
    for name in ["far.glb", "far.xml"] {
        let path = folder.0.join(name);
        write_scene(&path, scene.clone(), [4096.0, 0.0, -512.0]).unwrap();
        let far = read_path(&path, &ReadOptions::default()).unwrap();
        let by = far.cameras[0].eye - scene.cameras[0].eye;
        assert_eq!(by.to_array(), [4096.0, 0.0, -512.0]);
        let low = |s: SceneBuilder| s.build().unwrap().bounds().unwrap()[0];
        let moved = low(far) - low(scene.clone());
        // Coordinates near 4096 have steps of 2⁻¹¹.
        assert!((moved.x - 4096.0).abs() < 1e-3 && (moved.z + 512.0).abs() < 1e-3, "{name} {moved}");
    }
}

/// What a format lacks is named once a kind, and what lies beside the file is there.
#[test]
fn what_a_format_lacks_is_said() {
    let folder = Folder::new("lacks");
    let written = write(&folder, "sky.glb", &built_in("sky-dome"));
    let said: Vec<_> = written.messages.iter().map(|m| m.text.as_str()).collect();
    assert!(said.iter().any(|t| t.contains("`environment` = sky-environment.exr")), "{said:?}");
    assert!(said.iter().any(|t| t.starts_with("spheres are meshes in glTF")), "{said:?}");
    assert!(written.files.iter().all(|(path, bytes)| fs::metadata(path).unwrap().len() == *bytes));
    assert_eq!(written.files.len(), 2);
    assert!(write(&folder, "pillars.glb", &built_in("pillars")).messages.is_empty());
    assert!(write(&folder, "antumbra.xml", &built_in("antumbra")).messages.is_empty());
}
