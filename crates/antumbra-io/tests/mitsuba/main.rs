//! Mitsuba 3 XML: small scenes made here, each for one law.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

mod attributes;
mod colors;
mod damaged;
mod groups;
mod models;
mod serialized;

use std::collections::HashMap;

use antumbra::light::Light;
use antumbra::math::{DVec3, Rgb, real};
use antumbra::scene::{Alpha, Body, Lens, Level, Projection, SceneBuilder, Surface};
use antumbra::trace::Shape;
use antumbra_io::{Format, Limits, MemoryFiles, ReadError, read};

const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property float u\nproperty float v\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n0 0 1 1 1\n3 0 1 2\n3 1 0 3\n";

fn with<T: AsRef<[u8]>>(inside: &str, files: &[(&str, T)]) -> Result<SceneBuilder, ReadError> {
    let text = format!("<scene version=\"3.0.0\">\n{inside}\n</scene>");
    let files = files.iter().map(|(name, bytes)| (name.to_string(), bytes.as_ref().to_vec()));
    read(Format::Mitsuba, text.as_bytes(), &MemoryFiles(HashMap::from_iter(files)), &Limits::default())
}

fn scene(inside: &str) -> SceneBuilder {
    with(inside, &[("fold.ply", PLY)]).unwrap()
}

fn refused(inside: &str) -> String {
    let e = with(inside, &[("fold.ply", PLY)]).unwrap_err();
    format!("{}: {}", e.place, e.what)
}

fn warnings(scene: &SceneBuilder) -> Vec<String> {
    let warned = scene.messages.iter().filter(|m| m.level == Level::Warning);
    warned.map(|m| format!("{}: {}", m.place, m.text)).collect()
}

const BALL: &str = "<shape type=\"sphere\"/>";

#[test]
fn steps_of_a_transform_follow_each_other() {
    let s = scene(
        "<shape type='sphere'><transform name='to_world'><translate x='1'/><scale value='2'/>\
         <rotate z='1' angle='90'/><translate value='0, 0, 5'/></transform></shape>",
    );
    let Body::Shape(Shape::Sphere { center, radius }) = s.objects[0].body else { panic!("{:?}", s.objects) };
    assert!(
        radius == 2.0 && (DVec3::from(center.map(f64::from)) - DVec3::new(0.0, 2.0, 5.0)).length() < 1e-6
    );
}

#[test]
fn a_sensor_looks_along_z_with_x_to_the_left() {
    let s = scene(
        "<sensor type='perspective'><float name='fov' value='90'/><transform name='to_world'>\
         <lookat origin='1,2,3' target='1,2,0' up='0,1,0'/></transform><film type='hdrfilm'>\
         <integer name='width' value='200'/><integer name='height' value='100'/></film></sensor><shape type='cube'/>",
    );
    let camera = &s.cameras[0];
    assert_eq!((camera.eye, camera.size), (DVec3::new(1.0, 2.0, 3.0), Some([200, 100])));
    assert!((camera.look_at - camera.eye).normalize().abs_diff_eq(DVec3::NEG_Z, 1e-12));
    // 90° across 200 pixels are 2·atan(½) down 100.
    let Projection::Perspective { vertical_fov } = camera.projection else { panic!() };
    assert!((vertical_fov - 2.0 * real::atan(0.5)).abs() < 1e-12);
}

#[test]
fn a_thinlens_has_an_opening_and_a_focus() {
    let camera = |plugin: &str, inside: &str| {
        let s = scene(&format!("<sensor type='{plugin}'>{inside}</sensor><shape type='cube'/>"));
        assert!(warnings(&s).iter().all(|w| w.contains("no emitter")), "{:?}", warnings(&s));
        s.cameras[0].clone()
    };
    let lens = "<float name='aperture_radius' value='0.1'/><float name='focus_distance' value='3'/>";
    assert_eq!(camera("thinlens", lens).lens, Some(Lens { radius: 0.1, focus: 3.0 }));
    let scaled = format!("{lens}<transform name='to_world'><scale value='2'/></transform>");
    assert_eq!(camera("thinlens", &scaled).lens, Some(Lens { radius: 0.2, focus: 6.0 }));
    let shift = "<float name='principal_point_offset_x' value='0.25'/>";
    let shifted = camera("perspective", shift);
    assert_eq!((shifted.lens, shifted.shift), (None, [0.25, 0.0]));
    let error = refused(
        "<sensor type='thinlens'><float name='focus_distance' value='0'/></sensor><shape type='cube'/>",
    );
    assert!(error.contains("\"focus_distance\" = 0 of sensor \"thinlens\": it must be above 0"), "{error}");
}

