//! pbrt-v4: small scenes made here, each for one law.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod limits;
mod shapes;

use std::collections::HashMap;

use antumbra::light::{Light, SpotEdge};
use antumbra::math::{DVec3, Rgb, Vec3, real};
use antumbra::scene::{Alpha, Body, Level, Object, Projection, SceneBuilder, Surface};
use antumbra::trace::Shape;
use antumbra_io::{Format, Limits, MemoryFiles, ReadError, read};

fn whole(text: &str, files: &[(&str, &[u8])]) -> Result<SceneBuilder, ReadError> {
    let files = files.iter().map(|(name, bytes)| (name.to_string(), bytes.to_vec()));
    read(Format::Pbrt, text.as_bytes(), &MemoryFiles(HashMap::from_iter(files)), &Limits::default())
}

/// What stands behind `WorldBegin`.
fn world(text: &str) -> SceneBuilder {
    whole(&format!("WorldBegin\n{text}"), &[]).unwrap()
}

fn refused(text: &str) -> String {
    let e = whole(text, &[]).unwrap_err();
    format!("{}: {}", e.place, e.what)
}

fn warnings(scene: &SceneBuilder) -> Vec<String> {
    let warned = scene.messages.iter().filter(|m| m.level == Level::Warning);
    warned.map(|m| format!("{}: {}", m.place, m.text)).collect()
}

fn ball(object: &Object) -> (DVec3, f32) {
    let Body::Shape(Shape::Sphere { center, radius }) = object.body else { panic!("{object:?}") };
    (DVec3::from(center.map(f64::from)), radius)
}

const BALL: &str = "Shape \"sphere\"\n";

#[test]
fn the_last_transform_acts_first() {
    let s = world(
        "Translate 0 0 5 Rotate 90 0 0 1 Scale 2 2 2 Translate 1 0 0 Shape \"sphere\" \"float radius\" 1.5",
    );
    let (center, radius) = ball(&s.objects[0]);
    assert!(radius == 3.0 && (center - DVec3::new(0.0, 2.0, 5.0)).length() < 1e-6, "{center}");
}

#[test]
fn matrices_go_column_by_column_and_places_are_remembered() {
    let s = world(
        "Transform [ 2 0 0 0  0 2 0 0  0 0 2 0  1 2 3 1 ] CoordinateSystem \"here\" Identity Shape \"sphere\"\n\
         CoordSysTransform \"here\" ConcatTransform [ 1 0 0 0  0 1 0 0  0 0 1 0  10 0 0 1 ] Shape \"sphere\"",
    );
    assert_eq!(ball(&s.objects[0]), (DVec3::ZERO, 1.0));
    assert_eq!(ball(&s.objects[1]), (DVec3::new(21.0, 2.0, 3.0), 2.0));
}

#[test]
fn attributes_end() {
    let s = world(
        "MakeNamedMaterial \"red\" \"string type\" \"diffuse\" \"rgb reflectance\" [ 1 0 0 ]\n\
         AttributeBegin Translate 1 0 0 NamedMaterial \"red\" AreaLightSource \"diffuse\" \"rgb L\" [ 1 2 3 ]\n\
         Shape \"sphere\" AttributeEnd\n\
         TransformBegin Translate 5 0 0 NamedMaterial \"red\" TransformEnd Shape \"sphere\"",
    );
    let material = |i: usize| &s.materials[s.objects[i].material as usize];
    assert_eq!(material(0).emission.unwrap().radiance, Rgb::new(1.0, 2.0, 3.0));
    assert_eq!((ball(&s.objects[1]).0, material(1).emission), (DVec3::ZERO, None));
    assert_eq!(material(1).surface, Surface::Diffuse { albedo: Rgb::new(1.0, 0.0, 0.0) });
}

