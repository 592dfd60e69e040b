//! Groups of shapes and their instances; other names and other folders.

use antumbra::render::{Picture, render};
use antumbra::scene::{Body, SceneBuilder};
use antumbra::schedule::Flow;
use antumbra::settings::Settings;

use crate::{PLY, refused, scene, warnings, with};

/// A small picture.
pub fn picture(scene: SceneBuilder) -> Picture {
    let mut settings = Settings::default();
    for (name, value) in
        [("size", "32x24"), ("viewing_rays", "2"), ("filter", "box"), ("estimator", "mis"), ("bounces", "2")]
    {
        settings.set(name, value).unwrap();
    }
    render(&scene.build().unwrap(), &settings, None, &mut |_| Flow::Continue).unwrap()
}

/// Light and a view of the shapes about the origin.
pub const STAGE: &str = "<emitter type='constant'/><emitter type='point'><point name='position' value='1,3,4'/>\
    </emitter><sensor type='perspective'><transform name='to_world'><lookat origin='1,2,9' target='0,0,0' up='0,1,0'/>\
    </transform></sensor>";

fn moved(steps: &str) -> String {
    format!("<transform name='to_world'>{steps}</transform>")
}

fn parts(steps: &str) -> String {
    let look = "<bsdf type='diffuse'><rgb name='reflectance' value='.8,.3,.1'/></bsdf>";
    let smooth = moved(&format!("<scale value='2'/>{steps}"));
    format!(
        "<shape type='ply'><string name='filename' value='fold.ply'/>{look}{smooth}</shape>\
         <shape type='sphere'>{}</shape><shape type='rectangle'>{}</shape>",
        moved(&format!("<translate y='1'/>{steps}")),
        moved(&format!("<scale x='-1'/><translate x='-1'/>{steps}"))
    )
}

/// Whatever an instance does, its picture is that of the shapes with its transform behind their own, to the last bit.
#[test]
fn an_instance_is_its_shapes_in_another_place() {
    let places = [
        "<rotate y='1' angle='40'/><translate x='-2' y='-1'/>",
        "<rotate z='1' angle='-70'/><scale x='0.5' y='1.5' z='1'/><translate x='2'/>",
        "<scale value='0.5'/><translate y='2'/>",
    ];
    let instances =
        places.map(|p| format!("<shape type='instance'><ref id='all'/>{}</shape>", moved(p))).concat();
    let group = format!("<shape type='shapegroup' id='all'>{}</shape>", parts(""));
    let grouped = scene(&format!("{STAGE}{group}{instances}"));
    assert_eq!(warnings(&grouped), Vec::<String>::new());
    let flat = scene(&format!("{STAGE}{}", places.map(parts).concat()));
    assert_eq!((grouped.objects.len(), grouped.meshes.len()), (flat.objects.len(), flat.meshes.len()));
    // One ball is squeezed and so a mesh.
    let round = grouped.objects.iter().filter(|o| matches!(o.body, Body::Shape(_))).count();
    assert_eq!(round, 2);
    let (a, b) = (picture(grouped), picture(flat));
    let same = a.pixels.iter().flatten().zip(b.pixels.iter().flatten()).filter(|(a, b)| a == b).count();
    // Steps of a transform are joined in another order: a rounding of f64 may move an f32 corner by its last bit.
    assert!(same * 100 >= a.pixels.len() * 3 * 99, "{same} of {}", a.pixels.len() * 3);
    let merged = format!("<shape type='merge'>{}</shape>", parts(""));
    let (a, b) =
        (picture(scene(&format!("{STAGE}{merged}"))), picture(scene(&format!("{STAGE}{}", parts("")))));
    assert_eq!(a.pixels, b.pixels);
}

/// An instance that stays in place, or is moved by whole numbers, is the flat scene to the last bit.
#[test]
fn an_instance_moved_by_whole_numbers_is_the_same_to_the_bit() {
    let step = "<translate x='-2' y='1'/>";
    let group = format!("<shape type='shapegroup' id='all'>{}</shape>", parts(""));
    let instance = format!("<shape type='instance' id='one'><ref id='all'/>{}</shape>", moved(step));
    let grouped = scene(&format!("{STAGE}{group}{instance}"));
    assert!(grouped.objects.iter().all(|o| o.name == "one"));
    let flat = scene(&format!("{STAGE}{}", parts(step)));
    assert_eq!(picture(grouped).pixels, picture(flat).pixels);
}