#[test]
fn files_ask_for_settings() {
    let s = scene(
        "<default name='spp' value='64'/><integrator type='direct'><integer name='shading_samples' value='4'/>\
         </integrator><sensor type='perspective'><sampler type='independent'><integer name='sample_count' \
         value='$spp'/></sampler><film type='hdrfilm'><rfilter type='box'/></film></sensor><shape type='cube'/>",
    );
    let asked: Vec<_> = s.suggested.iter().map(|(n, v)| format!("{n}={v}")).collect();
    assert_eq!(asked, ["estimator=mis", "shadow_rays=4", "viewing_rays=64", "filter=box"]);
    assert_eq!(s.parameters, [("spp".to_string(), "64".to_string())]);
}

#[test]
fn opaque_looks_are_black_from_behind_unless_twosided() {
    let s = scene(
        "<bsdf type='twosided' id='both'><bsdf type='diffuse'><rgb name='reflectance' value='#ff0080'/></bsdf></bsdf>\
         <shape type='cube'><ref id='both'/></shape><shape type='cube'><bsdf type='plastic'/></shape>",
    );
    let look = |i: usize| &s.materials[s.objects[i].material as usize];
    assert!(!look(0).one_sided && look(1).one_sided);
    let Surface::Diffuse { albedo } = look(0).surface else { panic!() };
    // 0x80 of the screen is 0.2158 (IEC 61966-2-1).
    assert!((albedo.0[0], albedo.0[1]) == (1.0, 0.0) && (albedo.0[2] - 0.2158).abs() < 1e-4);
    assert!(matches!(look(1).surface, Surface::Plastic { .. }));
}

#[test]
fn a_rectangle_shines_along_its_normal() {
    let light = |flip: bool, scale: &str| {
        let s = scene(&format!(
            "<shape type='rectangle'><boolean name='flip_normals' value='{flip}'/><transform name='to_world'>\
             <scale {scale}/></transform><emitter type='area'><rgb name='radiance' value='3'/></emitter></shape>"
        ));
        match s.lights[0].1 {
            Light::Rectangle(r) => (r.u.cross(r.v).normalize().z, r.radiance),
            ref other => panic!("{other:?}"),
        }
    };
    assert_eq!(light(false, "value='2'"), (1.0, Rgb::grey(3.0)));
    assert_eq!(light(true, "value='2'").0, -1.0);
    // Mirrored in x its normal stays.
    assert_eq!(light(false, "x='-1'").0, 1.0);
}

#[test]
fn meshes_are_smooth_unless_they_ask_for_faces() {
    let ply = |more: &str| {
        let s = scene(&format!(
            "<shape type='ply'><string name='filename' value='fold.ply'/>{more}</shape>{BALL}"
        ));
        s.meshes[0].clone()
    };
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let n = ply("").normals.unwrap();
    assert!(n[0].iter().zip([0.0, half, half]).all(|(a, b)| (a - b).abs() < 1e-6), "{n:?}");
    assert!(ply("<boolean name='face_normals' value='true'/>").normals.is_none());
    let flipped = ply("<boolean name='flip_normals' value='true'/>");
    assert_eq!(flipped.triangles.indices[0], [0, 2, 1]);
    assert!(flipped.normals.unwrap()[2][2] < 0.0);
    let turned = ply("<boolean name='flip_tex_coords' value='true'/>");
    assert_eq!(turned.uvs[0].as_ref().unwrap()[0], [0.0, 1.0]);
}

#[test]
fn a_mask_lets_its_share_pass() {
    let s = scene(
        "<shape type='cube'><bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'/></bsdf></shape>",
    );
    let look = &s.materials[s.objects[0].material as usize];
    assert_eq!((look.alpha, look.opacity), (Alpha::Blend, 0.25));
}