/// x of the camera points to the right of the picture: in a right-handed world, `LookAt` alone shows it mirrored.
#[test]
fn a_left_handed_world_is_seen_mirrored() {
    let look = "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n";
    for (handed, mirrored) in [("", true), ("Scale -1 1 1", false)] {
        let text = format!(
            "{look} {handed} LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 90 WorldBegin {BALL}"
        );
        let s = whole(&text, &[]).unwrap();
        let camera = &s.cameras[0];
        assert_eq!((camera.mirrored, camera.size), (mirrored, Some([200, 100])));
        assert!((camera.eye - DVec3::Z * 5.0).length() < 1e-12);
        assert!((camera.look_at - camera.eye).normalize().abs_diff_eq(DVec3::NEG_Z, 1e-12));
        // 90° are those of the shorter side.
        let Projection::Perspective { vertical_fov } = camera.projection else { panic!() };
        assert!((vertical_fov - std::f64::consts::FRAC_PI_2).abs() < 1e-12);
    }
}

#[test]
fn a_window_aside_shifts_the_picture() {
    let s = whole(
        "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 200\n\
         Camera \"orthographic\" \"float screenwindow\" [ 0 2 -1 3 ] WorldBegin Shape \"sphere\"",
        &[],
    )
    .unwrap();
    assert_eq!(s.cameras[0].projection, Projection::Orthographic { height: 4.0 });
    assert_eq!(s.cameras[0].shift, [0.5, -0.25]);
}

#[test]
fn lights() {
    let s = world(&format!(
        "LightSource \"point\" \"rgb I\" [ 1 2 3 ] \"float scale\" 2 \"point3 from\" [ 0 4 0 ]\n\
         LightSource \"point\" \"float power\" 10\n\
         LightSource \"spot\" \"float coneangle\" 40 \"float conedeltaangle\" 10 \"point3 to\" [ 0 -1 0 ]\n\
         LightSource \"distant\" \"point3 from\" [ 0 1 0 ] \"point3 to\" [ 0 0 0 ] \"float illuminance\" 3\n\
         LightSource \"infinite\" \"float illuminance\" 3 {BALL}"
    ));
    let Light::Point(point) = &s.lights[0].1 else { panic!() };
    assert_eq!((point.position, point.intensity), (Vec3::new(0.0, 4.0, 0.0), Rgb::new(2.0, 4.0, 6.0)));
    let Light::Point(point) = &s.lights[1].1 else { panic!() };
    assert!((point.intensity.0[0] * 4.0 * real::PI - 10.0).abs() < 1e-5);
    let Light::Spot(spot) = &s.lights[2].1 else { panic!() };
    assert_eq!((spot.edge, spot.direction), (SpotEdge::Hermite, Vec3::NEG_Y));
    assert!((spot.inner.to_degrees() - 30.0).abs() < 1e-4 && (spot.outer.to_degrees() - 40.0).abs() < 1e-4);
    let Light::Directional(sun) = &s.lights[3].1 else { panic!() };
    assert_eq!((sun.to_light, sun.irradiance), (Vec3::Y, Rgb::grey(3.0)));
    let Light::Environment(sky) = &s.lights[4].1 else { panic!() };
    assert!((sky.radiance.0[0] * real::PI - 3.0).abs() < 1e-6);
}