#[test]
fn a_group_alone_draws_nothing_and_none_holds_itself() {
    let group = "<shape type='shapegroup' id='g'><shape type='cube'/></shape>";
    assert!(refused(group).contains("no shape in the scene"));
    for (inside, told) in [
        ("<shape type='instance'/>", "needs one shapegroup, 0 are here"),
        ("<shape type='cube' id='c'/><shape type='instance'><ref id='c'/></shape>", "a shapegroup is needed"),
        (
            "<shape type='shapegroup' id='g'><shape type='instance'><ref id='g'/></shape></shape>\
             <shape type='instance'><ref id='g'/></shape>",
            "an instance within a shapegroup",
        ),
        ("<shape type='merge' id='m'><ref id='m'/></shape>", "in themselves"),
    ] {
        let said = refused(inside);
        assert!(said.contains(told), "{inside}: {said}");
    }
    // Merges of merges that double at each step.
    let fan: String = (0..15)
        .map(|i| {
            format!("<shape type='merge' id='m{i}'>{}</shape>", format!("<ref id='m{}'/>", i + 1).repeat(40))
        })
        .collect();
    let said = refused(&format!("{fan}<shape type='merge' id='m15'><shape type='cube'/></shape>"));
    assert!(said.contains("out of proportion"), "{said}");
}

/// Each head asks for 2¹⁴ materials.
#[test]
fn a_fan_of_looks_is_refused() {
    let fan: String = (0..14)
        .map(|i| {
            format!("<bsdf type='twosided' id='a{i}'>{}</bsdf>", format!("<ref id='a{}'/>", i + 1).repeat(2))
        })
        .collect();
    let heads = "<shape type='cube'><bsdf type='twosided'><ref id='a0'/></bsdf></shape>".repeat(40);
    let said = refused(&format!("{fan}<bsdf type='diffuse' id='a14'/>{heads}"));
    assert!(said.contains("out of proportion"), "{said}");
}

/// However its path is spelled, and whatever is asked of it.
#[test]
fn a_file_brings_room_once() {
    let many = |name: &dyn Fn(usize) -> String| {
        let looks: String = (0..3000)
            .map(|i| {
                format!(
                    "<shape type='ply'><string name='filename' value='{}'/><bsdf type='diffuse'>\
                     <texture type='mesh_attribute' name='reflectance'><string name='name' value='vertex_{i}'/>\
                     </texture></bsdf></shape>",
                    name(i)
                )
            })
            .collect();
        let body = "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n".repeat(2000);
        let head = PLY.split("0 0 0 0 0").next().unwrap();
        let head = head.replace("vertex 4", "vertex 6000").replace("face 2", "face 1");
        let bytes = format!("{head}{body}3 0 1 2\n");
        with(&looks, &[("big.ply", bytes)]).map(|_| ()).map_err(|e| format!("{}: {}", e.place, e.what))
    };
    for spelled in [&|_| "big.ply".into(), &|i| format!("{}big.ply", "./".repeat(i % 50))]
        as [&dyn Fn(usize) -> String; 2]
    {
        let said = many(spelled).unwrap_err();
        assert!(said.contains("out of proportion"), "{said}");
    }
}

#[test]
fn an_alias_is_another_name() {
    let s = scene(
        "<bsdf type='conductor' id='a'/><alias id='a' as='b'/><alias id='b' as='c'/>\
         <shape type='cube'><ref id='c'/></shape><shape type='cube'><ref id='a'/></shape>",
    );
    assert_eq!(s.objects[0].material, s.objects[1].material);
    for (inside, told) in [
        ("<alias id='a' as='b'/><shape type='cube'/>", "nothing has the id \"a\""),
        ("<bsdf type='diffuse' id='a'/><alias id='a' as='a'/><shape type='cube'/>", "given twice"),
        ("<alias id='a'/><shape type='cube'/>", "needs \"id\" and \"as\""),
    ] {
        let said = refused(inside);
        assert!(said.contains(told), "{inside}: {said}");
    }
}

#[test]
fn a_path_is_a_folder_to_look_in_first() {
    let ply = "<shape type='ply'><string name='filename' value='fold.ply'/></shape>";
    let triangle = PLY.replace("element face 2", "element face 1");
    let files = [("fold.ply", PLY), ("parts/fold.ply", triangle.as_str())];
    let triangles = |inside: &str| with(inside, &files).unwrap().meshes[0].triangles.indices.len();
    assert_eq!(triangles(ply), 2);
    assert_eq!(triangles(&format!("<path value='parts'/>{ply}")), 1);
    assert_eq!(triangles(&format!("<path value='parts'/><path value='none'/>{ply}")), 1);
    for folder in ["/usr", "../up", "https://example.org"] {
        let said = refused(&format!("<path value='{folder}'/>{ply}"));
        assert!(said.contains("of <path>") && said.starts_with("line 2, column 1"), "{said}");
    }
}