#[test]
fn a_mask_by_texture_keeps_both_pictures_as_they_are() {
    let fields = |name: &str, scale: u32| {
        format!(
            "<texture name='{name}' type='checkerboard'><rgb name='color0' value='0,1,0'/><transform name='to_uv'>\
             <scale value='{scale}'/></transform></texture>"
        )
    };
    let inner = format!("<bsdf type='diffuse'>{}</bsdf>", fields("reflectance", 2));
    let s = scene(&format!(
        "<shape type='cube'><bsdf type='mask'>{}{inner}</bsdf></shape>",
        fields("opacity", 7)
    ));
    let look = &s.materials[s.objects[0].material as usize];
    let [color, cover] = [look.color, look.cover].map(|id| &s.textures[id.unwrap() as usize]);
    assert_eq!((color.map[0], cover.map[0]), (2.0, 7.0));
    assert_eq!((color.image.texel(0, 0), cover.image.texel(0, 0)[0]), ([0.0, 1.0, 0.0, 1.0], 0.7152));
    assert_eq!((look.alpha, look.opacity), (Alpha::Blend, 1.0));
}

/// The look of a cube with this bsdf, without a warning but for what the scene lacks.
fn look_of(bsdf: &str) -> (SceneBuilder, antumbra::scene::Material) {
    let s = scene(&format!("<shape type='cube'>{bsdf}</shape>{BALL}"));
    assert!(warnings(&s).iter().all(|w| w.contains("no emitter") || w.contains("no sensor")), "{bsdf}");
    let look = s.materials[s.objects[0].material as usize].clone();
    (s, look)
}

#[test]
fn numbers_of_a_look_may_be_textures() {
    let fields = |name: &str| {
        format!("<texture name='{name}' type='checkerboard'><rgb name='color0' value='0,1,0'/></texture>")
    };
    for plugin in ["roughconductor", "roughdielectric", "roughplastic"] {
        let (s, look) = look_of(&format!("<bsdf type='{plugin}'>{}</bsdf>", fields("alpha")));
        let roughness = look.roughness.unwrap();
        let image = &s.textures[roughness.channel.texture as usize].image;
        // Green counts by its luminance.
        assert_eq!((roughness.squared, image.texel(0, 0)[0]), (false, 0.7152), "{plugin}");
        assert_eq!(look.surface.facets().unwrap().alpha(), [1.0; 2]);
    }
    let (s, look) =
        look_of(&format!("<bsdf type='principled'>{}{}</bsdf>", fields("metallic"), fields("roughness")));
    let (metal, rough) = (look.metallic.unwrap(), look.roughness.unwrap());
    assert!(s.textures[metal.texture as usize].image.texel(0, 0)[0] == 0.7152 && rough.squared);
    for plugin in ["plastic", "roughplastic", "dielectric", "roughdielectric", "thindielectric"] {
        let gloss = fields("specular_reflectance");
        let (s, look) = look_of(&format!("<bsdf type='{plugin}'>{gloss}</bsdf>"));
        assert_eq!(s.textures[look.gloss.unwrap() as usize].image.texel(0, 0), [0.0, 1.0, 0.0, 1.0]);
    }
    let half = "<float name='specular_reflectance' value='0.5'/>";
    let (_, look) = look_of(&format!("<bsdf type='plastic'>{half}</bsdf>"));
    assert!(matches!(look.surface, Surface::Plastic { gloss: Rgb([0.5, 0.5, 0.5]), .. }));
}

#[test]
fn a_bumpmap_has_heights_and_a_scale() {
    let heights =
        "<texture type='checkerboard'><transform name='to_uv'><scale value='3'/></transform></texture>";
    let scale = "<float name='scale' value='0.25'/><boolean name='use_shadowing_function' value='false'/>";
    let inner = "<bsdf type='diffuse'/>";
    let (s, look) =
        look_of(&format!("<bsdf type='twosided'><bsdf type='bumpmap'>{heights}{scale}{inner}</bsdf></bsdf>"));
    let bump = look.bump.unwrap();
    assert_eq!((bump.scale, s.textures[bump.texture as usize].map[0]), (0.25, 3.0));
    assert!(matches!(look.surface, Surface::Diffuse { .. }) && !look.one_sided);
    let error = refused(&format!("<shape type='cube'><bsdf type='bumpmap'>{inner}</bsdf></shape>"));
    assert!(error.contains("needs a texture of heights"), "{error}");
}