#[test]
fn textures_are_joined() {
    let s = world(
        "Texture \"a\" \"spectrum\" \"constant\" \"rgb value\" [ 0.2 0.4 0.6 ]\n\
         Texture \"b\" \"spectrum\" \"scale\" \"texture tex\" \"a\" \"float scale\" 0.5\n\
         Texture \"c\" \"spectrum\" \"mix\" \"texture tex1\" \"a\" \"texture tex2\" \"b\" \"float amount\" 0.25\n\
         Material \"diffuse\" \"texture reflectance\" \"c\" Shape \"sphere\"\n\
         Texture \"d\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [ 1 0 0 ] \"rgb tex2\" [ 0 1 0 ] \"float uscale\" 4\n\
         Texture \"e\" \"spectrum\" \"scale\" \"texture tex\" \"d\" \"float scale\" 0.5\n\
         Material \"diffuse\" \"texture reflectance\" \"e\" Shape \"sphere\"",
    );
    let Surface::Diffuse { albedo } = s.materials[0].surface else { panic!() };
    let want = Rgb::new(0.2, 0.4, 0.6) * 0.875;
    assert!((0..3).all(|c| (albedo.0[c] - want.0[c]).abs() < 1e-6), "{albedo:?}");
    let Surface::Diffuse { albedo } = s.materials[1].surface else { panic!() };
    let texture = &s.textures[s.materials[1].color.unwrap() as usize];
    // Fields of a quarter of u: the first is tex1, the next tex2.
    let at = |u| Rgb(texture.at([u, 0.5])[..3].try_into().unwrap()) * albedo;
    assert_eq!(
        [at(0.1), at(0.3), at(0.6)],
        [Rgb::new(0.5, 0.0, 0.0), Rgb::new(0.0, 0.5, 0.0), Rgb::new(0.5, 0.0, 0.0)]
    );
    // What is painted is a mesh, whose coordinates the texture needs.
    assert!(matches!(s.objects[1].body, Body::Mesh(_)));
}

#[test]
fn materials() {
    let s = world(
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\" Shape \"sphere\"\n\
         Material \"conductor\" \"rgb reflectance\" [ 0.25 0.5 0.81 ] \"float roughness\" 0.25 Shape \"sphere\"\n\
         Material \"dielectric\" \"spectrum eta\" \"glass-BK7\" Shape \"sphere\"\n\
         Material \"interface\" Shape \"sphere\"\n\
         Material \"diffuse\" Shape \"sphere\" \"float alpha\" 0.25",
    );
    let of = |i: usize| &s.materials[s.objects[i].material as usize];
    let Surface::Conductor(gold) = of(0).surface else { panic!() };
    assert_eq!(gold.metal, antumbra::bsdf::Metal::named("Au").unwrap());
    let Surface::RoughConductor(metal) = of(1).surface else { panic!() };
    // Head on, η = 1 and k reflect k²/(4 + k²).
    let k2 = metal.metal.k.map(|k| k * k).0;
    assert!([0.25, 0.5, 0.81].iter().zip(k2).all(|(r, k2)| (k2 / (4.0 + k2) - r).abs() < 1e-5));
    assert_eq!(of(1).surface.facets().unwrap().alpha(), [0.5, 0.5]);
    assert!(matches!(of(2).surface, Surface::Dielectric(_)));
    assert_eq!((of(3).alpha, of(3).opacity), (Alpha::Blend, 0.0));
    assert_eq!((of(4).alpha, of(4).opacity), (Alpha::Blend, 0.25));
}

/// A leaf reflects by one texture and lets light through by the other; two shares that make more than 1 are named.
#[test]
fn a_leaf_lets_light_through() {
    let s = world(
        "Texture \"a\" \"spectrum\" \"checkerboard\"\nTexture \"b\" \"spectrum\" \"checkerboard\" \"float uscale\" 2\n\
         Material \"diffusetransmission\" \"texture reflectance\" \"a\" \"texture transmittance\" \"b\" \"float scale\" 0.5\n\
         Shape \"sphere\"\nMaterial \"diffusetransmission\" \"rgb reflectance\" [ 0.5 0.5 0.5 ] \"rgb transmittance\" [ 1 1 1 ]\n\
         Shape \"sphere\"",
    );
    let leaf = &s.materials[0];
    let Surface::DiffuseTransmission(d) = leaf.surface else { panic!() };
    assert_eq!((d.reflectance, d.transmittance), (Rgb::grey(0.5), Rgb::grey(0.5)));
    assert!(leaf.color.is_some() && leaf.gloss.is_some() && leaf.color != leaf.gloss);
    let said =
        "line 6: a diffusetransmission gives back more light than it gets: its two shares are scaled down";
    assert!(warnings(&s).iter().any(|s| s == said));
}

/// Metal in its coat: the two roughnesses apart, α their roots; polished where the file says nothing.
#[test]
fn coated_metal() {
    let s = world(
        "Material \"coatedconductor\" Shape \"sphere\" LightSource \"infinite\"\n\
         Material \"coatedconductor\" \"float interface.eta\" 1.3 \"float interface.roughness\" 0\n\
         \"float conductor.roughness\" 0.09 \"spectrum conductor.eta\" \"metal-Au-eta\" \"spectrum conductor.k\" \"metal-Au-k\"\n\
         Shape \"sphere\"",
    );
    assert!(warnings(&s).is_empty(), "{:?}", warnings(&s));
    let of = |i: usize| match s.materials[s.objects[i].material as usize].surface {
        Surface::CoatedConductor(c) => c,
        other => panic!("{other:?}"),
    };
    assert_eq!((of(0).eta(), of(0).facets()), (1.5, None));
    assert_eq!((of(1).eta(), of(1).facets().unwrap().alpha()), (1.3, [0.3, 0.3]));
    let gold = antumbra::bsdf::Metal::named("Au").unwrap();
    assert!((0..3).all(|c| (of(1).metal().k.0[c] / gold.k.0[c] - 1.0).abs() < 1e-6));
}

#[test]
fn files_within_files() {
    let files: [(&str, &[u8]); 2] = [
        ("parts/a.pbrt", b"Translate 1 0 0 Shape \"sphere\" Include \"parts/b.pbrt\""),
        ("parts/b.pbrt", b"# only a comment\nShape \"sphere\""),
    ];
    let s = whole(
        "WorldBegin Import \"parts/a.pbrt\" Shape \"sphere\" Include \"parts/a.pbrt\" Shape \"sphere\"",
        &files,
    );
    let places: Vec<_> = s.unwrap().objects.iter().map(|o| ball(o).0.x).collect();
    // What an import changes ends with it; what an include changes does not.
    assert_eq!(places, [1.0, 1.0, 0.0, 1.0, 1.0, 1.0]);
    let turning =
        whole("WorldBegin Include \"me.pbrt\"", &[("me.pbrt", b"Include \"me.pbrt\"")]).unwrap_err();
    assert!(turning.what.contains("more than 32 deep"), "{turning}");
}

#[test]
fn what_is_lacking_is_said_once_with_its_place() {
    let s = world(
        "\nMaterial \"hair\" \"float beta_m\" 2\nShape \"sphere\" \"float wrong\" 3\nShape \"curve\"\nLightSource \"projection\"",
    );
    let said = warnings(&s);
    for part in [
        "line 3: Material \"hair\" is a plugin that antumbra does not have: drawn grey",
        "line 4: \"wrong\" of Shape \"sphere\" is not read",
        "line 5: Shape \"curve\" is a plugin that antumbra does not have: left out",
        "line 6: LightSource \"projection\" is a plugin that antumbra does not have: left out",
    ] {
        assert!(said.iter().any(|s| s == part), "{part} in {said:#?}");
    }
}