#[test]
fn a_spot_falls_off_linearly() {
    let s = scene(&format!(
        "{BALL}<emitter type='spot'><float name='cutoff_angle' value='40'/><float name='beam_width' value='10'/></emitter>"
    ));
    assert!(s.messages.iter().all(|m| m.text.contains("sensor")), "{:?}", s.messages);
    let Light::Spot(spot) = &s.lights[0].1 else { panic!("{:?}", s.lights[0]) };
    assert_eq!(spot.edge, antumbra::light::SpotEdge::Linear);
}

#[test]
fn a_blend_has_two_looks_and_a_weight() {
    let cube = |bsdf: &str| {
        let s = scene(&format!("<shape type='cube'>{bsdf}</shape>{BALL}"));
        assert!(warnings(&s).iter().all(|w| w.contains("no emitter") || w.contains("no sensor")), "{bsdf}");
        let look = s.materials[s.objects[0].material as usize].clone();
        (s, look)
    };
    let mirror = "<bsdf type='conductor'/>";
    let blend = |weight: &str, first: &str| format!("<bsdf type='blendbsdf'>{weight}{first}{mirror}</bsdf>");
    let weight = "<float name='weight' value='0.25'/>";
    let (s, look) = cube(&blend(weight, "<bsdf type='diffuse'/>"));
    let Surface::Blend { first, second, weight: 0.25 } = look.surface else { panic!("{look:?}") };
    let part = |s: &SceneBuilder, id: u32| s.materials[id as usize].clone();
    assert!(matches!(part(&s, first).surface, Surface::Diffuse { .. }) && part(&s, first).one_sided);
    assert!(matches!(part(&s, second).surface, Surface::Mirror { .. }));
    // Two-sided, each part is.
    let both = blend(weight, "<bsdf type='diffuse'/>");
    let (s, look) = cube(&format!("<bsdf type='twosided'>{both}</bsdf>"));
    let Surface::Blend { first, second, .. } = look.surface else { panic!("{look:?}") };
    assert!(!part(&s, first).one_sided && !part(&s, second).one_sided);
    // Three quarters of nothing and a quarter of a mirror: three quarters of the rays pass.
    let (_, look) = cube(&blend(weight, "<bsdf type='null'/>"));
    assert_eq!((look.alpha, look.opacity), (Alpha::Blend, 0.25));
    assert!(matches!(look.surface, Surface::Blend { weight: 1.0, .. }));
    // A texture weighs by its luminance, 0.7152 for green.
    let fields = "<texture name='weight' type='checkerboard'><rgb name='color0' value='0,1,0'/></texture>";
    let (s, look) = cube(&blend(fields, "<bsdf type='diffuse'/>"));
    let texture = &s.textures[look.blend.unwrap() as usize];
    assert_eq!([texture.image.texel(0, 0)[0], texture.image.texel(1, 0)[0]], [0.7152, 0.2]);
    let error = refused("<shape type='cube'><bsdf type='blendbsdf'><bsdf type='diffuse'/></bsdf></shape>");
    assert!(error.contains("needs two bsdfs"), "{error}");
}

#[test]
fn a_second_bsdf_of_twosided_is_the_back() {
    let s = scene(
        "<shape type='cube'><bsdf type='twosided'><bsdf type='diffuse'/><bsdf type='conductor'/></bsdf></shape>",
    );
    let look = &s.materials[s.objects[0].material as usize];
    let back = &s.materials[look.back.unwrap() as usize];
    assert!(
        matches!(look.surface, Surface::Diffuse { .. }) && matches!(back.surface, Surface::Mirror { .. })
    );
    assert!(!look.one_sided && !back.one_sided);
    let third = "<bsdf type='diffuse'/>".repeat(3);
    let error = refused(&format!("<shape type='cube'><bsdf type='twosided'>{third}</bsdf></shape>"));
    assert!(error.contains("more than two bsdfs"), "{error}");
}

#[test]
fn what_is_not_read_is_named_once_with_its_line() {
    let s = scene(&format!(
        "{BALL}\n<shape type='klein_bottle'/>\n<shape type='sphere'><float name='wobble' value='1'/></shape>\n\
         <bsdf type='hair' id='h'/><shape type='sphere'><ref id='h'/></shape>\n<emitter type='constant'/>\
         <sensor type='perspective'/>"
    ));
    let said = warnings(&s);
    assert!(said[0].starts_with("line 3, column 1: shape \"klein_bottle\" is a plugin"), "{said:?}");
    assert!(said[1].starts_with("line 4, column 22: \"wobble\" of shape \"sphere\" is not read"), "{said:?}");
    assert!(
        said[2].contains("bsdf \"hair\"") && said[2].ends_with("drawn grey") && said.len() == 3,
        "{said:?}"
    );
    assert_eq!(s.objects.len(), 3);
}