#[test]
fn bad_input_is_named_with_its_line() {
    for (text, said) in [
        ("", ": the file is empty (0 bytes)"),
        ("WorldBegin", ": there is nothing to render: no shape in the scene"),
        ("Shape \"sphere\"", ": there is no WorldBegin"),
        ("WorldBegin\n[", "line 2: \"[\" stands where a directive is expected"),
        ("WorldBegin\nShepe", "line 2: \"Shepe\" is no directive of pbrt-v4"),
        ("WorldBegin Shape \"sphere", "line 1: a string is not closed: its second \" is missing"),
        ("WorldBegin\nTranslate 1 2 x", "line 2: Translate takes 3 numbers, and 2 are here"),
        ("WorldBegin\nTranslate 1 2 3e", "line 2: \"3e\" is no number"),
        (
            "WorldBegin Shape \"sphere\" \"float radius\" [ 1",
            "line 1: Shape \"sphere\": \"float radius\": the file ends before its value does",
        ),
        (
            "WorldBegin Shape \"sphere\" \"float radius\" [ 1 \"a\" ]",
            "line 1: Shape \"sphere\": \"float radius\" holds values of different kinds",
        ),
        (
            "WorldBegin Shape \"sphere\" \"radius\" 1",
            "line 1: Shape \"sphere\": \"radius\" is no type and name of a parameter",
        ),
        (
            "WorldBegin Shape \"sphere\" \"float radius\" -1",
            "line 1: Shape \"sphere\": \"radius\" is -1: it must be above 0",
        ),
        ("WorldBegin NamedMaterial \"x\"", "line 1: no material is called \"x\""),
        ("WorldBegin ObjectInstance \"x\"", "line 1: no object is called \"x\""),
        (
            "WorldBegin AttributeBegin TransformEnd",
            "line 1: this End belongs to TransformBegin, and AttributeBegin is still open",
        ),
        ("WorldBegin AttributeEnd", "line 1: an End without its AttributeBegin"),
        ("WorldBegin AttributeBegin Shape \"sphere\"", ": the file ends before its AttributeBegin does"),
        (
            "WorldBegin Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ] \"integer indices\" [ 0 1 3 ]",
            "line 1: Shape \"trianglemesh\": \"indices\" holds 3: \"P\" has 3 points",
        ),
        (
            "WorldBegin Shape \"plymesh\" \"string filename\" \"no.ply\"",
            "line 1: Shape \"plymesh\": the file \"no.ply\": no such file",
        ),
        (
            "WorldBegin Shape \"plymesh\" \"string filename\" \"/etc/passwd\"",
            "line 1: Shape \"plymesh\": the file \"/etc/passwd\": the path is absolute: not opened",
        ),
        ("WorldBegin Material \"matte\"", "line 1: Material \"matte\": this is a material of pbrt-v3"),
        (
            "Camera \"perspective\" \"float fov\" 180 WorldBegin",
            "line 1: Camera \"perspective\": \"fov\" is 180: an angle between 0 and 180 is needed",
        ),
        (
            "Scale 0 1 1 Camera \"perspective\" WorldBegin",
            "line 1: Camera \"perspective\": the transform of the camera is singular",
        ),
    ] {
        assert_eq!(refused(text), said, "{text}");
    }
}

#[test]
fn every_shorter_file_is_read_or_refused() {
    let text = "Film \"rgb\" \"integer xresolution\" [ 8 ]\nLookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nWorldBegin\n\
        AttributeBegin AreaLightSource \"diffuse\" \"blackbody L\" 4000 Shape \"sphere\" \"float radius\" [ 0.5 ] AttributeEnd\n\
        Texture \"t\" \"float\" \"checkerboard\" \"float tex1\" 0.1 Material \"coateddiffuse\" \"texture roughness\" \"t\"\n\
        Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 1 1 1 ] \"bool odd\" [ true ]\n";
    assert!(whole(text, &[]).is_ok());
    for end in 0..text.len() {
        let _ = whole(&text[..end], &[]);
        // And with a byte exchanged.
        let mut bytes = text.as_bytes().to_vec();
        bytes[end] = b'"';
        let _ = whole(&String::from_utf8_lossy(&bytes), &[]);
    }
}

#[test]
fn gzipped_files_are_unpacked() {
    use std::io::Write;
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(b"Shape \"sphere\"").unwrap();
    let bytes = packed.finish().unwrap();
    let s = whole("WorldBegin Include \"a.pbrt.gz\"", &[("a.pbrt.gz", &bytes)]).unwrap();
    assert_eq!(s.objects.len(), 1);
    let cut =
        whole("WorldBegin Include \"a.pbrt.gz\"", &[("a.pbrt.gz", &bytes[..bytes.len() - 6])]).unwrap_err();
    assert!(cut.what.contains("it cannot be unpacked"), "{cut}");
}