#[test]
fn old_files_and_broken_ones_say_where() {
    let old = read(Format::Mitsuba, b"<scene version='0.6.0'/>", &MemoryFiles::default(), &Limits::default());
    let old = old.unwrap_err();
    assert!(old.what.contains("Mitsuba 0.6.0") && old.place == "line 1, column 1", "{old}");
    assert!(old.hint.contains("upgrades"));
    for (inside, told) in [
        (
            "<shape type='sphere'><float name='radius' value='1,2'/></shape>",
            "line 2, column 22: \"value\" of <float> has 2",
        ),
        ("<shape type='cube'><ref id='me'/></shape>", "nothing has the id \"me\""),
        ("<shape type='ply'/>", "shape \"ply\" has no \"filename\""),
        ("<shape type='ply'><string name='filename' value='../up.ply'/></shape>", "leaves the folder"),
        ("<shape type='ply'><string name='filename' value='/etc/passwd'/></shape>", "the path is absolute"),
        ("<include filename='../other.xml'/>", "leaves the folder"),
        ("<shape type='cube'><float name='x' value='$none'/></shape>", "$none has no value"),
        (
            "<bsdf type='twosided' id='a'><ref id='a'/></bsdf><shape type='cube'><ref id='a'/></shape>",
            "deep in each other",
        ),
        (
            "<bsdf id='a' type='diffuse'/><bsdf id='a' type='diffuse'/><shape type='cube'/>",
            "the id \"a\" is given twice",
        ),
        (
            "<shape type='cube'><transform name='to_world'><lookat origin='0,0,0' target='0,0,0'/></transform></shape>",
            "the same point",
        ),
        ("<emitter type='point'/>", "no shape in the scene"),
        (
            "<shape type='cube'><emitter type='area'><rgb name='radiance' value='-1'/></emitter></shape>",
            "must not be negative",
        ),
    ] {
        let said = refused(inside);
        assert!(said.contains(told), "{inside}: {said}");
    }
}

#[test]
fn hostile_files_end_quickly() {
    // Includes that fan out: each file draws in the next one many times.
    let fan: Vec<(String, String)> = (0..12)
        .map(|i| {
            (
                format!("{i}.xml"),
                format!(
                    "<scene version='3.0.0'>{}</scene>",
                    format!("<include filename='{}.xml'/>", i + 1).repeat(50)
                ),
            )
        })
        .chain([("12.xml".into(), "<scene version='3.0.0'><shape type='cube'/></scene>".into())])
        .collect();
    let files: Vec<(&str, &str)> = fan.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let said = with("<include filename='0.xml'/>", &files).unwrap_err();
    assert!(said.what.contains("out of proportion"), "{said}");
    // Two files that draw each other in.
    let mutual = [
        ("a.xml", "<scene version='3.0.0'><include filename='b.xml'/></scene>"),
        ("b.xml", "<scene version='3.0.0'><include filename='a.xml'/></scene>"),
    ];
    let said = with("<include filename='a.xml'/>", &mutual).unwrap_err();
    assert!(said.what.contains("includes itself"), "{said}");
    // Elements in elements, attributes of millions, values that double.
    let said = refused(&format!("{}{}", "<a>".repeat(100_000), "</a>".repeat(100_000)));
    assert!(said.contains("deep in each other") || said.contains("broken"), "{said}");
    let doubling: String =
        (0..40).map(|i| format!("<default name='n{}' value='$n{i}$n{i}'/>", i + 1)).collect();
    let said = refused(&format!("<default name='n0' value='xx'/>{doubling}{BALL}"));
    assert!(said.contains("too long"), "{said}");
}

#[test]
fn a_sensor_that_mirrors_sees_mirrored() {
    for (scale, mirrored) in [("1", false), ("-1", true)] {
        let s = scene(&format!(
            "<sensor type='perspective'><float name='fov' value='90'/><transform name='to_world'><scale x='{scale}'/>\
             <lookat origin='1,2,3' target='1,2,0' up='0,1,0'/></transform></sensor>{BALL}"
        ));
        assert_eq!(s.cameras[0].mirrored, mirrored);
    }
}
